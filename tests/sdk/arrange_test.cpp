#include "scene_fakes.hpp"

#include <jet/arrange.hpp>

#include <gtest/gtest.h>

namespace jet {
namespace {

class ArrangeTest : public test::SceneFixture {
protected:
    ArrangeTest()
        : a_(addBox(Box({0, 0}, {10, 10}))), b_(addBox(Box({30, 5}, {50, 35}))), c_(addBox(Box({100, 50}, {110, 60})))
    {
        before_ = scene.hash();
    }
    /// Does it in one transaction and checks that undo takes all of it back.
    template <class Fn>
    void arrange(Fn&& fn)
    {
        auto edit = items().begin("Arrange");
        fn(edit);
        edit.commit();
        const auto after = scene.hash();
        history().undo();
        EXPECT_EQ(scene.hash(), before_);
        history().redo();
        EXPECT_EQ(scene.hash(), after);
    }
    std::vector<const Item*> order()
    {
        std::vector<const Item*> list;
        for (const auto& child : layer().children()) list.push_back(child.get());
        return list;
    }

    const Item &a_, &b_, &c_;
    const ItemList all_{&a_, &b_, &c_};
    std::uint64_t before_ = 0;
};

struct AlignCase {
    Alignment to;
    Vec2 a, b, c;  // min corners after
};

TEST_F(ArrangeTest, AligningMovesEachToTheCommonEdgeOrCentre)
{
    // Common bounds: 0,0 to 110,60, centre 55,30.
    for (const AlignCase& test : {AlignCase{Alignment::Left, {0, 0}, {0, 5}, {0, 50}},
                                  AlignCase{Alignment::CenterX, {50, 0}, {45, 5}, {50, 50}},
                                  AlignCase{Alignment::Right, {100, 0}, {90, 5}, {100, 50}},
                                  AlignCase{Alignment::Top, {0, 0}, {30, 0}, {100, 0}},
                                  AlignCase{Alignment::CenterY, {0, 25}, {30, 15}, {100, 25}},
                                  AlignCase{Alignment::Bottom, {0, 50}, {30, 30}, {100, 50}}}) {
        arrange([&](Transaction& edit) { alignItems(edit, all_, test.to); });
        EXPECT_EQ(a_.bounds().min, test.a);
        EXPECT_EQ(b_.bounds().min, test.b);
        EXPECT_EQ(c_.bounds().min, test.c);
        history().undo();
    }
}

TEST_F(ArrangeTest, AFrameTakesThePlaceOfTheCommonBounds)
{
    arrange([&](Transaction& edit) { alignItems(edit, all_, Alignment::Left, Box({-7, 0}, {0, 1})); });
    for (const Item* item : all_) EXPECT_EQ(item->bounds().min.x(), -7);
}

TEST_F(ArrangeTest, CentresAreSpacedEvenlyBetweenTheOuterOnes)
{
    arrange([&](Transaction& edit) { distributeItems(edit, all_, Distribution::CentersX); });
    EXPECT_EQ(a_.bounds().center().x(), 5);
    EXPECT_EQ(b_.bounds().center().x(), 55);
    EXPECT_EQ(c_.bounds().center().x(), 105);
}

TEST_F(ArrangeTest, GapsAreMadeEqualWhateverTheSizes)
{
    arrange([&](Transaction& edit) { distributeItems(edit, all_, Distribution::GapsX); });
    EXPECT_EQ(b_.bounds().min.x() - a_.bounds().max.x(), 35);
    EXPECT_EQ(c_.bounds().min.x() - b_.bounds().max.x(), 35);
    EXPECT_EQ(c_.bounds().min.x(), 100);
}

TEST_F(ArrangeTest, TwoItemsHaveNothingToDistribute)
{
    auto edit = items().begin("Distribute");
    distributeItems(edit, ItemList{&a_, &b_}, Distribution::GapsY);
    EXPECT_TRUE(edit.isEmpty());
}

TEST_F(ArrangeTest, FlippingTwiceGivesThePlacesBack)
{
    arrange([&](Transaction& edit) { flipItems(edit, all_, FlipAxis::Horizontal); });
    EXPECT_EQ(a_.bounds(), Box({100, 0}, {110, 10}));
    EXPECT_EQ(c_.bounds(), Box({0, 50}, {10, 60}));
    const auto flipped = scene.hash();
    auto edit = items().begin("Flip");
    flipItems(edit, all_, FlipAxis::Horizontal);
    EXPECT_NE(scene.hash(), flipped);
    EXPECT_EQ(a_.bounds(), Box({0, 0}, {10, 10}));
}

TEST_F(ArrangeTest, OrderChangesAmongSiblingsAndKeepsTheOrderOfTheMoved)
{
    using enum StackOrder;
    const Item& d = addBox(Box({0, 0}, {1, 1}));
    before_ = scene.hash();
    struct Case {
        StackOrder order;
        ItemList moved, after;
    };
    for (const Case& test :
         {Case{ToFront, {&a_, &b_}, {&c_, &d, &a_, &b_}}, Case{ToBack, {&b_, &d}, {&b_, &d, &a_, &c_}},
          Case{Forward, {&a_, &b_}, {&c_, &a_, &b_, &d}}, Case{Backward, {&c_, &d}, {&a_, &c_, &d, &b_}},
          Case{Forward, {&c_, &d}, {&a_, &b_, &c_, &d}}, Case{Backward, {&a_, &c_}, {&a_, &c_, &b_, &d}},
          Case{Forward, {&a_, &c_}, {&b_, &a_, &d, &c_}}}) {
        auto edit = items().begin("Order");
        reorderItems(edit, test.moved, test.order);
        EXPECT_EQ(order(), test.after);
        edit.rollback();
        EXPECT_EQ(scene.hash(), before_);
    }
}

TEST_F(ArrangeTest, GroupingAndUngroupingKeepTheOrder)
{
    const Item* group = nullptr;
    arrange([&](Transaction& edit) { group = groupItems(edit, ItemList{&a_, &b_}); });
    ASSERT_TRUE(a_.parent()->is<GroupItem>());
    EXPECT_EQ(a_.parent(), b_.parent());
    EXPECT_EQ(a_.sibling(), &b_);
    before_ = scene.hash();
    ItemList freed;
    const Item* made = a_.parent();
    arrange([&](Transaction& edit) { freed = ungroupItems(edit, ItemList{made}); });
    EXPECT_EQ(freed, (ItemList{&a_, &b_}));
    EXPECT_EQ(order(), all_);
}

TEST_F(ArrangeTest, LayersAreNotGrouped)
{
    auto edit = items().begin("Group");
    EXPECT_EQ(groupItems(edit, ItemList{&layer()}), nullptr);
    EXPECT_TRUE(edit.isEmpty());
}

TEST_F(ArrangeTest, WhatIsLockedOrInALockedGroupStays)
{
    auto lock = items().begin("Lock");
    const Item* group = groupItems(lock, ItemList{&c_});
    lock.set(*group, "locked", true);
    lock.set(b_, "locked", true);
    lock.commit();
    auto edit = items().begin("Everything");
    alignItems(edit, ItemList{&b_, &c_}, Alignment::Left, Box({-100, 0}, {0, 0}));
    flipItems(edit, ItemList{&b_, &c_}, FlipAxis::Vertical);
    reorderItems(edit, ItemList{&b_}, StackOrder::ToBack);
    EXPECT_EQ(ungroupItems(edit, ItemList{group}), ItemList{});
    EXPECT_EQ(moveToNextLayer(edit, ItemList{&b_}, true), ItemList{});
    EXPECT_TRUE(edit.isEmpty());
}

TEST_F(ArrangeTest, ItemsMoveToTheNextLayerAndStayAtTheLastOne)
{
    auto add = items().begin("Layer");
    const Item& upper = add.add<LayerItem>(scene.root());
    add.commit();
    before_ = scene.hash();
    ItemList moved;
    arrange([&](Transaction& edit) { moved = moveToNextLayer(edit, ItemList{&a_, &c_}, true); });
    EXPECT_EQ(moved, (ItemList{&a_, &c_}));
    EXPECT_EQ(a_.parent(), &upper);
    EXPECT_EQ(a_.sibling(), &c_);
    auto edit = items().begin("Up again");
    EXPECT_EQ(moveToNextLayer(edit, ItemList{&a_}, true), ItemList{});
    EXPECT_EQ(moveToNextLayer(edit, ItemList{&b_}, false), ItemList{});
    EXPECT_EQ(moveToNextLayer(edit, ItemList{&upper}, false), ItemList{});
}

TEST_F(ArrangeTest, TheTopSelectionIsInTreeOrderWithoutWhatIsInsideOfASelectedGroup)
{
    auto edit = items().begin("Group");
    const Item* group = groupItems(edit, ItemList{&b_, &c_});
    edit.commit();
    items().setSelection({b_.id(), group->id(), a_.id()});
    EXPECT_EQ(topSelection(scene), (ItemList{&a_, group}));
    items().setSelection({c_.id(), a_.id()});
    EXPECT_EQ(topSelection(scene), (ItemList{&a_, &c_}));
    items().setSelection({});
    EXPECT_EQ(topSelection(scene), ItemList{});
}

}  // namespace
}  // namespace jet
