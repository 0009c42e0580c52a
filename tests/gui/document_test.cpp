#include "window_fixture.hpp"

#include <jet/format.hpp>

#include <QApplication>
#include <QTest>

#include <fstream>

namespace jet::test {

class DocumentTest : public WindowFixture {
protected:
    void write(const std::filesystem::path& file, std::string_view text) { std::ofstream(file) << text; }
};

TEST_F(DocumentTest, ASavedProjectReopensEqual)
{
    draw("rectangle", {10, 10}, {60, 60});
    draw("ellipse", {100, 10}, {160, 60});
    const std::uint64_t hash = window().project().hash();
    ASSERT_TRUE(window().projects().saveAs(folder("game")));
    EXPECT_FALSE(window().isWindowModified());
    start();
    ASSERT_TRUE(window().projects().open(folder("game")));
    EXPECT_EQ(window().project().hash(), hash);
    EXPECT_FALSE(window().isWindowModified());
}

TEST_F(DocumentTest, AProjectThatCannotBeReadLeavesTheOpenOneAndSaysWhy)
{
    draw("rectangle", {10, 10}, {60, 60});
    EXPECT_FALSE(window().projects().open(folder("nowhere")));
    EXPECT_EQ(shapes().size(), 1u);
    EXPECT_TRUE(window().messages().text().contains("nowhere")) << window().messages().text().toStdString();
}

TEST_F(DocumentTest, ClosingAsksAboutChangesAndCancelStays)
{
    draw("rectangle", {10, 10}, {60, 60});
    int asked = 0;
    window().projects().setQuestion([&] {
        ++asked;
        return host::ProjectController::Answer::Cancel;
    });
    EXPECT_FALSE(window().close());
    EXPECT_EQ(asked, 1);
    window().projects().setQuestion([] { return host::ProjectController::Answer::Discard; });
}

TEST_F(DocumentTest, TwoScenesHaveTheirOwnSelectionAndHistory)
{
    draw("rectangle", {10, 10}, {60, 60});
    Scene& first = scene();
    trigger("scene.new");
    ASSERT_NE(&scene(), &first);
    EXPECT_TRUE(scene().items().selection().empty());
    EXPECT_FALSE(isEnabled("edit.undo"));
    window().openScene(first);
    EXPECT_EQ(scene().items().selection().size(), 1u);
    EXPECT_TRUE(isEnabled("edit.undo"));
}

/// Makes a shape of a line "x y", and fails at anything else.
class PointImporter final : public Importer {
public:
    Result<void> read(ImportRequest& request) override
    {
        request.edit.add<ShapeItem>(request.parent, Path::rectangle(Box({0, 0}, {5, 5})));
        if (request.data.size() > 4) return Error("expected two numbers", {request.file.string(), 1, 5});
        return {};
    }
};

TEST_F(DocumentTest, AnImportIsOneUndoStep)
{
    catalog().inCode().importer<PointImporter>("pts");
    write(folder("a.pts"), "1 2");
    const std::uint64_t empty = scene().hash();
    EXPECT_TRUE(window().formats().importFile(folder("a.pts")));
    EXPECT_EQ(shapes().size(), 1u);
    trigger("edit.undo");
    EXPECT_EQ(scene().hash(), empty);
}

TEST_F(DocumentTest, AFailedImportLeavesNothingAndSaysWhere)
{
    catalog().inCode().importer<PointImporter>("pts");
    write(folder("bad.pts"), "one two");
    const std::uint64_t empty = scene().hash();
    EXPECT_FALSE(window().formats().importFile(folder("bad.pts")));
    EXPECT_EQ(scene().hash(), empty);
    EXPECT_TRUE(window().messages().text().contains("bad.pts:1:5"));
    EXPECT_FALSE(isEnabled("edit.undo"));
}

TEST_F(DocumentTest, AFormatNobodyReadsIsExplained)
{
    write(folder("a.xyz"), "");
    EXPECT_FALSE(window().formats().importFile(folder("a.xyz")));
    EXPECT_FALSE(window().messages().text().isEmpty());
}

TEST_F(DocumentTest, TypingInAScriptIsOneUndoStepOfItsScene)
{
    auto edit = scene().items().begin("Add script");
    const ItemId id = edit.add<ScriptItem>(scene().root()).id();
    edit.commit();
    const std::uint64_t before = scene().hash();
    Scene& owner = scene();
    host::ScriptTab& tab = window().documents().openScript(owner, id, 0);
    QTest::keyClicks(&tab.code(), "var a = 1;");
    tab.commit();
    QTest::keyClicks(&tab.code(), " // and on");
    tab.commit();
    EXPECT_EQ(owner.items().find(id)->property("code")->as<std::string>(), "var a = 1; // and on");
    owner.undoRedo().undo();
    EXPECT_EQ(owner.hash(), before);
    EXPECT_TRUE(tab.code().toPlainText().isEmpty());
}

TEST_F(DocumentTest, AScriptErrorMarksItsLineAndRemovingTheScriptClosesItsTab)
{
    auto edit = scene().items().begin("Add script");
    const Item& script = edit.add<ScriptItem>(scene().root());
    const ItemId id = script.id();
    edit.set(script, "code", "a;\nb;\nc;");
    edit.commit();
    Scene& owner = scene();
    host::ScriptTab& tab = window().documents().openScript(owner, id, 3);
    EXPECT_EQ(tab.code().textCursor().blockNumber(), 2);
    window().print({OutputLine::Kind::Error, "b is not defined", id, 2});
    EXPECT_EQ(tab.code().errorLine(), 2);
    const int tabs = window().documents().count();
    auto removal = owner.items().begin("Delete");
    removal.remove(*owner.items().find(id));
    removal.commit();
    EXPECT_EQ(window().documents().count(), tabs - 1);
}

}  // namespace jet::test
