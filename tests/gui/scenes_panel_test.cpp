#include "scenes/scenes_widget.hpp"
#include "window_fixture.hpp"

#include <jet/assets.hpp>
#include <jet/format.hpp>
#include <jet/journal.hpp>

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>
#include <QTest>
#include <QTimer>
#include <QToolButton>

#include <fstream>

namespace jet::test {

namespace fs = std::filesystem;
using scenes::Row;

/// The panel in a dock of the window, so that focus and shortcuts are as a user has them.
class ScenesPanelTest : public WindowFixture {
protected:
    ScenesPanelTest()
    {
        QApplication::setDoubleClickInterval(1);  // clicks of a test come fast, and are two clicks all the same
        dock();
    }
    ~ScenesPanelTest() override
    {
        QApplication::setDoubleClickInterval(400);
        delete panel_;
    }

    void dock()
    {
        delete panel_;
        panel_ = new scenes::ScenesWidget(window());
        auto* dock = new QDockWidget(&window());
        dock->setObjectName("scenes-of-the-test");
        dock->setWidget(panel_);
        window().addDockWidget(Qt::RightDockWidgetArea, dock);
        dock->show();
        window().activateWindow();
        settle();
    }
    static void settle() { QTest::qWait(1), QApplication::processEvents(); }
    scenes::ProjectRows& rows() { return panel_->rows(); }
    Project& project() { return window().project(); }
    Filter& root() { return project().root(); }

    std::vector<std::string> sceneNames()
    {
        std::vector<std::string> names;
        for (const Scene* one : project().scenes()) names.push_back(one->name());
        return names;
    }
    /// The first row with that text; null where there is none.
    QTreeWidgetItem* item(const char* text)
    {
        settle();
        const auto found = rows().findItems(text, Qt::MatchExactly | Qt::MatchRecursive);
        return found.isEmpty() ? nullptr : found.front();
    }
    void select(const char* text)
    {
        QTest::mouseClick(rows().viewport(), Qt::LeftButton, {}, rows().visualItemRect(item(text)).center());
    }
    void press(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
    {
        QTest::keyClick(&rows(), static_cast<Qt::Key>(key), modifiers);
        settle();
    }
    void type(const char* name)
    {
        auto* line = rows().findChild<QLineEdit*>();
        ASSERT_NE(line, nullptr) << "no name is being edited";
        line->selectAll();
        QTest::keyClicks(line, name);
        QTest::keyClick(line, Qt::Key_Return);
        settle();
    }
    std::string undoText()
    {
        window().actionTable().refresh();
        return window().actionTable().find("edit.undo")->text().toStdString();
    }
    /// An entry of the context menu of a row.
    void choose(const char* entry, const char* row)
    {
        select(row);
        const QPoint at = rows().visualItemRect(item(row)).center();
        // The menu is modal: its entry is pressed from inside.
        QTimer::singleShot(0, panel_, [entry] {
            auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
            if (!menu) return ADD_FAILURE() << "no menu";
            for (QAction* action : menu->actions())
                if (action->text() == entry) action->trigger();
            menu->close();
        });
        emit rows().customContextMenuRequested(at);
    }
    void clickButton(const char* name) { QTest::mouseClick(panel_->findChild<QToolButton*>(name), Qt::LeftButton); }
    fs::path saved()
    {
        EXPECT_TRUE(window().projects().saveAs(folder("game")));
        return project().folder();
    }

    scenes::ScenesWidget* panel_ = nullptr;
};

TEST_F(ScenesPanelTest, ShowsScenesScriptsAndTheStart)
{
    auto edit = scene().items().begin("Add");
    const Item& script = edit.add<ScriptItem>(scene().root());
    edit.set(script, "name", "steer");
    edit.commit();
    ASSERT_NE(item("Scene 0"), nullptr);
    EXPECT_FALSE(item("Scene 0")->icon(1).isNull()) << "it plays first";
    ASSERT_NE(item("steer"), nullptr);
    EXPECT_EQ(item("steer")->parent(), item("Scene 0"));
}

TEST_F(ScenesPanelTest, ANewSceneIsNamedAtOnceAndUndoTakesItBack)
{
    select("Scene 0");
    clickButton("New scene");
    type("Menu");
    EXPECT_EQ(sceneNames(), (std::vector<std::string>{"Scene 0", "Menu"}));
    EXPECT_EQ(undoText(), "&Undo Rename scene Scene 1");
    press(Qt::Key_Z, Qt::ControlModifier);
    press(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(sceneNames(), (std::vector<std::string>{"Scene 0"}));
    press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(sceneNames(), (std::vector<std::string>{"Scene 0", "Menu"}));
}

TEST_F(ScenesPanelTest, UndoIsForWhatHasTheFocus)
{
    draw("rectangle", {100, 100}, {150, 150});
    select("Scene 0");
    press(Qt::Key_D, Qt::ControlModifier);
    ASSERT_EQ(sceneNames(), (std::vector<std::string>{"Scene 0", "Scene 1"}));
    view().setFocus();
    EXPECT_EQ(undoText(), "&Undo Create rectangle");
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(shapes().empty());
    EXPECT_EQ(sceneNames().size(), 2u);
    rows().setFocus();
    EXPECT_EQ(undoText(), "&Undo Duplicate scene Scene 0");
    press(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(sceneNames().size(), 1u);
}

TEST_F(ScenesPanelTest, ADeletedSceneComesBackWithContentHistoryAndTab)
{
    draw("rectangle", {100, 100}, {150, 150});
    trigger("scene.new");
    Scene& gone = *project().scene("Scene 0");
    const auto before = gone.hash();
    select("Scene 0");
    press(Qt::Key_Delete);
    EXPECT_EQ(sceneNames(), (std::vector<std::string>{"Scene 1"}));
    EXPECT_EQ(window().documents().viewOf(gone), nullptr) << "its tab is closed";
    EXPECT_EQ(undoText(), "&Undo Remove scene Scene 0");
    press(Qt::Key_Z, Qt::ControlModifier);
    ASSERT_EQ(project().scene("Scene 0"), &gone);
    EXPECT_EQ(gone.hash(), before);
    ASSERT_NE(window().documents().viewOf(gone), nullptr) << "its tab is open again";
    gone.undoRedo().undo();
    EXPECT_TRUE(shapes().empty()) << "its own history came with it";
}

TEST_F(ScenesPanelTest, DeleteIsForTheSceneNotForItemsSelectedInTheDrawing)
{
    draw("rectangle", {100, 100}, {150, 150});
    ASSERT_FALSE(scene().items().selection().empty());
    select("Scene 0");
    press(Qt::Key_Delete);
    EXPECT_EQ(shapes().size(), 1u);
    EXPECT_EQ(sceneNames().size(), 1u) << "the last one stays";
    EXPECT_NE(window().messages().text().indexOf("at least one scene"), -1);
}

TEST_F(ScenesPanelTest, ADuplicateHasTheContentAndALifeOfItsOwn)
{
    draw("rectangle", {100, 100}, {150, 150});
    const auto before = scene().hash();
    select("Scene 0");
    clickButton("Duplicate");
    Scene& copy = *project().scene("Scene 1");
    EXPECT_EQ(copy.hash(), before);
    window().openScene(copy);
    draw("rectangle", {200, 100}, {250, 150});
    EXPECT_EQ(project().scene("Scene 0")->hash(), before);
    saved();
    ASSERT_TRUE(window().projects().open(folder("game")));
    EXPECT_EQ(shapes().size(), 1u);
    EXPECT_EQ(project().scene("Scene 1")->items().itemCount(), 3u);
}

TEST_F(ScenesPanelTest, RenamingByKeyRefusesANameThatIsTaken)
{
    trigger("scene.new");
    select("Scene 1");
    press(Qt::Key_F2);
    type("Scene 0");
    EXPECT_EQ(sceneNames(), (std::vector<std::string>{"Scene 0", "Scene 1"}));
    EXPECT_NE(window().messages().text().indexOf("already"), -1);
    ASSERT_NE(item("Scene 1"), nullptr) << "the row shows the name that is";
    select("Scene 1");
    press(Qt::Key_F2);
    type("Level");
    EXPECT_EQ(sceneNames(), (std::vector<std::string>{"Scene 0", "Level"}));
    EXPECT_EQ(window().documents().tabText(1).toStdString(), "Level");
}

TEST_F(ScenesPanelTest, KeysMoveScenesAndTheStartIsChosen)
{
    for (int i = 0; i < 2; ++i) trigger("scene.new");
    select("Scene 2");
    press(Qt::Key_Up, Qt::AltModifier);
    EXPECT_EQ(sceneNames(), (std::vector<std::string>{"Scene 0", "Scene 2", "Scene 1"}));
    press(Qt::Key_Down, Qt::AltModifier);
    EXPECT_EQ(sceneNames(), (std::vector<std::string>{"Scene 0", "Scene 1", "Scene 2"}));
    window().projectTree().makeStart(*project().scene("Scene 2"));
    settle();
    EXPECT_FALSE(item("Scene 2")->icon(1).isNull());
    EXPECT_TRUE(item("Scene 0")->icon(1).isNull());
    EXPECT_EQ(undoText(), "&Undo Start with scene Scene 2");
}

TEST_F(ScenesPanelTest, PlayFirstLeavesTheSceneInItsPlaceAndIsSaved)
{
    trigger("scene.new");
    select("Scene 1");
    choose("Play first", "Scene 1");
    EXPECT_EQ(sceneNames(), (std::vector<std::string>{"Scene 0", "Scene 1"}));
    EXPECT_FALSE(item("Scene 1")->icon(1).isNull());
    const fs::path place = saved();
    ASSERT_TRUE(window().projects().open(place));
    EXPECT_EQ(scene().name(), "Scene 1") << "it opens first, too";
    EXPECT_FALSE(item("Scene 1")->icon(1).isNull());
}

TEST_F(ScenesPanelTest, ADropPutsASceneIntoAFilter)
{
    trigger("scene.new");
    select("Scene 0");
    clickButton("New filter");
    type("Levels");
    // As a drop within the tree tells it; Qt has no way to fake the drag itself.
    emit rows().moved(rows().rowOf(*item("Scene 1")), root().filters.front().get(), -1);
    settle();
    ASSERT_EQ(root().filters.front()->scenes.size(), 1u);
    EXPECT_EQ(item("Scene 1")->parent(), item("Levels"));
    press(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(root().filters.front()->scenes.empty());
}

TEST_F(ScenesPanelTest, ADoubleClickOpensScenesAndScripts)
{
    trigger("scene.new");
    auto edit = project().scene("Scene 0")->items().begin("Add");
    edit.set(edit.add<ScriptItem>(project().scene("Scene 0")->root()), "name", "steer");
    edit.commit();
    const auto open = [&](const char* text) {
        const QPoint at = rows().visualItemRect(item(text)).center();
        QTest::mouseClick(rows().viewport(), Qt::LeftButton, {}, at);
        QTest::mouseDClick(rows().viewport(), Qt::LeftButton, {}, at);
        settle();
    };
    open("Scene 0");
    EXPECT_EQ(window().activeScene(), project().scene("Scene 0"));
    open("steer");
    EXPECT_EQ(window().documents().currentView(), nullptr);
    EXPECT_EQ(window().documents().tabText(window().documents().currentIndex()).toStdString().find("steer"), 0u);
}

TEST_F(ScenesPanelTest, ScriptsAreDeletedFromHereAndUndoBringsTheTextBack)
{
    auto edit = scene().items().begin("Add");
    const Item& script = edit.add<ScriptItem>(scene().root());
    edit.set(script, "name", "steer");
    edit.set(script, "code", "var a = 1;");
    edit.commit();
    const auto before = scene().hash();
    select("steer");
    press(Qt::Key_Delete);
    EXPECT_EQ(item("steer"), nullptr);
    EXPECT_EQ(undoText(), "&Undo Delete");
    press(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_NE(item("steer"), nullptr);
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(ScenesPanelTest, TextTypedInATabOfADeletedSceneIsThereAfterUndo)
{
    trigger("scene.new");
    Scene& gone = *project().scene("Scene 0");
    auto edit = gone.items().begin("Add");
    const Item& script = edit.add<ScriptItem>(gone.root());
    edit.commit();
    const ItemId id = script.id();
    window().openScript(gone, id, 0);
    auto* tab = qobject_cast<host::ScriptTab*>(window().documents().currentWidget());
    ASSERT_NE(tab, nullptr);
    QTest::keyClicks(&tab->code(), "typed");
    window().projectTree().remove(gone);
    settle();
    window().projectTree().undo();
    EXPECT_EQ(gone.items().find(id)->property("code")->as<std::string>(), "typed");
}

// --- files

class ScenesPanelFilesTest : public ScenesPanelTest {
protected:
    ScenesPanelFilesTest()
    {
        game = saved();
        writeFileAtomically(folder("cat.png"), std::string_view("a cat")).orThrow();
        panel_->setFileQuestion([this] { return QStringList{QString::fromStdString(folder("cat.png").string())}; });
    }
    const Item& picture(const std::string& file)
    {
        auto edit = scene().items().begin("Add");
        const Item& item = edit.add<ImageItem>(scene().root(), Path::rectangle(Box({0, 0}, {10, 10})));
        edit.set(item, "file", file);
        edit.commit();
        return item;
    }
    fs::path game;
};

TEST_F(ScenesPanelFilesTest, AnAddedFileIsCopiedIntoTheProjectAndUndoTakesItOut)
{
    clickButton("Add files…");
    ASSERT_NE(item("assets/cat.png"), nullptr);
    EXPECT_EQ(readFile(game / "assets/cat.png").orThrow(), "a cat");
    press(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(item("assets/cat.png"), nullptr);
    EXPECT_FALSE(fs::exists(game / "assets/cat.png"));
    press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(readFile(game / "assets/cat.png").orThrow(), "a cat");
}

TEST_F(ScenesPanelFilesTest, ARenamedFileIsFollowedByWhatUsesIt)
{
    clickButton("Add files…");
    const ItemId id = picture("assets/cat.png").id();
    select("assets/cat.png");
    press(Qt::Key_F2);
    type("assets/tom.png");
    EXPECT_TRUE(fs::exists(game / "assets/tom.png"));
    EXPECT_EQ(scene().items().find(id)->property("file")->as<std::string>(), "assets/tom.png");
    press(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(fs::exists(game / "assets/cat.png"));
    EXPECT_EQ(scene().items().find(id)->property("file")->as<std::string>(), "assets/cat.png");
}

TEST_F(ScenesPanelFilesTest, AFileInUseIsNotDeletedAndOneThatIsNotComesBack)
{
    clickButton("Add files…");
    const ItemId id = picture("assets/cat.png").id();
    select("assets/cat.png");
    press(Qt::Key_Delete);
    EXPECT_TRUE(fs::exists(game / "assets/cat.png"));
    EXPECT_NE(window().messages().text().indexOf("uses this file"), -1);
    auto edit = scene().items().begin("Delete");
    edit.remove(*scene().items().find(id));
    edit.commit();
    select("assets/cat.png");
    press(Qt::Key_Delete);
    EXPECT_FALSE(fs::exists(game / "assets/cat.png"));
    press(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(readFile(game / "assets/cat.png").orThrow(), "a cat");
}

TEST_F(ScenesPanelFilesTest, ClosingWithoutSavingPutsFilesBackToWhereTheSavedScenesExpectThem)
{
    clickButton("Add files…");
    picture("assets/cat.png");
    ASSERT_TRUE(window().projects().save());
    window().projectTree().renameFile("assets/cat.png", "tom.png");
    window().projects().create();  // the question is answered with Discard
    EXPECT_TRUE(fs::exists(game / "assets/cat.png"));
    EXPECT_FALSE(fs::exists(game / "assets/tom.png"));
}

TEST_F(ScenesPanelFilesTest, RemovedFilesGoForGoodOnlyWhenAskedAndNotNeededByUndo)
{
    const fs::path shelf = project().folder() / ".jet-removed";
    fs::create_directories(shelf);
    std::ofstream(shelf / "1 old.png") << "of an earlier session";
    int asked = 0;
    bool yes = false;
    panel_->setEmptyQuestion([&](const QString& question) {
        ++asked;
        EXPECT_TRUE(question.contains("1 old.png")) << question.toStdString();
        EXPECT_FALSE(question.contains("2 ")) << "what Undo needs is not in question";
        return yes;
    });
    std::ofstream(project().folder() / "unused.txt") << "note";
    window().projectTree().removeFile("unused.txt");
    const auto empty = [&] { choose("Empty removed files…", "Files"); };
    empty();
    EXPECT_EQ(asked, 1);
    EXPECT_TRUE(fs::exists(shelf / "1 old.png")) << "the answer was no";
    yes = true;
    empty();
    EXPECT_FALSE(fs::exists(shelf / "1 old.png"));
    window().projectTree().undo();
    EXPECT_TRUE(fs::exists(project().folder() / "unused.txt"));
    window().projectTree().redo();
    empty();
    EXPECT_EQ(asked, 2) << "nothing that may go is left: no question";
}

TEST_F(ScenesPanelFilesTest, AMissingFileIsShownAsMissing)
{
    picture("assets/gone.png");
    clickButton("New filter");
    ASSERT_NE(item("assets/gone.png"), nullptr);
    EXPECT_NE(item("assets/gone.png")->toolTip(0).indexOf("missing"), -1);
}

}  // namespace jet::test
