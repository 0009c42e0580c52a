// The spatial index through the questions it answers: always what looking at every item would answer.
#include "scene_fakes.hpp"

#include <jet/scene_painter.hpp>

#include "support/recording_painter.hpp"

#include <random>

namespace jet {
namespace {

class ItemsQueryTest : public test::SceneFixture {
protected:
    std::vector<const Item*> all()
    {
        std::vector<const Item*> found;
        scene.root().walk([&](const Item& item) {
            if (!item.path().isEmpty() && item.shown()) found.push_back(&item);
        });
        return found;
    }
    void expectTruth(const Box& area, const char* when)
    {
        std::vector<const Item*> painted, inside;
        for (const Item* item : all()) {
            if (area.intersects(paintedArea(item->path().bounds()))) painted.push_back(item);
            if (item->editable() && area.contains(item->path().bounds())) inside.push_back(item);
        }
        ASSERT_EQ(items().query(area), painted) << when;
        ASSERT_EQ(items().itemsIn(area), inside) << when;
    }
    Box box(double size)
    {
        const double x = place(random), y = place(random);
        return Box({x, y}, {x + size, y + size});
    }

    std::mt19937 random{7};
    std::uniform_real_distribution<double> place{0, 1000};
};

TEST_F(ItemsQueryTest, AnswersAreTrueThroughEditsUndoAndRedo)
{
    {
        auto edit = items().begin("Many");
        for (int i = 0; i < 6000; ++i)
            edit.add<ShapeItem>(layer(), Path::ellipse(box(i % 500 == 0 ? 700 : 1 + i % 17)));
        edit.commit();
    }
    const auto pick = [&]() -> const Item& { return *layer().children()[random() % layer().children().size()]; };
    for (int round = 0; round < 60; ++round) {
        expectTruth(box(100), "before");
        auto edit = items().begin("Edit");
        for (int i = 0; i < (round % 7 == 0 ? 4000 : 5); ++i)
            edit.transform(pick(), Affine::translation(Vec2(place(random) - 500, 3)));
        if (round % 3 == 0) edit.remove(pick());
        if (round % 4 == 0) edit.move(pick(), layer(), 0);
        if (round % 5 == 0) edit.set(pick(), "visible", false);
        if (round % 6 == 0) edit.set(pick(), "locked", true);
        edit.addCopy(pick(), layer(), random() % 100);
        expectTruth(box(200), "inside");
        if (round % 4 == 1) {
            edit.rollback();
        } else {
            edit.commit();
        }
        expectTruth(box(50), "after");
        if (round % 2 == 0) history().undo();
        if (round % 8 == 0) history().redo();
    }
}

TEST_F(ItemsQueryTest, WhatIsPaintedIsWhatTheQueryFinds)
{
    const Item& near = addBox(Box({0, 0}, {10, 10}));
    addBox(Box({5000, 0}, {5010, 10}));
    for (const Item* item : std::vector<const Item*>{&near, layer().children()[1].get()}) {
        auto edit = items().begin("Tint");
        edit.addEffect(*item, "tint");
        edit.commit();
    }
    test::RecordingPainter painter;
    paintScene(scene, nullptr, PaintPurpose::Export, Box({-5, -5}, {15, 15}), painter);
    EXPECT_EQ(painter.drawn().size(), 1u);
}

TEST_F(ItemsQueryTest, AGroupWithoutAPathIsNowhere)
{
    auto edit = items().begin("Groups");
    for (int i = 0; i < 10; ++i) edit.add<GroupItem>(layer());
    edit.commit();
    EXPECT_TRUE(items().query(Box({-1e9, -1e9}, {1e9, 1e9})).empty());
    EXPECT_EQ(items().itemAt({0, 0}, 1e9), nullptr);
}

TEST_F(ItemsQueryTest, PaintingOrderIsTheOrderOfTheTree)
{
    auto edit = items().begin("Nested");
    const Item& outer = edit.add<GroupItem>(layer());
    const Item& inner = edit.add<GroupItem>(outer);
    const Item& deep = edit.add<ShapeItem>(inner);
    const Item& flat = edit.add<ShapeItem>(outer);
    edit.commit();
    EXPECT_TRUE(isPaintedBefore(outer, deep)) << "a parent before its children";
    EXPECT_FALSE(isPaintedBefore(deep, outer));
    EXPECT_TRUE(isPaintedBefore(deep, flat));
    EXPECT_FALSE(isPaintedBefore(flat, deep));
    EXPECT_FALSE(isPaintedBefore(deep, deep));
}

TEST_F(ItemsQueryTest, AnItemKnowsItsIndexWhateverHappensAroundIt)
{
    for (int i = 0; i < 200; ++i) addBox(Box({0, 0}, {1, 1}));
    auto edit = items().begin("Shuffle");
    for (int i = 0; i < 300; ++i) {
        const auto count = layer().children().size();
        if (i % 3 == 0) edit.remove(*layer().children()[random() % count]);
        edit.move(*layer().children()[random() % (count - 1)], layer(), random() % count);
        for (int k = 0; k < 5; ++k) {
            const std::size_t at = random() % layer().children().size();
            ASSERT_EQ(layer().children()[at]->index(), at);
        }
    }
    edit.commit();
}

}  // namespace
}  // namespace jet
