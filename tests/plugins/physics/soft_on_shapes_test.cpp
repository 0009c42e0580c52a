// Soft bodies meet rigid ones made of several shapes by the outline of all of them together.
#include "scenes.hpp"

namespace jet::physics::test {

namespace {

ShapeDef bar(const Vec2& middle, double width, double height)
{
    ShapeDef shape;
    shape.kind = ShapeDef::Kind::Polygon;
    const Vec2 half(0.5 * width, 0.5 * height);
    shape.points = {middle - half,
                    {middle.x() + half.x(), middle.y() - half.y()},
                    middle + half,
                    {middle.x() - half.x(), middle.y() + half.y()}};
    return shape;
}

RigidBodyDef fixedOf(std::vector<ShapeDef> shapes)
{
    RigidBodyDef def;
    def.common.fixed = true;
    def.shapes = std::move(shapes);
    return def;
}

/// The middles of a cross's sides lie within its other bar, their ends do not.
TEST(SoftOnShapes, ABallRestsOnEachArmOfACross)
{
    for (const double x : {-30.0, -20.0, 20.0, 35.0}) {
        auto world = makeWorld({0, 98.1});
        world->addRigidBody(fixedOf({bar({0, 0}, 100, 16), bar({0, 0}, 16, 100)}));
        world->addSoftBody(softBall({x, -20}, 10, 400, 2));
        run(*world, 3);
        const Vec2 at = world->bodies().position[1];
        EXPECT_NEAR(at.x(), x, 2) << x;
        EXPECT_NEAR(at.y(), -18, 1.5) << x;
    }
}

TEST(SoftOnShapes, ABallSlidesOverWhereShapesTouchOrLieOverEachOtherAsOverOneShape)
{
    const auto ends = [](const std::vector<ShapeDef>& shapes) {
        WorldSettings settings;
        settings.gravity = {0, 98.1};
        settings.materials = {MaterialPair{0, 0, true}};
        auto world = JetPhysics().createWorld(settings);
        world->addRigidBody(fixedOf(shapes));
        SoftBodyDef ball = softBall({-80, -10.5}, 10, 400, 2);
        ball.common.velocity = {50, 0};
        world->addSoftBody(ball);
        run(*world, 3);
        return Vec2(world->bodies().position[1]);
    };
    const Vec2 one = ends({bar({0, 5}, 200, 10)});
    const Vec2 beside = ends({bar({-50, 5}, 100, 10), bar({50, 5}, 100, 10)});
    const Vec2 over = ends({bar({-40, 5}, 120, 10), bar({40, 5}, 120, 10)});
    const Vec2 under = ends({bar({0, 5}, 200, 10), bar({0, 8}, 40, 10)});
    EXPECT_GT(one.x(), 60);
    for (const Vec2& end : {beside, over, under}) EXPECT_LT((end - one).norm(), 0.5) << end.x() << " " << end.y();
}

}  // namespace

}  // namespace jet::physics::test
