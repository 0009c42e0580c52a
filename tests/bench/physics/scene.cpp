#include "bench/physics/scene.hpp"

#include "bench/physics/scene_soft.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

// The two poured scenes, one body a line: kind (b, c, p), x, y, angle, then its measures. Embedded, so that the program
// runs anywhere.
asm(".section .rodata\n"
    ".global jet_bench_container\njet_bench_container: .incbin \"" JET_BENCH_SCENES "/container.txt\"\n.byte 0\n"
    ".global jet_bench_tumbler\njet_bench_tumbler: .incbin \"" JET_BENCH_SCENES "/tumbler.txt\"\n.byte 0\n"
    ".previous\n");
extern "C" const char jet_bench_container[];
extern "C" const char jet_bench_tumbler[];

namespace jet::bench {

namespace {

/// The scenes were written with single precision and nine digits.
double single(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(static_cast<float>(x)));
    return std::strtod(text, nullptr);
}

SceneShape box(double halfX, double halfY, Point centre = {})
{
    SceneShape shape;
    shape.half = {halfX, halfY};
    shape.centre = centre;
    return shape;
}

SceneShape circle(double radius)
{
    SceneShape shape;
    shape.kind = SceneShape::Kind::Circle;
    shape.radius = radius;
    return shape;
}

SceneBody body(SceneBody::Type type, double x, double y, SceneShape shape)
{
    SceneBody made;
    made.type = type;
    made.position = {x, y};
    made.shapes.push_back(std::move(shape));
    return made;
}

SceneBody solid(double x, double y, SceneShape shape) { return body(SceneBody::Type::Dynamic, x, y, std::move(shape)); }
SceneBody still(double x, double y, SceneShape shape) { return body(SceneBody::Type::Static, x, y, std::move(shape)); }

Scene pyramid()
{
    Scene scene;
    scene.warmUpSteps = 100, scene.steps = 400;
    scene.bounds[1] = -2;
    scene.bodies.push_back(still(0, -1, box(100, 1)));
    for (int row = 0; row < 100; ++row)
        for (int i = 0; i < 100 - row; ++i)
            scene.bodies.push_back(solid(i - (99 - row) / 2.0, 0.5 + row, box(0.5, 0.5)));
    return scene;
}

Scene islands()
{
    Scene scene;
    scene.bounds[1] = -2;
    for (int level = 0; level < 10; ++level) scene.bodies.push_back(still(0, 12 * level - 0.5, box(110, 0.5)));
    for (int level = 0; level < 10; ++level)
        for (int pile = 0; pile < 20; ++pile)
            for (int row = 0; row < 10; ++row)
                for (int i = 0; i < 10 - row; ++i)
                    scene.bodies.push_back(
                        solid(-109 + 11 * pile + i + 0.5 * row, 12 * level + 0.5 + row, box(0.5, 0.5)));
    return scene;
}

Scene jointGrid()
{
    Scene scene;
    scene.steps = 440;
    const std::uint32_t side = 50;
    for (std::uint32_t x = 0; x < side; ++x) {
        for (std::uint32_t y = 0; y < side; ++y) {
            const bool fixed = y == 0 && x >= side / 2 - 3 && x <= side / 2 + 3;
            scene.bodies.push_back(fixed ? still(x, -1.0 * y, circle(single(0.4)))
                                         : solid(x, -1.0 * y, circle(single(0.4))));
            scene.bodies.back().collides = false;
            const std::uint32_t index = x * side + y;
            if (y > 0) scene.joints.push_back({index - 1, index, {0, -0.5}, {0, 0.5}});
            if (x > 0) scene.joints.push_back({index - side, index, {0.5, 0}, {-0.5, 0}});
        }
    }
    return scene;
}

Scene bullets(bool moving)
{
    Scene scene;
    scene.warmUpSteps = 0, scene.steps = 90;
    scene.gravity = {0, 0};
    const double speeds[] = {10, 20, 40, 60, 80, 100, 150, 200, 300, 390};
    for (int i = 0; i < 200; ++i) {
        scene.bodies.push_back(solid(single(-5.0F - 0.013F * static_cast<float>(i)), i, circle(single(0.1))));
        scene.bodies.back().velocity = {speeds[i % 10], 0};
    }
    if (!moving) scene.bodies.push_back(still(2, 100, box(single(0.05), 110)));
    for (int i = 0; moving && i < 200; ++i) scene.bodies.push_back(solid(2, i, box(single(0.05), single(0.45))));
    return scene;
}

void pour(Scene& scene, const char* table)
{
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream in(line);
        char kind = 0;
        double x = 0, y = 0, angle = 0, a = 0, b = 0;
        if (!(in >> kind >> x >> y >> angle)) continue;
        SceneShape shape;
        if (kind == 'c') {
            in >> a;
            shape = circle(a);
        } else if (kind == 'b') {
            in >> a >> b;
            shape = box(a, b);
        } else {
            shape.kind = SceneShape::Kind::Polygon;
            while (in >> a >> b) shape.corners.push_back({a, b});
        }
        scene.bodies.push_back(solid(x, y, std::move(shape)));
        scene.bodies.back().angle = angle;
    }
}

Scene container()
{
    Scene scene;
    scene.steps = 540;
    scene.bounds = {-21, -1, 21};
    scene.bodies.push_back(still(0, -1, box(22, 1)));
    scene.bodies.push_back(still(-21, 40, box(1, 60)));
    scene.bodies.push_back(still(21, 40, box(1, 60)));
    pour(scene, jet_bench_container);
    return scene;
}

Scene tumbler()
{
    Scene scene;
    scene.steps = 540;
    scene.bounds = {-23, -23, 23};
    scene.bodies.push_back(body(SceneBody::Type::Kinematic, 0, 0, box(0.5, 15.5, {15, 0})));
    scene.bodies[0].omega = 0.5;
    scene.bodies[0].shapes.push_back(box(0.5, 15.5, {-15, 0}));
    scene.bodies[0].shapes.push_back(box(15.5, 0.5, {0, 15}));
    scene.bodies[0].shapes.push_back(box(15.5, 0.5, {0, -15}));
    pour(scene, jet_bench_tumbler);
    return scene;
}

const std::vector<std::pair<std::string, std::function<Scene()>>>& makers()
{
    static const std::vector<std::pair<std::string, std::function<Scene()>>> all = {
        {"pyramid", pyramid},
        {"container", container},
        {"islands", islands},
        {"joint-grid", jointGrid},
        {"tumbler", tumbler},
        {"soft-balls", softBalls},
        {"soft-sheet", softSheet},
        {"bullets-static-wall", [] { return bullets(false); }},
        {"bullets-moving-plates", [] { return bullets(true); }},
    };
    return all;
}

}  // namespace

std::vector<Point> cornersOf(const SceneShape& shape)
{
    if (shape.kind == SceneShape::Kind::Polygon) return shape.corners;
    const auto [hx, hy] = shape.half;
    const auto [cx, cy] = shape.centre;
    return {{cx - hx, cy - hy}, {cx + hx, cy - hy}, {cx + hx, cy + hy}, {cx - hx, cy + hy}};
}

AreaMoments momentsOf(const SceneBody& body)
{
    AreaMoments sum;
    for (const SceneShape& shape : body.shapes) {
        if (shape.kind == SceneShape::Kind::Circle) {
            const double area = 3.14159265358979323846 * shape.radius * shape.radius;
            sum.area += area;
            sum.secondMoment += 0.5 * area * shape.radius * shape.radius;
            continue;
        }
        const std::vector<Point> at = cornersOf(shape);
        for (std::size_t i = 0; i < at.size(); ++i) {
            const Point &p = at[i], &q = at[(i + 1) % at.size()];
            const double cross = p.x * q.y - p.y * q.x;
            sum.area += cross / 2;
            sum.centroid.x += cross * (p.x + q.x) / 6;
            sum.centroid.y += cross * (p.y + q.y) / 6;
            sum.secondMoment += cross * (p.x * p.x + p.x * q.x + q.x * q.x + p.y * p.y + p.y * q.y + q.y * q.y) / 12;
        }
    }
    if (sum.area > 0) sum.centroid.x /= sum.area, sum.centroid.y /= sum.area;
    return sum;
}

std::vector<std::string> sceneNames()
{
    std::vector<std::string> names;
    for (const auto& [name, make] : makers()) names.push_back(name);
    return names;
}

Scene makeScene(const std::string& name)
{
    for (const auto& [known, make] : makers()) {
        if (known != name) continue;
        Scene scene = make();
        scene.name = name;
        return scene;
    }
    throw std::runtime_error("There is no scene \"" + name + "\".");
}

}  // namespace jet::bench
