// jet convert: any importer to any exporter, one by one or in batches.
#include "cli_fixture.hpp"

namespace jet::test {
namespace {

class ConvertCommandTest : public CliTest {
protected:
    ConvertCommandTest()
    {
        plugins().link("org.jet.test.good");
        write("a.boxes", "0 0 10 10\n20 0 5 5\n");
        write("b.boxes", "0 0 1 1\n");
        write("bad.boxes", "0 0 1 1\nnonsense\n");
    }
};

TEST_F(ConvertCommandTest, AFileBecomesAnother)
{
    const Outcome run = jet("convert a.boxes a.count");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(read("a.count"), "2\n");
}

TEST_F(ConvertCommandTest, AFileBecomesAProjectAndAProjectAFile)
{
    EXPECT_EQ(jet("convert a.boxes game").code, 0);
    EXPECT_EQ(json(jet("--json project info game").out)["scenes"][0]["items"], 2);
    EXPECT_EQ(jet("convert game game.count").code, 0);
    EXPECT_EQ(read("game.count"), "2\n");
}

TEST_F(ConvertCommandTest, EffectsAndPropertiesAreSetOnTheWay)
{
    const Outcome run = jet("convert a.boxes game --apply tint:width=5,color=red --set gravity='0 5'");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(read("game/scenes/Scene 0.scene"), HasSubstr("<property id=\"width\">5</property>"));
    EXPECT_THAT(read("game/scenes/Scene 0.scene"), HasSubstr("<property id=\"gravity\">0 5</property>"));
    for (const auto& [option, message] :
         std::map<std::string, std::string>{{"--apply sparkle", "No installed plugin provides the effect 'sparkle'"},
                                            {"--apply tint:speed=1", "has no property 'speed'"},
                                            {"--apply tint:width=x", "Expected a number"},
                                            {"--apply tint:width=1000", "must be from 0 to 100"},
                                            {"--set speed=1", "no item has a property 'speed'"},
                                            {"--set speed", "is not property=value"},
                                            {"--background nonsense", "nonsense"}}) {
        const Outcome wrong = jet("convert a.boxes other " + option);
        EXPECT_EQ(wrong.code, 1) << option;
        EXPECT_THAT(wrong.err, HasSubstr(message));
        EXPECT_FALSE(exists("other")) << option;
    }
}

TEST_F(ConvertCommandTest, ABrokenFileIsToldWithItsPlaceAndLeavesNothing)
{
    const Outcome run = jet("convert bad.boxes bad.count");
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(run.err, "bad.boxes:2:1: error: a box is four numbers: x y width height\n");
    EXPECT_FALSE(exists("bad.count"));
}

TEST_F(ConvertCommandTest, ABatchGoesOnAfterAFailure)
{
    const Outcome run = jet("convert a.boxes bad.boxes b.boxes missing.boxes '*.count'");
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(run.out, "2 converted, 2 failed\n");
    EXPECT_EQ(lines(run.err), 2u) << run.err;
    EXPECT_EQ(read("a.count") + read("b.count"), "2\n1\n");
    EXPECT_FALSE(exists("bad.count"));
}

TEST_F(ConvertCommandTest, SeveralFilesBecomeScenesOfOneProject)
{
    EXPECT_EQ(jet("convert a.boxes b.boxes game").code, 0);
    EXPECT_EQ(json(jet("--json project info game").out)["scenes"].size(), 2u);
    const Outcome run = jet("convert a.boxes b.boxes one.count");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("several inputs need a project as output, or '*' in its name"));
}

TEST_F(ConvertCommandTest, TwoInputsNeverWriteOneOutput)
{
    write("other/a.boxes", "0 0 1 1\n");
    const Outcome run = jet("convert a.boxes other/a.boxes '*.count'");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("other/a.boxes: error: 'a.count' was made from 'a.boxes' already"));
    EXPECT_EQ(read("a.count"), "2\n");
}

TEST_F(ConvertCommandTest, FormatsNobodyKnowsAreExplained)
{
    const Outcome in = jet("convert a.xyz a.count"), out = jet("convert a.boxes a.xyz");
    EXPECT_EQ(in.code, 1);
    EXPECT_THAT(
        in.err,
        HasSubstr("a.xyz: error: No installed plugin provides the importer for .xyz files; install one that does"));
    EXPECT_EQ(out.code, 1);
    EXPECT_THAT(out.err, HasSubstr("a.xyz: error: No installed plugin provides the exporter for .xyz files"));
    plugins().link("org.jet.test.throws-on-load");
    write("a.licensed", "");
    const Outcome broken = jet("convert a.licensed a.count");
    EXPECT_EQ(broken.code, 1);
    EXPECT_EQ(lines(broken.err), 1u) << broken.err;
    EXPECT_THAT(broken.err, HasSubstr("no licence found"));
}

TEST_F(ConvertCommandTest, AnImporterOrExporterThatThrowsIsNamed)
{
    plugins().link("org.jet.test.throws-inside");
    write("a.fragile", "");
    const std::string options = "--plugins test.jetset --plugin-path '" + plugins().path().string() + "' ";
    const Outcome in = plain(options + "convert a.fragile a.count", "JET_TEST_THROW=Importer::read");
    EXPECT_EQ(in.code, 1);
    EXPECT_THAT(in.err, HasSubstr("Throws inside (org.jet.test.throws-inside 1.0.0)"));
    EXPECT_THAT(in.err, HasSubstr("oops"));
    EXPECT_EQ(lines(in.err), 1u) << in.err;
    EXPECT_FALSE(exists("a.count"));
    const Outcome out = plain(options + "convert a.boxes a.fragile", "JET_TEST_THROW=Exporter::write");
    EXPECT_EQ(out.code, 1);
    EXPECT_THAT(out.err, HasSubstr("oops"));
    EXPECT_FALSE(exists("a.fragile.part"));
}

TEST_F(ConvertCommandTest, AReadOnlyTargetIsLeftAlone)
{
    write("a.count", "old");
    std::filesystem::permissions(home() / "a.count", std::filesystem::perms::owner_read);
    const Outcome run = jet("convert a.boxes a.count");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("a.count: error: cannot be written: Permission denied"));
    EXPECT_EQ(read("a.count"), "old");
}

}  // namespace
}  // namespace jet::test
