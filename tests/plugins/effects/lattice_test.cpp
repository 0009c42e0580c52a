#include "lattice.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <numbers>
#include <random>
#include <set>

namespace {

using jet::Box;
using jet::Path;
using jet::Vec2;
using jet::lattice::build;
using jet::lattice::Lattice;
using jet::lattice::Options;
using jet::lattice::Region;
using jet::lattice::Ring;
using jet::lattice::SpringKind;

constexpr auto kInfinity = std::numeric_limits<double>::infinity();

std::size_t count(const Lattice& lattice, SpringKind kind)
{
    std::size_t n = 0;
    for (const auto& s : lattice.springs) n += s.kind == kind;
    return n;
}

double length(const Lattice& lattice, const jet::lattice::Spring& s)
{
    return (lattice.particles[s.a] - lattice.particles[s.b]).norm();
}

Region regionOf(const Lattice& lattice)
{
    std::vector<Ring> rings;
    for (const auto& indices : lattice.rings) {
        Ring ring;
        for (const auto i : indices) ring.push_back(lattice.particles[i]);
        rings.push_back(ring);
    }
    return Region(rings);
}

bool areNeighbours(const Lattice& lattice, std::uint32_t a, std::uint32_t b)
{
    for (const auto& ring : lattice.rings)
        for (std::size_t i = 0; i < ring.size(); ++i)
            if (std::minmax(ring[i], ring[(i + 1) % ring.size()]) == std::minmax(a, b)) return true;
    return false;
}

/// What lattice.hpp promises of every lattice. Springs are tested at many points, by means other than Region::holds().
void expectSound(const Lattice& lattice)
{
    const Region region = regionOf(lattice);
    const double nothing = 1e-6 * region.bounds().size().maxCoeff();
    const auto isOutside = [&](const Vec2& p) {
        return !region.contains(p) && !region.hasWallWithin(p, Vec2::Constant(nothing));
    };
    for (std::size_t i = lattice.borderCount; i < lattice.particles.size(); ++i)
        EXPECT_TRUE(region.contains(lattice.particles[i])) << "inside particle " << i;

    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    for (const auto& s : lattice.springs) {
        ASSERT_LT(std::max(s.a, s.b), lattice.particles.size());
        EXPECT_NE(s.a, s.b);
        EXPECT_GT(length(lattice, s), 0);
        EXPECT_TRUE(seen.insert(std::minmax(s.a, s.b)).second) << s.a << '-' << s.b << " twice";
        EXPECT_EQ(s.kind == SpringKind::Inside, s.a >= lattice.borderCount && s.b >= lattice.borderCount);
        EXPECT_EQ(s.kind == SpringKind::Border, s.a < lattice.borderCount && s.b < lattice.borderCount);
        if (s.kind == SpringKind::Border && areNeighbours(lattice, s.a, s.b)) continue;
        for (int k = 1; k < 64; ++k) {
            const Vec2 p = lattice.particles[s.a] + (lattice.particles[s.b] - lattice.particles[s.a]) * (k / 64.0);
            ASSERT_FALSE(isOutside(p)) << "spring " << s.a << '-' << s.b << " leaves the shape at " << p.transpose();
        }
    }
    for (const auto& ring : lattice.rings) EXPECT_GE(ring.size(), 3u);
}

Path rectangle(double width, double height, int intermediate = 0)
{
    Path path = Path::rectangle(Box({0, 0}, {width, height}));
    path.setIntermediate(intermediate);
    return path;
}

Path circle(double radius, int intermediate)
{
    Path path = Path::ellipse(Box({-radius, -radius}, {radius, radius}));
    path.setIntermediate(intermediate);
    return path;
}

Path star(int tips, double outer, double inner)
{
    std::vector<Vec2> points;
    for (int i = 0; i < 2 * tips; ++i) {
        const double angle = std::numbers::pi * i / tips, radius = i % 2 == 0 ? outer : inner;
        points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return Path::polygon(points);
}

/// The thesis's §4.2 ground: an ellipse pulled into a croissant.
Path croissant()
{
    return Path::parse("M 0 0 C 40 80 160 80 200 0 C 190 30 130 40 100 40 C 70 40 10 30 0 0 Z n 8 4 4").orThrow();
}

// --- Border ---

TEST(Lattice, BorderParticlesLieOnSegmentsAndIntermediatePoints)
{
    const Lattice lattice = build(circle(50, 4), {});
    ASSERT_EQ(lattice.rings.size(), 1u);
    EXPECT_EQ(lattice.borderCount, 4u * (1 + 4));
    for (std::size_t i = 0; i < lattice.borderCount; ++i) EXPECT_NEAR(lattice.particles[i].norm(), 50, 50 * 3e-4);
}

TEST(Lattice, ABorderCountSpreadsParticlesEvenlyAlongTheOutline)
{
    Options options;
    options.borderOnSegments = false;
    options.borderCount = 12;
    const Lattice lattice = build(rectangle(100, 20), options);  // 240 around: one every 20
    ASSERT_EQ(lattice.borderCount, 12u);
    const Vec2 expected[] = {{0, 0},    {20, 0},  {40, 0},  {60, 0},  {80, 0},  {100, 0},
                             {100, 20}, {80, 20}, {60, 20}, {40, 20}, {20, 20}, {0, 20}};
    for (int i = 0; i < 12; ++i) EXPECT_LT((lattice.particles[i] - expected[i]).norm(), 1e-9) << i;
}

TEST(Lattice, ABorderCountOnACircleGivesARegularPolygon)
{
    Options options;
    options.borderOnSegments = false;
    options.borderCount = 10;  // not a multiple of the four segments
    const Lattice lattice = build(circle(50, 0), options);
    ASSERT_EQ(lattice.borderCount, 10u);
    const double side = 2 * 50 * std::sin(std::numbers::pi / 10);
    for (int i = 0; i < 10; ++i)
        EXPECT_NEAR((lattice.particles[(i + 1) % 10] - lattice.particles[i]).norm(), side, 0.02) << i;
}

TEST(Lattice, RangesOfBorderSpringsCountFromTheNextParticle)
{
    // On a convex ring of n, each distance gives n springs; the distance n/2 gives n/2.
    const Path ring = circle(50, 4);  // n = 20
    const auto springs = [&](int from, int to) {
        Options options;
        options.border = {from, to};
        return count(build(ring, options), SpringKind::Border);
    };
    EXPECT_EQ(springs(1, 1), 20u);
    EXPECT_EQ(springs(1, 2), 40u);
    EXPECT_EQ(springs(2, 2), 20u);
    EXPECT_EQ(springs(3, 2), 0u);
    EXPECT_EQ(springs(10, 10), 10u);
    EXPECT_EQ(springs(1, 10), 190u) << "all pairs";
    EXPECT_EQ(springs(1, 1000), 190u) << "further round the ring are the same pairs";
    EXPECT_EQ(springs(19, 19), 20u) << "19 one way is 1 the other way";
}

TEST(Lattice, WithoutAnySpringsOnlyTheBorderIsLeft)  // the thesis's static ground (§4.2)
{
    Options options;
    options.borderSprings = options.axisAligned = options.cross = false;
    const Lattice lattice = build(croissant(), options);
    EXPECT_EQ(lattice.borderCount, 3u + 8 + 4 + 4);
    EXPECT_EQ(lattice.insideCount(), 0u);
    EXPECT_TRUE(lattice.springs.empty());
}

// --- Inside ---

TEST(Lattice, TheGridOfARectangleFollowsFormulas)
{
    Options options;
    options.cell = {10, 20};
    for (const auto& [from, to] : {std::pair(1, 1), std::pair(1, 2), std::pair(2, 3)}) {
        options.inside = {from, to};
        const Lattice lattice = build(rectangle(100, 120), options);
        const int columns = 100 / 10 - 1, rows = 120 / 20 - 1;  // a cell from every side
        ASSERT_EQ(lattice.insideCount(), static_cast<std::size_t>(columns * rows));
        int expected = 0;
        for (int k = from; k <= to; ++k)
            expected += (columns - k) * rows + columns * (rows - k) + 2 * (columns - k) * (rows - k);
        EXPECT_EQ(count(lattice, SpringKind::Inside), static_cast<std::size_t>(expected)) << from << ".." << to;
        EXPECT_EQ(lattice.particles[lattice.borderCount], Vec2(10, 20));
        expectSound(lattice);
    }
}

TEST(Lattice, FlagsChooseTheDirectionsOfInsideSprings)
{
    Options options;
    options.cell = {10, 10};
    options.inside = {1, 1};
    options.cross = false;
    const Lattice straight = build(rectangle(50, 50), options);  // 4 x 4
    EXPECT_EQ(count(straight, SpringKind::Inside), 2u * 3 * 4);
    for (const auto& s : straight.springs) {
        if (s.kind == SpringKind::Inside) {
            EXPECT_DOUBLE_EQ(length(straight, s), 10);
        }
    }

    options.cross = true, options.axisAligned = false;
    const Lattice diagonal = build(rectangle(50, 50), options);
    EXPECT_EQ(count(diagonal, SpringKind::Inside), 2u * 3 * 3);
    for (const auto& s : diagonal.springs) {
        if (s.kind == SpringKind::Inside) {
            EXPECT_DOUBLE_EQ(length(diagonal, s), std::hypot(10, 10));
        }
    }
}

TEST(Lattice, BorderParticlesHoldOnToTheNearestInsideParticles)
{
    Options options;
    options.cell = {10, 10};
    for (const int n : {0, 1, 3, 7}) {
        options.borderToInside = n;
        const Lattice lattice = build(circle(50, 4), options);
        if (n == 0) {
            EXPECT_EQ(lattice.insideCount(), 0u) << "loose particles would fall out of the body";
            continue;
        }
        EXPECT_EQ(count(lattice, SpringKind::BorderToInside), 20u * n);
        for (std::uint32_t border = 0; border < lattice.borderCount; ++border) {
            double farthestJoined = 0, nearestOther = kInfinity;
            std::set<std::uint32_t> joined;
            for (const auto& s : lattice.springs)
                if (s.kind == SpringKind::BorderToInside && s.a == border) {
                    joined.insert(s.b);
                    farthestJoined = std::max(farthestJoined, length(lattice, s));
                }
            for (std::uint32_t i = lattice.borderCount; i < lattice.particles.size(); ++i)
                if (!joined.contains(i))
                    nearestOther = std::min(nearestOther, (lattice.particles[i] - lattice.particles[border]).norm());
            EXPECT_LE(farthestJoined, nearestOther + 1e-9) << "in a convex shape all are seen";
        }
    }
}

TEST(Lattice, InsideParticlesFillACircleAndKeepClearOfItsBorder)
{
    Options options;
    options.cell = {5, 5};
    const Lattice lattice = build(circle(50, 9), options);
    const double area = std::numbers::pi * 50 * 50;
    EXPECT_NEAR(static_cast<double>(lattice.insideCount()), area / 25, 0.15 * area / 25);
    for (std::size_t i = lattice.borderCount; i < lattice.particles.size(); ++i)
        EXPECT_LT(lattice.particles[i].norm(), 50 - 0.4 * 5 + 0.2);
}

TEST(Lattice, ASymmetricShapeGetsASymmetricLattice)
{
    const Lattice lattice = build(circle(50, 4), {});
    for (std::size_t i = lattice.borderCount; i < lattice.particles.size(); ++i) {
        const Vec2 mirrored(-lattice.particles[i].x(), lattice.particles[i].y());
        double nearest = kInfinity;
        for (std::size_t j = lattice.borderCount; j < lattice.particles.size(); ++j)
            nearest = std::min(nearest, (lattice.particles[j] - mirrored).norm());
        EXPECT_LT(nearest, 1e-9);
    }
}

TEST(Lattice, AChosenCellGivesEvenThinShapesAnInside)
{
    for (const Path& path : {rectangle(100, 60), rectangle(200, 10), rectangle(10, 300), circle(1e-3, 4),
                             circle(1e6, 4), star(5, 50, 20)}) {
        const Lattice lattice = build(path, {});
        EXPECT_GE(lattice.insideCount(), 1u);
        EXPECT_LE(lattice.insideCount(), 400u);
        expectSound(lattice);
    }
}

TEST(Lattice, ACellSizeOfOneComponentIsSquare)
{
    Options options;
    options.cell = {0, 12};
    EXPECT_EQ(build(rectangle(100, 60), options).cell, Vec2(12, 12));
}

TEST(Lattice, ACellLargerThanTheShapeLeavesItsInsideEmpty)
{
    Options options;
    options.cell = {500, 500};
    const Lattice lattice = build(circle(50, 4), options);
    EXPECT_EQ(lattice.insideCount(), 0u);
    EXPECT_EQ(count(lattice, SpringKind::Border), 40u);
    expectSound(lattice);
}

// --- Any shape ---

TEST(Lattice, NoSpringLeavesAConcaveShape)
{
    Options options;
    for (const Path& path : {croissant(), star(5, 50, 15), star(12, 50, 40),
                             Path::parse("M 0 0 H 30 V 80 H 70 V 0 H 100 V 100 H 0 Z n 2 6 2 6 2 8 8 8").orThrow()}) {
        for (const double cell : {0.0, 4.0, 9.0}) {
            options.cell = {cell, cell};
            options.border = {1, 4};
            options.inside = {1, 3};
            options.borderToInside = 6;
            expectSound(build(path, options));
        }
    }
}

TEST(Lattice, AHoleGetsABorderOfItsOwnAndNoSpringAcross)
{
    Path path = circle(50, 9);
    Path hole = circle(20, 4);
    path.contours().push_back(hole.contours().front());
    Options options;
    options.cell = {6, 6};
    const Lattice lattice = build(path, options);
    ASSERT_EQ(lattice.rings.size(), 2u);
    EXPECT_EQ(lattice.rings[0].size(), 40u);
    EXPECT_EQ(lattice.rings[1].size(), 20u);
    for (std::size_t i = lattice.borderCount; i < lattice.particles.size(); ++i)
        EXPECT_GT(lattice.particles[i].norm(), 20);
    expectSound(lattice);
}

TEST(Lattice, SeveralPiecesShareABorderCountByTheirLengths)
{
    Path path = rectangle(100, 100);
    Path small = Path::rectangle(Box({200, 0}, {250, 50}));
    path.contours().push_back(small.contours().front());
    Options options;
    options.borderOnSegments = false;
    options.borderCount = 30;
    const Lattice lattice = build(path, options);
    ASSERT_EQ(lattice.rings.size(), 2u);
    EXPECT_EQ(lattice.rings[0].size(), 20u);
    EXPECT_EQ(lattice.rings[1].size(), 10u);
    expectSound(lattice);
}

TEST(Lattice, RandomShapesGiveSoundLattices)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(20, 80), share(0, 1);
    for (int round = 0; round < 40; ++round) {
        std::vector<Vec2> points;
        const int n = 5 + round % 9;
        for (int i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * (i + 0.6 * share(random)) / n, r = radius(random);
            points.push_back({r * std::cos(angle), r * std::sin(angle)});
        }
        Path path = Path::polygon(points);
        if (round % 3 == 0)
            for (auto& s : path.contours()[0].segments) s.out += Vec2(20 * share(random), 20 * share(random));
        path.setIntermediate(round % 4);
        Options options;
        options.cell = Vec2(3 + 10 * share(random), 3 + 10 * share(random));
        options.border = {1 + round % 2, 1 + round % 5};
        options.inside = {1, 1 + round % 3};
        SCOPED_TRACE(round);
        expectSound(build(path, options));
    }
}

TEST(Lattice, AShapeThatCrossesItselfIsInsideWhereItsRingsSaySo)
{
    const Vec2 eight[] = {{0, 0}, {100, 60}, {100, 0}, {0, 60}};
    Options options;
    options.cell = {5, 5};
    expectSound(build(Path::polygon(eight), options));
}

TEST(Lattice, EqualInputsGiveEqualLattices)
{
    const Lattice a = build(croissant(), {}), b = build(croissant(), {});
    ASSERT_EQ(a.particles.size(), b.particles.size());
    EXPECT_TRUE(std::equal(a.particles.begin(), a.particles.end(), b.particles.begin()));
    ASSERT_EQ(a.springs.size(), b.springs.size());
    for (std::size_t i = 0; i < a.springs.size(); ++i)
        EXPECT_TRUE(a.springs[i].a == b.springs[i].a && a.springs[i].b == b.springs[i].b);
}

TEST(Lattice, RepeatedPointsBecomeOneParticle)
{
    const Vec2 points[] = {{0, 0}, {0, 0}, {50, 0}, {50, 50}, {50, 50}, {0, 50}, {0, 0}};
    const Lattice lattice = build(Path::polygon(points), {});
    EXPECT_EQ(lattice.borderCount, 4u);
    expectSound(lattice);
}

// --- Limits ---

std::string failureOf(const Path& path, const Options& options)
{
    try {
        (void)build(path, options);
    } catch (const jet::Failure& failure) {
        return failure.error().message;
    }
    return {};
}

TEST(Lattice, TooFineACellIsRefusedAtOnceAndNamed)
{
    Options options;
    for (const double cell : {0.1, 1e-3, 1e-9, 1e-300}) {
        options.cell = {cell, cell};
        const auto begin = std::chrono::steady_clock::now();
        EXPECT_NE(failureOf(rectangle(1000, 1000), options).find("cell-size"), std::string::npos) << cell;
        EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
    }
    options.cell = {1e-300, 100};
    EXPECT_NE(failureOf(rectangle(1000, 1000), options).find("cell-size"), std::string::npos);
}

TEST(Lattice, TooManyIntermediatePointsAreRefusedAndNamed)
{
    Path path = star(50, 100, 50);
    path.setIntermediate(1000);
    EXPECT_NE(failureOf(path, {}).find("intermediate"), std::string::npos);
}

TEST(Lattice, TooManySpringsAreRefused)
{
    Options options;
    options.cell = {1, 1};
    options.inside = {1, 100};
    EXPECT_NE(failureOf(rectangle(130, 130), options).find("springs"), std::string::npos);
}

// A comb: springs between its teeth would leave it, so it is not their number that stops the search for them.
TEST(Lattice, SpringsThatTakeTooLongToFindAreRefused)
{
    std::vector<Vec2> comb{{4000, 0}, {0, 0}};
    for (int i = 0; i < 4000; ++i) comb.insert(comb.end(), {Vec2(i, 100), Vec2(i + 0.5, 1 + i % 50)});
    Options options;
    options.border = {1, 1000};
    EXPECT_NE(failureOf(Path::polygon(comb), options).find("too long"), std::string::npos);
}

TEST(Lattice, AnOutlineWithoutAreaIsRefusedInWords)
{
    const Vec2 flat[] = {{0, 0}, {50, 0}, {100, 0}};
    EXPECT_NE(failureOf(Path::polygon(flat), {}).find("area"), std::string::npos);
    EXPECT_NE(failureOf(Path::line({0, 0}, {10, 10}), {}).find("area"), std::string::npos);
    EXPECT_NE(failureOf(Path(), {}).find("area"), std::string::npos);
    EXPECT_EQ(failureOf(circle(50, 0), {}), "") << "a square in a circle has area";
}

TEST(Lattice, OutlinesOfNoSizeAndOfAnySizeAreAnswered)
{
    for (const bool onSegments : {true, false}) {
        Options options;
        options.borderOnSegments = onSegments;
        EXPECT_NE(failureOf(Path::rectangle(Box({5, 5}, {5, 5})), options).find("area"), std::string::npos);
        EXPECT_NE(failureOf(circle(1e-200, 4), options).find("area"), std::string::npos);
        EXPECT_NE(failureOf(circle(1e200, 4), options).find("too large"), std::string::npos);
        for (const double radius : {1e-90, 1e-9, 1e9, 1e90})
            EXPECT_EQ(failureOf(circle(radius, 4), options), "") << radius;
    }
}

TEST(Lattice, ALatticeNearTheLimitIsBuiltInMoments)
{
    Options options;
    options.cell = {1, 1};
    Path path = circle(70, 200);
    const auto begin = std::chrono::steady_clock::now();
    const Lattice lattice = build(path, options);
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
    EXPECT_GT(lattice.insideCount(), 14'000u);
    EXPECT_LT(spent.count(), 5000);
    RecordProperty("milliseconds", static_cast<int>(spent.count()));
    std::cout << lattice.particles.size() << " particles, " << lattice.springs.size() << " springs, " << spent.count()
              << " ms\n";
}

}  // namespace
