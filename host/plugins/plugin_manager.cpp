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
        const PluginOrigin origin = originOf(folder);
        if (!options_.safeMode || options_.builtIn.empty() || origin == PluginOrigin::BuiltIn)
            readFolder(folder, origin);
    }
    resolve();
}

PluginOrigin PluginManager::originOf(const fs::path& folder) const
{
    if (folder == options_.builtIn) return PluginOrigin::BuiltIn;
    return folder == userPluginFolder() ? PluginOrigin::User : PluginOrigin::Path;
}

std::vector<std::string> PluginManager::addFolder(const fs::path& folder, PluginOrigin origin)
{
    auto ids = readFolder(folder, origin);
    resolve();
    return ids;
}

std::vector<std::string> PluginManager::readFolder(const fs::path& folder, PluginOrigin origin)
{
    std::error_code problem;
    std::vector<fs::path> candidates;
    for (const auto& entry : fs::directory_iterator(folder, problem))
        if (entry.is_directory(problem)) candidates.push_back(entry.path());
    if (fs::exists(folder / "plugin.json", problem))
        candidates.push_back(folder);  // --plugin-path may name one plugin itself
    std::sort(candidates.begin(), candidates.end());
    std::vector<std::string> ids;
    for (const fs::path& candidate : candidates) {
        const fs::path file = candidate / "plugin.json";
        if (!fs::exists(file, problem) || !folders_.insert(candidate.native()).second) continue;
        auto plugin = std::make_unique<Plugin>();
        plugin->folder = candidate;
        plugin->origin = origin;
        if (auto manifest = Manifest::read(file)) {
            plugin->manifest = std::move(*manifest);
            plugin->state = PluginState::Valid;
        } else {
            plugin->manifest = Manifest::unreadable(file);
            plugin->broken = true;
            plugin->state = PluginState::Faulted;
            plugin->reason = manifest.error().text();
        }
        if (options_.without.contains(plugin->manifest.id)) continue;
        ids.push_back(plugin->manifest.id);
        adopt(std::move(plugin));
    }
    return ids;
}

void PluginManager::adopt(std::unique_ptr<Plugin> plugin)
{
    auto& place = plugins_[plugin->manifest.id];
    const auto rank = [this](const Plugin& p) {
        return std::tuple(!p.broken, isWanted(p), p.manifest.version, -static_cast<int>(p.origin));
    };
    if (place && rank(*plugin) > rank(*place)) std::swap(place, plugin);
    if (!place) {
        place = std::move(plugin);
        return;
    }
    // A broken manifest stays worth telling, even where another copy of the plugin works.
    if (!plugin->broken) {
        plugin->state = PluginState::Shadowed;
        plugin->reason =
            "version " + place->manifest.version.text() + " in " + place->folder.string() + " is used instead";
    }
    shadowed_.push_back(std::move(plugin));
}

bool PluginManager::isWanted(const Plugin& plugin) const
{
    const auto fits = [&](const std::optional<PluginSet>& set) {
        return !set || set->admits(plugin.manifest.id, plugin.manifest.version);
    };
    return fits(options_.set) && fits(options_.projectSet);
}

std::vector<std::string> PluginManager::chooseCopies()
{
    const std::set<std::string> before = usableOnes();
    std::map<std::string, const Plugin*> used;
    for (const auto& [id, plugin] : plugins_) used.emplace(id, plugin.get());
    std::vector<std::unique_ptr<Plugin>> copies = std::exchange(shadowed_, {});
    for (auto& copy : copies) {
        const auto place = plugins_.find(copy->manifest.id);
        if (place == plugins_.end() || place->second->library) {
            shadowed_.push_back(std::move(copy));
            continue;
        }
        if (copy->state == PluginState::Shadowed) {
            copy->state = PluginState::Valid;
            copy->reason.clear();
        }
        adopt(std::move(copy));
    }
    std::vector<std::string> changed = resolve(before);
    for (const auto& [id, plugin] : used)
        if (plugins_.find(id)->second.get() != plugin && std::find(changed.begin(), changed.end(), id) == changed.end())
            changed.push_back(id);
    return changed;
}

std::vector<std::string> PluginManager::useSet(std::optional<PluginSet> set)
{
    options_.set = std::move(set);
    return chooseCopies();
}

std::vector<std::string> PluginManager::setProjectSet(std::optional<PluginSet> set)
{
    options_.projectSet = std::move(set);
    return chooseCopies();
}

std::set<std::string> PluginManager::usableOnes() const
{
    std::set<std::string> usable;
    for (const auto& [id, plugin] : plugins_)
        if (plugin->usable()) usable.insert(id);
    return usable;
}

std::vector<std::string> PluginManager::resolve(const std::set<std::string>& usableBefore)
{
    resolvePlugins(plugins_, {options_.disabled, options_.set});
    buildIndex();
    const std::set<std::string> after = usableOnes();
    std::vector<std::string> changed;
    std::set_symmetric_difference(usableBefore.begin(), usableBefore.end(), after.begin(), after.end(),
                                  std::back_inserter(changed));
    return changed;
}

std::vector<std::string> PluginManager::removeFolder(const fs::path& folder)
{
    folders_.erase(folder.native());
    std::vector<std::unique_ptr<Plugin>> copies;
    const auto take = [&](std::unique_ptr<Plugin>& plugin) {
        if (plugin->folder != folder) return false;
        plugin->state = PluginState::Disabled;
        plugin->reason = "it was removed";
        removed_.push_back(std::move(plugin));  // its objects may still be in use
        return true;
    };
    std::erase_if(shadowed_, take);
    for (auto entry = plugins_.begin(); entry != plugins_.end();) {
        const std::string id = entry->first;
        if (!take(entry->second)) {
            ++entry;
            continue;
        }
        entry = plugins_.erase(entry);
        std::erase_if(shadowed_, [&](std::unique_ptr<Plugin>& copy) {
            if (copy->manifest.id != id) return false;
            copies.push_back(std::move(copy));
            return true;
        });
    }
    for (auto& copy : copies) {
        if (copy->state == PluginState::Shadowed) copy->state = PluginState::Valid;
        adopt(std::move(copy));
    }
    return resolve();
}

std::vector<std::string> PluginManager::setEnabled(const std::set<std::string>& ids, bool enabled)
{
    for (const std::string& id : ids) {
        if (!enabled) {
            options_.disabled.insert(id);
            continue;
        }
        options_.disabled.erase(id);
        if (options_.set) options_.set->letIn(id);
    }
    return resolve();
}

template <class T>
void PluginManager::retire(Table<T>& table, ContributionKind kind)
{
    std::erase_if(table, [&](auto& entry) {
        auto& [id, shared] = entry;
        if (shared.object && shared.plugin == providerOf(kind, id)) return false;
        if (shared.object) retired_.push_back(shared.object);
        return true;
    });
}

void PluginManager::buildIndex()
{
    index_.clear();
    formats_.clear();
    const auto add = [this](Plugin& plugin) {
        for (const Contribution& one : plugin.manifest.contributions) {
            index_.emplace(Key{one.kind, one.id}, &plugin);
            for (const std::string& extension : one.extensions) formats_.emplace(Key{one.kind, extension}, one.id);
        }
    };
    // Usable plugins first, so that an unusable one answers only for what nobody else offers.
    for (const bool usable : {true, false})
        for (auto& [id, plugin] : plugins_)
            if (plugin->usable() == usable) add(*plugin);
    for (auto& plugin : shadowed_) add(*plugin);
    retire(effects_, ContributionKind::Effect);
    retire(itemTypes_, ContributionKind::ItemType);
    retire(importers_, ContributionKind::Importer);
    retire(exporters_, ContributionKind::Exporter);
    retire(physicsEngines_, ContributionKind::PhysicsEngine);
    retire(scriptEngines_, ContributionKind::ScriptEngine);
    retire(commands_, ContributionKind::Command);
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
    for (std::string& notice : guard_.notices()) list.push_back(std::move(notice));
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
    if (plugin.state != PluginState::Resolved || plugin.loading) return;
    plugin.loading = true;  // an optional plugin may want this one, too
    loadRequirementsFirst(plugin);
    plugin.loading = false;
}

void PluginManager::loadRequirementsFirst(Plugin& plugin)
{
    for (const Dependency& need : plugin.manifest.requires_) {
        Plugin& other = *plugins_.find(need.id)->second;
        loadOrFault(other);
        if (other.usable()) continue;
        plugin.reason = "it requires " + need.id + ", which failed: " + other.reason;
        plugin.state = PluginState::Faulted;
        return;
    }
    for (const Dependency& wish : plugin.manifest.optional) {
        const auto found = plugins_.find(wish.id);
        if (found != plugins_.end() && wish.admits(found->second->manifest.version)) loadOrFault(*found->second);
    }
    const auto before = std::chrono::steady_clock::now();
    Registrations registrations;
    registrations.openSettings = [&](std::string_view page, const PropertyTable& table) {
        return settingsStore_.page(plugin.manifest.id, std::string(page), table);
    };
    if (!plugin.account)
        plugin.account =
            std::make_unique<CallAccount>(plugin, guard_, plugin.manifest.id + " " + plugin.manifest.version.text());
    auto opened = PluginLibrary::open(plugin.folder, plugin.manifest, *plugin.account,
                                      {options_.copyLibraries, options_.strictUnload}, registrations);
    Result<void> fine = opened ? checkRegistrations(plugin.manifest, registrations) : Result<void>(opened.error());
    plugin.loadMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count();
    if (!fine) {
        registrations = {};  // before the library, which may really go
        plugin.reason = fine.error().message;
        plugin.state = PluginState::Faulted;
        if (guard_.onProblem)
            guard_.onProblem({plugin.manifest.id, "load",
                              "the plugin " + plugin.title() + " cannot be used: " + plugin.reason, plugin.reason});
        return;
    }
    plugin.library = std::move(*opened);
    plugin.mapped = plugin.library->file();
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
                *plugin, Callback::Factory, [&] { return factory->second(); }, std::shared_ptr<T>());
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
        *plugin, Callback::Factory, [&] { return factory->second(host); }, std::unique_ptr<Tool>());
    return tool ? guarded(guard_, *plugin, std::move(tool), host) : nullptr;
}

std::unique_ptr<Panel> PluginManager::createPanel(std::string_view id, Editor& editor)
{
    Plugin* plugin = ready(ContributionKind::Panel, id);
    if (!plugin) return nullptr;
    const auto factory = plugin->registrations.panels.find(id);
    auto panel = guard_.call(
        *plugin, Callback::Factory, [&] { return factory->second(editor); }, std::unique_ptr<Panel>());
    return panel ? guarded(guard_, *plugin, std::move(panel), editor) : nullptr;
}

}  // namespace jet::host
