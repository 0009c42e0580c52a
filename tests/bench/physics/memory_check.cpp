// What of the heap a body, a contact, a particle and a spring take: by how much worlds with more of them are larger.
#include "bench/physics/memory_check.hpp"

#include "engine.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>

namespace jet::bench {

namespace {

constexpr int kFew = 4000, kMany = 20000;

using Fill = std::function<void(PhysicsWorld&, int count)>;

/// In worlds that may sleep; floating, bodies are at rest from the start.
enum class Motion { Falling, Floating };

/// Bytes of a world, with all it makes for steps and, if somebody does, for who looks at its bodies.
double bytesOf(const Fill& fill, int count, bool look, Motion motion)
{
    const std::size_t before = heapInUse();
    WorldSettings settings;
    settings.gravity = {0, motion == Motion::Falling ? 98.1 : 0};
    const auto world = physics::JetPhysics().createWorld(settings);
    fill(*world, count);
    const int steps = motion == Motion::Falling ? 30 : 120;  // long enough to fall asleep
    std::size_t most = 0;
    for (int i = 0; i < steps; ++i) {
        world->step(1.0 / 60);
        if (motion == Motion::Floating) most = std::max(most, heapInUse());
    }
    if (look) world->bodies();
    return static_cast<double>(std::max(most, heapInUse())) - static_cast<double>(before);
}

double bytesEach(const Fill& fill, bool look = true, Motion motion = Motion::Falling)
{
    return (bytesOf(fill, kMany, look, motion) - bytesOf(fill, kFew, look, motion)) / (kMany - kFew);
}

RigidBodyDef boxAt(double x, double y, double halfWidth)
{
    RigidBodyDef def;
    def.shapes.push_back(
        {ShapeDef::Kind::Polygon,
         {{x - halfWidth, y - 5}, {x + halfWidth, y - 5}, {x + halfWidth, y + 5}, {x - halfWidth, y + 5}},
         0});
    return def;
}

void addBoxes(PhysicsWorld& world, int count, bool onGround)
{
    RigidBodyDef ground = boxAt(0, onGround ? 10 : 1e6, 1e6);
    ground.common.fixed = true;
    world.addRigidBody(ground);
    for (int i = 0; i < count; ++i) world.addRigidBody(boxAt(20.0 * i, 0, 5));
}

/// One body: particles in a row, and springs from each to the next ones.
void addRow(PhysicsWorld& world, int count, int springs, double tearRatio)
{
    SoftBodyDef def;
    for (int i = 0; i < count; ++i) def.particles.emplace_back(10.0 * i, 0);
    def.masses.assign(def.particles.size(), 1);
    for (int i = 0; i < count; ++i)
        for (int k = 1; k <= springs && i + k < count; ++k)
            def.springs.push_back(
                {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + k), 10.0 * k, 10, 0.1, tearRatio});
    world.addSoftBody(def);
}

/// Bytes of one, under the limit; 0: has none.
bool print(const char* what, double bytes, double limit = 0)
{
    const bool fine = limit == 0 || bytes < limit;
    std::printf("%-22s %7.0f bytes", what, bytes);
    if (limit > 0) std::printf("  %s %.0f", fine ? "<" : "TOO MANY, must be <", limit);
    std::printf("\n");
    return fine;
}

}  // namespace

std::size_t heapInUse()
{
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

bool memoryIsInLimits()
{
    const double box = bytesEach([](PhysicsWorld& world, int count) { addBoxes(world, count, false); });
    const double unseen = bytesEach([](PhysicsWorld& world, int count) { addBoxes(world, count, false); }, false);
    const double standing = bytesEach([](PhysicsWorld& world, int count) { addBoxes(world, count, true); });
    const double particle = bytesEach([](PhysicsWorld& world, int count) { addRow(world, count, 0, 0); });
    const double resting =
        bytesEach([](PhysicsWorld& world, int count) { addRow(world, count, 0, 0); }, true, Motion::Floating);
    const double sprung = bytesEach([](PhysicsWorld& world, int count) { addRow(world, count, 4, 0); });
    const double tearing = bytesEach([](PhysicsWorld& world, int count) { addRow(world, count, 4, 2); });
    bool fine = print("rigid body (box)", box, 700);
    print("  nobody looks at", unseen);
    print("contact of two points", standing - box);
    fine = print("particle", particle, 120) && fine;
    fine = print("particle that rests", resting, 120) && fine;
    fine = print("spring", (sprung - particle) / 4, 64) && fine;
    return print("spring that may tear", (tearing - particle) / 4, 64) && fine;
}

}  // namespace jet::bench
