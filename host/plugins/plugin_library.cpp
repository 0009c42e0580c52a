#include "plugin_library.hpp"

#include "plugin_manager.hpp"

#include <jet/effect.hpp>
#include <jet/version.hpp>

#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <elf.h>
#include <fstream>
#include <set>
#include <unistd.h>

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

namespace {

// Mapping a file that was cut short is a crash in the dynamic linker, not an error.
Result<void> checkWhole(const std::filesystem::path& file)
{
    std::error_code problem;
    const std::uintmax_t size = std::filesystem::file_size(file, problem);
    std::ifstream in(file, std::ios::binary);
    Elf64_Ehdr header{};
    if (!in.read(reinterpret_cast<char*>(&header), sizeof header) ||
        std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 || header.e_phentsize != sizeof(Elf64_Phdr))
        return Error("its library " + file.string() + " is no shared library; build or install the plugin again");
    in.seekg(static_cast<std::streamoff>(header.e_phoff));
    for (int i = 0; i < header.e_phnum; ++i) {
        Elf64_Phdr part{};
        if (!in.read(reinterpret_cast<char*>(&part), sizeof part) ||
            (part.p_type == PT_LOAD && part.p_offset + part.p_filesz > size))
            return Error("its library " + file.string() + " is cut short; build or install the plugin again");
    }
    return {};
}

// A file of its own for each load, gone when the program ends (or at once, see open()).
Result<std::filesystem::path> copyOf(const std::filesystem::path& file)
{
    std::string name =
        (std::filesystem::temp_directory_path() / ("jet-" + file.stem().string() + "-XXXXXX.so")).string();
    const int descriptor = mkstemps(name.data(), 3);
    if (descriptor < 0) return Error("its library cannot be copied to " + name + "; make room there, or set TMPDIR");
    close(descriptor);
    std::error_code problem;
    std::filesystem::copy_file(file, name, std::filesystem::copy_options::overwrite_existing, problem);
    if (!problem) return std::filesystem::path(name);
    unlink(name.c_str());
    return Error("its library cannot be copied to " + name + ": " + problem.message());
}

Result<const JetPluginEntry*> checkedEntry(boost::dll::shared_library& library)
{
    if (!library.has("jet_plugin_entry"))
        return Error(
            "its library has no symbol jet_plugin_entry; write JET_PLUGIN(plugin) { ... } in one of its files");
    const auto& entry = library.get<const JetPluginEntry>("jet_plugin_entry");
    if (entry.magic != JET_PLUGIN_MAGIC)
        return Error("its jet_plugin_entry is not one; rebuild it with the present SDK");
    if (entry.sdkMajor != JET_SDK_VERSION_MAJOR || entry.sdkMinor > JET_SDK_VERSION_MINOR ||
        std::string_view(entry.abi) != JET_ABI_TAG)
        return Error("its library was built for SDK " + std::to_string(entry.sdkMajor) + "." +
                     std::to_string(entry.sdkMinor) + " (" + entry.abi +
                     "), other than its plugin.json says; build and install both together");
    return &entry;
}

Result<void> collect(const JetPluginEntry& entry, Registrations& registrations)
{
    try {
        Collector collector(registrations);
        entry.registerContributions(collector);
        return {};
    } catch (const std::exception& e) {
        return Error(std::string("it fails while registering: ") + e.what());
    } catch (...) {
        return Error("it fails while registering, with an unknown exception");
    }
}

}  // namespace

Result<std::unique_ptr<PluginLibrary>> PluginLibrary::open(const std::filesystem::path& folder,
                                                           const Manifest& manifest, CallAccount& account,
                                                           LibraryOptions options, Registrations& registrations)
{
    namespace dll = boost::dll;
    const std::filesystem::path original = folder / (manifest.library + ".so");
    if (!std::filesystem::exists(original))
        return Error("its library " + original.string() + " is missing; install the plugin again");
    if (const auto whole = checkWhole(original); !whole) return whole.error();
    auto opened = std::make_unique<PluginLibrary>();
    opened->file_ = original;
    if (options.copy) {
        auto copy = copyOf(original);
        if (!copy) return copy.error();
        opened->file_ = *copy;
    }
    const CallScope scope(account, Callback::Load);  // static constructors run in here
    const auto load = [&]() -> std::string {
        try {
            opened->library_.load(opened->file_, dll::load_mode::rtld_now | dll::load_mode::rtld_local);
            return {};
        } catch (const std::exception& e) {
            return e.what();
        }
    };
    std::string problem = load();
    if (!problem.empty() && provideSdkUi(problem)) problem = load();
    if (options.copy) unlink(opened->file_.c_str());  // what is mapped lives on
    if (!problem.empty()) return Error("its library does not load: " + problem);
    if (!options.unload) opened->keep();
    const auto entry = checkedEntry(opened->library_);
    if (!entry) return entry.error();
    opened->entry_ = *entry;
    CallBoard::addCode(account.place(), *entry);
    if (const auto collected = collect(**entry, registrations); !collected) {
        registrations = {};
        return collected.error();
    }
    return opened;
}

void PluginLibrary::keep() const
{
    static auto* const kept = new std::vector<boost::dll::shared_library>;
    kept->push_back(library_);
}

void PluginLibrary::release() const { CallBoard::releaseCode(entry_); }

}  // namespace jet::host
