// Drawn outlines as convex parts: the parts together are the region, whatever was drawn.
#include "scenes.hpp"

#include "rigid/decompose.hpp"

#include <gtest/gtest.h>

#include <random>

namespace jet::physics::test {

namespace {

struct Moments {
    double area = 0, second = 0;  // the latter about the origin
    Vec2 first{0, 0};
};

void addRing(Moments& m, const std::vector<Vec2>& ring)
{
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        const double twice = cross(a, b);
        m.area += 0.5 * twice;
        m.first += twice / 6 * (a + b);
        m.second += twice / 12 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
    }
}

std::vector<Vec2> ringOf(const Pieces& pieces, const Piece& piece)
{
    std::vector<Vec2> ring;
    for (const std::uint32_t corner : piece.corners) ring.push_back(pieces.points[corner]);
    return ring;
}

Moments momentsOf(const Pieces& pieces)
{
    Moments m;
    for (const Piece& piece : pieces.pieces) addRing(m, ringOf(pieces, piece));
    return m;
}

void expectConvex(const Pieces& pieces)
{
    for (const Piece& piece : pieces.pieces) {
        const std::vector<Vec2> ring = ringOf(pieces, piece);
        ASSERT_GE(ring.size(), 3u);
        ASSERT_LE(ring.size(), 8u);
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 in = ring[(i + 1) % ring.size()] - ring[i],
                       out = ring[(i + 2) % ring.size()] - ring[(i + 1) % ring.size()];
            EXPECT_GE(cross(in, out), -1e-8 * in.norm() * out.norm());
        }
    }
}

/// Length of the sides that are marked as outside.
double outerLength(const Pieces& pieces)
{
    double length = 0;
    for (const Piece& piece : pieces.pieces) {
        const std::vector<Vec2> ring = ringOf(pieces, piece);
        for (std::size_t i = 0; i < ring.size(); ++i)
            if ((piece.inner >> i & 1) == 0) length += (ring[(i + 1) % ring.size()] - ring[i]).norm();
    }
    return length;
}

double lengthOf(const std::vector<Vec2>& ring)
{
    double length = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) length += (ring[(i + 1) % ring.size()] - ring[i]).norm();
    return length;
}

/// Around a centre, at random distances: concave, not crossing itself.
std::vector<Vec2> star(std::mt19937& random, const Vec2& centre, double least, double most, int corners)
{
    std::uniform_real_distribution<double> distance(least, most);
    std::vector<Vec2> ring = circleRing({0, 0}, 1, corners);
    for (Vec2& at : ring) at = centre + distance(random) * at;
    return ring;
}

TEST(Decompose, RandomConcaveOutlinesKeepAreaMomentAndBorder)
{
    std::mt19937 random(7);
    for (int trial = 0; trial < 300; ++trial) {
        const int corners = 3 + trial % 97;
        std::vector<Vec2> ring = star(random, {40, -30}, 20, 60, corners);
        if (trial % 2 == 1) std::reverse(ring.begin(), ring.end());
        const Pieces pieces = decompose({ring});
        Moments wanted;
        addRing(wanted, ring);
        if (wanted.area < 0) wanted.area = -wanted.area, wanted.second = -wanted.second, wanted.first = -wanted.first;
        const Moments got = momentsOf(pieces);
        EXPECT_NEAR(got.area, wanted.area, 1e-9 * wanted.area) << trial;
        EXPECT_NEAR(got.second, wanted.second, 1e-9 * wanted.second) << trial;
        EXPECT_NEAR((got.first - wanted.first).norm(), 0, 1e-9 * wanted.first.norm()) << trial;
        EXPECT_NEAR(outerLength(pieces), lengthOf(ring), 1e-9 * lengthOf(ring)) << trial;
        EXPECT_LE(pieces.pieces.size(), ring.size() - 2);
        expectConvex(pieces);
    }
}

TEST(Decompose, HolesAndIslandsInHolesAreCutOut)
{
    std::mt19937 random(11);
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<std::vector<Vec2>> rings{star(random, {0, 0}, 80, 120, 40)};
        for (int i = 0; i < 1 + trial % 4; ++i)
            rings.push_back(star(random, {-40.0 + 80 * (i % 2), -40.0 + 80 * (i / 2)}, 8, 20, 5 + trial % 20));
        rings.push_back(circleRing({40.0 * (trial % 2) - 20, 0.5}, 3, 12));
        if (trial % 4 == 0) rings.push_back(star(random, {-40, -40}, 2, 5, 9));  // in the first hole
        double area = 0;
        double border = 0;
        for (std::size_t i = 0; i < rings.size(); ++i) {
            Moments m;
            addRing(m, rings[i]);
            area += std::abs(m.area) * (i == 0 || (trial % 4 == 0 && i + 1 == rings.size()) ? 1 : -1);
            border += lengthOf(rings[i]);
        }
        const Pieces pieces = decompose(rings);
        EXPECT_NEAR(momentsOf(pieces).area, area, 1e-9 * area) << trial;
        EXPECT_NEAR(outerLength(pieces), border, 1e-9 * border) << trial;
        expectConvex(pieces);
    }
}

TEST(Decompose, WhatCrossesItselfIsInsideWhereAnOddNumberOfRingsSaysSo)
{
    // A bow tie: two triangles. A five-pointed star: five tips, no core. Two squares: both without what they share.
    EXPECT_NEAR(momentsOf(decompose({{{0, 0}, {20, 20}, {20, 0}, {0, 20}}})).area, 200, 1e-6);
    const std::vector<Vec2> five = circleRing({0, 0}, 10, 5);
    const double pentagram = momentsOf(decompose({{five[0], five[2], five[4], five[1], five[3]}})).area;
    const double inner = 10 * 0.38196601125;  // 1 / phi²
    const double all = 5 * 10 * inner * std::sin(3.14159265358979 / 5),
                 core = 2.5 * inner * inner * std::sin(2 * 3.14159265358979 / 5);
    EXPECT_NEAR(pentagram, all - core, 1e-6);
    EXPECT_NEAR(momentsOf(decompose({boxRing({0, 0}, 10, 10), boxRing({5, 5}, 10, 10)})).area, 200 - 2 * 25, 1e-6);
    EXPECT_TRUE(decompose({boxRing({0, 0}, 10, 10), boxRing({0, 0}, 10, 10)}).pieces.empty());
    EXPECT_NEAR(momentsOf(decompose({{{0, 0}, {20, 0}, {20, 20}, {10, 0}, {0, 20}}})).area, 200, 1e-6)
        << "touches itself";
}

TEST(Decompose, RandomScribblesNeitherFailNorLoseArea)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-50, 50);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Vec2> ring;
        for (int i = 0; i < 4 + trial % 17; ++i) ring.push_back({place(random), place(random)});
        if (trial % 5 == 0) ring.push_back(ring[1]);
        const Pieces pieces = decompose({ring});
        expectConvex(pieces);
        // Counted on a grid of points.
        const auto inside = [&](const Vec2& at, const std::vector<Vec2>& loop) {
            bool odd = false;
            for (std::size_t i = 0, k = loop.size() - 1; i < loop.size(); k = i++)
                if ((loop[i].y() > at.y()) != (loop[k].y() > at.y()) &&
                    at.x() < (loop[k].x() - loop[i].x()) * (at.y() - loop[i].y()) / (loop[k].y() - loop[i].y()) +
                                 loop[i].x())
                    odd = !odd;
            return odd;
        };
        int wrong = 0;
        for (double x = -49.3; x < 50; x += 2.7) {
            for (double y = -49.1; y < 50; y += 2.7) {
                int holders = 0;
                for (const Piece& piece : pieces.pieces) holders += inside({x, y}, ringOf(pieces, piece));
                wrong += holders != static_cast<int>(inside({x, y}, ring));
            }
        }
        EXPECT_EQ(wrong, 0) << trial;
    }
}

/// A spike of 1.7e8 units makes the grain 0.17: lines cross nearer to a level than it can tell, and lie on it the other
/// way round.
TEST(Decompose, LinesThatCrossNearerToALevelThanGrainsCanTellAreCut)
{
    const Pieces pieces = decompose({{{18.036195901108865, -36.636536791843234},
                                      {17.157046173063424, -33.930792147125679},
                                      {14.855402303840235, -32.258549991812224},
                                      {12.010414021484737, -32.258549991812224},
                                      {9.7087701522615468, -33.930792147125679},
                                      {8.829620424216106, -36.636536791843234},
                                      {167384868.93805033, -39.342281436560789},
                                      {12.010414021484735, -41.014523591874244},
                                      {14.855402303840235, -41.014523591874244},
                                      {17.157046173063424, -39.342281436560789}},
                                     {{16.494847297532445, -36.636536791843234},
                                      {14.76483680313912, -32.537281942356081},
                                      {9.8106795580412616, -34.004833664428396},
                                      {9.110943288670061, -39.776628077344057},
                                      {14.84760888422681, -40.990537912631709}}});
    EXPECT_GT(momentsOf(pieces).area, 0);
    for (const Piece& piece : pieces.pieces)
        for (const std::uint32_t corner : piece.corners) EXPECT_LT(corner, pieces.points.size());
}

TEST(Decompose, ARoundOutlineNeedsFewParts)
{
    EXPECT_LE(decompose({circleRing({0, 0}, 10, 64)}).pieces.size(), 20u);
    EXPECT_EQ(decompose({boxRing({0, 0}, 10, 4)}).pieces.size(), 1u);
    // An L of two boxes.
    EXPECT_EQ(decompose({{{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 30}, {0, 30}}}).pieces.size(), 2u);
}

TEST(Decompose, CornersAreOpenOnlyToTheOutside)
{
    // The hollow corner of an L is open to nothing; the others to a quarter turn, in every part that has them.
    const Pieces pieces = decompose({{{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 30}, {0, 30}}});
    for (const Piece& piece : pieces.pieces) {
        for (std::size_t i = 0; i < piece.corners.size(); ++i) {
            const Vec2 at = pieces.points[piece.corners[i]];
            if (at == Vec2(10, 10)) {
                EXPECT_EQ(piece.before[i], Vec2(0, 0));
                EXPECT_EQ(piece.after[i], Vec2(0, 0));
            } else {
                EXPECT_NEAR(cross(piece.before[i], piece.after[i]), 1, 1e-12) << at.x() << ", " << at.y();
            }
        }
    }
}

TEST(Decompose, ThousandsOfCornersKeepTheirArea)
{
    std::mt19937 random(5);
    const std::vector<Vec2> ring = star(random, {0, 0}, 900, 1000, 3000);
    const Pieces pieces = decompose({ring});
    Moments wanted;
    addRing(wanted, ring);
    EXPECT_NEAR(momentsOf(pieces).area, wanted.area, 1e-8 * wanted.area);
}

}  // namespace

}  // namespace jet::physics::test
