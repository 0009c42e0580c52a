#include <jet/testing/catalog.hpp>

#include <jet/effect.hpp>
#include <jet/format.hpp>
#include <jet/item_type.hpp>
#include <jet/script.hpp>
#include <jet/settings.hpp>
#include <jet/tool.hpp>
#include <jet/ui/panel.hpp>

#include <nlohmann/json.hpp>

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <any>
#include <cstdlib>
#include <fstream>
#include <tuple>

namespace jet::test {

namespace {

constexpr ContributionKind kKinds[] = {ContributionKind::Tool,         ContributionKind::Effect,
                                       ContributionKind::ItemType,     ContributionKind::Importer,
                                       ContributionKind::Exporter,     ContributionKind::PhysicsEngine,
                                       ContributionKind::ScriptEngine, ContributionKind::Panel,
                                       ContributionKind::Command,      ContributionKind::SettingsPage};

[[noreturn]] void fail(std::string message) { throw Failure(Error(std::move(message))); }

std::vector<std::filesystem::path>& addedPaths()
{
    static std::vector<std::filesystem::path> paths;
    return paths;
}

/// The folder of the plugins that ship with the SDK this process runs with; empty if it is not a shared library.
std::filesystem::path shippedPlugins()
{
    std::filesystem::path found;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* result) {
            const std::filesystem::path library(info->dlpi_name);
            if (!library.filename().string().starts_with("libjet-sdk.so")) return 0;
            *static_cast<std::filesystem::path*>(result) =
                (library.parent_path() / "jet" / "plugins").lexically_normal();
            return 1;
        },
        &found);
    return found;
}

}  // namespace

std::vector<std::filesystem::path> pluginPath()
{
    std::vector<std::filesystem::path> folders;
    if (const char* value = std::getenv("JET_TEST_PLUGIN_PATH")) {
        std::string_view rest(value);
        while (!rest.empty()) {
            const std::string_view one = rest.substr(0, rest.find(':'));
            if (!one.empty()) folders.emplace_back(one);
            rest.remove_prefix(std::min(rest.size(), one.size() + 1));
        }
    }
    folders.insert(folders.end(), addedPaths().begin(), addedPaths().end());
    if (auto shipped = shippedPlugins(); !shipped.empty()) folders.push_back(std::move(shipped));
    return folders;
}

bool addPluginPath(std::filesystem::path folder)
{
    addedPaths().push_back(std::move(folder));
    return true;
}

struct TestCatalog::Entry {
    Contribution contribution;
    std::string version;
    std::any factory;              // of the type the registrar received
    std::shared_ptr<void> object;  // made on first use; tools and panels are not kept
};

struct TestCatalog::Json {
    const nlohmann::json& json;
};

struct TestCatalog::Private {
    std::vector<std::unique_ptr<Entry>> entries;
    std::vector<std::string> plugins;
    std::unique_ptr<Registrar> inCode;
};

/// Fills the factories of one plugin's declared entries, or makes entries for code without a manifest.
class TestCatalog::Registrar final : public PluginRegistrar {
public:
    Registrar(TestCatalog& catalog, std::string plugin, bool declared)
        : catalog_(catalog), plugin_(std::move(plugin)), declared_(declared)
    {
    }

    void addTool(std::string_view id, ToolFactory f) override { add(ContributionKind::Tool, id, std::move(f)); }
    void addPanel(std::string_view id, PanelFactory f) override { add(ContributionKind::Panel, id, std::move(f)); }
    void addEffect(std::string_view id, Factory<Effect> f) override { add(ContributionKind::Effect, id, std::move(f)); }
    void addItemType(std::string_view id, Factory<ItemType> f) override
    {
        add(ContributionKind::ItemType, id, std::move(f));
    }
    void addImporter(std::string_view id, Factory<Importer> f) override
    {
        add(ContributionKind::Importer, id, std::move(f));
    }
    void addExporter(std::string_view id, Factory<Exporter> f) override
    {
        add(ContributionKind::Exporter, id, std::move(f));
    }
    void addPhysicsEngine(std::string_view id, Factory<PhysicsEngine> f) override
    {
        add(ContributionKind::PhysicsEngine, id, std::move(f));
    }
    void addScriptEngine(std::string_view id, Factory<ScriptEngine> f) override
    {
        add(ContributionKind::ScriptEngine, id, std::move(f));
    }
    void addCommand(std::string_view id, Factory<Command> f) override
    {
        add(ContributionKind::Command, id, std::move(f));
    }
    std::shared_ptr<Settings> addSettingsPage(std::string_view id, const PropertyTable& table) override
    {
        auto page = settingsInMemory(table);
        add(ContributionKind::SettingsPage, id, page);
        return page;
    }

private:
    void add(ContributionKind kind, std::string_view id, std::any factory)
    {
        Entry* entry = catalog_.find(kind, id);
        if (declared_ && (!entry || entry->contribution.plugin != plugin_))
            fail(plugin_ + " registers the " + std::string(kindName(kind)) + " '" + std::string(id) +
                 "', which its plugin.json does not declare.");
        if (!declared_) entry = &declare(kind, id);
        entry->factory = std::move(factory);
    }

    Entry& declare(ContributionKind kind, std::string_view id)
    {
        auto entry = std::make_unique<Entry>();
        entry->contribution.kind = kind;
        entry->contribution.id = entry->contribution.label = id;
        entry->contribution.plugin = plugin_;
        entry->contribution.extensions = {std::string(id)};
        entry->version = "0";
        catalog_.d_->entries.push_back(std::move(entry));
        return *catalog_.d_->entries.back();
    }

    TestCatalog& catalog_;
    std::string plugin_;
    bool declared_;
};

TestCatalog::TestCatalog(std::initializer_list<std::string_view> pluginIds) : d_(std::make_unique<Private>())
{
    d_->inCode = std::make_unique<Registrar>(*this, "test", false);
    for (std::string_view id : pluginIds) load(id);
}

TestCatalog::~TestCatalog() = default;

PluginRegistrar& TestCatalog::inCode() { return *d_->inCode; }

namespace {

Contribution readContribution(const nlohmann::json& json, ContributionKind kind, const std::string& plugin,
                              const std::filesystem::path& folder)
{
    Contribution c;
    c.kind = kind;
    c.id = json.at("id").get<std::string>();
    c.label = json.value("label", c.id);
    c.plugin = plugin;
    if (const std::string icon = json.value("icon", ""); !icon.empty()) {
        c.icon = folder / icon;
        if (!std::filesystem::exists(c.icon)) fail(plugin + ": the icon " + c.icon + " is missing.");
    }
    c.shortcut = json.value("shortcut", "");
    c.menu = json.value("menu", "");
    c.area = json.value("area", "");
    c.extensions = json.value("extensions", std::vector<std::string>{});
    c.order = json.value("order", 100);
    return c;
}

/// The entry symbol of a library, checked as the host checks it.
const JetPluginEntry& openLibrary(const std::filesystem::path& file)
{
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) fail(std::string("The library cannot be loaded: ") + dlerror());
    const auto* entry = static_cast<const JetPluginEntry*>(dlsym(library, "jet_plugin_entry"));
    if (!entry || entry->magic != JET_PLUGIN_MAGIC) fail(file.string() + " is not a JET plugin: it has no JET_PLUGIN.");
    if (entry->sdkMajor != JET_SDK_VERSION_MAJOR || entry->sdkMinor > JET_SDK_VERSION_MINOR ||
        std::string_view(entry->abi) != JET_ABI_TAG)
        fail(file.string() + " was built for another SDK or compiler; build it again.");
    return *entry;
}

}  // namespace

void TestCatalog::declare(const Json& contributes, const std::string& plugin, const std::string& version,
                          const std::filesystem::path& folder)
{
    for (const ContributionKind kind : kKinds) {
        for (const auto& json : contributes.json.value(manifestKey(kind), nlohmann::json::array())) {
            auto entry = std::make_unique<Entry>();
            entry->contribution = readContribution(json, kind, plugin, folder);
            entry->version = version;
            d_->entries.push_back(std::move(entry));
        }
    }
}

void TestCatalog::load(std::string_view pluginId)
{
    const std::string id(pluginId);
    std::string searched;
    for (const auto& folder : pluginPath()) {
        if (std::filesystem::exists(folder / id / "plugin.json")) return loadFolder(folder / id);
        searched += (searched.empty() ? "" : ", ") + folder.string();
    }
    fail("There is no plugin " + id + " in " + (searched.empty() ? "any folder" : searched) +
         "; build it first, or name its folder in JET_TEST_PLUGIN_PATH.");
}

void TestCatalog::loadFolder(const std::filesystem::path& folder)
{
    std::ifstream file(folder / "plugin.json");
    if (!file) fail("There is no plugin.json in " + folder.string() + "; name the folder of a built plugin.");
    const auto manifest = nlohmann::json::parse(file, nullptr, true, true);
    const auto id = manifest.at("id").get<std::string>();
    if (std::find(d_->plugins.begin(), d_->plugins.end(), id) != d_->plugins.end()) return;
    d_->plugins.push_back(id);

    for (const std::string& need : manifest.value("requires", std::vector<std::string>{}))
        load(std::string_view(need).substr(0, need.find(' ')));
    declare(Json{manifest.at("contributes")}, id, manifest.at("version").get<std::string>(), folder);
    Registrar registrar(*this, id, true);
    openLibrary(folder / (manifest.at("library").get<std::string>() + ".so")).registerContributions(registrar);
    for (const auto& entry : d_->entries)
        if (entry->contribution.plugin == id && !entry->factory.has_value())
            fail(id + " declares the " + std::string(kindName(entry->contribution.kind)) + " '" +
                 entry->contribution.id + "' in its plugin.json, but does not register it.");
}

std::vector<std::string> TestCatalog::plugins() const { return d_->plugins; }

TestCatalog::Entry* TestCatalog::find(ContributionKind kind, std::string_view id) const
{
    for (const auto& entry : d_->entries)
        if (entry->contribution.kind == kind && entry->contribution.id == id) return entry.get();
    return nullptr;
}

TestCatalog::Entry* TestCatalog::findFormat(ContributionKind kind, std::string_view extension) const
{
    for (const auto& entry : d_->entries) {
        const auto& known = entry->contribution.extensions;
        if (entry->contribution.kind == kind && std::find(known.begin(), known.end(), extension) != known.end())
            return entry.get();
    }
    return nullptr;
}

template <class T>
T* TestCatalog::shared(Entry* entry)
{
    if (!entry) return nullptr;
    if (!entry->object) entry->object = std::any_cast<PluginRegistrar::Factory<T>&>(entry->factory)();
    return static_cast<T*>(entry->object.get());
}

std::vector<Contribution> TestCatalog::contributions(ContributionKind kind) const
{
    std::vector<Contribution> found;
    for (const auto& entry : d_->entries)
        if (entry->contribution.kind == kind) found.push_back(entry->contribution);
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return std::tie(a.order, a.id) < std::tie(b.order, b.id); });
    return found;
}

const ItemType* TestCatalog::itemType(std::string_view id)
{
    if (Entry* entry = find(ContributionKind::ItemType, id)) return shared<ItemType>(entry);
    return builtInItemType(id);
}

const Effect* TestCatalog::effect(std::string_view id) { return shared<Effect>(find(ContributionKind::Effect, id)); }
Importer* TestCatalog::importer(std::string_view extension)
{
    return shared<Importer>(findFormat(ContributionKind::Importer, extension));
}
Exporter* TestCatalog::exporter(std::string_view extension)
{
    return shared<Exporter>(findFormat(ContributionKind::Exporter, extension));
}

namespace {

/// An empty id means the first declared engine.
std::string engineId(const TestCatalog& catalog, ContributionKind kind, std::string_view id)
{
    if (!id.empty()) return std::string(id);
    const auto all = catalog.contributions(kind);
    return all.empty() ? std::string() : all.front().id;
}

}  // namespace

PhysicsEngine* TestCatalog::physicsEngine(std::string_view id)
{
    return shared<PhysicsEngine>(
        find(ContributionKind::PhysicsEngine, engineId(*this, ContributionKind::PhysicsEngine, id)));
}

ScriptEngine* TestCatalog::scriptEngine(std::string_view id)
{
    return shared<ScriptEngine>(
        find(ContributionKind::ScriptEngine, engineId(*this, ContributionKind::ScriptEngine, id)));
}

std::unique_ptr<Tool> TestCatalog::createTool(std::string_view id, ToolHost& host)
{
    Entry* entry = find(ContributionKind::Tool, id);
    return entry ? std::any_cast<PluginRegistrar::ToolFactory&>(entry->factory)(host) : nullptr;
}

std::unique_ptr<Panel> TestCatalog::createPanel(std::string_view id, Editor& editor)
{
    Entry* entry = find(ContributionKind::Panel, id);
    return entry ? std::any_cast<PluginRegistrar::PanelFactory&>(entry->factory)(editor) : nullptr;
}

Command* TestCatalog::command(std::string_view id) { return shared<Command>(find(ContributionKind::Command, id)); }

std::string TestCatalog::explain(ContributionKind kind, std::string_view id) const
{
    return "The test has not loaded a plugin with the " + std::string(kindName(kind)) + " '" + std::string(id) + "'.";
}

std::string TestCatalog::provider(ContributionKind kind, std::string_view id) const
{
    const bool format = kind == ContributionKind::Importer || kind == ContributionKind::Exporter;
    const Entry* entry = format ? findFormat(kind, id) : find(kind, id);
    return entry ? entry->contribution.plugin + " " + entry->version : std::string();
}

}  // namespace jet::test
