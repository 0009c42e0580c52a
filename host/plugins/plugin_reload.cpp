// Changes of a manager that has scanned already: plugins left out for this run, found later, reloaded, unloaded.
#include "host_call_watch.hpp"
#include "leftovers.hpp"
#include "plugin_library.hpp"
#include "plugin_manager.hpp"

#include <chrono>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

bool isInCall(const Plugin& plugin)
{
    if (!plugin.account) return false;
    for (const ThreadCalls& calls : CallBoard::memory().threads)
        for (std::uint32_t i = 0, n = std::min(calls.depth.load(), ThreadCalls::kDepth); i < n; ++i)
            if (calls.thread != 0 && calls.frames[i].plugin == plugin.account->place()) return true;
    return false;
}

}  // namespace

bool PluginManager::isInCall(std::string_view id) const
{
    const auto found = plugins_.find(id);
    return found != plugins_.end() && host::isInCall(*found->second);
}

void PluginManager::leaveOut(const std::vector<std::string>& ids, bool safeMode)
{
    options_.safeMode = options_.safeMode || safeMode;
    options_.without.insert(ids.begin(), ids.end());
    plugins_.clear();
    shadowed_.clear();
    folders_.clear();
    scan();
}

Result<std::string> PluginManager::takeIn(const fs::path& folder)
{
    auto manifest = Manifest::read(folder / "plugin.json");
    if (!manifest) return manifest.error();
    const std::string id = manifest->id;
    if (options_.without.contains(id)) return Error("the plugin " + id + " is left out of this run");
    if (const auto known = plugins_.find(id); known != plugins_.end()) {
        if (known->second->folder == folder) return id;
        return Error("the plugin " + id + " in " + folder.string() + " is not used: there is one in " +
                     known->second->folder.string() + "; the newer one is chosen at the next start");
    }
    auto plugin = std::make_unique<Plugin>();
    plugin->folder = folder;
    plugin->manifest = std::move(*manifest);
    plugin->state = PluginState::Valid;
    plugins_[id] = std::move(plugin);
    resolve();
    buildIndex();
    return id;
}

Result<void> PluginManager::reload(std::string_view id, const std::function<void()>& beforeSwap)
{
    const auto found = plugins_.find(id);
    if (found == plugins_.end())
        return Error("there is no plugin '" + std::string(id) + "'; 'jet plugins list' shows all");
    Plugin& plugin = *found->second;
    if (plugin.state == PluginState::Disabled)
        return Error("the plugin " + plugin.title() + " is " + std::string(stateName(plugin.state)) + ": " +
                     plugin.reason);
    if (host::isInCall(plugin))
        return Error("the plugin " + plugin.title() + " is in the middle of a call; reload it when that has returned");
    const auto keeps = [&](const std::string& reason) {
        return Error("the plugin " + plugin.title() + " was not reloaded" +
                     (plugin.library && plugin.usable() ? ", what was loaded before goes on" : "") + ": " + reason);
    };
    auto manifest = Manifest::read(plugin.folder / "plugin.json");
    if (!manifest) return keeps(manifest.error().text());
    if (manifest->id != plugin.manifest.id)
        return keeps("its plugin.json now has the id " + manifest->id + "; restart JET to use it under that");
    if (const auto fits = checkBuild(*manifest); !fits) return keeps(fits.error().message);
    if (const auto swapped = swapIn(plugin, std::move(*manifest), beforeSwap); !swapped)
        return keeps(swapped.error().message);
    return {};
}

// Everything that can fail comes before the first change.
Result<void> PluginManager::swapIn(Plugin& plugin, Manifest manifest, const std::function<void()>& beforeSwap)
{
    for (const Dependency& need : manifest.requires_) {
        const auto other = plugins_.find(need.id);
        if (other == plugins_.end()) return Error("it requires " + need.id + ", which is not installed; install it");
        loadOrFault(*other->second);
        if (!other->second->usable())
            return Error("it requires " + need.id + ", which failed: " + other->second->reason);
    }
    auto account = std::make_unique<CallAccount>(plugin, guard_, manifest.id + " " + manifest.version.text());
    Registrations registrations;
    registrations.openSettings = [&](std::string_view page, const PropertyTable& table) {
        return settingsStore_.page(plugin.manifest.id, std::string(page), table);
    };
    const auto before = std::chrono::steady_clock::now();
    auto opened = PluginLibrary::open(plugin.folder, manifest, *account, {true, options_.strictUnload}, registrations);
    if (!opened) return opened.error();
    if (const auto equal = checkRegistrations(manifest, registrations); !equal) {
        registrations = {};  // before the library, which may really go
        return equal;
    }
    if (beforeSwap) beforeSwap();
    plugin.loadMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count();

    const auto oldLibrary = std::exchange(plugin.library, std::move(*opened));
    // The old factories and objects go while their code and their account are still there.
    const auto oldAccount = plugin.account ? std::exchange(plugin.account, nullptr) : nullptr;
    plugin.account = std::move(account);
    plugin.mapped = plugin.library->file();
    std::swap(plugin.registrations, registrations);
    plugin.manifest = std::move(manifest);
    plugin.reason.clear();
    plugin.state = PluginState::Loaded;
    renewObjects(plugin);
    buildIndex();
    registrations = {};
    if (oldLibrary) oldLibrary->release();
    return {};
}

template <class T, class Map>
void PluginManager::renewTable(Table<T>& table, Plugin& plugin, Map Registrations::*factories)
{
    const auto& offered = plugin.registrations.*factories;
    for (auto entry = table.begin(); entry != table.end();) {
        Shared<T>& shared = entry->second;
        const auto factory = offered.find(entry->first);
        if (!shared.object) {  // nobody offered it so far
            entry = table.erase(entry);
        } else if (shared.plugin != &plugin) {
            ++entry;
        } else if (factory == offered.end()) {
            renew(*shared.object, nullptr);
            retired_.push_back(std::move(shared.object));  // others may still hold it
            entry = table.erase(entry);
        } else {
            auto made = guard_.call(
                plugin, Callback::Factory, [&] { return factory->second(); }, std::shared_ptr<T>());
            renew(*shared.object, std::move(made));
            if (plugin.usable()) plugin.state = PluginState::Active;
            ++entry;
        }
    }
}

void PluginManager::renewObjects(Plugin& plugin)
{
    renewTable(effects_, plugin, &Registrations::effects);
    renewTable(itemTypes_, plugin, &Registrations::itemTypes);
    renewTable(importers_, plugin, &Registrations::importers);
    renewTable(exporters_, plugin, &Registrations::exporters);
    renewTable(physicsEngines_, plugin, &Registrations::physicsEngines);
    renewTable(scriptEngines_, plugin, &Registrations::scriptEngines);
    renewTable(commands_, plugin, &Registrations::commands);
}

void PluginManager::guardPanelEvent(std::string_view id, const std::function<void()>& deliver)
{
    const auto found = plugins_.find(id);
    if (found == plugins_.end() || !found->second->account) return deliver();
    guard_.run(*found->second, Callback::PanelEvent, deliver);
}

Result<void> PluginManager::unload(std::string_view id)
{
    const auto found = plugins_.find(id);
    if (found == plugins_.end() || !found->second->library) return {};
    Plugin& plugin = *found->second;
    if (host::isInCall(plugin)) return Error("the plugin " + plugin.title() + " is in the middle of a call");
    plugin.registrations = {};
    renewObjects(plugin);
    const auto leaves = [&](const std::string& what) {
        if (plugin.library) plugin.library->keep();
        return Error("the plugin " + plugin.title() + " leaves " + what + " behind; it stays in memory");
    };
    if (plugin.account->listeners() > 0)
        return leaves(std::to_string(plugin.account->listeners()) + " event listener(s)");
    if (const int threads = threadsIn(plugin.account->place()); threads > 0)
        return leaves(std::to_string(threads) + " running thread(s)");
    const fs::path file = plugin.library->file();
    plugin.library.reset();
    plugin.state = PluginState::Resolved;
    if (!options_.strictUnload) return {};
    if (isMapped(file))
        return leaves("its library (a thread-local destructor, a unique symbol, or a dlopen of its own holds it)");
    CallBoard::removeCode(plugin.account->place());
    return {};
}

}  // namespace jet::host
