// Determinism, snapshots, and what must never get in or out: numbers that are none.
#include "lab.hpp"

#include <limits>

namespace jet::conformance {

namespace {

std::unique_ptr<PhysicsWorld> onGround(const Lab& lab, int threads)
{
    WorldSettings settings;
    settings.gravity = {0, 98.1};
    settings.threads = threads;
    settings.materials = {MaterialPair{0.5, 0.2, true}};
    auto world = lab.world(settings);
    world->addRigidBody(ground(0));
    return world;
}

/// A bit of everything rigid: a pile, joints, springs, things that move by themselves.
std::unique_ptr<PhysicsWorld> scene(const Lab& lab, int threads = 1)
{
    auto world = onGround(lab, threads);
    BodyHandle last = kNoHandle;
    for (int i = 0; i < 60; ++i) {
        const Vec2 place(30 * (i % 6) + 3 * (i % 4), -15.0 - 25 * (i / 6));
        last = world->addRigidBody(i % 3 == 0 ? disc(place, 9) : box(place, 18, 16, 1 + i % 4, 0.1 * i));
    }
    world->addSpring({background({-40, -120}), on(last, at(*world, last)), -1, 20, 0.5, 0});
    try {
        const BodyHandle bob = world->addRigidBody(disc({-60, -80}, 8, 3));
        world->addJoint(joint(JointDef::Kind::Revolute, background({-60, -120}), on(bob, {-60, -120})));
    } catch (const Failure&) {  // then without joints
    }
    return world;
}

/// Pinned at its upper corners.
SoftBodyDef sheet(const Vec2& corner, std::uint32_t side)
{
    SoftBodyDef def;
    for (std::uint32_t i = 0; i < side * side; ++i) def.particles.push_back(corner + 8.0 * Vec2(i % side, i / side));
    def.masses.assign(def.particles.size(), 0.1);
    def.movable.assign(def.particles.size(), 1);
    def.movable[0] = def.movable[side - 1] = 0;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        if (i % side + 1 < side) def.springs.push_back({i, i + 1, 8, 400, 0.5, 0});
        if (i / side + 1 < side) def.springs.push_back({i, i + side, 8, 400, 0.5, 0});
    }
    return def;
}

Outcome twoRuns(const Lab& lab)
{
    const auto a = scene(lab), b = scene(lab);
    for (int i = 0; i < 300; ++i) {
        a->step(kStep), b->step(kStep);
        if (a->hash() != b->hash()) return holds(false, "runs differ from step " + std::to_string(i + 1));
    }
    return holds(true, {});
}

/// A heap of 2,000 bodies that touch from the start and settle, and a sheet of 2,500 particles: small worlds may be
/// left to one thread, and then any count of threads gives the same bits.
std::unique_ptr<PhysicsWorld> crowd(const Lab& lab, int threads)
{
    auto world = onGround(lab, threads);
    for (int i = 0; i < 2000; ++i) {
        const Vec2 place(10 * (i % 80) + i / 80 % 3, -5.0 - 10 * (i / 80));
        world->addRigidBody(i % 3 == 0 ? disc(place, 5) : box(place, 10, 10, 1 + i % 4));
    }
    try {
        world->addSoftBody(sheet({-700, -600}, 50));
    } catch (const Failure&) {  // then without soft bodies
    }
    return world;
}

Outcome threads(const Lab& lab)
{
    const auto one = crowd(lab, 1);
    run(*one, 1);
    for (const int count : {2, 4}) {
        const auto many = crowd(lab, count);
        run(*many, 1);
        if (many->hash() != one->hash()) return holds(false, std::to_string(count) + " threads give other bits");
    }
    return {Outcome::Verdict::Supported, 0, 0, {}, std::to_string(one->stats().contacts) + " contacts"};
}

Outcome continuing(const Lab& lab, bool otherWorld)
{
    const auto world = scene(lab);
    run(*world, 1);
    const std::vector<std::byte> state = world->save();
    const std::uint64_t saved = world->hash();
    run(*world, 2);
    const std::uint64_t end = world->hash();
    const auto other = otherWorld ? scene(lab) : nullptr;
    PhysicsWorld& again = other ? *other : *world;
    again.restore(state);
    if (again.hash() != saved) return holds(false, "the restored state is not the saved one");
    run(again, 2);
    if (again.hash() != end) return holds(false, "the future after restoring is another one");
    return {Outcome::Verdict::Supported, 0, 0, {}, std::to_string(state.size()) + " bytes for 62 bodies"};
}

/// A hand is no part of what a world is made of: states of before a drag, of its midst and of after it restore each
/// other, in the world that saved them and in an equal one, with the joint or without it.
Outcome dragged(const Lab& lab)
{
    const int grabbed = 20, letGo = 50, end = 70;
    const auto world = scene(lab);
    JointHandle hand = kNoHandle;
    const auto act = [&](PhysicsWorld& in, int step) {
        if (step == grabbed) {
            JointDef def = joint(JointDef::Kind::Mouse, background(at(in, 3)), on(3, at(in, 3)));
            def.hertz = 5, def.maxForce = 1e5;
            hand = in.addJoint(def);
        }
        if (step > grabbed && step < letGo) in.setJointTarget(hand, {3.0 * step, -200});
        if (step == letGo) in.removeJoint(hand);
        in.step(kStep);
    };
    std::vector<std::vector<std::byte>> states;
    std::vector<std::uint64_t> hashes;
    std::vector<double> heights;
    for (int step = 0; step < end; ++step) {
        states.push_back(world->save()), hashes.push_back(world->hash());
        heights.push_back(at(*world, 3).y());
        act(*world, step);
    }
    const std::uint64_t last = world->hash();
    if (heights[letGo] > heights[grabbed] - 20) return holds(false, "the hand does not lift the body");
    const auto other = scene(lab);
    for (PhysicsWorld* again : {world.get(), other.get()})
        for (const int from : {grabbed - 10, grabbed + 10, letGo + 5, grabbed + 20, 0}) {
            again->restore(states[from]);
            for (int step = from; step < end; ++step) {
                if (again->hash() != hashes[step])
                    return holds(false, "restored to step " + std::to_string(from) + ", other bits at step " +
                                            std::to_string(step));
                act(*again, step);
            }
            if (again->hash() != last) return holds(false, "the last step is another one");
        }
    // To before the drag: nobody holds anything.
    world->restore(states[grabbed - 10]);
    run(*world, (letGo - grabbed + 10) * kStep);
    return holds(at(*world, 3).y() > heights[letGo] + 20, "a hand of a future that was gone back from still pulls");
}

Outcome foreign(const Lab& lab)
{
    const auto world = scene(lab);
    run(*world, 0.5);
    const std::uint64_t before = world->hash();
    std::vector<std::byte> state = world->save();
    int accepted = 0;
    const auto attempt = [&](std::span<const std::byte> bytes) {
        try {
            world->restore(bytes);
            ++accepted;
        } catch (const Failure&) {
        }
    };
    attempt({});
    attempt(std::vector<std::byte>(1000, std::byte{0x5a}));
    attempt(std::span(state).first(state.size() - 3));
    // Damaged on the way.
    for (std::size_t at = 0; at < state.size(); at += 1 + state.size() / 5) {
        std::vector<std::byte> damaged = state;
        damaged[at] ^= std::byte{32};
        attempt(damaged);
    }
    // A world that is made of something else.
    const auto other = scene(lab);
    other->addRigidBody(box({400, -20}, 10, 10));
    attempt(other->save());
    if (world->hash() != before) return holds(false, "a refused state changed the world");
    return measured(accepted, "broken states of 9 taken", 0);
}

Outcome oneBit(const Lab& lab)
{
    const auto a = scene(lab), b = scene(lab);
    b->applyImpulse(5, {1e-3, 0});
    a->step(kStep), b->step(kStep);
    return holds(a->hash() != b->hash(), "the hash does not see a small push");
}

JointDef jointTo(BodyHandle body, JointDef::Kind kind)
{
    JointDef def;
    def.kind = kind;
    def.b = on(body, {0, 0});
    return def;
}

Outcome poison(const Lab& lab)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    const auto world = scene(lab);
    const auto torque = world->addTorque({on(1, {0, -15}), 0});
    const auto force = world->addForce({on(1, {0, -15}), {0, 0}});
    const std::vector<std::pair<std::string, std::function<void()>>> attempts{
        {"velocity",
         [&] {
             world->setVelocity(1, {nan, 0});
         }},
        {"spin", [&] { world->setOmega(1, nan); }},
        {"position",
         [&] {
             world->setPosition(1, {0, infinite});
         }},
        {"gravity",
         [&] {
             world->setGravity({nan, 1});
         }},
        {"torque", [&] { world->setTorque(torque, infinite); }},
        {"force",
         [&] {
             world->setForce(force, {nan, nan});
         }},
        {"applied force",
         [&] {
             world->applyForce(1, {infinite, 0});
         }},
        {"impulse",
         [&] {
             world->applyImpulse(1, {0, nan});
         }},
        {"mass",
         [&] {
             world->addRigidBody(disc({500, 0}, 5, nan));
         }},
        {"no mass",
         [&] {
             world->addRigidBody(disc({500, 0}, 5, 0));
         }},
        {"radius",
         [&] {
             world->addRigidBody(disc({500, 0}, nan));
         }},
        {"point",
         [&] {
             world->addRigidBody(drawn({{{500, 0}, {510, 0}, {nan, 10}}}));
         }},
        {"initial velocity",
         [&] {
             world->addRigidBody(moving(disc({500, 0}, 5), {nan, 0}));
         }},
        {"material",
         [&] {
             RigidBodyDef def = disc({500, 0}, 5);
             def.common.material = 99;
             world->addRigidBody(def);
         }},
        {"spring",
         [&] {
             world->addSpring({background({0, 0}), on(1, {0, 0}), -1, nan, 0, 0});
         }},
        {"stiffness below 0",
         [&] {
             world->addSpring({background({0, 0}), on(1, {0, 0}), -1, -5, 0, 0});
         }},
        {"body of an anchor",
         [&] {
             world->addTorque({on(12345, {0, 0}), 1});
         }},
        {"body",
         [&] {
             world->setVelocity(12345, {0, 0});
         }},
        {"kind of joint that there is not", [&] { world->addJoint(jointTo(1, static_cast<JointDef::Kind>(99))); }},
        {"axis without a direction",
         [&] {
             JointDef def = jointTo(1, JointDef::Kind::Prismatic);
             def.axis = {0, 0};
             world->addJoint(def);
         }},
        {"limits the wrong way round",
         [&] {
             JointDef def = jointTo(1, JointDef::Kind::Revolute);
             def.lower = 1, def.upper = -1;
             world->addJoint(def);
         }},
        {"shape of a cast that there is not",
         [&] {
             ShapeDef shape{ShapeDef::Kind::Circle, {{0, 0}}, 1};
             shape.kind = static_cast<ShapeDef::Kind>(9);
             world->shapeCast(shape, {1, 0});
         }},
        {"restitution above 1",
         [&] {
             WorldSettings settings;
             settings.materials[0].restitution = 2;
             world->setSettings(settings);
         }},
    };
    std::string taken, silent;
    for (const auto& [name, attempt] : attempts) {
        try {
            attempt();
            taken += (taken.empty() ? "" : ", ") + name;
        } catch (const Failure& failure) {
            if (failure.error().message.size() < 15) silent += (silent.empty() ? "" : ", ") + name;
        }
    }
    if (!taken.empty()) return holds(false, "taken: " + taken);
    if (!silent.empty()) return holds(false, "refused without a sentence: " + silent);
    run(*world, 1);
    for (const Vec2& p : world->bodies().points)
        if (!isFinite(p)) return holds(false, "a number that is none came out");
    return {Outcome::Verdict::Supported, 0, 0, {}, std::to_string(attempts.size()) + " poisoned inputs refused"};
}

Outcome absurd(const Lab& lab)
{
    const auto world = scene(lab);
    for (int i = 0; i < 120; ++i) {
        world->applyForce(static_cast<BodyHandle>(1 + i % 60), Vec2(i % 2 ? 1e9 : -1e9, 1e9));
        world->step(kStep);
    }
    for (const Vec2& p : world->bodies().points)
        if (!isFinite(p)) return holds(false, "forces of 10⁹ gave a number that is none");
    return holds(true, {});
}

}  // namespace

std::vector<Check> stateChecks()
{
    return {{"state", "two runs, the same bits", twoRuns},
            {"state", "1, 2, 4 threads, the same bits", threads},
            {"state", "the hash sees a small push", oneBit},
            {"state", "a snapshot goes on bit-equal", [](const Lab& lab) { return continuing(lab, false); }},
            {"state", "a snapshot in an equal world", [](const Lab& lab) { return continuing(lab, true); }},
            {"state", "drags come and go", dragged},
            {"state", "broken snapshots are refused", foreign},
            {"state", "poisoned inputs are refused", poison},
            {"state", "absurd forces stay finite", absurd}};
}

}  // namespace jet::conformance
