// What a project says of its plugins, and how it differs from those that are here.
#include "plugin_folder.hpp"

#include "host/plugins/plugin_control.hpp"
#include "host/plugins/plugin_differences.hpp"

#include <jet/format.hpp>
#include <jet/project.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace jet::host {
namespace {

using test::PluginFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ProjectDifferencesTest : public testing::Test {
protected:
    PluginManager& scan(PluginOptions options = {})
    {
        options.searchPath = {folder.path()};
        manager = std::make_unique<PluginManager>(std::move(options));
        manager->scan();
        return *manager;
    }
    /// Adds a plugin with a physics engine: what a project says of one is known without loading it.
    void add(const std::string& id, const std::string& version = "1.0.0", const std::string& more = "",
             const std::string& place = "")
    {
        folder.write(place.empty() ? id : place,
                     "{ \"id\": \"" + id + "\", \"name\": \"" + id + "\", \"version\": \"" + version +
                         "\", \"jet\": \"" JET_SDK_VERSION "\", \"library\": \"none\", \"builtFor\": { \"sdk\": "
                         "\"" JET_SDK_VERSION "\", \"abi\": \"" JET_ABI_TAG "\" }, " +
                         more + (more.empty() ? "" : ", ") + "\"contributes\": { \"physicsEngines\": [ { \"id\": \"" +
                         id.substr(id.rfind('.') + 1) + "\", \"label\": \"x\" } ] } }");
    }
    /// A project with two scenes for the engine "rope" and one for "glue"; `plugins` stands in its <plugins>.
    void write(const std::string& plugins)
    {
        std::filesystem::create_directories(game());
        std::string scenes;
        for (const std::string name : {"glue", "rope", "rope2"}) {
            scenes += "<scene name=\"" + name + "\" file=\"" + name + ".scene\"/>";
            std::ofstream(game() / (name + ".scene")) << "<scene version=\"1\"><settings><property id=\"physics\">" +
                                                             name.substr(0, 4) + "</property></settings></scene>";
        }
        std::ofstream(game() / "project.jet") << "<jet-project version=\"1\" name=\"Game\">"
                                              << (plugins.empty() ? "" : "<plugins>" + plugins + "</plugins>")
                                              << "<filter name=\"F\">" << scenes << "</filter></jet-project>";
    }
    std::unique_ptr<Project> load() { return Project::load(game(), events, *manager).orThrow(); }
    std::vector<std::string> told()
    {
        std::vector<std::string> sentences;
        for (const PluginDifference& one : projectDifferences(*manager, *load())) sentences.push_back(sentenceOf(one));
        return sentences;
    }
    std::filesystem::path game() const { return config.path() / "game"; }

    static constexpr const char* kRecord =
        R"(<plugin id="org.acme.glue" version="1.0.0" uses="1" provides="physicsEngines/glue"/>)"
        R"(<plugin id="org.acme.rope" version="1.2.0" uses="2" provides="physicsEngines/rope"/>)";
    PluginFolder config, folder;
    EventsCenter events;
    std::unique_ptr<PluginManager> manager;
};

TEST_F(ProjectDifferencesTest, NothingIsSaidWhereAllIsAsItWasSaved)
{
    add("org.acme.rope", "1.2.0");
    add("org.acme.glue");
    scan();
    write(kRecord);
    EXPECT_THAT(told(), IsEmpty());
    EXPECT_TRUE(checkFrozen(*manager, load().get()));
}

TEST_F(ProjectDifferencesTest, MissingDisabledFaultedAndOtherVersionsAreToldWithUsesAndRemedy)
{
    write(kRecord);
    scan();
    EXPECT_THAT(told(), ElementsAre("org.acme.glue: the project wants 1.0.0 (1 use), it is not installed; get its "
                                    ".jetplugin file and run 'jet plugins install FILE'",
                                    "org.acme.rope: the project wants 1.2.0 (2 uses), it is not installed; get its "
                                    ".jetplugin file and run 'jet plugins install FILE'"));
    add("org.acme.rope", "1.2.0", R"("requires": ["org.acme.gone"])");
    add("org.acme.glue");
    PluginOptions options;
    options.disabled = {"org.acme.glue"};
    scan(options);
    EXPECT_THAT(told(),
                ElementsAre(HasSubstr("org.acme.glue: the project wants 1.0.0 (1 use), it is disabled: switched off"),
                            HasSubstr("(2 uses), it is faulted: it requires org.acme.gone")));
    folder.remove("org.acme.rope");
    add("org.acme.rope", "1.3.0");
    scan();
    EXPECT_THAT(told(),
                ElementsAre("org.acme.rope: the project wants 1.2.0 (2 uses), version 1.3.0 is here; go on with "
                            "the newer one, which the project records when it is saved"));
    folder.remove("org.acme.rope");
    add("org.acme.rope", "1.1.0");
    scan();
    EXPECT_THAT(told(), ElementsAre(HasSubstr("version 1.1.0 is here; install 1.2.0 or later: the older one may not")));
    EXPECT_THAT(checkFrozen(*manager, load().get()).error().text(),
                HasSubstr("project.jet: error: the plugins are not those that are recorded (--frozen):\n  "
                          "org.acme.rope: the project wants 1.2.0"));
}

TEST_F(ProjectDifferencesTest, AnotherPluginThatProvidesTheSameIsNamed)
{
    write(kRecord);
    add("org.acme.rope", "1.2.0");
    add("com.other.glue");
    scan();
    EXPECT_THAT(told(), IsEmpty()) << "it is in use already: its engine 'glue' is the one the scene names";
    EXPECT_THAT(checkFrozen(*manager, load().get()).error().message,
                HasSubstr("com.other.glue: the project uses it and does not record its version"));
}

TEST_F(ProjectDifferencesTest, AProjectWithoutARecordIsAnsweredByTheReverseIndex)
{
    write("");
    add("org.acme.rope", "1.2.0");
    add("org.acme.glue");
    PluginOptions options;
    options.disabled = {"org.acme.glue"};
    scan(options);
    EXPECT_THAT(told(), ElementsAre(HasSubstr("org.acme.glue: the project wants it (1 use), it is disabled")));
}

TEST_F(ProjectDifferencesTest, ThePluginsJetsetBesideTheProjectCountsToo)
{
    write(kRecord);
    add("org.acme.rope", "1.2.0");
    add("org.acme.glue");
    std::ofstream(game() / "plugins.jetset")
        << R"({ "plugins": ["org.acme.exporter ^2"], "optional": ["org.acme.maybe"] })";
    scan();
    EXPECT_THAT(told(), ElementsAre(HasSubstr("org.acme.exporter: the plugin set wants ^2, it is not installed")));
    EXPECT_THAT(checkFrozen(*manager, load().get()).error().message,
                HasSubstr("gives no exact version of org.acme.exporter ^2"));
}

TEST_F(ProjectDifferencesTest, TheVersionTheProjectsSetWantsIsUsedOfSeveralCopies)
{
    write(kRecord);
    add("org.acme.rope", "1.2.0", "", "rope-1.2");
    add("org.acme.rope", "1.3.0", "", "rope-1.3");
    add("org.acme.glue");
    std::ofstream(game() / "plugins.jetset") << R"({ "plugins": ["org.acme.rope =1.2.0", "org.acme.glue =1.0.0"] })";
    PluginControl control(scan(), events);
    EXPECT_THAT(told(), ElementsAre(HasSubstr("version 1.3.0 is here")));
    EXPECT_EQ(control.setProject(game()), "");
    EXPECT_THAT(told(), IsEmpty());
    EXPECT_TRUE(checkFrozen(*manager, load().get()));
    control.setProject(config.path());
    EXPECT_EQ(manager->plugin("org.acme.rope")->manifest.version.text(), "1.3.0") << "another project, another wish";
}

TEST_F(ProjectDifferencesTest, SavingRecordsVersionsAndCountsAnew)
{
    write(kRecord);
    add("org.acme.rope", "1.3.0");
    add("org.acme.glue");
    scan();
    const auto project = load();
    EXPECT_EQ(project->recordedPlugins()[1].version, "1.2.0");
    EXPECT_EQ(project->recordedPlugins()[1].count, 2);
    project->removeScene(*project->scene("rope2"));
    EXPECT_EQ(project->recordedPlugins()[1].count, 2) << "as in the file";
    ASSERT_TRUE(project->save());
    EXPECT_EQ(project->recordedPlugins()[1].count, 1);
    EXPECT_EQ(project->recordedPlugins()[1].version, "1.3.0");
    EXPECT_THAT(readFile(game() / "project.jet").orThrow(),
                HasSubstr(R"(<plugin id="org.acme.rope" version="1.3.0" uses="1" provides="physicsEngines/rope"/>)"));
    EXPECT_THAT(told(), IsEmpty());
}

}  // namespace
}  // namespace jet::host
