#include "plugin_manager.hpp"

#include "plugin_library.hpp"

#include <jet/ui/panel.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <dlfcn.h>

namespace jet::host {

namespace fs = std::filesystem;

fs::path builtInPluginFolder()
{
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&builtInItemType), &info) == 0 || !info.dli_fname) return {};
    std::error_code ignored;
    return fs::canonical(info.dli_fname, ignored).parent_path() / "jet" / "plugins";
}

fs::path userPluginFolder()
{
    if (const char* data = std::getenv("XDG_DATA_HOME"); data && *data) return fs::path(data) / "jet" / "plugins";
    const char* home = std::getenv("HOME");
    return home && *home ? fs::path(home) / ".local" / "share" / "jet" / "plugins" : fs::path();
}

PluginManager::PluginManager(PluginOptions options) : options_(std::move(options)), settingsStore_(options_.settings) {}
PluginManager::~PluginManager() = default;

void PluginManager::scan()
{
    for (const fs::path& folder : options_.searchPath) {
        const bool foreign = !options_.builtIn.empty() && folder != options_.builtIn;
        if (!(options_.safeMode && foreign)) readFolder(folder);
    }
    resolve();
    buildIndex();
}

void PluginManager::readFolder(const fs::path& folder)
{
    std::error_code problem;
    std::vector<fs::path> candidates;
    for (const auto& entry : fs::directory_iterator(folder, problem)) candidates.push_back(entry.path());
    if (fs::exists(folder / "plugin.json", problem))
        candidates.push_back(folder);  // --plugin-path may name one plugin itself
    std::sort(candidates.begin(), candidates.end());
    for (const fs::path& candidate : candidates) {
        const fs::path file = candidate / "plugin.json";
        if (!fs::exists(file, problem)) continue;
        auto plugin = std::make_unique<Plugin>();
        plugin->folder = candidate;
        if (auto manifest = Manifest::read(file)) {
            plugin->manifest = std::move(*manifest);
            plugin->state = PluginState::Valid;
        } else {
            plugin->manifest.id = candidate.filename().string();
            plugin->manifest.name = plugin->manifest.id;
            plugin->state = PluginState::Faulted;
            plugin->reason = manifest.error().text();
        }
        if (!options_.without.contains(plugin->manifest.id)) adopt(std::move(plugin));
    }
}

void PluginManager::adopt(std::unique_ptr<Plugin> plugin)
{
    auto& place = plugins_[plugin->manifest.id];
    const auto rank = [](const Plugin& p) { return std::pair(p.state != PluginState::Faulted, p.manifest.version); };
    if (place && rank(*plugin) > rank(*place)) std::swap(place, plugin);
    if (!place) {
        place = std::move(plugin);
        return;
    }
    // A broken manifest stays worth telling, even where another copy of the plugin works.
    if (plugin->state != PluginState::Faulted) {
        plugin->state = PluginState::Shadowed;
        plugin->reason =
            "version " + place->manifest.version.text() + " in " + place->folder.string() + " is used instead";
    }
    shadowed_.push_back(std::move(plugin));
}

void PluginManager::resolve()
{
    for (auto& [id, plugin] : plugins_) {
        if (plugin->state != PluginState::Valid) continue;
        if (options_.disabled.contains(id)) {
            plugin->state = PluginState::Disabled;
            plugin->reason = "switched off; 'jet plugins enable " + id + "' switches it on";
        } else if (options_.only && !options_.only->contains(id)) {
            plugin->state = PluginState::Disabled;
            plugin->reason = "not in the chosen plugin set";
        } else if (const auto built = checkBuild(plugin->manifest); !built) {
            plugin->state = PluginState::Faulted;
            plugin->reason = built.error().message;
        }
    }
    for (auto& [id, plugin] : plugins_) {
        std::vector<const Plugin*> chain;
        resolve(*plugin, chain);
    }
}

void PluginManager::resolve(Plugin& plugin, std::vector<const Plugin*>& chain)
{
    if (plugin.state != PluginState::Valid) return;
    const auto fault = [&](std::string reason) {
        plugin.state = PluginState::Faulted;
        plugin.reason = std::move(reason);
    };
    const auto path = [&](const std::string& last) {
        std::string text;
        for (const Plugin* link : chain) text += link->manifest.id + " → ";
        return text + last;
    };
    chain.push_back(&plugin);
    for (const Dependency& need : plugin.manifest.requires_) {
        const auto found = plugins_.find(need.id);
        const auto inChain =
            std::find_if(chain.begin(), chain.end(), [&](const Plugin* p) { return p->manifest.id == need.id; });
        if (inChain != chain.end()) {
            fault("it depends on itself: " + path(need.id) + "; remove one of these requirements");
        } else if (found == plugins_.end()) {
            fault("it requires " + need.id + " (" + path(need.id) + "), which is not installed; install it");
        } else if (need.minimum != Version{} && !need.admits(found->second->manifest.version)) {
            fault("it requires " + need.id + " " + need.minimum.text() + " or a later " +
                  std::to_string(need.minimum.major) + ".x, version " + found->second->manifest.version.text() +
                  " is installed; install a matching one");
        } else {
            resolve(*found->second, chain);
            if (plugin.state == PluginState::Valid && !found->second->usable())
                fault("it requires " + need.id + ", which is " + std::string(stateName(found->second->state)) + " (" +
                      found->second->reason + ")");
        }
        if (plugin.state != PluginState::Valid) break;
    }
    chain.pop_back();
    if (plugin.state == PluginState::Valid) plugin.state = PluginState::Resolved;
}

void PluginManager::buildIndex()
{
    // Usable plugins first, so that an unusable one answers only for what nobody else offers.
    for (const bool usable : {true, false})
        for (auto& [id, plugin] : plugins_) {
            if (plugin->usable() != usable) continue;
            for (const Contribution& one : plugin->manifest.contributions) {
                index_.emplace(Key{one.kind, one.id}, plugin.get());
                for (const std::string& extension : one.extensions) formats_.emplace(Key{one.kind, extension}, one.id);
            }
        }
}

std::vector<const Plugin*> PluginManager::plugins() const
{
    std::vector<const Plugin*> all;
    for (const auto& [id, plugin] : plugins_) all.push_back(plugin.get());
    for (const auto& plugin : shadowed_) all.push_back(plugin.get());
    return all;
}

const Plugin* PluginManager::plugin(std::string_view id) const
{
    const auto found = plugins_.find(id);
    return found == plugins_.end() ? nullptr : found->second.get();
}

std::vector<std::string> PluginManager::problems() const
{
    std::vector<std::string> list;
    for (const Plugin* plugin : plugins())
        if (plugin->state == PluginState::Faulted)
            list.push_back("The plugin " + plugin->manifest.id + " is not used: " + plugin->reason);
    return list;
}

Result<void> PluginManager::load(std::string_view id)
{
    const auto found = plugins_.find(id);
    if (found == plugins_.end())
        return Error("there is no plugin '" + std::string(id) + "'; 'jet plugins list' shows all");
    loadOrFault(*found->second);
    if (found->second->usable()) return {};
    return Error("the plugin " + found->second->title() + " is " + std::string(stateName(found->second->state)) + ": " +
                 found->second->reason);
}

void PluginManager::loadOrFault(Plugin& plugin)
{
    if (plugin.state != PluginState::Resolved) return;
    for (const Dependency& need : plugin.manifest.requires_) {
        Plugin& other = *plugins_.find(need.id)->second;
        loadOrFault(other);
        if (other.usable()) continue;
        plugin.state = PluginState::Faulted;
        plugin.reason = "it requires " + need.id + ", which failed: " + other.reason;
        return;
    }
    const auto before = std::chrono::steady_clock::now();
    Registrations registrations;
    registrations.openSettings = [&](std::string_view page, const PropertyTable& table) {
        return settingsStore_.page(plugin.manifest.id, std::string(page), table);
    };
    auto opened = PluginLibrary::open(plugin, registrations);
    Result<void> fine = opened ? checkRegistrations(plugin.manifest, registrations) : Result<void>(opened.error());
    plugin.loadMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count();
    if (!fine) {
        plugin.state = PluginState::Faulted;
        plugin.reason = fine.error().message;
        if (guard_.onProblem)
            guard_.onProblem({plugin.manifest.id, "load",
                              "the plugin " + plugin.title() + " cannot be used: " + plugin.reason, plugin.reason});
        return;
    }
    plugin.library = std::move(*opened);
    plugin.mapped = plugin.folder / (plugin.manifest.library + ".so");
    plugin.registrations = std::move(registrations);
    plugin.state = PluginState::Loaded;
}

Plugin* PluginManager::providerOf(ContributionKind kind, std::string_view id) const
{
    const auto found = index_.find(Key{kind, std::string(id)});
    return found == index_.end() ? nullptr : found->second;
}

std::string PluginManager::findFormat(ContributionKind kind, std::string_view extension) const
{
    const auto found = formats_.find(Key{kind, std::string(extension)});
    return found == formats_.end() ? std::string() : found->second;
}

Plugin* PluginManager::ready(ContributionKind kind, std::string_view id)
{
    Plugin* plugin = providerOf(kind, id);
    if (!plugin) return nullptr;
    loadOrFault(*plugin);
    if (!plugin->usable()) return nullptr;
    plugin->state = PluginState::Active;
    return plugin;
}

std::vector<Contribution> PluginManager::contributions(ContributionKind kind) const
{
    std::vector<Contribution> list;
    for (const auto& [key, plugin] : index_) {
        if (key.first != kind || !plugin->usable()) continue;
        for (const Contribution& one : plugin->manifest.contributions) {
            if (one.kind != kind || one.id != key.second) continue;
            list.push_back(one);
            if (!one.icon.empty()) list.back().icon = (plugin->folder / one.icon).string();
        }
    }
    std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.order < b.order; });
    return list;
}

template <class T, class Map>
T* PluginManager::shared(Table<T>& table, ContributionKind kind, std::string_view id, Map Registrations::*factories)
{
    auto found = table.find(id);
    if (found == table.end()) {
        Shared<T> made;
        if (Plugin* plugin = ready(kind, id)) {
            const auto factory = (plugin->registrations.*factories).find(id);
            auto own = guard_.call(
                *plugin, "factory", [&] { return factory->second(); }, std::shared_ptr<T>());
            if (own) made = {guarded(guard_, *plugin, std::move(own)), plugin};
        }
        // Objects stay valid while the manager lives; "nothing" is remembered, too: a failed plugin is not asked again.
        found = table.emplace(id, std::move(made)).first;
    }
    const Shared<T>& shared = found->second;
    return shared.plugin && shared.plugin->usable() ? shared.object.get() : nullptr;
}

template <class Get>
auto PluginManager::firstWorking(ContributionKind kind, Get&& get) -> decltype(get(std::string()))
{
    for (const Contribution& one : contributions(kind))
        if (auto* engine = get(one.id)) return engine;
    return nullptr;
}

const ItemType* PluginManager::itemType(std::string_view id)
{
    if (const ItemType* builtIn = builtInItemType(id)) return builtIn;
    return shared(itemTypes_, ContributionKind::ItemType, id, &Registrations::itemTypes);
}
const Effect* PluginManager::effect(std::string_view id)
{
    return shared(effects_, ContributionKind::Effect, id, &Registrations::effects);
}
Importer* PluginManager::importer(std::string_view extension)
{
    return shared(importers_, ContributionKind::Importer, findFormat(ContributionKind::Importer, extension),
                  &Registrations::importers);
}
Exporter* PluginManager::exporter(std::string_view extension)
{
    return shared(exporters_, ContributionKind::Exporter, findFormat(ContributionKind::Exporter, extension),
                  &Registrations::exporters);
}

PhysicsEngine* PluginManager::physicsEngine(std::string_view id)
{
    if (id.empty())
        return firstWorking(ContributionKind::PhysicsEngine,
                            [this](const std::string& any) { return physicsEngine(any); });
    return shared(physicsEngines_, ContributionKind::PhysicsEngine, id, &Registrations::physicsEngines);
}

ScriptEngine* PluginManager::scriptEngine(std::string_view id)
{
    if (id.empty())
        return firstWorking(ContributionKind::ScriptEngine,
                            [this](const std::string& any) { return scriptEngine(any); });
    return shared(scriptEngines_, ContributionKind::ScriptEngine, id, &Registrations::scriptEngines);
}

Command* PluginManager::command(std::string_view id)
{
    return shared(commands_, ContributionKind::Command, id, &Registrations::commands);
}

std::shared_ptr<Settings> PluginManager::settings(std::string_view page)
{
    Plugin* plugin = ready(ContributionKind::SettingsPage, page);
    return plugin ? plugin->registrations.settings.find(page)->second : nullptr;
}

std::unique_ptr<Tool> PluginManager::createTool(std::string_view id, ToolHost& host)
{
    Plugin* plugin = ready(ContributionKind::Tool, id);
    if (!plugin) return nullptr;
    const auto factory = plugin->registrations.tools.find(id);
    auto tool = guard_.call(
        *plugin, "factory", [&] { return factory->second(host); }, std::unique_ptr<Tool>());
    return tool ? guarded(guard_, *plugin, std::move(tool), host) : nullptr;
}

std::unique_ptr<Panel> PluginManager::createPanel(std::string_view id, Editor& editor)
{
    Plugin* plugin = ready(ContributionKind::Panel, id);
    if (!plugin) return nullptr;
    const auto factory = plugin->registrations.panels.find(id);
    auto panel = guard_.call(
        *plugin, "factory", [&] { return factory->second(editor); }, std::unique_ptr<Panel>());
    return panel ? guarded(guard_, *plugin, std::move(panel), editor) : nullptr;
}

std::string PluginManager::explain(ContributionKind kind, std::string_view id) const
{
    const bool format = kind == ContributionKind::Importer || kind == ContributionKind::Exporter;
    std::string name = format ? findFormat(kind, id) : std::string(id);
    // Any engine would do: tell of one that is there and does not work.
    if (name.empty() && !format)
        for (const auto& [key, plugin] : index_)
            if (key.first == kind && (name.empty() || plugin->usable())) name = key.second;
    std::string what = std::string(kindName(kind)) + " '" + std::string(id) + "'";
    if (format) what = std::string(kindName(kind)) + " for ." + std::string(id) + " files";
    if (id.empty()) what = std::string(kindName(kind));
    const Plugin* plugin = name.empty() ? nullptr : providerOf(kind, name);
    if (!plugin)
        return "No installed plugin provides " + std::string(id.empty() ? "a " : "the ") + what +
               "; install one that does, or look at 'jet plugins list'.";
    if (plugin->usable()) return "The " + what + " comes from " + plugin->title() + ".";
    return "The " + what + " needs " + plugin->title() + ", which is " + std::string(stateName(plugin->state)) + ": " +
           plugin->reason + ".";
}

std::string PluginManager::provider(ContributionKind kind, std::string_view id) const
{
    const Plugin* plugin = providerOf(kind, id);
    return plugin ? plugin->manifest.id + " " + plugin->manifest.version.text() : std::string();
}

}  // namespace jet::host
