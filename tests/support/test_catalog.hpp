// TestCatalog: a Catalog for tests, made of built plugins, of objects registered in the test itself, or of both.
//
//   TestCatalog catalog{"org.jet.effect.polygon-face", "org.jet.physics"};   // loads
//   <build>/lib/jet/plugins/<id>/<library>.so catalog.load("org.jet.io.svg"); // any time later
//   catalog.inCode().effect<FakeEffect>("fake");                             // without a library, as JET_PLUGIN would
//   do it Scene scene("Scene", events, catalog);
//
// - It loads the real library, as the editor does: manifest, entry symbol, SDK version, ABI tag, then registration.
// What is
//   registered must equal what the manifest declares, else load() throws Failure with the difference.
// - Unlike the host it guards nothing: what a plugin throws arrives in the test.
// - Libraries stay mapped until the process ends, so that the order of destruction in a test does not matter to them.
// - In CMake: LIBRARIES jet-test-support, and add_dependencies(<test> <plugin>...) for the plugins it loads.
#pragma once

#include <jet/catalog.hpp>
#include <jet/plugin.hpp>

#include <initializer_list>
#include <memory>
#include <string_view>
#include <vector>

namespace jet::test {

class TestCatalog final : public Catalog {
public:
    TestCatalog(std::initializer_list<std::string_view> pluginIds = {});
    ~TestCatalog() override;

    /// Loads a built plugin by its id; throws Failure when it cannot, or when it is not what its manifest says.
    void load(std::string_view pluginId);
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
    class Registrar;
    struct Private;
    Entry* find(ContributionKind kind, std::string_view id) const;
    Entry* findFormat(ContributionKind kind, std::string_view extension) const;
    template <class T>
    T* shared(Entry* entry);

    std::unique_ptr<Private> d_;
};

}  // namespace jet::test
