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

/// Receives a plugin's contributions while it is being loaded. Factories are called on first use, on the GUI thread.
class JET_API PluginRegistrar {
public:
    virtual ~PluginRegistrar();

    template <class T>
    void tool(std::string_view id)
    {
        addTool(id, [](ToolHost& host) -> std::unique_ptr<Tool> { return std::make_unique<T>(host); });
    }
    template <class T>
    void panel(std::string_view id)
    {
        addPanel(id, [](Editor& editor) -> std::unique_ptr<Panel> { return std::make_unique<T>(editor); });
    }
    template <class T>
    void effect(std::string_view id)
    {
        addEffect(id, [] { return std::shared_ptr<Effect>(std::make_shared<T>()); });
    }
    template <class T>
    void itemType(std::string_view id)
    {
        addItemType(id, [] { return std::shared_ptr<ItemType>(std::make_shared<T>()); });
    }
    /// `id` names the format; its extensions are in the manifest.
    template <class T>
    void importer(std::string_view id)
    {
        addImporter(id, [] { return std::shared_ptr<Importer>(std::make_shared<T>()); });
    }
    template <class T>
    void exporter(std::string_view id)
    {
        addExporter(id, [] { return std::shared_ptr<Exporter>(std::make_shared<T>()); });
    }
    template <class T>
    void physicsEngine(std::string_view id)
    {
        addPhysicsEngine(id, [] { return std::shared_ptr<PhysicsEngine>(std::make_shared<T>()); });
    }
    template <class T>
    void scriptEngine(std::string_view id)
    {
        addScriptEngine(id, [] { return std::shared_ptr<ScriptEngine>(std::make_shared<T>()); });
    }
    template <class T>
    void command(std::string_view id)
    {
        addCommand(id, [] { return std::shared_ptr<Command>(std::make_shared<T>()); });
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
