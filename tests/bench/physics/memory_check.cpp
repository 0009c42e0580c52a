// What of the heap a body, a contact, a particle and a spring take: by how much worlds with more of them are larger.
#include "bench/physics/memory_check.hpp"

#include "engine.hpp"

#include <malloc.h>

#include <cstdio>
#include <functional>
#include <memory>

namespace jet::bench {

namespace {

constexpr int kFew = 4000, kMany = 20000;

using Fill = std::function<void(PhysicsWorld&, int count)>;

/// Bytes of a world, with all it makes for steps and, if somebody does, for who looks at its bodies.
double bytesOf(const Fill& fill, int count, bool look)
{
    const std::size_t before = heapInUse();
    WorldSettings settings;
    settings.gravity = {0, 98.1};
    const auto world = physics::JetPhysics().createWorld(settings);
    fill(*world, count);
    for (int i = 0; i < 30; ++i) world->step(1.0 / 60);
    if (look) world->bodies();
    return static_cast<double>(heapInUse()) - static_cast<double>(before);
}

double bytesEach(const Fill& fill, bool look = true)
{
    return (bytesOf(fill, kMany, look) - bytesOf(fill, kFew, look)) / (kMany - kFew);
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

}  // namespace

std::size_t heapInUse()
{
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

void printMemory()
{
    const double box = bytesEach([](PhysicsWorld& world, int count) { addBoxes(world, count, false); });
    const double unseen = bytesEach([](PhysicsWorld& world, int count) { addBoxes(world, count, false); }, false);
    const double resting = bytesEach([](PhysicsWorld& world, int count) { addBoxes(world, count, true); });
    const double particle = bytesEach([](PhysicsWorld& world, int count) { addRow(world, count, 0, 0); });
    const double sprung = bytesEach([](PhysicsWorld& world, int count) { addRow(world, count, 4, 0); });
    const double tearing = bytesEach([](PhysicsWorld& world, int count) { addRow(world, count, 4, 2); });
    std::printf("rigid body (box)        %6.0f bytes\n", box);
    std::printf("  nobody looks at       %6.0f bytes\n", unseen);
    std::printf("contact of two points   %6.0f bytes\n", resting - box);
    std::printf("particle                %6.0f bytes\n", particle);
    std::printf("spring                  %6.0f bytes\n", (sprung - particle) / 4);
    std::printf("spring that may tear    %6.0f bytes\n", (tearing - particle) / 4);
}

}  // namespace jet::bench
