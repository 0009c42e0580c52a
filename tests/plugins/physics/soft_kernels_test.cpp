// The wide kernels of soft bodies: every spring has its place, and each instruction set gives the same bits.
#include "lattices.hpp"
#include "soft/batch.hpp"

#include <array>
#include <random>

namespace jet::physics::soft {

namespace {

using test::sheet;

std::vector<Ends> endsOf(const SoftBodyDef& def, const std::vector<std::uint32_t>& order)
{
    std::vector<std::uint32_t> node(order.size());
    for (std::uint32_t n = 0; n < order.size(); ++n) node[order[n]] = n;
    std::vector<Ends> ends;
    for (const SpringDef& spring : def.springs) ends.push_back({node[spring.a], node[spring.b]});
    return ends;
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
            const std::uint32_t block = blocks.seat[i] / kLanes, k = blocks.seat[i] % kLanes;
            EXPECT_EQ(taken[blocks.seat[i]]++, 0);
            std::uint32_t a = 0, b = 0;
            if (block < blocks.runs.size()) {
                a = blocks.runs[block].a + k, b = blocks.runs[block].b + k;
                ASSERT_LT(blocks.runs[block].b, order.size());
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

namespace {

struct Particles {
    std::vector<double> position, velocity, inverse;
};

/// The planes of `size` nodes, in memory of their own.
struct Room {
    explicit Room(std::size_t size)
        : size_((size + 7) & ~std::size_t{7}), planes(Planes::kCount * (size_ + 8), 7), near(4 * size_, 7)
    {
    }
    Planes view() { return {planes.data(), size_ + 8, near.data(), size_}; }

private:
    std::size_t size_;

public:
    std::vector<float> planes, near;
};

class Random {
public:
    double operator()(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }

private:
    std::mt19937 engine_{3};
};

Particles shaken(const SoftBodyDef& def, const std::vector<std::uint32_t>& order, Random& number)
{
    Particles all;
    for (std::uint32_t particle : order) {
        for (int axis : {0, 1}) all.position.push_back(def.particles[particle][axis] + number(-3, 3));
        for (int axis : {0, 1}) all.velocity.push_back(5 * axis + number(-90, 90));
        all.inverse.push_back(number(0, 1) < 0.1 ? 0 : number(0.1, 100));
    }
    return all;
}

std::vector<float> numbers(std::size_t count, double from, double to, Random& number)
{
    std::vector<float> all(count);
    for (float& value : all) value = static_cast<float>(number(from, to));
    return all;
}

}  // namespace

TEST(SoftKernels, AreThoseAskedForOrTheNextNarrowerThatThereAre)
{
    EXPECT_EQ(&kernelsFor(Simd::Sse2), &kernelsSse2());
    EXPECT_EQ(&kernelsFor(Simd::Avx2), hasAvx2() ? &kernelsAvx2() : &kernelsSse2());
    EXPECT_EQ(&kernelsFor(Simd::Avx512), hasAvx512() ? &kernelsAvx512() : &kernelsFor(Simd::Avx2));
    EXPECT_EQ(&kernelsFor(Simd::Automatic), &kernelsFor(Simd::Avx512));
}

TEST(SoftKernels, EveryInstructionSetGivesTheSameBits)
{
    if (!hasAvx2()) GTEST_SKIP() << "this processor has one instruction set only";
    Random number;
    // Round, with springs to gather; in rows, with all counts of nodes left over after fours.
    for (const SoftBodyDef& def : {test::defaultBall({1000, -70}, 30), sheet(20, 10), sheet(23, 7), sheet(9, 13)}) {
        const auto order = orderOf(def);
        const Blocks blocks = arrange(endsOf(def, order), static_cast<std::uint32_t>(order.size()));
        const Particles start = shaken(def, order, number);
        const auto rest = numbers(blocks.count() * kLanes, 0, 20, number), kinds = numbers(3 * 16, 0, 20, number);
        const auto tear = numbers(blocks.count() * kLanes, 1, 40, number);
        std::vector<std::uint32_t> kind(blocks.count());
        for (std::size_t i = 0; i < kind.size(); ++i) kind[i] = i % 3;
        const auto run = [&](const Kernels& kernels, bool pushed) {
            Particles now = start;
            std::vector<double> force(now.position.size(), 0.25);
            Room room(roomFor(order.size(), blocks.reach));
            std::vector<std::uint32_t> torn(blocks.count());
            const SpringBlocks springs{blocks.runs.data(), blocks.runs.size(),
                                       blocks.ends.data(), blocks.ends.size() / 16,
                                       rest.data(),        kind.data(),
                                       kinds.data(),       tear.data(),
                                       torn.data(),        0.001F,
                                       blocks.reach};
            const Swing swing =
                kernels.swing(springs,
                              {now.position.data(), now.velocity.data(), pushed ? force.data() : nullptr,
                               now.inverse.data(), order.size()},
                              {now.position[0], 2, 1, 2}, {1.0 / 480, 0.3, 9.8, 0.999}, room.view(), {0, order.size()});
            torn.resize(swing.torn);
            kernels.advance(now.position.data(), now.velocity.data(), order.size(), 1.0 / 480, swing.x, swing.y);
            return std::tuple(now.position, now.velocity, room.planes, room.near, swing.pinned, force, torn);
        };
        for (const bool pushed : {false, true}) {
            EXPECT_EQ(run(kernelsSse2(), pushed), run(kernelsAvx2(), pushed));
            EXPECT_FALSE(std::get<6>(run(kernelsSse2(), pushed)).empty());
        }
    }
}

TEST(SoftKernels, ALargeBodyInPartsIsPulledAsWholeAndTearsWhereItDid)
{
    // In rows; with one particle in seven joined far away, so that there are springs to gather across parts.
    for (const std::uint32_t far : {0U, 100U}) {
        SoftBodyDef def = sheet(100, 130);
        for (std::uint32_t i = 0; far > 0 && i + far + i % 5 < 13000; i += 7)
            if (i % 100 < 90) def.springs.push_back({i, i + far + i % 5, 3, 10, 0.1, 0});
        Random number;
        const auto order = orderOf(def);
        Batch batch;
        batch.rows = static_cast<Index>(order.size());
        batch.blocks = arrange(endsOf(def, order), batch.rows);
        batch.divide();
        ASSERT_EQ(batch.parts.size(), 3U);
        const Blocks& blocks = batch.blocks;
        EXPECT_EQ(blocks.ends.empty(), far == 0);
        const Particles start = shaken(def, order, number);
        const auto rest = numbers(blocks.count() * kLanes, 0, 20, number), kinds = numbers(3 * 16, 0, 20, number);
        const auto tear = numbers(blocks.count() * kLanes, 1, 40, number);
        const std::vector<std::uint32_t> kind(blocks.count(), 1);
        const std::size_t head = headFor(blocks.reach);
        const auto run = [&](std::vector<Stretch> parts) {
            Particles now = start;
            const NodeArrays nodes{now.position.data(), now.velocity.data(), nullptr, now.inverse.data(), order.size()};
            const VelocityStep step{1.0 / 480, 0.3, 9.8, 0.999};
            Room room(roomFor(order.size(), blocks.reach));
            std::vector<std::uint32_t> torn;
            std::vector<std::vector<float>> held(parts.size()), spilt(parts.size());
            Swing all;
            // The last first: no part may need what another has already changed.
            for (std::size_t k = parts.size(); k-- > 0;) {
                held[k].resize(2 * head), spilt[k].resize(2 * head, 7);
                parts[k].held = held[k].data(), parts[k].spilt = k + 1 < parts.size() ? spilt[k].data() : nullptr;
                std::vector<std::uint32_t> own(blocks.count());
                const SpringBlocks springs{blocks.runs.data(), blocks.runs.size(),
                                           blocks.ends.data(), blocks.ends.size() / 16,
                                           rest.data(),        kind.data(),
                                           kinds.data(),       tear.data(),
                                           own.data(),         0.001F,
                                           blocks.reach};
                const Swing swing = kernelsFor(Simd::Automatic)
                                        .swing(springs, nodes, {now.position[0], 2, 1, 2}, step, room.view(), parts[k]);
                torn.insert(torn.end(), own.begin(), own.begin() + static_cast<std::ptrdiff_t>(swing.torn));
                all.x += swing.x, all.y += swing.y;
            }
            for (std::size_t k = 1; k < parts.size(); ++k) {
                const Swing swing =
                    kernelsFor(Simd::Automatic).join(nodes, step, room.view(), parts[k], spilt[k - 1].data());
                all.x += swing.x, all.y += swing.y;
            }
            std::sort(torn.begin(), torn.end());
            return std::tuple(now.velocity, torn, all.x, all.y);
        };
        const auto [velocity, torn, x, y] = run(batch.parts);
        const auto [whole, tornWhole, wholeX, wholeY] = run({{0, order.size()}});
        EXPECT_EQ(torn, tornWhole);
        EXPECT_FALSE(torn.empty());
        for (std::size_t i = 0; i < whole.size(); ++i)
            ASSERT_NEAR(velocity[i], whole[i], 1e-5 * (1 + std::abs(whole[i]))) << i;
        EXPECT_NEAR(x, wholeX, 0.1);
        EXPECT_NEAR(y, wholeY, 0.1);
    }
}

TEST(SoftKernels, BodiesAlikeGetTheSameBitsFromEveryInstructionSet)
{
    if (!hasAvx2()) GTEST_SKIP() << "this processor has one instruction set only";
    Random number;
    const SoftBodyDef def = test::defaultBall({3, -7}, 30);
    const auto rows = static_cast<std::uint32_t>(def.particles.size());
    std::vector<std::uint32_t> all(8 * rows), nodeAt(8 * rows);
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i % rows, nodeAt[i] = i / 8 + i % 8 * rows;
    const Particles start = shaken(def, all, number);
    std::vector<soft::Run> runs;
    for (const SpringDef& spring : def.springs) runs.push_back({8 * spring.a, 8 * spring.b});
    const auto rest = numbers(runs.size() * kLanes, 0, 20, number), kinds = numbers(16, 0, 20, number);
    const std::vector<std::uint32_t> kind(runs.size(), 0);
    std::array<Frame, 8> frames;
    std::array<VelocityStep, 8> steps;
    for (Frame& frame : frames) frame = {number(-9, 9), number(-9, 9), number(-9, 9), number(-9, 9)};
    for (VelocityStep& step : steps) step = {1.0 / 480, number(-9, 9), number(-9, 9), 0.999};
    const auto run = [&](const Kernels& kernels, bool pushed) {
        Particles now = start;
        std::vector<double> force(now.position.size(), 0.25), left(16);
        Room room(nodeAt.size());
        const Planes planes = room.view();
        kernels.relateAlike(now.position.data(), now.velocity.data(), nodeAt.data(), rows, frames.data(), planes);
        kernels.pull({runs.data(), runs.size(), nullptr, 0, rest.data(), kind.data(), kinds.data()}, planes);
        kernels.sumAlike(planes, rows, left.data());
        kernels.accelerateAlike(now.velocity.data(), pushed ? force.data() : nullptr, now.inverse.data(), nodeAt.data(),
                                rows, 7, steps.data(), planes);
        return std::tuple(now.velocity, room.planes, left, force);
    };
    for (const bool pushed : {false, true}) EXPECT_EQ(run(kernelsSse2(), pushed), run(kernelsAvx2(), pushed));
    EXPECT_NE(std::get<0>(run(kernelsSse2(), false)), start.velocity);
    // The lane that is not counted stays as it was.
    const std::vector<double> after = std::get<0>(run(kernelsSse2(), false));
    EXPECT_TRUE(std::equal(after.begin() + 14 * rows, after.end(), start.velocity.begin() + 14 * rows));
}

}  // namespace jet::physics::soft
