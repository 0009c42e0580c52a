// The plugin contract: one exported C symbol, checked before any C++ call, and a registrar that receives the
// contributions.
//
//   JET_PLUGIN(plugin) { plugin.tool<RectangleTool>("rectangle"); }
//
// What is registered must equal what plugin.json declares; otherwise the plugin is faulted and the difference shown.
#pragma once

#include <jet/catalog.hpp>
#include <jet/version.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

namespace jet {

class PropertyTable;
class Settings;

/// Receives a plugin's contributions while it is being loaded. Factories are called on first use, on the GUI thread;
/// they pass `args`, copied, on to the constructor.
class JET_API PluginRegistrar {
public:
    virtual ~PluginRegistrar();

    template <class T, class... Args>
    void tool(std::string_view id, const Args&... args)
    {
        addTool(id, [args...](ToolHost& host) -> std::unique_ptr<Tool> { return std::make_unique<T>(host, args...); });
    }
    template <class T, class... Args>
    void panel(std::string_view id, const Args&... args)
    {
        addPanel(id,
                 [args...](Editor& editor) -> std::unique_ptr<Panel> { return std::make_unique<T>(editor, args...); });
    }
    template <class T, class... Args>
    void effect(std::string_view id, const Args&... args)
    {
        addEffect(id, [args...] { return std::shared_ptr<Effect>(std::make_shared<T>(args...)); });
    }
    template <class T, class... Args>
    void itemType(std::string_view id, const Args&... args)
    {
        addItemType(id, [args...] { return std::shared_ptr<ItemType>(std::make_shared<T>(args...)); });
    }
    /// `id` names the format; its extensions are in the manifest.
    template <class T, class... Args>
    void importer(std::string_view id, const Args&... args)
    {
        addImporter(id, [args...] { return std::shared_ptr<Importer>(std::make_shared<T>(args...)); });
    }
    template <class T, class... Args>
    void exporter(std::string_view id, const Args&... args)
    {
        addExporter(id, [args...] { return std::shared_ptr<Exporter>(std::make_shared<T>(args...)); });
    }
    template <class T, class... Args>
    void physicsEngine(std::string_view id, const Args&... args)
    {
        addPhysicsEngine(id, [args...] { return std::shared_ptr<PhysicsEngine>(std::make_shared<T>(args...)); });
    }
    template <class T, class... Args>
    void scriptEngine(std::string_view id, const Args&... args)
    {
        addScriptEngine(id, [args...] { return std::shared_ptr<ScriptEngine>(std::make_shared<T>(args...)); });
    }
    template <class T, class... Args>
    void command(std::string_view id, const Args&... args)
    {
        addCommand(id, [args...] { return std::shared_ptr<Command>(std::make_shared<T>(args...)); });
    }

    /// Declared under "settingsPages". The values are live: keep the pointer and read when needed.
    std::shared_ptr<Settings> settingsPage(std::string_view id, const PropertyTable& table)
    {
        return addSettingsPage(id, table);
    }

    using ToolFactory = std::function<std::unique_ptr<Tool>(ToolHost&)>;
    using PanelFactory = std::function<std::unique_ptr<Panel>(Editor&)>;
    template <class T>
    using Factory = std::function<std::shared_ptr<T>()>;

    virtual void addTool(std::string_view id, ToolFactory factory) = 0;
    virtual void addPanel(std::string_view id, PanelFactory factory) = 0;
    virtual void addEffect(std::string_view id, Factory<Effect> factory) = 0;
    virtual void addItemType(std::string_view id, Factory<ItemType> factory) = 0;
    virtual void addImporter(std::string_view id, Factory<Importer> factory) = 0;
    virtual void addExporter(std::string_view id, Factory<Exporter> factory) = 0;
    virtual void addPhysicsEngine(std::string_view id, Factory<PhysicsEngine> factory) = 0;
    virtual void addScriptEngine(std::string_view id, Factory<ScriptEngine> factory) = 0;
    virtual void addCommand(std::string_view id, Factory<Command> factory) = 0;
    /// The default keeps the values in memory.
    virtual std::shared_ptr<Settings> addSettingsPage(std::string_view id, const PropertyTable& table);
};

}  // namespace jet

extern "C" {
/// What `jet_plugin_entry` points to: plain data, read before anything of the plugin is called.
struct JetPluginEntry {
    std::uint32_t magic;  ///< 'JETP'
    std::uint32_t sdkMajor, sdkMinor;
    const char* abi;  ///< JET_ABI_TAG of the compiler that built the plugin
    void (*registerContributions)(jet::PluginRegistrar& plugin);
};
}

#define JET_PLUGIN_MAGIC 0x4a455450U

#define JET_PLUGIN(registrar)                                                                                          \
    static void jetRegisterContributions(jet::PluginRegistrar&);                                                       \
    extern "C" __attribute__((visibility("default"))) const JetPluginEntry jet_plugin_entry = {                        \
        JET_PLUGIN_MAGIC, JET_SDK_VERSION_MAJOR, JET_SDK_VERSION_MINOR, JET_ABI_TAG, &jetRegisterContributions};       \
    static void jetRegisterContributions(jet::PluginRegistrar& registrar)
