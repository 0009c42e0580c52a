#include <jet/testing/gtest.hpp>

namespace {

class AutoLayoutTest : public jet::test::PluginTest {
protected:
    AutoLayoutTest() : PluginTest{"org.example.auto-layout"} {}

    /// Squares of 20 units in a heap: `count` of them, each 3 units from the one before.
    void heap(int count)
    {
        std::vector<jet::ItemId> ids;
        for (int i = 0; i < count; ++i)
            ids.push_back(addRectangle({{3.0 * i, 2.0 * (i % 5)}, {3.0 * i + 20, 2.0 * (i % 5) + 20}}).id());
        items().setSelection(ids);
    }
    int overlaps()
    {
        int count = 0;
        const auto all = scene().shapes();
        for (std::size_t i = 0; i < all.size(); ++i)
            for (std::size_t j = i + 1; j < all.size(); ++j) count += all[i].bounds().intersects(all[j].bounds());
        return count;
    }
};

TEST_F(AutoLayoutTest, PartsAHeapAsOneUndoStep)
{
    heap(40);
    EXPECT_GT(overlaps(), 100);
    const auto before = scene().hash();
    const auto steps = undoSteps();
    ASSERT_TRUE(run("auto-layout"));
    EXPECT_EQ(overlaps(), 0);
    EXPECT_TRUE(editor().messages.empty());
    EXPECT_EQ(undoSteps(), steps + 1);
    undo();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(AutoLayoutTest, ItemsOnTheSamePlacePart)
{
    const jet::Item& a = addRectangle({{0, 0}, {20, 20}});
    const jet::Item& b = addRectangle({{0, 0}, {20, 20}});
    items().setSelection({a.id(), b.id()});
    ASSERT_TRUE(run("auto-layout"));
    EXPECT_EQ(overlaps(), 0);
}

TEST_F(AutoLayoutTest, WhatIsApartStaysWhereItIs)
{
    const jet::Item& a = addRectangle({{0, 0}, {20, 20}});
    const jet::Item& b = addRectangle({{100, 0}, {120, 20}});
    items().setSelection({a.id(), b.id()});
    const auto before = scene().hash();
    ASSERT_TRUE(run("auto-layout"));
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(AutoLayoutTest, TellsItsProgressAndLeavesTheSceneWhenCancelled)
{
    heap(40);
    const auto before = scene().hash();
    editor().cancelAt = 0.004;
    ASSERT_TRUE(run("auto-layout"));
    EXPECT_EQ(scene().hash(), before);
    EXPECT_GE(editor().progressed.size(), 2u);
    EXPECT_FALSE(editor().status.empty());
}

TEST_F(AutoLayoutTest, GivesTheSameResultEachTime)
{
    heap(25);
    run("auto-layout");
    const auto first = scene().hash();
    undo();
    run("auto-layout");
    EXPECT_EQ(scene().hash(), first);
}

TEST_F(AutoLayoutTest, NeedsTwoSelectedItems)
{
    items().setSelection({addRectangle({{0, 0}, {20, 20}}).id()});
    EXPECT_FALSE(run("auto-layout"));
}

}  // namespace
