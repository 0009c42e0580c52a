// The commands of the Symbol menu, without a window; where there is one symbol, nothing is asked.
#include "support/test_catalog.hpp"

#include <jet/symbols.hpp>
#include <jet/testing/gtest.hpp>

namespace jet {
namespace {

class SymbolCommands : public test::PluginTest {
protected:
    SymbolCommands() : PluginTest{"org.jet.command.symbols"}
    {
        addRectangle(Box({0, 0}, {10, 10}));
        addRectangle(Box({20, 0}, {30, 10}));
        items().setSelection({scene().root().children()[0]->id(), scene().root().children()[1]->id()});
    }
    const Item& first() { return *scene().root().children().front(); }
    const Item& last() { return *scene().root().children().back(); }
};

TEST_F(SymbolCommands, WhatMakesNoSenseIsNotEnabled)
{
    for (const char* id : {"place-symbol", "swap-symbol", "detach-instance", "select-instances", "delete-symbol"})
        EXPECT_FALSE(run(id)) << id;
    items().setSelection({});
    EXPECT_FALSE(run("create-symbol"));
}

TEST_F(SymbolCommands, CreateAndPlaceAreOneStepEach)
{
    const std::size_t before = undoSteps();
    ASSERT_TRUE(run("create-symbol"));
    EXPECT_TRUE(isInstance(first()));
    EXPECT_TRUE(items().isSelected(first().id()));
    ASSERT_TRUE(run("place-symbol"));
    EXPECT_EQ(last().bounds(), Box({20, 20}, {50, 30})) << "a little aside";
    EXPECT_EQ(undoSteps(), before + 2);
    ASSERT_TRUE(run("select-instances"));
    EXPECT_EQ(items().selection().size(), 2u);
    undo(), undo();
    EXPECT_TRUE(symbolsOf(scene()).empty());
}

TEST_F(SymbolCommands, ASymbolInUseIsNotDeletedAndTheMessageSaysWhatToDo)
{
    run("create-symbol");
    ASSERT_TRUE(run("delete-symbol"));
    ASSERT_EQ(editor().messages.size(), 1u);
    EXPECT_EQ(editor().messages[0], "The symbol 'Symbol 1' is used 1 times; detach or delete its instances first.");
    ASSERT_TRUE(run("detach-instance"));
    ASSERT_TRUE(run("delete-symbol"));
    EXPECT_TRUE(symbolsOf(scene()).empty());
    EXPECT_FALSE(isInstance(first()));
}

}  // namespace
}  // namespace jet
