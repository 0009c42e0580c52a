// What is heavy lies on what is light, however much heavier it is: it may press it flat, but does not sink through it.
#include "lattices.hpp"

namespace jet::physics::test {

namespace {

SoftBodyDef ballOf(const Vec2& centre, double radius, double ks, double mass)
{
    SoftBodyDef ball = defaultBall(centre, radius, ks);
    for (double& each : ball.masses) each = mass / static_cast<double>(ball.masses.size());
    return ball;
}

/// Is body 1 above body 0 all the time? y is downward.
void expectAbove(PhysicsWorld& world, double step, double seconds, const std::string& what)
{
    double lowest = 1e9;
    for (double time = 0; time < seconds; time += step) {
        world.step(step);
        const BodyStates bodies = world.bodies();
        lowest = std::min(lowest, bodies.position[0].y() - bodies.position[1].y());
    }
    EXPECT_GT(lowest, 15) << what;
    EXPECT_TRUE(allFinite(world)) << what;
}

TEST(MassRatio, ABoxTenThousandTimesAsHeavyStaysOnASoftBall)
{
    for (const double mass : {1.0, 300.0, 1000.0, 10000.0})
        for (const double ks : {1e4, 1e6, 1e9})
            for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
                auto world = makeWorld({0, 98.1});
                world->addSoftBody(ballOf({0, -50.5}, 50, ks, 1));
                world->addRigidBody(box({2, -135}, 40, 40, mass));
                world->addRigidBody(ground(0));
                expectAbove(*world, step, 4,
                            std::to_string(mass) + " " + std::to_string(ks) + " " + std::to_string(step));
            }
}

void expectSoftAboveSoft(std::initializer_list<double> masses, std::initializer_list<double> stiffnesses)
{
    for (const double mass : masses)
        for (const double ks : stiffnesses)
            for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
                auto world = makeWorld({0, 98.1});
                world->addSoftBody(ballOf({0, -50.5}, 50, ks, 1));
                world->addSoftBody(ballOf({2, -125}, 20, ks, mass));
                world->addRigidBody(ground(0));
                expectAbove(*world, step, 4,
                            std::to_string(mass) + " " + std::to_string(ks) + " " + std::to_string(step));
            }
}

TEST(MassRatio, ASoftBallAThousandTimesAsHeavyStaysOnALightOne)
{
    expectSoftAboveSoft({1.0, 300.0, 1000.0}, {1e4, 1e6, 1e9});
}

TEST(MassRatio, ASoftBallTenThousandTimesAsHeavyStaysOnALightOneThatCanBearIt)
{
    expectSoftAboveSoft({100.0, 1000.0, 10000.0}, {1e5, 1e6, 1e9});
}

}  // namespace

}  // namespace jet::physics::test
