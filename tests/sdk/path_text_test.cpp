#include "geometry_samples.hpp"

#include <numbers>

namespace jet {
namespace {

using std::numbers::pi;
using test::cpuSeconds;
using test::distance;
using test::parsed;
using test::Random;
using test::randomContour;
using test::sameBits;

TEST(PathTextTest, TextIsSvgPathDataWithTheIntermediateCountsAfterIt)
{
    Path path = Path::polygon(std::vector<Vec2>{{0, 0}, {10, 0}, {10, 5.5}});
    EXPECT_EQ(path.text(), "M 0 0 L 10 0 L 10 5.5 Z");
    path.setIntermediate(2);
    EXPECT_EQ(path.text(), "M 0 0 L 10 0 L 10 5.5 Z n 2 2 2");
    EXPECT_EQ(Path().text(), "");
}

TEST(PathTextTest, TextReadsBackBitForBit)
{
    Random random(100);
    for (int i = 0; i < 500; ++i) {
        Path path;
        const std::size_t contours = random.index(4);
        for (std::size_t c = 0; c < contours; ++c) {
            Contour contour = randomContour(random, 1 + random.index(5));
            contour.closed = random.index(2) == 0;  // open ones have control points no curve uses
            for (Segment& s : contour.segments) {
                if (random.index(5) == 0) s.intermediate = static_cast<int>(random.index(kMaxIntermediate + 1));
                if (random.index(6) == 0) s.point = s.in = s.out = contour.segments.front().point;
                if (random.index(6) == 0) s = Segment(Vec2(-0.0, 0.0), s.in, Vec2(0.0, -0.0));
                if (random.index(9) == 0) s.out = Vec2(5e-324, -1.7976931348623157e308);
            }
            path.contours().push_back(contour);
        }
        EXPECT_TRUE(sameBits(parsed(path.text()), path)) << path.text();
    }
}

TEST(PathTextTest, AnyFiniteBitsReadBackUnchanged)
{
    Random random(110);
    const auto any = [&] {
        double value = 0;
        do value = std::bit_cast<double>(random.bits());
        while (!std::isfinite(value));
        return value;
    };
    for (int i = 0; i < 2000; ++i) {
        Path path;
        path.moveTo({any(), any()});
        path.cubicTo({any(), any()}, {any(), any()}, {any(), any()});
        EXPECT_TRUE(sameBits(parsed(path.text()), path)) << path.text();
    }
}

TEST(PathTextTest, EverySvgCommandIsRead)
{
    const std::vector<std::pair<std::string, std::string>> cases{
        {"m 1 2 3 4 l 1 1", "M 1 2 L 4 6 L 5 7"},
        {"M 1 2 3 4", "M 1 2 L 3 4"},
        {"M1 2H5V7h-1v-2", "M 1 2 L 5 2 L 5 7 L 4 7 L 4 5"},
        {"M0 0H1 2 3", "M 0 0 L 1 0 L 2 0 L 3 0"},
        {"M0 0c1 2 3 4 5 6", "M 0 0 C 1 2 3 4 5 6"},
        {"M0 0C0 5 5 5 5 0S10-5 10 0", "M 0 0 C 0 5 5 5 5 0 C 5 -5 10 -5 10 0"},
        {"M0 0 5 0s1 1 2 2", "M 0 0 L 5 0 C 5 0 6 1 7 2"},
        {"M0 0Q3 3 6 0t6 0", "M 0 0 C 2 2 4 2 6 0 C 8 -2 10 -2 12 0"},
        {"M0 0T6 0", "M 0 0 C 0 0 2 0 6 0"},
        {"M0 0Q3 3 6 0L7 0T10 0", "M 0 0 C 2 2 4 2 6 0 L 7 0 C 7 0 8 0 10 0"},
        {"M1 1L2 2zl1 0z", "M 1 1 L 2 2 Z M 1 1 L 2 1 Z"},
        {"M1 1L2 2zm1 0l1 0", "M 1 1 L 2 2 Z M 2 1 L 3 1"},
        {"M1 1zz", "M 1 1 Z"},
        {"M1.5.5-1-2", "M 1.5 0.5 L -1 -2"},
        {"M1e2,1E-1+3.e0,.5", "M 100 0.1 L 3 0.5"},
        {" \t\r\nM\n1,\n2 ", "M 1 2"},
        {"M0,0L1,1,2,2", "M 0 0 L 1 1 L 2 2"},
        {"", ""},
        {"  ", ""},
    };
    for (const auto& [source, expected] : cases) EXPECT_EQ(parsed(source).text(), expected) << source;
}

TEST(PathTextTest, ArcFlagsNeedNoSeparators)
{
    const Path spaced = parsed("M 0 0 a 1 1 0 0 1 0.5 0.5");
    EXPECT_EQ(parsed("M0,0a1,1 0 01.5.5"), spaced);
    EXPECT_EQ(parsed("M0 0a1 1 0 0,1,.5,.5"), spaced);
    EXPECT_EQ(parsed("M0 0a1 1 0 01.5.5 1 1 0 10-1-1").contours()[0].curveCount(), 4u);
    EXPECT_NEAR(spaced.contours()[0].segments.back().point.x(), 0.5, 0);
}

TEST(PathTextTest, AnArcRotationIsInDegreesInText)
{
    Path path;
    path.moveTo({0, 0});
    path.arcTo({4, 2}, pi / 6, false, true, {3, 3});
    EXPECT_LT(distance(parsed("M 0 0 A 4 2 30 0 1 3 3").segment(1).in, path.segment(1).in), 1e-14);
}

TEST(PathTextTest, AnErrorSaysWhatWasExpectedAndWhere)
{
    struct Case {
        std::string text, word;
        int column;
        std::string prefix;  ///< what SVG wants drawn all the same
    };
    const std::vector<Case> cases{
        {"L 1 1", "M or m", 1, ""},
        {"M 1", "a number", 4, ""},
        {"M 0 0 L 1 x", "a number", 11, "M 0 0"},
        {"M 0 0 L 1 1 2", "a number", 14, "M 0 0 L 1 1"},
        {"M 0 0 L 1 1,", "a number", 13, "M 0 0 L 1 1"},
        {"M 0 0,,1 1", "a number", 7, "M 0 0"},
        {"M ,0 0", "a number", 3, ""},
        {"M 0 0 X 1 1", "a command", 7, "M 0 0"},
        {"M 0 0 L 1 1 Z 5", "a command", 15, "M 0 0 L 1 1 Z"},
        {"M 0 0 A 1 1 0 2 1 5 5", "arc flag", 15, "M 0 0"},
        {"M 0 0 L nan 0", "a number", 9, "M 0 0"},
        {"M 0 0 L inf 0", "a number", 9, "M 0 0"},
        {"M 0 0 L 1e999 0", "below 1.8e308", 9, "M 0 0"},
        {"M 0 0 L - 0", "complete", 9, "M 0 0"},
        {"M 1e308 0 l 1 1 1e308 0", "add up", 17, "M 1e+308 0 L 1e+308 1"},
        {"M -1e308 0 Q 1e308 0 1e308 1", "differences", 14, "M -1e+308 0"},
        {"M 0 0 C 0 0 -1e308 0 1e308 0 S 0 0 1 1", "reflection", 32, "M 0 0 C 0 0 -1e+308 0 1e+308 0"},
        {"M 0 0 L 1 1 n 1", "a count", 16, "M 0 0 L 1 1 n 1 0"},
        {"M 0 0 n 1001", "a count", 9, "M 0 0"},
        {"M 0 0 n -1", "a count", 9, "M 0 0"},
        {"M 0 0 n 1 L 1 1", "its end", 11, "M 0 0 n 1"},
        {"M 0 0 i 1 5 5", "open contour", 9, "M 0 0"},
        {"M 0 0 Z o 0 5 5", "open contour", 11, "M 0 0 Z"},
        {"M 0 0 i 0 5 5 L 1 1", "its end", 15, "M 0 0 i 0 5 5"},
        {"M 0 0 \x01", "unprintable", 7, "M 0 0"},
        {std::string("M 0 0\0L 1 1", 11), "unprintable", 6, "M 0 0"},
    };
    for (const Case& c : cases) {
        const Result<Path> path = Path::parse(c.text);
        ASSERT_FALSE(path) << c.text;
        EXPECT_NE(path.error().message.find(c.word), std::string::npos) << c.text << ": " << path.error().message;
        EXPECT_EQ(path.error().where.column, c.column) << c.text << ": " << path.error().message;
        Error problem;
        EXPECT_EQ(Path::parsePrefix(c.text, &problem).text(), c.prefix) << c.text;
        EXPECT_EQ(problem.message, path.error().message);
    }
}

TEST(PathTextTest, APrefixWithoutErrorLeavesNoMessage)
{
    Error problem("old");
    EXPECT_EQ(Path::parsePrefix("M 1 2", &problem).text(), "M 1 2");
    EXPECT_EQ(problem.message, "");
    EXPECT_EQ(Path::parsePrefix("M 1 2 #").text(), "M 1 2");
}

TEST(PathTextTest, RandomBytesAreReadOrRefusedAndWhatIsReadIsFinite)
{
    const std::string_view alphabet = "MmLlHhVvCcSsQqTtAaZznio0123456789.,-+eE \n\t\"x";
    Random random(120);
    for (int i = 0; i < 20000; ++i) {
        std::string text = "M 1 1";
        for (std::size_t n = random.index(40); n > 0; --n) text += alphabet[random.index(alphabet.size())];
        const Path path = Path::parsePrefix(text);
        EXPECT_TRUE(path.isFinite()) << text;
        EXPECT_TRUE(sameBits(parsed(path.text()), path)) << text;
    }
}

TEST(PathTextTest, AHundredThousandShapesAreWrittenAndReadQuickly)
{
    Random random(130);
    std::vector<Path> shapes;
    for (int i = 0; i < 100'000; ++i) shapes.push_back(Path::ellipse(Box(random.point(), random.point())));
    double fastest = std::numeric_limits<double>::infinity();  // of three: the machine may be busy
    for (int round = 0; round < 3; ++round) {
        const double start = cpuSeconds();
        std::size_t equal = 0;
        for (const Path& shape : shapes) {
            const Result<Path> read = Path::parse(shape.text());
            equal += read && *read == shape;
        }
        fastest = std::min(fastest, cpuSeconds() - start);
        ASSERT_EQ(equal, shapes.size());
    }
    RecordProperty("seconds", std::to_string(fastest));
#ifdef NDEBUG
    EXPECT_LT(fastest, 1.0);
#endif
}

}  // namespace
}  // namespace jet
