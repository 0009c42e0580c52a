// TestCatalog: a Catalog for tests, made of built plugins, of objects registered in the test itself, or of both.
//
//   TestCatalog catalog{"org.jet.effect.polygon-face", "org.acme.rope"};  // loads built plugins
//   catalog.loadFolder("build/lib/jet/plugins/org.acme.knot");            // any time later, from anywhere
//   catalog.inCode().effect<FakeEffect>("fake");                          // without a library, as JET_PLUGIN would do
//   Scene scene("Scene", events, catalog);
//
// It loads the real library as the editor does: manifest, entry symbol, SDK version, ABI tag, then registration. What
// is registered must equal what the manifest declares, else load() throws Failure with the difference.
//
// Unlike the host it guards nothing: what a plugin throws arrives in the test. Libraries stay mapped until the process
// ends, so that the order of destruction in a test does not matter to them.
#pragma once

#include <jet/catalog.hpp>
#include <jet/plugin.hpp>

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace jet::test {

/// Where load() looks for a folder named as the plugin's id: the folders of the environment variable
/// JET_TEST_PLUGIN_PATH (joined by ':'), those of addPluginPath(), the shipped plugins beside libjet-sdk.so.
std::vector<std::filesystem::path> pluginPath();
/// jet_add_plugin_test() calls this with the folder its plugins are built into.
bool addPluginPath(std::filesystem::path folder);

class TestCatalog final : public Catalog {
public:
    TestCatalog(std::initializer_list<std::string_view> pluginIds = {});
    ~TestCatalog() override;

    /// Loads a built plugin by its id from the first folder of pluginPath() that has it, with what it requires. Throws
    /// Failure when it cannot, or when it is not what its manifest says. A plugin that is loaded already stays.
    void load(std::string_view pluginId);
    /// Loads the built plugin in this very folder.
    void loadFolder(const std::filesystem::path& folder);
    /// Ids of the loaded plugins, in the order of loading.
    std::vector<std::string> plugins() const;
    /// Registers in code. Such contributions have their id as label; importers and exporters have it as their
    /// extension.
    PluginRegistrar& inCode();

    std::vector<Contribution> contributions(ContributionKind kind) const override;
    const ItemType* itemType(std::string_view id) override;
    const Effect* effect(std::string_view id) override;
    Importer* importer(std::string_view extension) override;
    Exporter* exporter(std::string_view extension) override;
    PhysicsEngine* physicsEngine(std::string_view id) override;
    ScriptEngine* scriptEngine(std::string_view id) override;
    std::unique_ptr<Tool> createTool(std::string_view id, ToolHost& host) override;
    std::unique_ptr<Panel> createPanel(std::string_view id, Editor& editor) override;
    Command* command(std::string_view id) override;
    std::string explain(ContributionKind kind, std::string_view id) const override;
    std::string provider(ContributionKind kind, std::string_view id) const override;

private:
    struct Entry;
    struct Json;
    class Registrar;
    struct Private;
    void declare(const Json& contributes, const std::string& plugin, const std::string& version,
                 const std::filesystem::path& folder);
    Entry* find(ContributionKind kind, std::string_view id) const;
    Entry* findFormat(ContributionKind kind, std::string_view extension) const;
    template <class T>
    T* shared(Entry* entry);

    std::unique_ptr<Private> d_;
};

}  // namespace jet::test
