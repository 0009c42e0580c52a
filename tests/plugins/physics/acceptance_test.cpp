// What engines of rigid bodies are asked to let stand (most scenes are Box2D's samples), and within what.
#include "acceptance.hpp"

namespace jet::physics::test {

namespace {

// What has to stand.

struct Standing {
    const char* name;
    void (*build)(Stage&);
    double moved;   ///< units that any body may have moved
    double turned;  ///< radians that any body may have turned
    const char* why;
};
void PrintTo(const Standing& row, std::ostream* out) { *out << row.name; }

void pyramidOf(Stage& stage, int rows, double size, double x = 0, double heavy = 1, double drop = 0)
{
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < rows - row; ++i) {
            const bool top = row == rows - 1;
            const Vec2 centre(x + size * (i - 0.5 * (rows - row - 1)), -size * (row + 0.5) - (top ? drop : 0));
            stage.add(box(centre, size, size, top ? heavy : 1));
        }
}

void stackOfThirty(Stage& stage)
{
    stage.add(ground(0));
    for (int i = 0; i < 30; ++i) stage.add(box({0, -kMetre * (i + 0.5)}, kMetre, kMetre));
}

void tinyPyramid(Stage& stage)
{
    stage.add(ground(0));
    pyramidOf(stage, 30, 0.05 * kMetre);
}

/// Five storeys of cards 0.4 m long and 2 mm thick that lean at 25°, with cards over their tops that lie on each other.
void houseOfCards(Stage& stage)
{
    stage.add(ground(0));
    const double length = 0.4 * kMetre, thick = 0.002 * kMetre, lean = 25 * kPi / 180;
    const double width = length * std::sin(lean) + thick * std::cos(lean);
    const double height = length * std::cos(lean) + thick * std::sin(lean);
    double floor = 0;
    for (int storey = 0; storey < 5; ++storey) {
        const double left = width * storey;
        for (int i = 0; i < 5 - storey; ++i) {
            const double apex = left + width * (2 * i + 1);
            stage.add(box({apex - width / 2, floor - height / 2}, thick, length, 1, lean));
            stage.add(box({apex + width / 2, floor - height / 2}, thick, length, 1, -lean));
            if (i < 4 - storey) stage.add(box({apex + width, floor - height - thick * (i % 2 + 0.5)}, length, thick));
        }
        floor -= height + (storey < 3 ? 2 : 1) * thick;
    }
}

/// Blocks along a catenary with joints square to it, between two fixed abutments: the line of thrust is the middle one.
void arch(Stage& stage)
{
    const double a = 15, half = 2 * a, thick = 6;
    const int count = 17;
    const auto corner = [&](int joint, double side) {
        const double arc = a * std::sinh(half / a) * (2.0 * joint / count - 1);
        const double x = a * std::asinh(arc / a), slope = std::sinh(x / a), unit = std::sqrt(1 + slope * slope);
        return Vec2(x + side * thick / 2 * slope / unit, a * std::cosh(x / a) - side * thick / 2 / unit);
    };
    const Vec2 tangent = (corner(0, 0) - corner(1, 0)).normalized() * 2 * thick;
    const auto mirrored = [](const Vec2& p) { return Vec2(-p.x(), p.y()); };
    const Vec2 outer = corner(0, 1), inner = corner(0, -1);
    stage.add(fixed({{outer, inner, inner + tangent, outer + tangent}}));
    stage.add(fixed({{mirrored(inner), mirrored(outer), mirrored(outer + tangent), mirrored(inner + tangent)}}));
    for (int i = 0; i < count; ++i)
        stage.add(rigid({{corner(i, 1), corner(i + 1, 1), corner(i + 1, -1), corner(i, -1)}}));
}

/// Three pyramids on whose tops blocks of 100, 200 and 300 times the mass of the others fall from a height of 2 m.
void heavyBlocksOnPyramids(Stage& stage)
{
    stage.add(ground(0));
    for (int j = 0; j < 3; ++j) pyramidOf(stage, 10, 2 * kMetre, 25 * kMetre * (j - 1), 100 * (j + 1));
}

/// A block of 20 m on two of 2 m, a hundred times lighter.
void largeBlockOnSmallOnes(Stage& stage)
{
    stage.add(ground(0));
    for (const double x : {-9.0, 9.0}) stage.add(box({x * kMetre, -kMetre}, 2 * kMetre, 2 * kMetre, 4));
    stage.add(box({0, -12 * kMetre}, 20 * kMetre, 20 * kMetre, 400));
}

/// The same block on the points of two triangles, eight hundred times lighter.
void largeBlockOnPoints(Stage& stage)
{
    stage.add(ground(0));
    for (const double x : {-9.0 * kMetre, 9.0 * kMetre})
        stage.add(rigid({{{x - kMetre / 2, 0}, {x + kMetre / 2, 0}, {x, -kMetre}}}, 0.5));
    stage.add(box({0, -11 * kMetre}, 20 * kMetre, 20 * kMetre, 400));
}

/// Each of ten boxes has 1.47 times the mass of the one below: together a hundred times the lowest.
void heavierWithHeight(Stage& stage)
{
    stage.add(ground(0));
    for (int i = 0; i < 10; ++i) stage.add(box({0, -kMetre * (i + 0.5)}, kMetre, kMetre, std::pow(1.47, i)));
}

/// A car of two wheels on axles with springs of 4 Hz, loaded with ten boxes, on level ground.
void loadedCart(Stage& stage)
{
    stage.add(ground(0));
    const BodyHandle chassis = stage.add(box({0, -1.25 * kMetre}, 6 * kMetre, 0.5 * kMetre, 4));
    for (const double x : {-2.0, 2.0}) {
        const Vec2 axle(x * kMetre, -0.5 * kMetre);
        const BodyHandle wheel = stage.add(disc(axle, 0.5 * kMetre, 1));
        JointDef joint;
        joint.a = {chassis, axle}, joint.b = {wheel, axle};
        stage.world->addJoint(joint);
    }
    for (int i = 0; i < 10; ++i) stage.add(box({(i % 5 - 2) * kMetre, -(2 + i / 5) * kMetre}, kMetre, kMetre, 1));
}

class Stands : public ::testing::TestWithParam<std::tuple<Standing, bool>> {};

TEST_P(Stands, ForTenSecondsAndIsStillThen)
{
    const auto& [row, drawn] = GetParam();
    Stage stage(drawn);
    row.build(stage);
    run(*stage.world, 10);
    for (std::size_t i = 0; i < stage.watched.size(); ++i) {
        const BodyHandle body = stage.watched[i];
        EXPECT_LE((stage.at(body) - stage.placed[i]).norm(), row.moved) << "body " << body << ": " << row.why;
        EXPECT_NEAR(stage.world->bodies().angle[body], 0, row.turned) << "body " << body << ": " << row.why;
    }
    EXPECT_LT(stage.fastest(), 0.05 * kMetre) << "the issue's bound for what stands, 5 cm/s";
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Stands,
    ::testing::Combine(
        ::testing::Values(
            Standing{"stackOfThirty", stackOfThirty, 0.0074 * 30 * kMetre, 0.02,
                     "a pyramid of a hundred rows sinks by 0.74 % of its height at most"},
            Standing{"tinyPyramid", tinyPyramid, 0.05 * kMetre / 4, 0.1, "a quarter of a box"},
            Standing{"houseOfCards", houseOfCards, 0.04 * kMetre, 0.1,
                     "legs at 25° push outwards with tan 25° = 0.47 of their load, and friction has 0.6"},
            Standing{"arch", arch, 1, 0.05, "the line of thrust stays in the middle third of 6 units"},
            Standing{"heavyBlocksOnPyramids", heavyBlocksOnPyramids, 0.5 * kMetre, 0.1, "a quarter of a box"},
            Standing{"largeBlockOnSmallOnes", largeBlockOnSmallOnes, 0.1 * kMetre, 0.02, "a twentieth of a small box"},
            Standing{"largeBlockOnPoints", largeBlockOnPoints, 0.1 * kMetre, 0.05, "a tenth of a triangle"},
            Standing{"heavierWithHeight", heavierWithHeight, 0.1 * kMetre, 0.05,
                     "a hundred times its mass is what docs/physics.md says a body bears; 1 % of the height"},
            Standing{"loadedCart", loadedCart, 0.1 * kMetre, 0.05, "level ground"}),
        ::testing::Bool()),
    [](const auto& info) {
        return std::get<0>(info.param).name + std::string(std::get<1>(info.param) ? "Drawn" : "Simple");
    });

}  // namespace

}  // namespace jet::physics::test
