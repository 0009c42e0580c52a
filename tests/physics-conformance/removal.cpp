// Bodies and actuators that are taken out of a running world.
#include "lab.hpp"

#include <jet/physics_removal.hpp>

#include <deque>

namespace jet::conformance {

namespace {

bool isRefused(const std::function<void()>& act)
{
    try {
        act();
    } catch (const Failure& failure) {
        return failure.error().message.find("was removed") != std::string::npos;
    }
    return false;
}

/// One comes and one goes each step; what they land on is a floor with a few boxes.
struct Fountain {
    std::unique_ptr<PhysicsWorld> world;
    std::deque<BodyHandle> alive;
    Numbers numbers;
    bool soft = false;

    explicit Fountain(const Lab& lab, bool softBodies = false) : world(lab.world({0, 200})), soft(softBodies)
    {
        world->addRigidBody(ground(0));
        for (int i = 0; i < 5; ++i) world->addRigidBody(box({30.0 * i - 60, -10}, 20, 20));
    }
    void turn()
    {
        const Vec2 place(numbers(-80, 80), numbers(-70, -40));
        const bool round = alive.size() % 2 == 0;
        alive.push_back(soft ? world->addSoftBody(softBall(place, 8, 200, 1, 8, 2))
                             : world->addRigidBody(round ? disc(place, 5) : box(place, 8, 8)));
        if (alive.size() > 15) removal(*world).removeBody(alive.front()), alive.pop_front();
        world->step(kStep);
    }
};

Outcome comeAndGo(const Lab& lab, bool soft)
{
    const int steps = soft ? 600 : 10'000;
    Fountain fountain(lab, soft), again(lab, soft);
    removal(*fountain.world);  // or it is not supported
    std::size_t early = 0, late = 0;
    for (int i = 0; i < steps; ++i) {
        fountain.turn();
        std::size_t& most = i < steps / 3 ? early : late;
        most = std::max(most, fountain.world->stats().memory);
        if (i < 300) again.turn();
        if (i == 299 && fountain.world->hash() != again.world->hash()) return holds(false, "two runs differ");
    }
    for (const Vec2& point : fountain.world->bodies().points)
        if (!isFinite(point)) return holds(false, "a number that is none came out");
    const std::size_t bodies = fountain.world->bodyCount();
    if (bodies > 30) return holds(false, std::to_string(bodies) + " entries in bodies() for 21 bodies");
    const double grown = early > 0 ? 100 * (static_cast<double>(late) / static_cast<double>(early) - 1) : 0;
    // How much contacts take goes up and down with how bodies lie; bodies that stayed would be thousands of per cent.
    return measured(std::max(0.0, grown), "% more memory", 12,
                    std::to_string(steps) + " steps, " + std::to_string(bodies) + " entries");
}

Outcome whatHoldsIt(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    WorldRemoval& out = removal(*world);
    const BodyHandle body = world->addRigidBody(box({0, 0}, 20, 20)), other = world->addRigidBody(box({60, 0}, 20, 20));
    const JointHandle link = world->addJoint(joint(JointDef::Kind::Revolute, on(body, {30, 0}), on(other, {30, 0})));
    const ActuatorHandle spring = world->addSpring({on(body, {0, 0}), on(other, {60, 0})});
    const ActuatorHandle torque = world->addTorque({on(body, {0, 0}), 50});
    const ActuatorHandle force = world->addForce({on(other, {60, 0}), {60, 0}});
    run(*world, 0.5);
    out.removeBody(body);
    if (out.hasBody(body) || out.hasJoint(link) || out.hasActuator(ActuatorKind::Spring, spring) ||
        out.hasActuator(ActuatorKind::Torque, torque))
        return holds(false, "what held it is still there");
    if (!out.hasActuator(ActuatorKind::Force, force)) return holds(false, "what held another is gone");
    const std::vector<std::function<void()>> acts{[&] { out.removeBody(body); },
                                                  [&] {
                                                      world->setVelocity(body, {1, 0});
                                                  },
                                                  [&] { world->setMass(body, 2); },
                                                  [&] { world->joint(link); },
                                                  [&] { world->setSpring(spring, 1, 1, 1, 0); },
                                                  [&] { world->setTorque(torque, 1); },
                                                  [&] {
                                                      world->addForce({on(body, {0, 0}), {1, 0}});
                                                  }};
    for (const auto& act : acts)
        if (!isRefused(act)) return holds(false, "a call with a removed handle is taken");
    const double before = velocity(*world, other).x();
    run(*world, 1);
    return measured(percentOff(velocity(*world, other).x() - before, 60), "% of what its own force gives", 1);
}

Outcome whatLiesOnIt(const Lab& lab)
{
    double worst = 0;
    for (const bool standing : {false, true}) {
        const auto world = lab.world({0, 100});
        world->addRigidBody(ground(0));
        RigidBodyDef lower = box({0, -10}, 20, 20);
        lower.common.fixed = standing;
        const BodyHandle below = world->addRigidBody(lower), above = world->addRigidBody(box({0, -30}, 20, 20));
        for (int i = 0; i < 240; ++i) world->step(kStep), world->contactEvents();
        removal(*world).removeBody(below);
        if (world->rayCast({-50, -10}, {50, -10})) return holds(false, "a ray still meets it");
        world->step(kStep);
        bool told = false;
        for (const ContactEvent& event : world->contactEvents())
            told |= !event.begins && event.bodyA == below && event.bodyB == above;
        if (!told) return holds(false, "the end of its contacts is not told");
        run(*world, 2);
        worst = std::max(worst, std::abs(at(*world, above).y() + 10));
    }
    return measured(worst, "units from where it lands", 0.5, "on a body that slept, and on a fixed one");
}

Outcome snapshots(const Lab& lab)
{
    Fountain fountain(lab);
    for (int i = 0; i < 60; ++i) fountain.turn();
    PhysicsWorld& world = *fountain.world;
    const std::vector<std::byte> before = world.save();
    removal(world).removeBody(fountain.alive.back());
    fountain.alive.pop_back();
    const std::vector<std::byte> since = world.save();
    run(world, 1);
    const std::uint64_t end = world.hash();
    world.restore(since);
    run(world, 1);
    if (world.hash() != end) return holds(false, "the future after restoring is another one");
    try {
        world.restore(before);
    } catch (const Failure&) {
        return holds(world.hash() == end, "a refused state changed the world");
    }
    return holds(false, "a state of before the removal is taken");
}

Outcome angularSpring(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle rod = world->addRigidBody(box({20, 0}, 40, 4));
    world->addJoint(joint(JointDef::Kind::Revolute, background({0, 0}), on(rod, {0, 0})));
    const ActuatorHandle spring =
        world->addAngularSpring({background({100, 0}), background({0, 0}), on(rod, {40, 0}), 0, true, 1e5, 2e4});
    run(*world, 1);
    liveAngularSprings(*world).setAngularSpring(spring, 1.0, 1e5, 2e4);
    run(*world, 4);
    return measured(std::abs(world->bodies().angle[rod] - 1), "rad", 0.01);
}

}  // namespace

std::vector<Check> removalChecks()
{
    return {{"removal", "a body comes and goes each step", [](const Lab& lab) { return comeAndGo(lab, false); }},
            {"removal", "a soft body comes and goes each step", [](const Lab& lab) { return comeAndGo(lab, true); }},
            {"removal", "what held a removed body", whatHoldsIt},
            {"removal", "what lay on a removed body", whatLiesOnIt},
            {"removal", "snapshots since and before", snapshots},
            {"removal", "an angular spring's values, live", angularSpring}};
}

}  // namespace jet::conformance
