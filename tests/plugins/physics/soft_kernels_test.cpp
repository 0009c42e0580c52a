// The wide kernels of soft bodies: every spring has its place, and each instruction set gives the same bits.
#include "lattices.hpp"
#include "soft/layout.hpp"

#include <cstring>
#include <random>

namespace jet::physics::soft {

namespace {

/// `columns` x `rows` particles, a unit apart, joined to their eight neighbours.
SoftBodyDef sheet(std::uint32_t columns, std::uint32_t rows)
{
    SoftBodyDef def;
    for (std::uint32_t y = 0; y < rows; ++y)
        for (std::uint32_t x = 0; x < columns; ++x) def.particles.emplace_back(x, y);
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        def.springs.push_back({a, b, (def.particles[a] - def.particles[b]).norm(), 10, 0.1, 0});
    };
    for (std::uint32_t y = 0; y < rows; ++y)
        for (std::uint32_t x = 0; x < columns; ++x) {
            const std::uint32_t i = y * columns + x;
            if (x + 1 < columns) join(i, i + 1);
            if (y + 1 < rows) join(i, i + columns);
            if (x + 1 < columns && y + 1 < rows) join(i, i + columns + 1), join(i + 1, i + columns);
        }
    def.masses.assign(def.particles.size(), 1);
    return def;
}

std::vector<Ends> endsOf(const SoftBodyDef& def, const std::vector<std::uint32_t>& order)
{
    std::vector<std::uint32_t> node(order.size());
    for (std::uint32_t n = 0; n < order.size(); ++n) node[order[n]] = n;
    std::vector<Ends> ends;
    for (const SpringDef& spring : def.springs) ends.push_back({node[spring.a], node[spring.b]});
    return ends;
}

std::uint32_t springOfLane(std::uint32_t lane)
{
    return static_cast<std::uint32_t>(std::find(std::begin(kLaneOf), std::end(kLaneOf), lane) - std::begin(kLaneOf));
}

}  // namespace

TEST(SoftLayout, EachSpringHasASeatOfItsOwnBetweenItsNodes)
{
    for (const SoftBodyDef& def :
         {sheet(30, 20), sheet(9, 3), test::defaultBall({0, 0}, 30), test::banana({0, 0}, 50)}) {
        const auto order = orderOf(def);
        const auto ends = endsOf(def, order);
        const Blocks blocks = arrange(ends, static_cast<std::uint32_t>(order.size()));
        std::vector<int> taken(blocks.count() * kLanes, 0);
        for (std::size_t i = 0; i < ends.size(); ++i) {
            const std::uint32_t block = blocks.seat[i] / kLanes, k = springOfLane(blocks.seat[i] % kLanes);
            EXPECT_EQ(taken[blocks.seat[i]]++, 0);
            std::uint32_t a = 0, b = 0;
            if (block < blocks.runs.size()) {
                a = blocks.runs[block].a + k, b = blocks.runs[block].b + k;
                ASSERT_LE(blocks.runs[block].b + kLanes, order.size());
            } else {
                const std::uint32_t* scattered = blocks.ends.data() + (block - blocks.runs.size()) * 2 * kLanes;
                a = scattered[k], b = scattered[kLanes + k];
            }
            EXPECT_EQ(std::minmax(a, b), std::minmax(ends[i].a, ends[i].b));
        }
    }
}

TEST(SoftLayout, ASheetNeedsHardlyAnyGathering)
{
    const SoftBodyDef def = sheet(100, 100);
    const Blocks blocks = arrange(endsOf(def, orderOf(def)), 10000);
    EXPECT_GT(static_cast<double>(blocks.runs.size()) / static_cast<double>(blocks.count()), 0.97);
}

TEST(SoftLayout, AShuffledSheetIsPutBackInRows)
{
    SoftBodyDef def = sheet(60, 60);
    std::vector<std::uint32_t> place(def.particles.size());
    for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
    std::shuffle(place.begin(), place.end(), std::mt19937(7));
    const SoftBodyDef drawn = def;
    for (std::size_t i = 0; i < place.size(); ++i) def.particles[place[i]] = drawn.particles[i];
    for (SpringDef& spring : def.springs) spring.a = place[spring.a], spring.b = place[spring.b];
    const Blocks blocks = arrange(endsOf(def, orderOf(def)), 3600);
    EXPECT_GT(static_cast<double>(blocks.runs.size()) / static_cast<double>(blocks.count()), 0.95);
}

TEST(SoftKernels, EveryInstructionSetGivesTheSameBits)
{
    if (!hasAvx2()) GTEST_SKIP() << "this processor has one instruction set only";
    const SoftBodyDef def = test::defaultBall({1000, -70}, 30);
    const auto order = orderOf(def);
    const Blocks blocks = arrange(endsOf(def, order), static_cast<std::uint32_t>(order.size()));
    std::mt19937 random(3);
    const auto number = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    std::vector<double> position, velocity, inverse;
    for (std::uint32_t particle : order) {
        for (int axis : {0, 1}) position.push_back(def.particles[particle][axis] + number(-3, 3));
        for (int axis : {0, 1}) velocity.push_back(5 * axis + number(-90, 90));
        inverse.push_back(number(0, 1) < 0.1 ? 0 : number(0.1, 100));
    }
    std::vector<float> coefficients(blocks.count() * 3 * kLanes), tear(blocks.count() * kLanes);
    for (float& c : coefficients) c = static_cast<float>(number(0, 20));
    for (float& t : tear) t = static_cast<float>(number(1, 40));

    const auto run = [&](const Kernels& kernels) {
        std::vector<double> at = position, moving = velocity, force(position.size(), 0.25);
        std::vector<float> relative(2 * position.size());
        std::vector<std::uint32_t> torn(blocks.count());
        const SpringBlocks springs{blocks.runs.data(),  blocks.runs.size(), blocks.ends.data(), blocks.ends.size() / 16,
                                   coefficients.data(), tear.data(),        torn.data()};
        kernels.relate(at.data(), moving.data(), order.size(), {at[0], at[1], 1, 2}, relative.data());
        torn.resize(kernels.pull(springs, relative.data(), force.data()));
        const std::vector<double> pulled = force;
        kernels.accelerate(moving.data(), force.data(), inverse.data(), order.size(), {1.0 / 480, 0.3, 9.8, 0.999});
        kernels.advance(at.data(), moving.data(), order.size(), 1.0 / 480);
        return std::tuple(at, moving, pulled, relative, torn);
    };
    EXPECT_EQ(run(kernelsSse2()), run(kernelsAvx2()));
    EXPECT_FALSE(std::get<4>(run(kernelsSse2())).empty());
}

}  // namespace jet::physics::soft
