#include "skin.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace jet {
namespace {

// An ellipse as a soft body whose border is its own polygon.
struct Blob {
    Path path = Path::ellipse(Box({10, 20}, {50, 40}));
    SoftBodyDef body;
    Blob()
    {
        path.setIntermediate(3);
        std::vector<std::uint32_t> ring;
        const std::vector<Polyline> border = path.polygonized();
        for (const Vec2& p : border[0].points) {
            ring.push_back(static_cast<std::uint32_t>(body.particles.size()));
            body.particles.push_back(p);
        }
        body.borders.push_back(ring);
    }
    std::vector<Vec2> moved(const Affine& m) const
    {
        std::vector<Vec2> points;
        for (const Vec2& p : body.particles) points.push_back(m * p);
        return points;
    }
};

double largestDifference(const Path& a, const Path& b)
{
    double most = 0;
    for (std::size_t i = 0; i < a.segmentCount(); ++i) {
        const Segment &s = a.segment(i), &t = b.segment(i);
        most = std::max({most, (s.point - t.point).norm(), (s.in - t.in).norm(), (s.out - t.out).norm()});
    }
    return most;
}

TEST(SkinTest, AtRestThePathIsAsDrawn)
{
    const Blob blob;
    const Path expected = splitAtIntermediatePoints(blob.path);
    EXPECT_LT(largestDifference(Skin(blob.path, blob.body).deformed(blob.body.particles), expected), 1e-12);
    EXPECT_LT((expected.bounds().size() - blob.path.bounds().size()).norm(), 1e-12);
}

TEST(SkinTest, ASimilarityOfTheParticlesIsThatOfThePath)
{
    const Blob blob;
    const Skin skin(blob.path, blob.body);
    const Affine similarity = Affine::translation({300, -70}) * Affine::rotation(1.234) * Affine::scaling({1.7, 1.7});
    EXPECT_LT(largestDifference(skin.deformed(blob.moved(similarity)),
                                splitAtIntermediatePoints(blob.path).transformed(similarity)),
              1e-10);
}

TEST(SkinTest, AnchorsStayOnTheBorderWhenItIsStretched)
{
    const Blob blob;
    const Affine stretch = Affine::scaling({2, 0.5});
    const Path deformed = Skin(blob.path, blob.body).deformed(blob.moved(stretch));
    const Path expected = splitAtIntermediatePoints(blob.path).transformed(stretch);
    for (std::size_t i = 0; i < expected.segmentCount(); ++i)
        EXPECT_LT((deformed.segment(i).point - expected.segment(i).point).norm(), 1e-10);
}

TEST(SkinTest, EachBorderParticleIsASegmentOfTheDrawnCurve)
{
    const Blob blob;
    auto crushed = blob.body.particles;
    for (Vec2& p : crushed) p.y() = std::min(p.y(), 32.0);  // flat on a floor at y = 32
    const Path drawn = Skin(blob.path, blob.body).deformed(crushed);
    ASSERT_EQ(drawn.segmentCount(), crushed.size());
    for (std::size_t i = 0; i < crushed.size(); ++i)
        EXPECT_LT((drawn.segment(i).point - crushed[i]).norm(), 1e-10) << i;
}

TEST(SkinTest, WithoutABorderThePathStays)
{
    const Blob blob;
    SoftBodyDef bare;
    bare.particles = {{0, 0}};
    EXPECT_EQ(Skin(blob.path, bare).deformed(bare.particles), splitAtIntermediatePoints(blob.path));
}

TEST(SkinTest, BorderPointsInOnePlaceAreNoTrouble)
{
    Blob blob;
    blob.body.borders[0].insert(blob.body.borders[0].begin(), 0);  // an edge of no length
    const Path deformed = Skin(blob.path, blob.body).deformed(blob.body.particles);
    EXPECT_TRUE(deformed.isFinite());
}

}  // namespace
}  // namespace jet
