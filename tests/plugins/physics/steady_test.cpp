// A world that has come to its rhythm takes no more memory, and what it has is little: every `operator new` of this
// program is counted.
#include "lattices.hpp"
#include "shape_worlds.hpp"

#include <jet/physics_removal.hpp>

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> allocations{0}, liveBytes{0};

void* counted(std::size_t size, std::size_t alignment = alignof(std::max_align_t))
{
    ++allocations;
    void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    liveBytes += static_cast<long>(malloc_usable_size(memory));
    return memory;
}

void freed(void* memory)
{
    liveBytes -= static_cast<long>(malloc_usable_size(memory));
    std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, std::align_val_t alignment)
{
    return counted(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment)
{
    return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { freed(memory); }
void operator delete[](void* memory) noexcept { freed(memory); }
void operator delete(void* memory, std::size_t) noexcept { freed(memory); }
void operator delete[](void* memory, std::size_t) noexcept { freed(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { freed(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { freed(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { freed(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { freed(memory); }

namespace jet::physics::test {

namespace {

constexpr double kBoxBytes = 695;  // docs/physics.md, and a little for what the heap rounds up

long allocationsOf(PhysicsWorld& world, int warmUp, int steps)
{
    for (int i = 0; i < warmUp; ++i) world.step(kStep);
    const long before = allocations;
    for (int i = 0; i < steps; ++i) world.step(kStep);
    return allocations - before;
}

/// All parts of a zigzag overlap, but none is a pair with another: of 2,000 there would be two million.
TEST(SteadyStep, ABodyWhosePartsOverlapTakesNoMemoryForPairsOfThem)
{
    auto world = makeWorld({0, 100});
    std::vector<Vec2> zigzag;
    for (int i = 0; i < 2000; ++i) zigzag.push_back({i % 2 == 0 ? 0.0 : 500.0, i / 2 * 1e-3});
    world->addRigidBody(fixed({zigzag}));
    world->addRigidBody(box({250, -100}, 10, 10));
    const long before = liveBytes;
    world->step(kStep);
    EXPECT_LT(liveBytes - before, 8'000'000);
}

/// Bodies with joints, springs and forces that come and go, 20 at a time.
TEST(SteadyStep, AWorldInWhichBodiesComeAndGoTakesNoMoreMemory)
{
    for (const bool soft : {false, true}) {
        auto world = makeWorld({0, 200});
        world->addRigidBody(simple(ground(0)));
        std::vector<BodyHandle> alive;
        const auto turn = [&](int i) {
            const Vec2 at(15.0 * (i % 9), -25.0 - i % 3);
            const BodyHandle body =
                soft ? world->addSoftBody(softBall(at, 8, 200, 1, 8, 2)) : world->addRigidBody(simple(box(at, 9, 9)));
            const Anchor held{body, at, 0}, fixed{kNoHandle, at - Vec2(0, 20), 0};
            JointDef rope;
            rope.kind = JointDef::Kind::Rope;
            rope.a = fixed, rope.b = held;
            world->addJoint(rope);
            world->addSpring({fixed, held});
            world->addForce({held, {10, 0}});
            alive.push_back(body);
            if (alive.size() > 20) removal(*world).removeBody(alive.front()), alive.erase(alive.begin());
            world->step(kStep);
        };
        const auto mostOf = [&](int from, int to) {
            long most = 0;
            for (int i = from; i < to; ++i) turn(i), most = std::max<long>(most, liveBytes);
            return most;
        };
        const int steps = soft ? 300 : 3000;
        const long before = mostOf(0, steps), after = mostOf(steps, 3 * steps);
        // What contacts take goes up and down with how bodies lie.
        EXPECT_LT(static_cast<double>(after), 1.1 * static_cast<double>(before)) << (soft ? "soft" : "rigid");
    }
}

TEST(SteadyStep, TheCountSeesAnAllocation)
{
    const long before = allocations;
    std::vector<int>* volatile made = new std::vector<int>(100);  // else compilers may leave both out
    delete made;
    EXPECT_GE(allocations - before, 2);
}

TEST(SteadyStep, AStandingPyramidAllocatesNothing)
{
    for (const int threads : {1, 2}) {
        auto world = pyramidWorld(shapeSettings(threads));
        EXPECT_EQ(allocationsOf(*world, 120, 300), 0) << threads << " threads";
    }
}

TEST(SteadyStep, ASmallStackInDoublePrecisionAllocatesNothing)
{
    auto world = pyramidWorld(shapeSettings(), 10);
    EXPECT_EQ(allocationsOf(*world, 120, 300), 0);
}

TEST(SteadyStep, AHangingNetAllocatesNothing)
{
    auto world = netWorld(shapeSettings());
    EXPECT_EQ(allocationsOf(*world, 60, 300), 0);
}

/// Balls of springs on each other in a box: contacts between soft bodies and with walls.
std::unique_ptr<PhysicsWorld> pile(int balls, bool torn)
{
    WorldSettings settings;
    settings.gravity = {0, 98};
    auto world = JetPhysics().createWorld(settings);
    for (int i = 0; i < balls; ++i) {
        SoftBodyDef ball = defaultBall({50.0 * (i % 3) + 7 * (i / 3), -30 - 50.0 * (i / 3)}, 20, 40);
        ball.matter.thickness = 1;
        ball.matter.pressure = i % 2 == 0 ? 5 : 0;
        ball.matter.selfCollision = i % 4 == 1;
        if (torn)
            for (SpringDef& spring : ball.springs) spring.tearRatio = 3;
        world->addSoftBody(ball);
    }
    world->addRigidBody(ground(0));
    world->addRigidBody(fixed({boxRing({-75, -100}, 100, 400), boxRing({190, -100}, 100, 400)}));
    return world;
}

TEST(SteadyStep, APileOfSoftBodiesAllocatesNothing)
{
    auto world = pile(9, false);
    EXPECT_EQ(allocationsOf(*world, 900, 300), 0);
}

TEST(SteadyStep, SoftBodiesThatMayTearAllocateNothingAsLongAsTheyDoNot)
{
    auto world = pile(6, true);
    EXPECT_EQ(allocationsOf(*world, 900, 300), 0);
}

TEST(SteadyStep, ASwingingSheetAllocatesNothing)
{
    WorldSettings settings;
    settings.gravity = {0, 98};
    auto world = JetPhysics().createWorld(settings);
    SoftBodyDef sheet = square({0, 0}, 100);
    sheet.movable.assign(sheet.particles.size(), 1);
    sheet.movable[0] = 0;
    world->addSoftBody(sheet);
    EXPECT_EQ(allocationsOf(*world, 60, 300), 0);
}

struct Bytes {
    double taken = 0, told = 0;  // of the heap; as the world says
};

Bytes bytesOfBoxes(int count, bool look)
{
    const long before = liveBytes;
    WorldSettings settings;
    settings.gravity = {0, 98.1};
    auto world = JetPhysics().createWorld(settings);
    for (int i = 0; i < count; ++i) world->addRigidBody(simple(box({20.0 * i, 0}, 10, 10)));
    for (int i = 0; i < 30; ++i) {
        world->step(kStep);
        if (look) world->bodies();
    }
    const auto told = static_cast<double>(world->stats().memory);
    return {static_cast<double>(liveBytes - before), told};
}

/// What a box more takes.
Bytes bytesEach(bool look)
{
    const Bytes few = bytesOfBoxes(2000, look), many = bytesOfBoxes(6000, look);
    return {(many.taken - few.taken) / 4000, (many.told - few.told) / 4000};
}

TEST(Memory, ABoxTakesNoMoreThanItDid)
{
    EXPECT_LT(bytesEach(true).taken, kBoxBytes);
    EXPECT_LT(bytesEach(false).taken, kBoxBytes);
}

TEST(Memory, WorldsTellWhatTheyTake)
{
    for (const bool look : {false, true}) {
        const Bytes each = bytesEach(look);
        EXPECT_NEAR(each.told, each.taken, 0.03 * each.taken) << look;
    }
}

}  // namespace

}  // namespace jet::physics::test
