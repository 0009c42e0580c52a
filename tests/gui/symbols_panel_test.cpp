#include "symbols/symbols_widget.hpp"
#include "window_fixture.hpp"

#include <jet/symbols.hpp>

#include <QApplication>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QLineEdit>
#include <QMimeData>
#include <QPointer>
#include <QTest>
#include <QToolButton>

namespace jet::test {

class SymbolsPanelTest : public WindowFixture {
protected:
    SymbolsPanelTest()
    {
        draw("rectangle", {100, 100}, {150, 150});
        dock();
    }
    ~SymbolsPanelTest() override { delete panel_; }

    void dock()
    {
        panel_ = new symbol_list::SymbolsWidget(window());
        auto* dock = new QDockWidget(&window());
        dock->setObjectName("symbols-of-the-test");
        dock->setWidget(panel_);
        window().addDockWidget(Qt::RightDockWidgetArea, dock);
        window().activateWindow();
        QTest::qWait(1);
    }
    /// Until the panel has followed what was done.
    static void settle() { QTest::qWait(5); }
    QListWidget& list() { return panel_->list(); }
    void click(const char* button) { QTest::mouseClick(panel_->findChild<QToolButton*>(button), Qt::LeftButton); }
    void create()
    {
        scene().items().setSelection({shapes().front()->id()});
        click("Make a symbol of the selection");
        settle();
    }
    const Item& symbol() { return *symbolsOf(scene()).at(0); }
    std::vector<const Item*> instances() { return instancesOf(scene(), symbol()); }
    bool eventually(const std::function<bool()>& holds) { return QTest::qWaitFor(holds, 10000); }

    QPointer<symbol_list::SymbolsWidget> panel_;
};

TEST_F(SymbolsPanelTest, ASymbolIsMadeOfTheSelectionShownAndPlacedByADoubleClick)
{
    create();
    ASSERT_EQ(list().count(), 1);
    EXPECT_EQ(list().item(0)->text(), "Symbol 1");
    EXPECT_FALSE(list().item(0)->icon().isNull());
    const QPoint at = list().visualItemRect(list().item(0)).center();
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, at);
    QTest::mouseDClick(list().viewport(), Qt::LeftButton, {}, at);
    EXPECT_EQ(instances().size(), 2u);
    EXPECT_TRUE(scene().items().isSelected(instances().back()->id()));
    trigger("edit.undo");
    EXPECT_EQ(instances().size(), 1u);
}

TEST_F(SymbolsPanelTest, ThePictureFollowsAChangeInAnInstance)
{
    create();
    const QImage before = list().item(0)->icon().pixmap(72, 48).toImage();
    auto edit = scene().items().begin("Change");
    edit.setPath(*instances()[0]->children().front(), Path::ellipse(Box({0, 0}, {90, 20})));
    edit.commit();
    EXPECT_TRUE(eventually([&] { return list().item(0)->icon().pixmap(72, 48).toImage() != before; }));
}

TEST_F(SymbolsPanelTest, RenamingByKeyRefusesNamesThatAreTaken)
{
    create();
    draw("rectangle", {300, 100}, {350, 150});
    scene().items().setSelection({shapes().back()->id()});
    click("Make a symbol of the selection");
    settle();
    ASSERT_EQ(list().count(), 2);
    const auto rename = [&](const char* name) {
        list().setCurrentRow(0);
        list().setFocus();
        QTest::keyClick(&list(), Qt::Key_F2);
        auto* line = list().findChild<QLineEdit*>();
        ASSERT_NE(line, nullptr);
        line->selectAll();
        QTest::keyClicks(line, name);
        QTest::keyClick(line, Qt::Key_Return);
        QTest::qWait(1);
        QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    };
    rename("Wheel");
    EXPECT_EQ(symbol().name(), "Wheel");
    rename("Symbol 2");
    EXPECT_EQ(symbol().name(), "Wheel");
    EXPECT_NE(window().messages().text().indexOf("already"), -1);
    EXPECT_TRUE(eventually([&] { return list().item(0)->text() == "Wheel"; }));
    EXPECT_EQ(instances().size(), 1u) << "Enter ended the name, and placed nothing";
}

TEST_F(SymbolsPanelTest, EditingSelectsWhatIsInTheFirstInstance)
{
    create();
    click("Edit in its first instance");
    EXPECT_TRUE(scene().items().isSelected(instances()[0]->children().front()->id()));
}

TEST_F(SymbolsPanelTest, DeleteRefusesASymbolInUseAndDetachMakesItFree)
{
    create();
    list().setFocus();
    QTest::keyClick(&list(), Qt::Key_Delete);
    EXPECT_EQ(symbolsOf(scene()).size(), 1u);
    EXPECT_NE(window().messages().text().indexOf("detach"), -1);
    click("Detach the selected instances");
    EXPECT_NE(window().messages().text().indexOf("detach"), -1);
    click("Select all instances");
    click("Detach the selected instances");
    EXPECT_TRUE(instances().empty());
    QTest::keyClick(&list(), Qt::Key_Delete);
    EXPECT_TRUE(symbolsOf(scene()).empty());
    EXPECT_TRUE(eventually([&] { return list().count() == 0; }));
    trigger("edit.undo");
    EXPECT_TRUE(eventually([&] { return list().count() == 1; }));
}

TEST_F(SymbolsPanelTest, AnInstanceIsPastedInAnotherEditorWithItsSymbol)
{
    create();
    scene().items().setSelection({instances()[0]->id()});
    trigger("edit.copy");
    delete panel_;
    start();  // another editor: nothing is shared with the first one but the clipboard
    ASSERT_TRUE(symbolsOf(scene()).empty());
    trigger("edit.paste");
    trigger("edit.paste");
    ASSERT_EQ(symbolsOf(scene()).size(), 1u) << "the same symbol comes once";
    EXPECT_EQ(instances().size(), 2u);
    auto edit = scene().items().begin("Change");
    edit.set(*instances()[0]->children().front(), "name", "Both");
    edit.commit();
    EXPECT_EQ(instances()[1]->children().front()->name(), "Both") << "they are linked here, too";
    trigger("edit.undo");
    trigger("edit.undo");
    trigger("edit.undo");
    EXPECT_TRUE(symbolsOf(scene()).empty());
}

TEST_F(SymbolsPanelTest, ASymbolDraggedIntoTheSceneIsPlacedWhereItWasDropped)
{
    create();
    const std::unique_ptr<QMimeData> data(list().model()->mimeData({list().model()->index(0, 0)}));
    ASSERT_NE(data, nullptr);
    QDragEnterEvent enter({300, 200}, Qt::CopyAction, data.get(), Qt::LeftButton, {});
    QApplication::sendEvent(&view(), &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent drop({300, 200}, Qt::CopyAction, data.get(), Qt::LeftButton, {});
    QApplication::sendEvent(&view(), &drop);
    ASSERT_EQ(instances().size(), 2u);
    EXPECT_TRUE(instances().back()->bounds().center().isApprox(Vec2(300, 200)));
    EXPECT_TRUE(scene().items().isSelected(instances().back()->id()));
    trigger("edit.undo");
    EXPECT_EQ(instances().size(), 1u);
    QMimeData foreign;
    foreign.setData("application/x-jet-scene-drag", "org.example.parts/1");
    QDropEvent other({300, 200}, Qt::CopyAction, &foreign, Qt::LeftButton, {});
    QApplication::sendEvent(&view(), &other);
    EXPECT_EQ(instances().size(), 1u) << "another panel's";
}

}  // namespace jet::test
