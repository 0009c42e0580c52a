// A world that has come to its rhythm takes no more memory: every `operator new` of this program is counted.
#include "shape_worlds.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment = alignof(std::max_align_t))
{
    ++allocations;
    void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
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
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace jet::physics::test {

namespace {

long allocationsOf(PhysicsWorld& world, int warmUp, int steps)
{
    for (int i = 0; i < warmUp; ++i) world.step(kStep);
    const long before = allocations;
    for (int i = 0; i < steps; ++i) world.step(kStep);
    return allocations - before;
}

TEST(SteadyStep, TheCountSeesAnAllocation)
{
    const long before = allocations;
    delete new std::vector<int>(100);
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

}  // namespace

}  // namespace jet::physics::test
