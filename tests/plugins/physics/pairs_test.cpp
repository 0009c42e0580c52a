// The broad phase finds each pair of boxes that comes to meet, whatever their sizes and wherever they are.
#include "rigid/pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace jet::physics::test {

namespace {

using Pairs = std::set<std::pair<Index, Index>>;

FatBox around(double x, double y, double width, double height)
{
    return {static_cast<float>(x - width / 2), static_cast<float>(y - height / 2), static_cast<float>(x + width / 2),
            static_cast<float>(y + height / 2)};
}

Pairs meeting(const std::vector<FatBox>& boxes)
{
    Pairs pairs;
    for (Index a = 0; a < boxes.size(); ++a)
        for (Index b = a + 1; b < boxes.size(); ++b)
            if (boxes[a].meets(boxes[b])) pairs.insert({a, b});
    return pairs;
}

void begin(PairSweep& pairs, Arena& arena)
{
    arena.reset();
    pairs.open(arena);
}

/// What is found, and ready for more moves.
Pairs sweep(PairSweep& pairs, Arena& arena)
{
    Pairs found;
    pairs.sweep(arena, [&](Index a, Index b) { EXPECT_TRUE(found.insert({a, b}).second); });
    begin(pairs, arena);
    return found;
}

/// Sizes over five decades, some far out, many moved, many not.
TEST(Pairs, WhatComesToMeetIsFoundOnceAndNothingElse)
{
    std::mt19937 random(7);
    const auto in = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
    const auto anyBox = [&] {
        const double size = std::pow(10, in(-2, 3)), far = in(0, 1) < 0.05 ? 1e7 : 300;
        return around(in(-far, far), in(-far, far), size * in(0.2, 1), size * in(0.2, 1));
    };
    PairSweep pairs;
    Arena arena;
    std::vector<FatBox> boxes(500);
    pairs.resize(boxes.size(), 1);
    begin(pairs, arena);
    for (Index i = 0; i < boxes.size(); ++i) pairs.move(i, boxes[i] = anyBox());
    EXPECT_EQ(sweep(pairs, arena), meeting(boxes));
    for (int round = 0; round < 60; ++round) {
        const Pairs before = meeting(boxes);
        // Where few are moved the cells are not filled again; in turns with many.
        const double still = round % 4 < 2 ? 0.7 : 0.99;
        for (Index i = 0; i < boxes.size(); ++i) {
            if (in(0, 1) < still) continue;
            if (in(0, 1) < 0.1) {
                boxes[i] = anyBox();
            } else {
                const float x = static_cast<float>(in(-5, 5)), y = static_cast<float>(in(-5, 5));
                boxes[i].minX += x, boxes[i].maxX += x, boxes[i].minY += y, boxes[i].maxY += y;
            }
            pairs.move(i, boxes[i]);
        }
        pairs.noteMoves();
        Pairs fresh;
        const Pairs now = meeting(boxes);
        std::set_difference(now.begin(), now.end(), before.begin(), before.end(), std::inserter(fresh, fresh.end()));
        EXPECT_EQ(sweep(pairs, arena), fresh) << round;
        EXPECT_FALSE(pairs.anyMoved());
    }
}

TEST(Pairs, WhatIsMuchLongerIsFoundEachTimeSinceItsBoxMeetsBeforeItDoes)
{
    PairSweep pairs;
    Arena arena;
    pairs.resize(3, 1);
    begin(pairs, arena);
    pairs.setReach(0, 10), pairs.setReach(1, 1), pairs.setReach(2, 4);
    pairs.move(0, around(0, 0, 14, 14));
    pairs.move(1, around(6, -6, 2, 2));
    pairs.move(2, around(-3, 3, 6, 6));
    EXPECT_EQ(sweep(pairs, arena), (Pairs{{0, 1}, {0, 2}}));
    for (const float x : {5.9F, 5.8F}) {
        pairs.move(1, around(x, -6, 2, 2)), pairs.move(2, around(-x / 2, 3, 6, 6));
        EXPECT_EQ(sweep(pairs, arena), (Pairs{{0, 1}})) << "but what is not, only when it comes";
    }
}

TEST(Pairs, AGridThatIsSpreadTooFarFindsTheSame)
{
    PairSweep pairs;
    Arena arena;
    std::vector<FatBox> boxes;
    for (int i = 0; i < 60; ++i) boxes.push_back(around(1e5 * (i / 3) + 0.4 * (i % 3), -1e5 * (i / 3), 1, 1));
    pairs.resize(boxes.size(), 1);
    begin(pairs, arena);
    for (Index i = 0; i < boxes.size(); ++i) pairs.move(i, boxes[i]);
    EXPECT_EQ(sweep(pairs, arena), meeting(boxes));
}

TEST(Pairs, AreFoundInTheSameOrderByAnyCountOfThreads)
{
    std::vector<std::pair<Index, Index>> alone;
    for (const int threads : {1, 2, 3}) {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> at(0, 40), size(0.2, 3);
        Pool pool;
        pool.setThreads(threads);
        PairSweep pairs;
        Arena arena;
        pairs.resize(1500, 1);
        std::vector<std::pair<Index, Index>> found;
        for (int round = 0; round < 3; ++round) {
            begin(pairs, arena);
            for (Index i = 0; i < pairs.parts(); ++i)
                pairs.move(i, around(at(random), at(random), size(random), size(random)));
            pairs.begin(arena, pool);
            pairs.seek(0, pairs.parts(), [&](Index a, Index b) { found.emplace_back(a, b); });
            pairs.finish(arena);
        }
        EXPECT_GT(found.size(), 10000U);
        if (threads == 1) alone = found;
        EXPECT_EQ(found, alone) << threads << " threads";
    }
}

TEST(Pairs, OnlyWhatMeetsAPieceOfALongPartMeetsIt)
{
    PairSweep pairs;
    Arena arena;
    pairs.resize(4, 1);
    begin(pairs, arena);
    pairs.setLong(0);
    pairs.move(0, {0, 0, 100, 100});  // a wall along the diagonal
    for (int i = 0; i < 50; ++i) pairs.piecesOf(0)->push_back(around(2 * i + 1, 2 * i + 1, 3, 3));
    pairs.move(1, around(30, 31, 1, 1));
    pairs.move(2, around(80, 20, 1, 1));
    pairs.move(3, around(52, 53, 2, 2));
    Pairs found;
    const auto note = [&](Index a, Index b) { found.insert({a, b}); };
    pairs.sweep(arena, note);
    EXPECT_EQ(found, (Pairs{{0, 1}, {0, 3}}));
    found.clear();
    begin(pairs, arena);
    pairs.move(2, around(80, 79, 1, 1));
    pairs.sweep(arena, note);
    EXPECT_EQ(found, (Pairs{{0, 2}})) << "from the other side, too";
    found.clear();
    begin(pairs, arena);
    pairs.forget(3), pairs.move(3, around(52, 53, 2, 2));
    pairs.sweep(arena, note);
    EXPECT_EQ(found, (Pairs{{0, 3}})) << "and again when it was forgotten";
}

}  // namespace

}  // namespace jet::physics::test
