// "Collect into project": what a project uses comes into its folder, once, under a name of its own.
#include "host/projects/collect.hpp"

#include "project_files.hpp"

namespace jet::host {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class CollectTest : public ProjectFilesTest {
protected:
    static std::string image(int id, const std::string& file)
    {
        return "<item type=\"image\" id=\"" + std::to_string(id) + "\" name=\"I" + std::to_string(id) +
               "\"><property id=\"file\">" + file + "</property></item>\n";
    }
    static std::string fileOf(const Project& project, std::uint64_t id)
    {
        return project.scenes()[0]->items().find(ItemId{id})->properties().find("file")->text();
    }
};

TEST_F(CollectTest, FilesElsewhereAreCopiedAndReferredToByRelativePaths)
{
    write("pictures/tree.png", "tree");
    write("game/own.png", "own");
    writeGame(image(1, "../pictures/tree.png") + image(2, (folder / "pictures/tree.png").string()) +
              image(3, "own.png") + image(4, (folder / "game/own.png").string()));
    const auto project = load();
    const auto made = collectAssets(*project).orThrow();
    ASSERT_THAT(made.copies, SizeIs(1));
    EXPECT_EQ(made.copies[0].from, folder / "pictures/tree.png");
    EXPECT_EQ(made.copies[0].to, "assets/tree.png");
    EXPECT_EQ(made.references, 3u);
    EXPECT_EQ(fileOf(*project, 1), "assets/tree.png");
    EXPECT_EQ(fileOf(*project, 2), "assets/tree.png");
    EXPECT_EQ(fileOf(*project, 3), "own.png");
    EXPECT_EQ(fileOf(*project, 4), "own.png") << "in the project already, by an absolute path";
    EXPECT_EQ(read("game/assets/tree.png"), "tree");
    EXPECT_EQ(read("pictures/tree.png"), "tree") << "a copy";
    project->save().orThrow();
    EXPECT_EQ(load()->hash(), project->hash());
}

TEST_F(CollectTest, ItIsOneUndoStepAndTheSecondTimeThereIsNothingToDo)
{
    write("a.png", "a"), write("b.png", "b");
    writeGame(image(1, "../a.png") + image(2, "../b.png"));
    const auto project = load();
    Scene& scene = *project->scenes()[0];
    const std::uint64_t before = scene.hash();
    ASSERT_TRUE(collectAssets(*project));
    EXPECT_EQ(scene.undoRedo().labels(), std::vector<std::string>{"Collect into project"});
    scene.undoRedo().undo();
    EXPECT_EQ(scene.hash(), before);
    scene.undoRedo().redo();
    const auto again = collectAssets(*project).orThrow();
    EXPECT_THAT(again.copies, IsEmpty());
    EXPECT_EQ(again.references, 0u);
    EXPECT_EQ(scene.undoRedo().size(), 1u);
}

TEST_F(CollectTest, EqualContentIsOneFileAndOtherContentGetsAnotherName)
{
    write("one/x.png", "same"), write("two/y.png", "same"), write("three/x.png", "other"), write("four/X.png", "third");
    write("game/assets/z.png", "fifth"), write("five/q.png", "fifth");
    writeGame(image(1, "../one/x.png") + image(2, "../two/y.png") + image(3, "../three/x.png") +
              image(4, "../four/X.png") + image(5, "../five/q.png"));
    const auto project = load();
    const auto made = collectAssets(*project).orThrow();
    EXPECT_THAT(made.copies, SizeIs(3));
    EXPECT_EQ(fileOf(*project, 1), "assets/x.png");
    EXPECT_EQ(fileOf(*project, 2), "assets/x.png") << "the same content";
    EXPECT_EQ(fileOf(*project, 3), "assets/x 2.png");
    EXPECT_EQ(fileOf(*project, 4), "assets/X 3.png") << "not only differing in case";
    EXPECT_EQ(fileOf(*project, 5), "assets/z.png") << "it was there already";
    EXPECT_EQ(read("game/assets/x 2.png"), "other");
}

TEST_F(CollectTest, MissingFilesAndAbsentPluginsAreToldAndStayAsTheyAre)
{
    write("noise.wav", "x");
    writeGame(image(1, "../gone.png") + image(2, "https://example.org/a.png") +
              "<item type=\"acme-cloud\" id=\"3\" name=\"Cloud\"><property "
              "id=\"rain-file\">../noise.wav</property></item>\n");
    const auto project = load();
    const std::uint64_t before = project->hash();
    const auto made = collectAssets(*project).orThrow();
    EXPECT_EQ(project->hash(), before);
    EXPECT_THAT(made.copies, IsEmpty());
    EXPECT_THAT(describe(made),
                ElementsAre(HasSubstr("'I1' in the scene 'One' refers to the file '../gone.png', which is not there"),
                            HasSubstr("cannot be changed without its plugin")));
}

TEST_F(CollectTest, WhenACopyFailsNoSceneIsChanged)
{
    write("a.png", "a");
    writeGame(image(1, "../a.png"));
    write("game/assets", "a file where the folder should be");
    const auto project = load();
    const std::uint64_t before = project->hash();
    const auto made = collectAssets(*project);
    ASSERT_FALSE(made);
    EXPECT_THAT(made.error().text(), HasSubstr("this folder cannot be made"));
    EXPECT_EQ(project->hash(), before);
    EXPECT_FALSE(project->isModified());
    EXPECT_THAT(collectAssets(*Project::create("New", events, catalog)).error().text(), HasSubstr("save it"));
}

}  // namespace
}  // namespace jet::host
