// The scene as a whole: copies, hashes, painting.
#include "scene_fakes.hpp"

#include "support/recording_painter.hpp"

#include <jet/scene_painter.hpp>

namespace jet {
namespace {

using test::Hooks;
using test::RecordingPainter;

class SceneTest : public test::SceneFixture {
protected:
    RecordingPainter paint(PaintPurpose purpose = PaintPurpose::Edit, const PoseSource* poses = nullptr)
    {
        RecordingPainter painter;
        paintScene(scene, poses, purpose, Box({-1e6, -1e6}, {1e6, 1e6}), painter);
        return painter;
    }
    const Item& tinted(const Box& box, Color color = {255, 0, 0, 255})
    {
        const Item& shape = addBox(box);
        auto edit = items().begin("Tint");
        edit.addEffect(shape, "tint", {{"color", color}});
        edit.commit();
        return shape;
    }
};

TEST_F(SceneTest, ACloneIsEqualAndIndependent)
{
    const Item& shape = tinted(Box({0, 0}, {1, 1}));
    auto edit = items().begin("Settings");
    edit.setScene("gravity", Vec2(1, 2));
    edit.set(shape, "locked", true);
    edit.commit();
    EventsCenter others;
    const auto copy = scene.clone(others);
    EXPECT_EQ(copy->hash(), scene.hash());
    auto change = copy->items().begin("Change");
    change.remove(*copy->items().find(shape.id()));
    change.commit();
    EXPECT_NE(copy->hash(), scene.hash());
    EXPECT_NE(items().find(shape.id()), nullptr);
}

TEST_F(SceneTest, TheHashSeesEachPart)
{
    const Item& shape = tinted(Box({0, 0}, {1, 1}));
    std::set<std::uint64_t> hashes{scene.hash()};
    const auto differs = [&](auto&& change) {
        auto edit = items().begin("Change");
        change(edit);
        EXPECT_TRUE(hashes.insert(scene.hash()).second) << hashes.size();
        edit.rollback();
    };
    differs([&](auto& e) { e.set(shape, "name", "x"); });
    differs([&](auto& e) { e.set(shape, "visible", false); });
    differs([&](auto& e) { e.set(shape, "locked", true); });
    differs([&](auto& e) { e.setPath(shape, Path::rectangle(Box({0, 0}, {1, 1.0000000000000002}))); });
    differs([&](auto& e) { e.setEffect(shape, 0, "width", 3.0); });
    differs([&](auto& e) { e.setEffect(shape, 0, "visible", false); });
    differs([&](auto& e) { e.removeEffect(shape, 0); });
    differs([&](auto& e) { e.setScene("linear-damping", 1.0); });
    differs([&](auto& e) { e.setMaterials(MaterialTable("ice")); });
    differs([&](auto& e) { e.add("group", layer()); });
    differs([&](auto& e) { e.move(shape, scene.root(), 0); });
}

TEST_F(SceneTest, PaintingGoesFromTheBottomToTheTopAndLeavesOutTheHidden)
{
    tinted(Box({0, 0}, {1, 1}), {1, 0, 0, 255});
    const Item& hidden = tinted(Box({0, 0}, {1, 1}), {2, 0, 0, 255});
    tinted(Box({0, 0}, {1, 1}), {3, 0, 0, 255});
    auto edit = items().begin("Hide");
    edit.set(hidden, "visible", false);
    edit.commit();
    const auto fills = paint().fills();
    ASSERT_EQ(fills.size(), 2u);
    EXPECT_EQ(fills[0].color().r, 1);
    EXPECT_EQ(fills[1].color().r, 3);
}

TEST_F(SceneTest, AnEffectIsAskedOnceForTwoPaints)
{
    const Item& shape = tinted(Box({0, 0}, {1, 1}));
    Hooks::now().updates = 0;
    paint(), paint();
    EXPECT_EQ(Hooks::now().updates, 1);
    auto edit = items().begin("Change");
    edit.setEffect(shape, 0, "width", 5.0);
    paint(), paint();
    EXPECT_EQ(Hooks::now().updates, 2) << "again after a change";
    edit.rollback();
    paint();
    EXPECT_EQ(Hooks::now().updates, 3) << "and after it was taken back";
    scene.dropEffectStates();
    paint();
    EXPECT_EQ(Hooks::now().updates, 4);
}

TEST_F(SceneTest, WhatAnEffectKeptGoesWithItsItem)
{
    const Item& shape = tinted(Box({0, 0}, {1, 1}));
    paint();
    auto edit = items().begin("Remove");
    edit.remove(shape);
    edit.commit();
    paint();
    history().undo();
    Hooks::now().updates = 0;
    paint();
    EXPECT_EQ(Hooks::now().updates, 1);
}

TEST_F(SceneTest, APosedItemIsPaintedWithItsPose)
{
    struct Shifted final : PoseSource {
        mutable Path path;
        const Path* pose(const Item& item) const override
        {
            path = item.path().transformed(Affine::translation({100, 0}));
            return &path;
        }
    } poses;
    tinted(Box({0, 0}, {1, 1}));
    Hooks::now().updates = 0;
    EXPECT_EQ(paint(PaintPurpose::Play, &poses).fills().at(0).path.bounds(), Box({100, 0}, {101, 1}));
    EXPECT_EQ(Hooks::now().updates, 0) << "what is kept belongs to the path as drawn";
}

TEST_F(SceneTest, WhatAMissingPluginDrewShowsAsAPlaceholderWhileEditing)
{
    tinted(Box({0, 0}, {1, 1}));
    test::TestCatalog none;
    Scene bare("Bare", events, none);
    SceneBuilder builder(bare);
    Item& item = builder.add(builder.root(), {}, "shape");
    builder.setPath(item, Path::rectangle(Box({0, 0}, {1, 1})));
    builder.addEffect(item, {"tint", {}, true});
    RecordingPainter edit, play;
    paintScene(bare, nullptr, PaintPurpose::Edit, Box({-9, -9}, {9, 9}), edit);
    paintScene(bare, nullptr, PaintPurpose::Play, Box({-9, -9}, {9, 9}), play);
    EXPECT_EQ(edit.strokes().size(), 1u);
    EXPECT_TRUE(play.drawn().empty());
}

TEST_F(SceneTest, AnEffectWhosePluginCameAfterTheSceneWasReadIsStillAPlaceholder)
{
    Scene late("Late", events, catalog);
    SceneBuilder builder(late);
    Item& item = builder.add(builder.root(), {}, "shape");
    builder.setPath(item, Path::rectangle(Box({0, 0}, {1, 1})));
    builder.addEffect(item, {"tint", {{"color", Value(RawText{"#ff0000"})}}, true});
    RecordingPainter edit;
    paintScene(late, nullptr, PaintPurpose::Edit, Box({-9, -9}, {9, 9}), edit);
    EXPECT_TRUE(edit.fills().empty()) << "the effect wants a colour, and there is a text";
    EXPECT_EQ(edit.strokes().size(), 1u);
}

TEST_F(SceneTest, AnItemOfAnAbsentTypeShowsTheNameOfTheTypeWhileEditing)
{
    test::TestCatalog none;
    Scene bare("Bare", events, none);
    SceneBuilder builder(bare);
    Item& item = builder.add(builder.root(), {}, "acme-rope");
    builder.setPath(item, Path::rectangle(Box({0, 0}, {4, 2})));
    RecordingPainter edit, exported;
    paintScene(bare, nullptr, PaintPurpose::Edit, Box({-9, -9}, {9, 9}), edit);
    paintScene(bare, nullptr, PaintPurpose::Export, Box({-9, -9}, {9, 9}), exported);
    ASSERT_EQ(edit.texts().size(), 1u);
    EXPECT_EQ(edit.texts()[0].text, "acme-rope");
    EXPECT_TRUE(exported.drawn().empty());
}

}  // namespace
}  // namespace jet
