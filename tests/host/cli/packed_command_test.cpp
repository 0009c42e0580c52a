// jet project pack, unpack and collect, and the commands that read a packed project.
#include "cli_fixture.hpp"

namespace jet::test {
namespace {

class PackedCommandTest : public CliTest {
protected:
    PackedCommandTest() { writeGame(); }
    std::map<std::string, std::string> below(const std::string& folder) const
    {
        std::map<std::string, std::string> all;
        for (const auto& [name, content] : files())
            if (name.starts_with(folder + "/")) all[name.substr(folder.size() + 1)] = content;
        return all;
    }
};

TEST_F(PackedCommandTest, PackAndUnpackGiveTheSameFiles)
{
    const Outcome packed = jet("project pack game");
    EXPECT_EQ(packed.code, 0) << packed.err;
    EXPECT_THAT(packed.out, HasSubstr("packed 3 files into game.jetz"));
    EXPECT_EQ(jet("project pack game -o other.jetz").code, 0);
    EXPECT_EQ(read("game.jetz"), read("other.jetz"));
    const Outcome unpacked = jet("project unpack game.jetz copy");
    EXPECT_EQ(unpacked.code, 0) << unpacked.err;
    EXPECT_THAT(unpacked.out, HasSubstr("unpacked copy/project.jet"));
    EXPECT_EQ(below("copy"), below("game"));
    EXPECT_THAT(jet("project unpack game.jetz copy").err, HasSubstr("copy: error: is not an empty folder"));
    EXPECT_EQ(json(jet("--json project pack game").out)["files"], 3);
}

TEST_F(PackedCommandTest, CommandsThatReadTakeAPackedProjectAndLeaveNothingBehind)
{
    jet("project pack game");
    const Outcome check = jet("project check game.jetz");
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_THAT(check.out, HasSubstr("fine: 2 scenes"));
    EXPECT_EQ(json(jet("--json project info game.jetz").out)["hash"],
              json(jet("--json project info game").out)["hash"]);
    EXPECT_THAT(jet("play game.jetz --steps 1").err, HasSubstr("physics")) << "as without: no engine is installed here";
    EXPECT_EQ(jet("convert game.jetz folder").code, 0);
    EXPECT_EQ(json(jet("--json project info folder").out)["scenes"].size(), 2u);
    EXPECT_EQ(jet("convert game again.jetz").code, 0);
    EXPECT_EQ(read("again.jetz"), read("game.jetz"));
    const std::string before = read("game.jetz");
    const Outcome save = jet("project save game.jetz");
    EXPECT_EQ(save.code, 1);
    EXPECT_THAT(save.err,
                HasSubstr("game.jetz: error: this is a project packed into one file, for sending; unpack it"));
    EXPECT_EQ(read("game.jetz"), before);
}

TEST_F(PackedCommandTest, MessagesNameThePackedFileAndTheOneInIt)
{
    write("game/two.scene", "<scene version=\"1\">\n<item/></scene>\n");
    write("good/project.jet", read("game/project.jet"));
    write("good/one.scene", read("game/two.scene")), write("good/two.scene", "<scene version=\"1\"/>\n");
    EXPECT_EQ(jet("project pack game").code, 1) << "what does not open is not sent";
    EXPECT_FALSE(exists("game.jetz"));
    // Somebody else may have packed it all the same.
    ASSERT_EQ(
        std::system(
            ("cd '" + file("good") + "' && python3 -m zipfile -c ../bad.jetz project.jet one.scene two.scene").c_str()),
        0);
    EXPECT_THAT(jet("project check bad.jetz").err, testing::StartsWith("bad.jetz/one.scene:2:2: error: "));
    EXPECT_THAT(json(jet("--json project check bad.jetz").out)["errors"][0]["file"], "bad.jetz/one.scene");
    write("bad.jetz", "no zip");
    for (const char* command : {"project check", "project info", "play"}) {
        const Outcome refused = jet(std::string(command) + " bad.jetz");
        EXPECT_EQ(refused.code, 1) << command;
        EXPECT_THAT(refused.err, HasSubstr("bad.jetz: error: this is no packed project, or it is damaged")) << command;
    }
}

TEST_F(PackedCommandTest, CheckRepairsWithABackupAndSaysSo)
{
    write("game/two.scene", "<scene version=\"1\">\n<item type=\"group\" id=\"1\" name=\"A\"/>\n<item type=\"group\" "
                            "id=\"1\" name=\"B\"/>\n</scene>\n");
    const Outcome found = jet("project check game");
    EXPECT_EQ(found.code, 1);
    EXPECT_EQ(found.err,
              "game/two.scene:3:2: error: there is another item with the id 1; with --repair it gets the id 2\n");
    EXPECT_THAT(found.out, HasSubstr("game/project.jet: 1 errors, of which --repair mends 1"));
    const Outcome repaired = jet("--json project check game --repair");
    EXPECT_EQ(repaired.code, 0) << repaired.err;
    const auto told = json(repaired.out);
    EXPECT_EQ(told["ok"], true);
    EXPECT_EQ(told["problems"][0]["repaired"], true);
    EXPECT_EQ(told["problems"][0]["line"], 3);
    EXPECT_EQ(told["written"].size(), 1u);
    EXPECT_THAT(jet("project check game").out, HasSubstr("fine: 2 scenes"));
    EXPECT_EQ(json(jet("--json project backups game").out).size(), 1u);
    jet("project pack game");
    EXPECT_THAT(jet("project check game.jetz --repair").err, HasSubstr("is not repaired in place; unpack it"));
}

TEST_F(PackedCommandTest, CollectBringsFilesIntoTheProject)
{
    write("tree.png", "tree");
    write("game/two.scene", "<scene version=\"1\">\n<item type=\"image\" id=\"1\" name=\"Tree\"><property "
                            "id=\"file\">../tree.png</property></item></scene>\n");
    EXPECT_THAT(jet("project pack game").err, HasSubstr("tree.png: warning: lies outside of the project"));
    const Outcome collected = jet("project collect game");
    EXPECT_EQ(collected.code, 0) << collected.err;
    EXPECT_THAT(collected.out, HasSubstr("tree.png -> assets/tree.png\n1 files copied, 1 references rewritten"));
    EXPECT_EQ(read("game/assets/tree.png"), "tree");
    EXPECT_THAT(read("game/two.scene"), HasSubstr("assets/tree.png</property>"));
    EXPECT_THAT(jet("project pack game").err, testing::Not(HasSubstr("tree.png")));
    std::filesystem::remove(file("game/assets/tree.png"));
    const Outcome missing = jet("--json project collect game");
    EXPECT_EQ(missing.code, 1);
    EXPECT_EQ(json(missing.out)["ok"], false);
    EXPECT_THAT(json(missing.out)["problems"][0], HasSubstr("'Tree' in the scene 'Two' refers to the file"));
}

TEST_F(PackedCommandTest, WhatCannotBeMeantIsRefused)
{
    EXPECT_THAT(jet("project pack game -o game.zip").err, HasSubstr("the name of a packed project ends in .jetz"));
    EXPECT_THAT(jet("project pack nothing").err, HasSubstr("nothing"));
    EXPECT_EQ(jet("project unpack").code, 2);
    EXPECT_THAT(jet("project unpack nothing.jetz copy").err, HasSubstr("nothing.jetz: error: cannot be opened"));
    EXPECT_FALSE(exists("copy"));
}

}  // namespace
}  // namespace jet::test
