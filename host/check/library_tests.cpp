// The plugin as a whole: manifest, loading and unloading, contributions.
#include "tests.hpp"

#include "host/packages/package.hpp"
#include "host/plugins/guard.hpp"
#include "host/plugins/plugin_library.hpp"
#include "host/plugins/plugin_manager.hpp"

#include <jet/editor.hpp>
#include <jet/effect.hpp>
#include <jet/item_type.hpp>
#include <jet/script.hpp>

#include <dlfcn.h>
#include <set>

namespace jet::host::check {

namespace {

/// An error's text, but for the place if that is the plugin's own folder.
std::string told(const Error& error) { return error.where.line > 0 ? error.text() : error.message; }

void checkTable(const Context& context, const std::string& what, const PropertyTable& table)
{
    std::set<std::string> ids;
    for (const PropertySpec& spec : table.specs()) {
        const std::string name = what + ": the property '" + spec.id + "' ";
        if (spec.id.empty()) context.fail(what + " has a property without an id");
        if (!ids.insert(spec.id).second) context.fail(name + "is declared twice");
        if (spec.label.empty()) context.fail(name + "has no label");
        if (spec.kind == ValueKind::Choice && spec.choices.empty()) context.fail(name + "has no choices");
        if (spec.kind == ValueKind::None || spec.kind == ValueKind::Raw) context.fail(name + "has no kind");
        if (spec.minimum > spec.maximum) context.fail(name + "has a range that ends before it begins");
        if (const auto fine = spec.check(spec.fallback); !fine)
            context.fail(name + "has a default that does not do: " + fine.error().message);
    }
}

}  // namespace

void testManifest(Context& context)
{
    const auto manifest = Manifest::read(context.folder / "plugin.json");
    if (!manifest) context.fail(told(manifest.error()));
    if (const auto complete = checkContents(*manifest, context.folder); !complete) context.fail(told(complete.error()));
    if (const auto fits = checkBuild(*manifest); !fits) context.fail(fits.error().message);
    PluginOptions options;
    options.builtIn = builtInPluginFolder();
    options.searchPath = {context.folder, context.folder.parent_path(), userPluginFolder(), options.builtIn};
    PluginManager manager(std::move(options));
    manager.scan();
    for (const Plugin* plugin : manager.plugins()) {
        std::error_code ignored;
        const bool self = std::filesystem::equivalent(plugin->folder, context.folder, ignored);
        if (self && plugin->state == PluginState::Faulted) context.fail(plugin->reason);
    }
    for (const Contribution& one : manifest->contributions)
        for (const std::string& extension : one.extensions)
            if (extension.empty() || extension != extensionOf("x." + extension))
                context.fail("the extension '" + extension + "' of '" + one.id + "' is not lower case without a dot");
}

void testContributions(Context& context)
{
    Plugin plugin;
    plugin.folder = context.folder;
    plugin.manifest = context.manifest;
    Registrations made;
    Guard guard;
    CallAccount account(plugin, guard, plugin.manifest.id + " " + plugin.manifest.version.text());
    context.board.callback("registering");
    const auto opened = PluginLibrary::open(plugin.folder, plugin.manifest, account, {}, made);
    if (!opened) context.fail(opened.error().message);
    if (const auto agree = checkRegistrations(plugin.manifest, made); !agree) context.fail(agree.error().message);
    const auto makeAll = [&](const auto& factories, const char* kind, const auto& look) {
        for (const auto& [id, factory] : factories) {
            const auto& make = factory;
            const auto object = context.call("factory", [&] { return make(); });
            const std::string what = std::string("the ") + kind + " '" + id + "'";
            if (!object) context.fail(what + " is null: its factory made nothing");
            look(what, *object);
        }
    };
    const auto nothing = [](const std::string&, const auto&) {};
    makeAll(made.effects, "effect", [&](const std::string& what, const Effect& effect) {
        context.call("Effect::properties", [&] { checkTable(context, what, effect.properties()); });
    });
    makeAll(made.itemTypes, "item type", [&](const std::string& what, const ItemType& type) {
        context.call("ItemType::properties", [&] { checkTable(context, what, type.properties()); });
        if (context.call("ItemType::label", [&] { return type.label(); }).empty()) context.fail(what + " has no label");
    });
    makeAll(made.importers, "importer", nothing);
    makeAll(made.exporters, "exporter", nothing);
    makeAll(made.physicsEngines, "physics engine", nothing);
    makeAll(made.scriptEngines, "script engine", nothing);
    makeAll(made.commands, "command", nothing);
    Stage stage(context);
    for (const auto& [id, factory] : made.tools) {
        const auto tool = context.call("factory", [&, &make = factory] { return make(stage.host); });
        if (!tool) context.fail("the tool '" + id + "' is null: its factory made nothing");
        context.call("Tool::options",
                     [&, &name = id] { checkTable(context, "the tool '" + name + "'", tool->options()); });
    }
}

namespace {

/// Receives the contributions of one loading, makes one object of each, and forgets it.
class Taster final : public PluginRegistrar {
public:
    explicit Taster(ToolHost& host) : host_(host) {}
    void addTool(std::string_view, ToolFactory f) override { f(host_); }
    void addPanel(std::string_view, PanelFactory) override {}  // needs a window: the test of panels makes it
    void addEffect(std::string_view, Factory<Effect> f) override { f(); }
    void addItemType(std::string_view, Factory<ItemType> f) override { f(); }
    void addImporter(std::string_view, Factory<Importer> f) override { f(); }
    void addExporter(std::string_view, Factory<Exporter> f) override { f(); }
    void addPhysicsEngine(std::string_view, Factory<PhysicsEngine> f) override { f(); }
    void addScriptEngine(std::string_view, Factory<ScriptEngine> f) override { f(); }
    void addCommand(std::string_view, Factory<Command> f) override { f(); }

private:
    ToolHost& host_;
};

}  // namespace

void testLoading(Context& context)
{
    const std::string file = context.folder / (context.manifest.library + ".so");
    // Opened once through the host first: that brings what a library needs of the SDK, and tells why it fails.
    test::TestCatalog nothing;
    EventsCenter events;
    Scene scene("Scene", events, nothing);
    test::TestToolHost host(scene);
    const std::size_t listeners = events.listenerCount();
    for (int round = 1; round <= 20; ++round) {
        context.activity("loading for the " + std::to_string(round) + ". time");
        context.board.callback("dlopen");
        void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!library) context.fail(std::string("its library does not load: ") + ::dlerror());
        const auto* entry = static_cast<const JetPluginEntry*>(::dlsym(library, "jet_plugin_entry"));
        if (!entry || entry->magic != JET_PLUGIN_MAGIC)
            context.fail("its library has no jet_plugin_entry; write JET_PLUGIN in it");
        Taster taster(host);
        context.call("registering", [&] { entry->registerContributions(taster); });
        if (events.listenerCount() != listeners)
            context.fail(context.where("an object of it that was destroyed leaves a listener of events behind"));
        context.board.callback("dlclose");
        ::dlclose(library);
        if (::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD) != nullptr)
            context.fail(
                context.where("its library stays in memory after it was unloaded: something in it holds it "
                              "(dlopen of itself, thread_local objects, or it was built without -fno-gnu-unique)"));
    }
    context.activity("after the last unloading");
}

}  // namespace jet::host::check
