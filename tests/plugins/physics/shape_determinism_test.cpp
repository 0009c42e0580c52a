// Worlds of simple shapes give the same bits over threads and instruction sets, and go on from a snapshot as if nothing
// had happened, in the same world and in one just built.
#include "shape_worlds.hpp"

#include <functional>

namespace jet::physics::test {

namespace {

using Build = std::function<std::unique_ptr<PhysicsWorld>(const WorldSettings&)>;

struct Case {
    const char* name;
    Build build;
};
void PrintTo(const Case& which, std::ostream* out) { *out << which.name; }

class ShapeDeterminism : public ::testing::TestWithParam<Case> {};

void stepTogether(PhysicsWorld& one, PhysicsWorld& other, int steps)
{
    for (int i = 0; i < steps; ++i) {
        one.step(kStep);
        other.step(kStep);
        ASSERT_EQ(one.hash(), other.hash()) << "step " << i;
    }
}

TEST_P(ShapeDeterminism, ThreadsAndInstructionsGiveTheSameBits)
{
    auto one = GetParam().build(shapeSettings());
    for (const auto& settings :
         {shapeSettings(2), shapeSettings(4, Simd::Sse2), shapeSettings(1, Simd::Sse2), shapeSettings(3, Simd::Avx2)}) {
        auto first = GetParam().build(shapeSettings()), other = GetParam().build(settings);
        stepTogether(*first, *other, 60);
    }
}

TEST_P(ShapeDeterminism, ASnapshotHasTheSameFutureInTheSameWorldAndInANewOne)
{
    auto world = GetParam().build(shapeSettings());
    for (int i = 0; i < 45; ++i) world->step(kStep);
    const std::vector<std::byte> saved = world->save();
    std::vector<std::uint64_t> future;
    for (int i = 0; i < 120; ++i) {
        world->step(kStep);
        future.push_back(world->hash());
    }
    world->restore(saved);
    auto fresh = GetParam().build(shapeSettings());
    fresh->restore(saved);
    for (int i = 0; i < 120; ++i) {
        world->step(kStep);
        fresh->step(kStep);
        ASSERT_EQ(world->hash(), future[i]) << "the same world, step " << i;
        ASSERT_EQ(fresh->hash(), future[i]) << "a new world, step " << i;
    }
}

TEST_P(ShapeDeterminism, SavingChangesNothing)
{
    auto watched = GetParam().build(shapeSettings()), alone = GetParam().build(shapeSettings());
    for (int i = 0; i < 60; ++i) {
        watched->step(kStep);
        static_cast<void>(watched->contacts());
        watched->hash();
        alone->step(kStep);
    }
    EXPECT_EQ(watched->hash(), alone->hash());
}

INSTANTIATE_TEST_SUITE_P(Worlds, ShapeDeterminism,
                         ::testing::Values(Case{"pyramid", [](const WorldSettings& s) { return pyramidWorld(s); }},
                                           Case{"smallPyramid",
                                                [](const WorldSettings& s) { return pyramidWorld(s, 8); }},
                                           Case{"drum", [](const WorldSettings& s) { return drumWorld(s); }},
                                           Case{"bouncingDrum",
                                                [](WorldSettings s) {
                                                    s.materials[0].restitution = 0.4;
                                                    return drumWorld(s, 24);
                                                }},
                                           Case{"plate", [](const WorldSettings& s) { return plateWorld(s); }},
                                           Case{"net", [](const WorldSettings& s) { return netWorld(s); }}),
                         [](const auto& info) { return info.param.name; });

}  // namespace

}  // namespace jet::physics::test
