// jet plugins new: what it writes, and what it refuses. That the projects build is tried by scripts/check-examples.
#include "cli_fixture.hpp"

#include <sys/stat.h>

namespace jet::test {
namespace {

class PluginNewCommandTest : public CliTest {
protected:
    PluginNewCommandTest() { std::filesystem::remove(file("test.jetset")); }
};

class EachKindOfNewPlugin : public PluginNewCommandTest, public testing::WithParamInterface<const char*> {};

TEST_P(EachKindOfNewPlugin, HasManifestTestReadmeAndCiFileInItsOwnName)
{
    const std::string kind = GetParam();
    const Outcome run = plain("plugins new " + kind + " rope-bridge 'my bridge'");
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("my bridge/build.sh'"));
    EXPECT_THAT(run.out, HasSubstr("--plugin-path '"));
    const auto all = files();
    for (const char* name : {"CMakeLists.txt", "plugin.json", "README.md", "build.sh", ".gitignore",
                             ".github/workflows/ci.yml", "rope_bridge.cpp", "rope_bridge_test.cpp"})
        EXPECT_TRUE(all.contains(std::string("my bridge/") + name)) << name;
    for (const auto& [name, content] : all) {
        for (const char* word : {"my-plugin", "my_plugin", "MyPlugin", "My plugin", "my-jet-prefix"}) {
            EXPECT_EQ(content.find(word), std::string::npos) << name << " still says " << word;
            EXPECT_EQ(name.find(word), std::string::npos);
        }
    }
    const auto manifest = json(read("my bridge/plugin.json"));
    EXPECT_EQ(manifest["id"], "org.example.rope-bridge");
    EXPECT_EQ(manifest["name"], "Rope bridge");
    EXPECT_EQ(manifest["library"], "rope-bridge");
    EXPECT_THAT(read("my bridge/rope_bridge.cpp"), HasSubstr("RopeBridge"));
    struct stat status {};
    ASSERT_EQ(::stat(file("my bridge/build.sh").c_str(), &status), 0);
    EXPECT_TRUE(status.st_mode & S_IXUSR) << "build.sh can be run";
}

INSTANTIATE_TEST_SUITE_P(Kinds, EachKindOfNewPlugin,
                         testing::Values("tool", "effect", "importer", "exporter", "panel", "command", "item", "script",
                                         "physics"));

TEST_F(PluginNewCommandTest, TakesTheNameForTheFolderAndAnIdOfOnesOwn)
{
    const Outcome run = plain("plugins new tool rope --id org.acme.rope --json");
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(json(run.out)["id"], "org.acme.rope");
    EXPECT_EQ(json(run.out)["folder"], file("rope"));
    EXPECT_EQ(json(read("rope/plugin.json"))["id"], "org.acme.rope");
    EXPECT_EQ(json(read("rope/plugin.json"))["contributes"]["tools"][0]["id"], "rope");
    EXPECT_THAT(read("rope/rope_test.cpp"), HasSubstr("\"org.acme.rope\""));
}

TEST_F(PluginNewCommandTest, ABadNameKindOrIdIsRefusedAndNothingIsWritten)
{
    const auto before = files();
    for (const char* arguments :
         {"tool Rope", "tool 2d", "tool rope-", "tool ro--pe", "tool 'ro pe'", "tool ../rope", "tool ''", "tool test",
          "tool aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", "car rope", "common rope", "tool rope --id rope",
          "tool rope --id org..rope", "tool rope --id 'org.a b'"}) {
        const Outcome run = plain(std::string("plugins new ") + arguments);
        EXPECT_EQ(run.code, 2) << arguments;
        EXPECT_THAT(run.err, HasSubstr("error: ")) << arguments;
    }
    EXPECT_EQ(files(), before);
    EXPECT_THAT(plain("plugins new car rope").err, HasSubstr("command, effect, exporter, importer, item, panel"));
    EXPECT_THAT(plain("plugins new tool Rope").err, HasSubstr("for example 'rope-bridge'"));
}

TEST_F(PluginNewCommandTest, AFolderInUseIsRefusedAndStaysAsItWas)
{
    write("taken/notes.txt", "mine");
    write("file", "mine");
    const auto before = files();
    const Outcome taken = plain("plugins new tool rope taken");
    EXPECT_EQ(taken.code, 1);
    EXPECT_THAT(taken.err, HasSubstr("taken is not empty; name a folder that does not exist yet"));
    EXPECT_EQ(plain("plugins new tool rope file").code, 1);
    EXPECT_EQ(plain("plugins new tool rope file/below").code, 1);
    EXPECT_EQ(files(), before);
}

TEST_F(PluginNewCommandTest, AnEmptyFolderAndOneWithASlashAtTheEndWillDo)
{
    std::filesystem::create_directories(file("empty"));
    EXPECT_EQ(plain("plugins new tool rope empty/").code, 0);
    EXPECT_TRUE(exists("empty/plugin.json"));
    EXPECT_EQ(plain("plugins new tool rope deep/er/still").code, 0);
    EXPECT_TRUE(exists("deep/er/still/plugin.json"));
}

}  // namespace
}  // namespace jet::test
