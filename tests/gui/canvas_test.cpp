// The parts of the scene view that need no window.
#include "canvas/backdrop.hpp"
#include "canvas/camera.hpp"
#include "canvas/damage_tracker.hpp"
#include "support/test_catalog.hpp"

#include <gtest/gtest.h>

namespace jet::test {

class DamageTest : public testing::Test {
protected:
    const Item& add(const Box& box)
    {
        auto edit = scene_.items().begin("Add");
        const Item& item = edit.add<ShapeItem>(scene_.root(), Path::rectangle(box));
        edit.commit();
        return item;
    }

    EventsCenter events_;
    TestCatalog catalog_;
    Scene scene_{"Scene", events_, catalog_};
    host::DamageTracker tracker_;
};

TEST_F(DamageTest, NothingChangedIsNoDamage)
{
    add(Box({0, 0}, {10, 10}));
    tracker_.reset(scene_);
    EXPECT_TRUE(tracker_.update(scene_).isNull());
}

TEST_F(DamageTest, AMoveDamagesWhereTheItemWasAndWhereItIs)
{
    const Item& item = add(Box({0, 0}, {10, 10}));
    add(Box({5000, 0}, {5010, 10}));
    tracker_.reset(scene_);
    auto edit = scene_.items().begin("Move");
    edit.transform(item, Affine::translation({100, 0}));
    const Box damage = tracker_.update(scene_);
    EXPECT_TRUE(damage.contains(Box({0, 0}, {110, 10})));
    EXPECT_FALSE(damage.contains(Vec2(5000, 5)));
}

TEST_F(DamageTest, ARemovedItemDamagesItsPlace)
{
    const Item& item = add(Box({0, 0}, {10, 10}));
    tracker_.reset(scene_);
    auto edit = scene_.items().begin("Remove");
    edit.remove(item);
    edit.commit();
    EXPECT_TRUE(tracker_.update(scene_).contains(Box({0, 0}, {10, 10})));
    EXPECT_TRUE(tracker_.update(scene_).isNull());
}

TEST_F(DamageTest, HidingAGroupDamagesItsMembers)
{
    auto edit = scene_.items().begin("Group");
    const Item& group = edit.add<GroupItem>(scene_.root());
    edit.add<ShapeItem>(group, Path::rectangle(Box({40, 40}, {50, 50})));
    edit.commit();
    tracker_.reset(scene_);
    auto hide = scene_.items().begin("Hide");
    hide.set(group, "visible", false);
    EXPECT_TRUE(tracker_.update(scene_).contains(Box({40, 40}, {50, 50})));
}

TEST_F(DamageTest, AChangeOfTheStackingOrderDamagesTheOverlap)
{
    const Item& lower = add(Box({0, 0}, {10, 10}));
    add(Box({5, 5}, {15, 15}));
    tracker_.reset(scene_);
    auto edit = scene_.items().begin("Raise");
    edit.move(lower, scene_.root(), 1);
    EXPECT_TRUE(tracker_.update(scene_).contains(Box({5, 5}, {10, 10})));
}

TEST(Camera, FramingShowsTheWholeBoxInTheMiddle)
{
    host::Camera camera;
    const Box box({-300, 50}, {700, 250});
    camera.frame(box, {800, 600});
    EXPECT_TRUE(camera.visibleArea({800, 600}).contains(box));
    EXPECT_NEAR((camera.toPixels(box.center()) - Vec2(400, 300)).norm(), 0, 1e-9);
}

TEST(Camera, ZoomIsLimitedWhereCoordinatesLosePixels)
{
    host::Camera camera;
    for (int i = 0; i < 200; ++i) camera.zoomAbout({0, 0}, 10);
    EXPECT_TRUE(std::isfinite(camera.view().scale));
    EXPECT_LE(camera.view().scale, 1e4);
}

TEST(Grid, StepsAreOneTwoOrFiveTimesAPowerOfTen)
{
    for (const double scale : {0.001, 0.03, 0.5, 1.0, 1.7, 40.0, 9000.0}) {
        const double step = host::gridStep(scale);
        EXPECT_GE(step * scale, 12);
        EXPECT_LT(step * scale, 12 * 2.5 + 1e-9);
        const double lead = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
        EXPECT_TRUE(std::abs(lead - 1) < 1e-6 || std::abs(lead - 2) < 1e-6 || std::abs(lead - 5) < 1e-6) << step;
    }
}

}  // namespace jet::test
