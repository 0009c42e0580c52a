#include <jet/testing/gtest.hpp>

namespace {

class WaveEffectTest : public jet::test::PluginTest {
protected:
    WaveEffectTest() : PluginTest{"org.example.wave"} {}

    jet::Path waveOf(const jet::Item& item, jet::PaintPurpose purpose = jet::PaintPurpose::Export)
    {
        const auto strokes = painted(item, purpose).strokes();
        return strokes.size() == 1 ? strokes[0].path : jet::Path();
    }
    const jet::Item& line = add("shape", jet::Path::line({0, 0}, {120, 0}));
};

TEST_F(WaveEffectTest, SwingsByItsAmplitudeAboutTheOutline)
{
    apply("wave", line, {{"amplitude", 5.0}, {"wavelength", 24.0}});
    const jet::Path wave = waveOf(line);
    EXPECT_EQ(wave.segmentCount(), 5u * 16 + 1) << "five waves of 16 pieces";
    EXPECT_NEAR(wave.bounds().max.y(), 5, 1e-9);
    EXPECT_NEAR(wave.bounds().min.y(), -5, 1e-9);
    // y = A sin(2 pi x / wavelength), by the sign of the perpendicular
    for (std::size_t i = 0; i < wave.segmentCount(); ++i) {
        const jet::Vec2 p = wave.segment(i).point;
        EXPECT_NEAR(p.y(), 5 * std::sin(2 * 3.141592653589793 * p.x() / 24), 1e-9);
    }
}

TEST_F(WaveEffectTest, AClosedOutlineTakesWholeWaves)
{
    const jet::Item& square = addRectangle({{0, 0}, {40, 40}});
    apply("wave", square, {{"wavelength", 15.0}, {"amplitude", 2.0}});
    const jet::Path wave = waveOf(square);
    EXPECT_TRUE(wave.contours().at(0).closed);
    EXPECT_EQ(wave.segmentCount() % 16, 0u);
}

TEST_F(WaveEffectTest, LooksTheSameWithAndWithoutItsKeptState)
{
    apply("wave", line);
    EXPECT_EQ(waveOf(line, jet::PaintPurpose::Edit), waveOf(line, jet::PaintPurpose::Play));
}

TEST_F(WaveEffectTest, FollowsTheItem)
{
    apply("wave", line);
    const jet::Path before = waveOf(line, jet::PaintPurpose::Edit);
    auto edit = items().begin("Move");
    edit.transform(line, jet::Affine::translation({0, 50}));
    edit.commit();
    EXPECT_NEAR(waveOf(line, jet::PaintPurpose::Edit).bounds().center().y(), before.bounds().center().y() + 50, 1e-9);
}

TEST_F(WaveEffectTest, HugeOutlinesAreBounded)
{
    const jet::Item& huge = add("shape", jet::Path::line({0, 0}, {1e9, 0}));
    apply("wave", huge, {{"wavelength", 0.1}});
    EXPECT_LE(waveOf(huge).segmentCount(), 100'001u);
}

}  // namespace
