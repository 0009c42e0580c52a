#include <jet/path_operations.hpp>

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace jet {
namespace {

const Path kCircle = Path::ellipse(Box({-10, -10}, {10, 10}));
const Cubic kArch{{Vec2(0, 0), Vec2(0, 30), Vec2(40, 30), Vec2(40, 0)}};

Cubic side(const Vec2& a, const Vec2& b) { return {{a, a, b, b}}; }

/// The largest distance of points of `a` from `b`.
double farthest(const Path& a, const Path& b)
{
    double most = 0;
    for (const Contour& contour : a.contours()) {
        for (std::size_t i = 0; i < contour.curveCount(); ++i) {
            for (int k = 0; k <= 50; ++k) most = std::max(most, b.nearest(contour.curve(i).at(k / 50.0)).distance);
        }
    }
    return most;
}

TEST(Crossings, OfALineAndAnArchAreBothOfThem)
{
    const auto found = crossings(kArch, side({-5, 10}, {45, 10}));
    ASSERT_EQ(found.size(), 2u);
    for (const Crossing& c : found) {
        EXPECT_NEAR(c.point.y(), 10, 1e-9);
        EXPECT_LT((kArch.at(c.s) - c.point).norm(), 1e-9);
    }
    EXPECT_LT(found[0].s, found[1].s);
    EXPECT_NEAR(found[0].point.x() + found[1].point.x(), 40, 1e-9);  // by symmetry
}

TEST(Crossings, OfTwoCubicsCanBeNine)
{
    const Cubic across{{Vec2(0, 0), Vec2(120, 70), Vec2(-20, 70), Vec2(100, 0)}};
    const Cubic upright{{Vec2(20, -20), Vec2(90, 100), Vec2(90, -60), Vec2(20, 60)}};
    for (const Crossing& c : crossings(across, upright)) EXPECT_LT((across.at(c.s) - upright.at(c.t)).norm(), 1e-7);
    EXPECT_GE(crossings(across, upright).size(), 2u);
}

TEST(Crossings, AreNoneWhereTheCurvesMissEachOther)
{
    EXPECT_TRUE(crossings(kArch, side({-5, 23}, {45, 23})).empty());  // the arch is 22.5 high
    EXPECT_TRUE(crossings(kArch, side({50, 0}, {60, 10})).empty());
}

TEST(Crossings, ATouchCountsOnce)
{
    const auto found = crossings(kArch, side({-5, 22.5}, {45, 22.5}), 1e-6);
    ASSERT_GE(found.size(), 1u);
    for (const Crossing& c : found) EXPECT_NEAR(c.point.x(), 20, 0.1);
}

TEST(Crossings, CurvesThatRunAlongEachOtherEndTheSearch)
{
    EXPECT_LE(crossings(kArch, kArch).size(), 64u);
    EXPECT_LE(crossings(side({0, 0}, {10, 0}), side({5, 0}, {15, 0})).size(), 64u);
}

TEST(CutPath, ACircleCutByALineGivesTwoArcsThatMakeItUp)
{
    const auto pieces = cutPath(kCircle, Path::line({-20, 3}, {20, 3}));
    ASSERT_EQ(pieces.size(), 2u);
    double length = 0;
    for (const Path& piece : pieces) {
        EXPECT_FALSE(piece.contours().front().closed);
        EXPECT_NEAR(piece.contours().front().segments.front().point.y(), 3, 1e-6);
        EXPECT_NEAR(piece.contours().front().segments.back().point.y(), 3, 1e-6);
        EXPECT_LT(farthest(piece, kCircle), 1e-6);
        length += piece.length();
    }
    EXPECT_NEAR(length, kCircle.length(), 1e-5);
}

TEST(CutPath, AnOpenPathIsCutAtEachCrossingAndKeepsItsCounts)
{
    Path zigzag = Path::polygon(std::array{Vec2(0, 0), Vec2(10, 10), Vec2(20, 0), Vec2(30, 10)}, false);
    zigzag.setIntermediate(4);
    const auto pieces = cutPath(zigzag, Path::line({-5, 5}, {40, 5}));
    ASSERT_EQ(pieces.size(), 4u);
    EXPECT_EQ(pieces[0].contours().front().segments.front().point, Vec2(0, 0));
    EXPECT_LT((pieces[0].contours().front().segments.back().point - Vec2(5, 5)).norm(), 1e-6);
    EXPECT_EQ(pieces[1].segmentCount(), 3u);
    EXPECT_EQ(pieces[1].segment(0).intermediate, 4);
}

TEST(CutPath, ThroughACornerCutsOnce)
{
    const Path square = Path::rectangle(Box({0, 0}, {10, 10}));
    EXPECT_EQ(cutPath(square, Path::line({-5, -5}, {15, 15})).size(), 2u);
}

TEST(CutPath, WithoutACrossingKeepsThePath)
{
    EXPECT_EQ(cutPath(kCircle, Path::line({-20, 30}, {20, 30})), std::vector<Path>{kCircle});
    EXPECT_EQ(cutPath(kCircle, Path()), std::vector<Path>{kCircle});
    EXPECT_TRUE(cutPath(Path(), kCircle).empty());
}

TEST(JoinPaths, PiecesOfACutCircleMakeACircleAgain)
{
    const auto pieces = cutPath(kCircle, Path::line({-20, 3}, {20, 3}));
    const Path joined = joinPaths(pieces, 1e-5);
    ASSERT_EQ(joined.contours().size(), 1u);
    EXPECT_TRUE(joined.contours().front().closed);
    EXPECT_NEAR(std::abs(joined.area()), std::abs(kCircle.area()), 1e-4);
    EXPECT_LT(farthest(joined, kCircle), 1e-5);
}

TEST(JoinPaths, NearestEndsAreConnectedWhateverTheDirections)
{
    const Path joined = joinPaths(std::array{Path::line({0, 0}, {10, 0}), Path::line({30, 0}, {12, 0})});
    ASSERT_EQ(joined.contours().size(), 1u);
    EXPECT_FALSE(joined.contours().front().closed);
    EXPECT_EQ(joined.segmentCount(), 4u);
    EXPECT_DOUBLE_EQ(joined.length(), 30);
}

TEST(JoinPaths, ASingleOpenPathIsClosedAndClosedOnesStay)
{
    const Path open = Path::polygon(std::array{Vec2(0, 0), Vec2(10, 0), Vec2(10, 10)}, false);
    const Path joined = joinPaths(std::array{open, kCircle});
    ASSERT_EQ(joined.contours().size(), 2u);
    for (const Contour& contour : joined.contours()) EXPECT_TRUE(contour.closed);
    EXPECT_EQ(joinPaths(std::array{kCircle}), kCircle);
    EXPECT_TRUE(joinPaths({}).isEmpty());
}

TEST(SimplifyPath, ACircleOfManySegmentsNeedsFewAndStaysWithinTheTolerance)
{
    Path circle = kCircle;
    for (int i = 0; i < 60; ++i) circle.split(0, static_cast<std::size_t>(i) % circle.segmentCount(), 0.37);
    ASSERT_EQ(circle.segmentCount(), 64u);
    const Path simple = simplifyPath(circle, 0.05);
    EXPECT_LE(simple.segmentCount(), 12u);
    EXPECT_TRUE(simple.contours().front().closed);
    EXPECT_LT(farthest(simple, circle), 0.06);
    EXPECT_LT(farthest(circle, simple), 0.06);
}

TEST(SimplifyPath, CornersAndStraightSidesStayExactly)
{
    Path square = Path::rectangle(Box({0, 0}, {10, 10}));
    for (std::size_t i = 0; i < 4; ++i) square.split(0, 2 * i, 0.3);
    square.setIntermediate(3);
    const Path simple = simplifyPath(square, 0.01);
    EXPECT_EQ(simple.segmentCount(), 4u);
    EXPECT_EQ(simple.bounds(), Box({0, 0}, {10, 10}));
    EXPECT_DOUBLE_EQ(std::abs(simple.area()), 100);
    EXPECT_EQ(simple.segment(0).intermediate, 3);
}

TEST(SimplifyPath, WhereNothingIsToWinThePathIsTheSame)
{
    EXPECT_EQ(simplifyPath(kCircle, 0.001), kCircle);
    EXPECT_EQ(simplifyPath(Path(), 1), Path());
}

TEST(OrientContours, HolesRunTheOtherWay)
{
    Path ring = kCircle;
    ring.contours().push_back(Path::ellipse(Box({-5, -5}, {5, 5})).contours().front());
    ring.contours().push_back(Path::ellipse(Box({-2, -2}, {2, 2})).contours().front());
    const Path turned = orientContours(ring);
    EXPECT_GT(Path({turned.contours()[0]}).area(), 0);
    EXPECT_LT(Path({turned.contours()[1]}).area(), 0);
    EXPECT_GT(Path({turned.contours()[2]}).area(), 0);
    EXPECT_FALSE(turned.contains({3.5, 0}));
    EXPECT_TRUE(turned.contains({0, 0}));
}

}  // namespace
}  // namespace jet
