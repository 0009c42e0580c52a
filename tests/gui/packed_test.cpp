// Projects on their way to somebody else, in the window: exported as one file, opened from one, their pictures
// collected.
#include "window_fixture.hpp"

#include <QApplication>
#include <QFileDialog>
#include <QTest>
#include <QTimer>

#include <fstream>
#include <sstream>

namespace jet::test {

namespace fs = std::filesystem;

class PackedTest : public WindowFixture {
protected:
    void unpackTo(const fs::path& folder)
    {
        window().projects().setUnpackQuestion([this, folder](const fs::path& packed) {
            asked_ = packed;
            return folder;
        });
    }
    static std::string read(const fs::path& file)
    {
        std::ifstream in(file, std::ios::binary);
        std::stringstream all;
        all << in.rdbuf();
        return all.str();
    }
    /// A saved project with a rectangle, exported.
    std::uint64_t exported()
    {
        draw("rectangle", {10, 10}, {60, 60});
        EXPECT_TRUE(window().projects().saveAs(folder("game")));
        EXPECT_TRUE(window().projects().exportPacked(folder("game.jetz")));
        return window().project().hash();
    }

    fs::path asked_;
};

TEST_F(PackedTest, OpeningASingleFileAsksForAFolderAndNeverWritesIntoTheFile)
{
    const std::uint64_t hash = exported();
    const std::string bytes = read(folder("game.jetz"));
    start();
    unpackTo(folder("copy"));
    ASSERT_TRUE(window().projects().open(folder("game.jetz")));
    EXPECT_EQ(asked_, folder("game.jetz"));
    EXPECT_EQ(window().project().hash(), hash);
    EXPECT_EQ(window().project().file(), folder("copy") / "project.jet");
    draw("ellipse", {100, 10}, {160, 60});
    EXPECT_TRUE(window().projects().save());
    EXPECT_EQ(read(folder("game.jetz")), bytes);
    EXPECT_NE(read(folder("copy") / "scenes/Scene 0.scene"), read(folder("game") / "scenes/Scene 0.scene"));
}

TEST_F(PackedTest, WithoutAFolderOrInAFullOneThePresentProjectStays)
{
    exported();
    start();
    const Project* before = &window().project();
    unpackTo({});
    EXPECT_FALSE(window().projects().open(folder("game.jetz")));
    unpackTo(folder("game"));
    EXPECT_FALSE(window().projects().open(folder("game.jetz")));
    std::ofstream(folder("bad.jetz")) << "no zip";
    unpackTo(folder("copy"));
    EXPECT_FALSE(window().projects().open(folder("bad.jetz")));
    EXPECT_EQ(&window().project(), before);
    EXPECT_FALSE(fs::exists(folder("copy")));
}

TEST_F(PackedTest, ExportSavesFirstAndAsksWhere)
{
    draw("rectangle", {10, 10}, {60, 60});
    ASSERT_TRUE(window().projects().saveAs(folder("game")));
    draw("rectangle", {100, 10}, {160, 60});
    // The dialog is answered as a user would: a name without its extension, Enter.
    QTimer::singleShot(0, &window(), [this] {
        auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
        ASSERT_NE(dialog, nullptr);
        dialog->selectFile(QString::fromStdString(folder("sent").string()));
        QMetaObject::invokeMethod(dialog, "accept", Qt::QueuedConnection);
    });
    trigger("file.export-single");
    EXPECT_FALSE(window().project().isModified());
    ASSERT_TRUE(fs::exists(folder("sent.jetz")));
    const std::uint64_t hash = window().project().hash();
    start();
    unpackTo(folder("copy"));
    ASSERT_TRUE(window().projects().open(folder("sent.jetz")));
    EXPECT_EQ(window().project().hash(), hash);
}

TEST_F(PackedTest, CollectIntoProjectIsOneUndoStep)
{
    std::ofstream(folder("tree.png")) << "tree";
    ASSERT_TRUE(window().projects().saveAs(folder("game")));
    {
        auto edit = scene().items().begin("Image");
        const Item& image = edit.add<ImageItem>(scene().root(), Path::rectangle(Box({0, 0}, {10, 10})));
        edit.set(image, "file", folder("tree.png").string());
        edit.commit();
    }
    const std::uint64_t before = scene().hash();
    trigger("file.collect");
    EXPECT_EQ(read(folder("game") / "assets/tree.png"), "tree");
    EXPECT_NE(scene().hash(), before);
    EXPECT_EQ(scene().undoRedo().undoLabel(), "Collect into project");
    trigger("edit.undo");
    EXPECT_EQ(scene().hash(), before);
}

}  // namespace jet::test
