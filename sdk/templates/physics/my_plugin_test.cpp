#include <jet/testing/gtest.hpp>

namespace {

constexpr double kStep = 1.0 / 64;

class MyPluginTest : public jet::test::PluginTest {
protected:
    MyPluginTest() : PluginTest{"org.example.my-plugin"} {}
    static jet::RigidBodyDef box(const jet::Vec2& corner, bool fixed = false)
    {
        jet::RigidBodyDef def;
        def.borders = {{corner, corner + jet::Vec2(10, 0), corner + jet::Vec2(10, 10), corner + jet::Vec2(0, 10)}};
        def.common.fixed = fixed;
        return def;
    }

    jet::WorldSettings settings;  // of its constructor: a gravity of (0, 98.1)
    std::unique_ptr<jet::PhysicsWorld> world = catalog().physicsEngine("my-plugin")->createWorld(settings);
};

TEST_F(MyPluginTest, FallsAsSemiImplicitEulerSays)
{
    const jet::BodyHandle body = world->addRigidBody(box({0, 0}));
    for (int i = 0; i < 64; ++i) world->step(kStep);
    // y = g dt² n (n + 1) / 2
    EXPECT_NEAR(world->bodies().position[body].y(), 5 + 98.1 * kStep * kStep * 64 * 65 / 2, 1e-9);
}

TEST_F(MyPluginTest, StaysAboveTheFloor)
{
    world->addRigidBody(box({0, 100}, true));
    const jet::BodyHandle body = world->addRigidBody(box({0, 0}));
    for (int i = 0; i < 640; ++i) world->step(kStep);
    EXPECT_LE(world->bodies().bounds[body].max.y(), 100 + 1e-9);
    EXPECT_GT(world->bodies().bounds[body].max.y(), 99);
}

TEST_F(MyPluginTest, GoesOnEquallyFromASavedState)
{
    const jet::BodyHandle body = world->addRigidBody(box({0, 0}));
    world->setOmega(body, 2);
    world->step(kStep);
    const auto state = world->save();
    world->step(kStep);
    const auto hash = world->hash();
    world->restore(state);
    EXPECT_NE(world->hash(), hash);
    world->step(kStep);
    EXPECT_EQ(world->hash(), hash);
}

}  // namespace
