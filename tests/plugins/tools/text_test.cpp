#include "support/tool_fixture.hpp"

#include <jet/ui/text_metrics.hpp>

#include <QClipboard>
#include <QGuiApplication>
#include <QMimeData>

namespace {

using jet::Box;
using jet::Item;
using jet::TextItem;
using jet::Vec2;

class TextToolTest : public jet::test::ToolFixture {
protected:
    TextToolTest() : ToolFixture{"org.jet.tool.text"} {}

    /// Keys as a keyboard gives them, one a letter.
    void type(std::string_view text)
    {
        for (const char c : text) tool("text-tool")->keyPress({std::string(1, c), std::string(1, c), {}, false});
    }
    void press(const char* key, jet::Modifiers modifiers = {}) { tool("text-tool").hold(modifiers).key(key).hold({}); }
    std::vector<const Item*> texts()
    {
        std::vector<const Item*> found;
        scene().root().walk([&](const Item& item) {
            if (item.is<TextItem>()) found.push_back(&item);
        });
        return found;
    }
    std::string textOf(const Item& item) { return item.property("text")->as<std::string>(); }
};

TEST_F(TextToolTest, AClickAndTypingMakeOneTextAndOneUndoStep)
{
    tool("text-tool").click({100, 100});
    EXPECT_TRUE(texts().empty()) << "a click alone leaves nothing";
    type("Hi there");
    press("Enter");
    type("you");
    ASSERT_EQ(texts().size(), 1u);
    EXPECT_EQ(textOf(*texts()[0]), "Hi there\nyou");
    EXPECT_EQ(undoSteps(), 1u);
    press("Escape");
    EXPECT_EQ(textOf(*texts()[0]), "Hi there\nyou") << "Esc keeps it";
    EXPECT_TRUE(scene().items().isSelected(texts()[0]->id()));
    undo();
    EXPECT_EQ(scene().hash(), emptySceneHash());
}

TEST_F(TextToolTest, TheFrameIsAsLargeAsTheTextAndStandsWhereItWasClicked)
{
    tool("text-tool").click({100, 100});
    type("Wide");
    press("Enter");
    type("M");
    jet::TextStyle style;
    style.size = 24;
    const Box frame = texts().at(0)->bounds();
    EXPECT_DOUBLE_EQ(frame.min.x(), 100);
    EXPECT_NEAR(frame.width(), jet::ui::textWidth("Wide", style), 1e-9);
    EXPECT_NEAR(frame.min.y(), 100 - 0.93 * 24, 1e-9) << "the click is on the baseline";
    EXPECT_NEAR(frame.height(), 2 * 1.2 * 24, 1e-9);
}

TEST_F(TextToolTest, CentredAndRightTextGrowsToBothSidesAndToTheLeft)
{
    for (const char* align : {"center", "right"}) {
        tool("text-tool").option("align", align).click({300, 100});
        type("some words");
        press("Escape");
        const Box frame = texts().back()->bounds();
        EXPECT_NEAR(align == std::string("center") ? frame.center().x() : frame.max.x(), 300, 1e-9) << align;
        undo();
    }
}

TEST_F(TextToolTest, AClickIntoTextPutsTheCaretBetweenTheNearestLetters)
{
    tool("text-tool").click({100, 100});
    type("abcd");
    press("Escape");
    jet::TextStyle style;
    style.size = 24;
    tool("text-tool").click({100 + jet::ui::textWidth("ab", style) + 1, 95});
    type("X");
    EXPECT_EQ(textOf(*texts().at(0)), "abXcd");
    EXPECT_EQ(texts().size(), 1u);
    EXPECT_EQ(undoSteps(), 2u) << "a session of its own";
    undo();
    EXPECT_EQ(textOf(*texts().at(0)), "abcd");
}

TEST_F(TextToolTest, TheCaretMovesByLettersWordsAndLines)
{
    tool("text-tool").click({100, 100});
    type("one two");
    press("Left", {.control = true});
    type("+");
    EXPECT_EQ(textOf(*texts().at(0)), "one +two");
    press("Home");
    type("<");
    press("End");
    type(">");
    press("Left");
    press("Left");
    press("Delete");
    EXPECT_EQ(textOf(*texts().at(0)), "<one +tw>");
    press("Backspace");
    press("Enter");
    press("Up");
    type("^");
    EXPECT_EQ(textOf(*texts().at(0)), "^<one +t\n>");
}

TEST_F(TextToolTest, LettersOfSeveralBytesAreOne)
{
    tool("text-tool").click({100, 100});
    for (const char* letter : {"ż", "ó", "e\xcc\x81"}) tool("text-tool")->keyPress({letter, letter, {}, false});
    press("Backspace");
    EXPECT_EQ(textOf(*texts().at(0)), "żó");
    press("Backspace");
    EXPECT_EQ(textOf(*texts().at(0)), "ż");
}

TEST_F(TextToolTest, TextThatIsAllDeletedGoesWithItsItem)
{
    tool("text-tool").click({100, 100});
    type("a");
    press("Backspace");
    press("Escape");
    EXPECT_TRUE(texts().empty());
    undo();
    EXPECT_EQ(scene().hash(), emptySceneHash());
}

TEST_F(TextToolTest, WhatUndoMadeOfTheTextIsGoneOnFrom)
{
    tool("text-tool").click({100, 100});
    type("abc");
    auto edit = scene().items().begin("Set");
    edit.set(*texts().at(0), "text", "other");
    edit.commit();
    type("!");
    EXPECT_EQ(textOf(*texts().at(0)), "oth!er") << "the caret stays where it was";
    undo();
    undo();
    EXPECT_EQ(textOf(*texts().at(0)), "abc");
    undo();
    type("x");
    EXPECT_TRUE(texts().empty()) << "its item is gone: nothing is being edited";
}

TEST_F(TextToolTest, TurnedTextIsEditedInItsFrame)
{
    tool("text-tool").click({100, 100});
    type("abc");
    press("Escape");
    auto edit = scene().items().begin("Turn");
    edit.transform(*texts().at(0), jet::Affine::rotation(1.0));
    edit.commit();
    const Vec2 corner = texts().at(0)->path().segment(0).point;
    const jet::Affine frame = jet::frameOf(texts().at(0)->path());
    tool("text-tool").click(frame * Vec2(0.99, 0.5));
    type("def");
    EXPECT_EQ(textOf(*texts().at(0)), "abcdef");
    EXPECT_TRUE(texts().at(0)->path().segment(0).point.isApprox(corner)) << "it grows along its own line";
}

TEST_F(TextToolTest, ShiftSelectsAndTypingReplacesWhatIsSelected)
{
    tool("text-tool").click({100, 100});
    type("one two");
    press("Left", {.shift = true, .control = true});
    type("2");
    EXPECT_EQ(textOf(*texts().at(0)), "one 2");
    press("Home", {.shift = true});
    press("Backspace");
    EXPECT_EQ(textOf(*texts().at(0)), "");
    type("ab");
    press("Enter");
    type("cd");
    press("Left");
    press("Up", {.shift = true});
    press("Delete");
    EXPECT_EQ(textOf(*texts().at(0)), "ad") << "from between c and d up to between a and b";
    EXPECT_EQ(undoSteps(), 1u);
}

TEST_F(TextToolTest, ArrowsLeaveTheSelectionAtItsEnds)
{
    tool("text-tool").click({100, 100});
    type("abcd");
    press("A", {.control = true});
    press("Left");
    type("<");
    press("A", {.control = true});
    press("Right");
    type(">");
    EXPECT_EQ(textOf(*texts().at(0)), "<abcd>");
    press("Backspace", {.control = true});
    press("Home", {.control = true});
    press("Delete", {.control = true});
    press("Delete", {.control = true});
    EXPECT_EQ(textOf(*texts().at(0)), "");
}

TEST_F(TextToolTest, TextIsCutCopiedAndPasted)
{
    tool("text-tool").click({100, 100});
    type("abc");
    press("Left", {.shift = true});
    press("C", {.control = true});
    press("Home");
    press("V", {.control = true});
    EXPECT_EQ(textOf(*texts().at(0)), "cabc");
    press("A", {.control = true});
    press("X", {.control = true});
    EXPECT_EQ(textOf(*texts().at(0)), "");
    EXPECT_EQ(QGuiApplication::clipboard()->text().toStdString(), "cabc");
    QGuiApplication::clipboard()->setText("two\r\nlines\tand\x01 more");
    press("V", {.control = true});
    EXPECT_EQ(textOf(*texts().at(0)), "two\nlines and more");
    auto* items = new QMimeData;
    items->setData("application/x-jet-scene+xml", "<scene/>");
    items->setText("<scene/>");
    QGuiApplication::clipboard()->setMimeData(items);
    press("V", {.control = true});
    EXPECT_EQ(textOf(*texts().at(0)), "two\nlines and more") << "items are no text";
    EXPECT_EQ(undoSteps(), 1u);
    QGuiApplication::clipboard()->clear();
}

TEST_F(TextToolTest, DraggingSelectsLettersAndADoubleClickAWord)
{
    jet::TextStyle style;
    style.size = 24;
    const auto at = [&](std::string_view before) { return Vec2(100 + jet::ui::textWidth(before, style) + 1, 95); };
    tool("text-tool").click({100, 100});
    type("some few words");
    press("Escape");
    tool("text-tool").drag(at("some "), at("some few"));
    type("many");
    EXPECT_EQ(textOf(*texts().at(0)), "some many words");
    tool("text-tool").doubleClick(at("so"));
    press("X", {.control = true});
    EXPECT_EQ(textOf(*texts().at(0)), " many words");
    tool("text-tool").click(at(" ma"));
    tool("text-tool").hold({.shift = true}).click(at(" many wo")).hold({});
    press("Delete");
    EXPECT_EQ(textOf(*texts().at(0)), " mards");
}

TEST_F(TextToolTest, WhatIsSelectedIsMarkedLineByLine)
{
    const auto marks = [&] { return tool("text-tool").painted().fills().size(); };
    tool("text-tool").click({100, 100});
    type("ab");
    press("Enter");
    type("cd");
    EXPECT_EQ(marks(), 0u);
    press("A", {.control = true});
    EXPECT_EQ(marks(), 2u);
    press("End");
    EXPECT_EQ(marks(), 0u);
}

TEST_F(TextToolTest, KeysWithoutAClickAreNotTaken)
{
    press("A");
    EXPECT_FALSE(tool("text-tool").used());
    EXPECT_TRUE(texts().empty());
}

}  // namespace
