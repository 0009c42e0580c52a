#include "plugin_library.hpp"

#include "plugin_manager.hpp"

#include <jet/effect.hpp>
#include <jet/version.hpp>

#include <dlfcn.h>
#include <set>

namespace jet::host {

namespace {

class Collector final : public PluginRegistrar {
public:
    explicit Collector(Registrations& target) : target_(target) {}
    void addTool(std::string_view id, ToolFactory f) override { add(target_.tools, id, std::move(f)); }
    void addPanel(std::string_view id, PanelFactory f) override { add(target_.panels, id, std::move(f)); }
    void addEffect(std::string_view id, Factory<Effect> f) override { add(target_.effects, id, std::move(f)); }
    void addItemType(std::string_view id, Factory<ItemType> f) override { add(target_.itemTypes, id, std::move(f)); }
    void addImporter(std::string_view id, Factory<Importer> f) override { add(target_.importers, id, std::move(f)); }
    void addExporter(std::string_view id, Factory<Exporter> f) override { add(target_.exporters, id, std::move(f)); }
    void addPhysicsEngine(std::string_view id, Factory<PhysicsEngine> f) override
    {
        add(target_.physicsEngines, id, std::move(f));
    }
    void addScriptEngine(std::string_view id, Factory<ScriptEngine> f) override
    {
        add(target_.scriptEngines, id, std::move(f));
    }
    void addCommand(std::string_view id, Factory<Command> f) override { add(target_.commands, id, std::move(f)); }
    std::shared_ptr<Settings> addSettingsPage(std::string_view id, const PropertyTable& table) override
    {
        auto page = target_.openSettings ? target_.openSettings(id, table) : settingsInMemory(table);
        add(target_.settings, id, page);
        return page;
    }

private:
    template <class Map, class F>
    static void add(Map& map, std::string_view id, F factory)
    {
        if (!map.emplace(id, std::move(factory)).second)
            throw Failure(Error("it registers '" + std::string(id) + "' twice"));
    }
    Registrations& target_;
};

template <class Map>
void compare(ContributionKind kind, const Manifest& manifest, const Map& registered, std::string& difference)
{
    std::set<std::string> declared;
    for (const Contribution& one : manifest.contributions)
        if (one.kind == kind) declared.insert(one.id);
    const auto note = [&](const std::string& id, const char* what) {
        difference += (difference.empty() ? "" : "; ") + std::string(kindName(kind)) + " '" + id + "' is " + what;
    };
    for (const std::string& id : declared)
        if (!registered.contains(id)) note(id, "declared in plugin.json but not registered");
    for (const auto& [id, factory] : registered)
        if (!declared.contains(id)) note(id, "registered but not declared in plugin.json");
}

/// A plugin with a widget that lies in a folder of the user does not find the SDK's part with Qt, which no headless
/// command has loaded: it lies beside libjet-sdk.so. False where that is not the problem.
bool provideSdkUi(std::string_view problem)
{
    static constexpr std::string_view name = "libjet-sdk-ui.so." JET_STRINGIZE(JET_SDK_VERSION_MAJOR);
    if (problem.find(name) == std::string_view::npos) return false;
    const auto file = builtInPluginFolder().parent_path().parent_path() / name;
    return dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL) != nullptr;
}

}  // namespace

Result<void> checkBuild(const Manifest& manifest)
{
    const Version host{JET_SDK_VERSION_MAJOR, JET_SDK_VERSION_MINOR, JET_SDK_VERSION_PATCH};
    const auto wants = [&](const Version& wanted, const std::string& how) -> Result<void> {
        if (wanted.major == host.major && wanted.minor <= host.minor) return {};
        return Error("it was " + how + " for SDK " + wanted.text() + ", this JET has SDK " + host.text() + "; " +
                     (wanted > host ? "use a newer JET or an older version of the plugin"
                                    : "rebuild the plugin with the present SDK"));
    };
    if (const auto written = wants(manifest.jet, "written"); !written) return written;
    if (manifest.sdk.empty() || manifest.abi.empty())
        return Error("its plugin.json does not say what it was built with; build it with jet_add_plugin() and use the "
                     "copy beside "
                     "the built library");
    const auto built = Version::parse(manifest.sdk);
    if (!built) return built.error();
    if (const auto fits = wants(*built, "built"); !fits) return fits;
    if (manifest.abi != JET_ABI_TAG)
        return Error("it was built for the compiler ABI " + manifest.abi + ", this JET for " + JET_ABI_TAG +
                     "; rebuild it with a matching compiler");
    return {};
}

Result<void> checkRegistrations(const Manifest& manifest, const Registrations& registered)
{
    std::string difference;
    compare(ContributionKind::Tool, manifest, registered.tools, difference);
    compare(ContributionKind::Panel, manifest, registered.panels, difference);
    compare(ContributionKind::Effect, manifest, registered.effects, difference);
    compare(ContributionKind::ItemType, manifest, registered.itemTypes, difference);
    compare(ContributionKind::Importer, manifest, registered.importers, difference);
    compare(ContributionKind::Exporter, manifest, registered.exporters, difference);
    compare(ContributionKind::PhysicsEngine, manifest, registered.physicsEngines, difference);
    compare(ContributionKind::ScriptEngine, manifest, registered.scriptEngines, difference);
    compare(ContributionKind::Command, manifest, registered.commands, difference);
    compare(ContributionKind::SettingsPage, manifest, registered.settings, difference);
    if (difference.empty()) return {};
    return Error("what it declares and what it registers differ: " + difference +
                 "; make plugin.json and JET_PLUGIN agree");
}

Result<std::unique_ptr<PluginLibrary>> PluginLibrary::open(const Plugin& plugin, Registrations& registrations)
{
    namespace dll = boost::dll;
    const std::filesystem::path file = plugin.folder / (plugin.manifest.library + ".so");
    if (!std::filesystem::exists(file))
        return Error("its library " + file.string() + " is missing; install the plugin again");
    auto opened = std::make_unique<PluginLibrary>();
    const auto load = [&] { opened->library_.load(file, dll::load_mode::rtld_now | dll::load_mode::rtld_local); };
    try {
        try {
            load();
        } catch (const std::exception& e) {
            if (!provideSdkUi(e.what())) throw;
            load();
        }
    } catch (const std::exception& e) {
        return Error(std::string("its library does not load: ") + e.what());
    }
    // From here on the mapping stays: exceptions, queued calls and types of the plugin may outlive any use of it.
    static auto* const kept = new std::vector<dll::shared_library>;
    kept->push_back(opened->library_);
    if (!opened->library_.has("jet_plugin_entry"))
        return Error(
            "its library has no symbol jet_plugin_entry; write JET_PLUGIN(plugin) { ... } in one of its files");
    const auto& entry = opened->library_.get<const JetPluginEntry>("jet_plugin_entry");
    if (entry.magic != JET_PLUGIN_MAGIC)
        return Error("its jet_plugin_entry is not one; rebuild it with the present SDK");
    if (entry.sdkMajor != JET_SDK_VERSION_MAJOR || entry.sdkMinor > JET_SDK_VERSION_MINOR ||
        std::string_view(entry.abi) != JET_ABI_TAG)
        return Error("its library was built for SDK " + std::to_string(entry.sdkMajor) + "." +
                     std::to_string(entry.sdkMinor) + " (" + entry.abi +
                     "), other than its plugin.json says; build and install both together");
    try {
        Collector collector(registrations);
        entry.registerContributions(collector);
    } catch (const std::exception& e) {
        return Error(std::string("it fails while registering: ") + e.what());
    } catch (...) {
        return Error("it fails while registering, with an unknown exception");
    }
    return opened;
}

}  // namespace jet::host
