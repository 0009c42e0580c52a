// Bodies on their own: falling, turning, damping, switches.
#include "lab.hpp"

namespace jet::conformance {

namespace {

using std::to_string;

double fallError(const Lab& lab, double dt, int substeps = 0)
{
    WorldSettings settings;
    settings.gravity = {0, 100};
    settings.substeps = substeps;
    const auto world = lab.world(settings);
    const BodyHandle body = world->addRigidBody(disc({0, 0}, 5));
    run(*world, 1, dt);
    return std::abs(at(*world, body).y() - 50);
}

Outcome freeFall(const Lab& lab)
{
    return measured(100 * fallError(lab, kStep) / 50, "% of ½ g t²", 1.7, "1 s at 60 Hz");
}

Outcome fallOrder(const Lab& lab)
{
    const double coarse = fallError(lab, 1.0 / 60, 1), fine = fallError(lab, 1.0 / 240, 1);
    if (coarse < 1e-3) return measured(coarse, "units", 1e-3, "exact at every step");
    const double order = std::log2(coarse / fine) / 2;
    return measured(std::max(0.0, 1 - order), "below order 1", 0.1,
                    "order " + to_string(order).substr(0, 4) + ", one substep");
}

Outcome projectile(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle body = world->addRigidBody(moving(disc({0, 0}, 2), {60, -80}));
    double before = 0;
    for (int i = 1; i < 300; ++i) {
        world->step(kStep);
        const Vec2 now = at(*world, body);
        if (before < 0 && now.y() >= 0) {
            const double back = now.y() / (now.y() - before);
            return measured(percentOff(now.x() - back * 60 * kStep, 96), "% of the range", 1.7, "2 vx vy / g");
        }
        before = now.y();
    }
    return holds(false, "it never came down");
}

Outcome damping(const Lab& lab)
{
    WorldSettings settings;
    settings.gravity = {0, 0};
    settings.linearDamping = 2, settings.angularDamping = 3;
    const auto world = lab.world(settings);
    const BodyHandle body = world->addRigidBody(moving(box({0, 0}, 10, 10), {100, 0}, 5));
    run(*world, 1);
    return measured(std::max(percentOff(velocity(*world, body).x(), 100 * std::exp(-2.0)),
                             percentOff(omega(*world, body), 5 * std::exp(-3.0))),
                    "% of exp(-c t)", 0.5);
}

Outcome inertia(const Lab& lab)
{
    // An L of three unit squares of side 10 about its own centroid: I = m a² 11 / 18.
    const double a = 10, mass = 3;
    const std::vector<Vec2> ell{{0, 0}, {2 * a, 0}, {2 * a, a}, {a, a}, {a, 2 * a}, {0, 2 * a}};
    const double should = mass * a * a * 11 / 18;
    const auto world = lab.world({0, 0});
    const BodyHandle body = world->addRigidBody(drawn({ell}, mass));
    world->addTorque({on(body, {a / 2, a / 2}), 100});
    run(*world, 1);
    return measured(percentOff(omega(*world, body), 100 / should), "% of τ t / I", 0.5, "a drawn L");
}

Outcome offCentreForce(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle body = world->addRigidBody(box({0, 0}, 20, 20, 2));
    world->addForce({on(body, {0, 10}), {60, 0}});
    world->step(kStep);
    const double linear = percentOff(velocity(*world, body).x(), 30 * kStep);
    const double turn = percentOff(omega(*world, body), -600 * kStep / (2 * 800.0 / 12));
    return measured(std::max(linear, turn), "% of F t / m, F r t / I", 1);
}

Outcome momentsOfPush(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle body = world->addRigidBody(disc({0, 0}, 5, 4));
    world->applyImpulse(body, {8, -4});
    const Vec2 kick = velocity(*world, body);
    world->applyForce(body, {0, 240});
    world->step(kStep);
    world->step(kStep);
    const Vec2 end = velocity(*world, body);
    return measured(std::max((kick - Vec2(2, -1)).norm(), (end - Vec2(2, 0)).norm()), "units/s", 1e-3,
                    "an impulse, and a force of one step");
}

Outcome gravityScale(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    RigidBodyDef balloon = disc({0, 0}, 5), heavy = disc({100, 0}, 5);
    balloon.common.gravityScale = -1, heavy.common.gravityScale = 2;
    const BodyHandle up = world->addRigidBody(balloon), down = world->addRigidBody(heavy);
    const BodyHandle rock = world->addRigidBody(fixed(disc({200, 0}, 5)));
    run(*world, 1);
    return measured(std::max({percentOff(velocity(*world, up).y(), -100), percentOff(velocity(*world, down).y(), 200),
                              100 * (at(*world, rock) - Vec2(200, 0)).norm()}),
                    "%", 0.1);
}

Outcome switches(const Lab& lab)
{
    WorldSettings settings;
    settings.gravity = {0, 100}, settings.linearDamping = 5;
    settings.applyGravity = settings.applyDamping = settings.findCollisions = false;
    const auto passing = lab.world(settings);
    passing->addRigidBody(ground(20));
    const BodyHandle a = passing->addRigidBody(moving(disc({0, 0}, 5), {0, 50}));
    run(*passing, 1);
    settings.findCollisions = true, settings.resolveCollisions = false;
    const auto touching = lab.world(settings);
    const BodyHandle floor = touching->addRigidBody(ground(20));
    const BodyHandle b = touching->addRigidBody(moving(disc({0, 0}, 5), {0, 50}));
    bool touched = false;
    for (int i = 0; i < 60; ++i) touching->step(kStep), touched = touched || touching->touching(b, floor);
    const double off = std::max(std::abs(at(*passing, a).y() - 50), std::abs(at(*touching, b).y() - 50));
    if (!touched) return holds(false, "without resolving, contacts are not reported");
    return measured(off, "units", 0.05, "gravity, damping, finding, resolving");
}

Outcome fixedRotation(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    RigidBodyDef def = box({0, 0}, 20, 20);
    def.common.fixedRotation = true;
    const BodyHandle body = world->addRigidBody(def);
    world->addForce({on(body, {0, 10}), {60, 0}});
    run(*world, 1);
    return measured(std::abs(world->bodies().angle[body]), "rad", 1e-6);
}

Outcome kinematic(const Lab& lab)
{
    const auto world = lab.world({0, 100}, 0.9);
    RigidBodyDef lift = box({0, 50}, 100, 10, 5);
    lift.common.kinematic = true, lift.common.velocity = {0, -20};
    const BodyHandle platform = world->addRigidBody(lift), load = world->addRigidBody(box({0, 35}, 20, 20, 50));
    run(*world, 2);
    const double off = std::max(std::abs(at(*world, platform).y() - 10), std::abs(at(*world, load).y() + 5));
    return measured(off, "units", 0.5, "lifts ten times its mass");
}

Outcome liveChanges(const Lab& lab)
{
    WorldSettings settings;
    settings.gravity = {0, 0};
    const auto world = lab.world(settings);
    const BodyHandle body = world->addRigidBody(disc({0, 0}, 5, 1));
    settings.gravity = {0, 60};
    world->setSettings(settings);
    world->step(kStep);
    double off = std::abs(velocity(*world, body).y() - 1);
    BodyCommon common;
    common.gravityScale = -1;
    world->setBody(body, common);
    world->step(kStep);
    off = std::max(off, std::abs(velocity(*world, body).y()));
    world->setMass(body, 10);
    world->applyImpulse(body, {20, 0});
    off = std::max(off, std::abs(velocity(*world, body).x() - 2));
    return measured(off, "units/s", 0.01, "settings, body, mass");
}

Outcome enabling(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle shelf = world->addRigidBody(fixed(box({0, 20}, 100, 10)));
    const BodyHandle ball = world->addRigidBody(disc({0, 0}, 5)), still = world->addRigidBody(disc({200, 0}, 5));
    world->setEnabled(shelf, false);
    world->setEnabled(still, false);
    run(*world, 1);
    const bool fell = at(*world, ball).y() > 40, stood = (at(*world, still) - Vec2(200, 0)).norm() < 1e-6;
    const bool unseen = world->overlapping(Box({190, -10}, {210, 10})).empty();
    world->setEnabled(still, true);
    run(*world, 1);
    return holds(fell && stood && unseen && at(*world, still).y() > 40,
                 !fell    ? "a disabled body still holds others"
                 : !stood ? "a disabled body moves"
                 : unseen ? "a body that was enabled again does not move"
                          : "queries see a disabled body");
}

}  // namespace

std::vector<Check> motionChecks()
{
    return {{"motion", "free fall", freeFall},
            {"motion", "order of the integration", fallOrder},
            {"motion", "range of a projectile", projectile},
            {"motion", "linear and angular damping", damping},
            {"motion", "moment of inertia of an outline", inertia},
            {"motion", "force off the centre", offCentreForce},
            {"motion", "impulse and force on a body", momentsOfPush},
            {"motion", "gravity scale, fixed bodies", gravityScale},
            {"motion", "the four switches", switches},
            {"motion", "fixed rotation", fixedRotation},
            {"motion", "kinematic bodies", kinematic},
            {"motion", "live changes", liveChanges},
            {"motion", "bodies switched off", enabling}};
}

}  // namespace jet::conformance
