// The scenes of soft bodies: balls that fall on each other, and a sheet that hangs by its upper edge. The shared files
// were written from single precision with nine digits; so are these, and equal them (--check).
#include "bench/physics/scene_soft.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace jet::bench {

namespace {

double written(float x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(x));
    return std::strtod(text, nullptr);
}

SceneBody particle(float x, float y, float radius, int group, double mass)
{
    SceneBody body;
    body.position = {written(x), written(y)};
    body.group = group, body.mass = mass, body.fixedRotation = true;
    SceneShape& shape = body.shapes.emplace_back();
    shape.kind = SceneShape::Kind::Circle;
    shape.radius = written(radius);
    return body;
}

void join(Scene& scene, std::uint32_t a, std::uint32_t b, double stiffness, double damping)
{
    const Point &p = scene.bodies[a].position, &q = scene.bodies[b].position;
    const float dx = static_cast<float>(q.x) - static_cast<float>(p.x);
    const float dy = static_cast<float>(q.y) - static_cast<float>(p.y);
    const double squared =
        static_cast<double>(dx) * static_cast<double>(dx) + static_cast<double>(dy) * static_cast<double>(dy);
    scene.springs.push_back({a, b, written(static_cast<float>(std::sqrt(squared))), stiffness, damping});
}

void addBall(Scene& scene, float x, float y, int group)
{
    constexpr std::uint32_t kOuter = 20, kInner = 10;
    constexpr double kStiffness = 486.178467, kDamping = 2.32133102, kMass = 0.0615752153;
    const auto first = static_cast<std::uint32_t>(scene.bodies.size());
    const auto ring = [&](std::uint32_t count, float radius) {
        for (std::uint32_t k = 0; k < count; ++k) {
            const float angle =
                static_cast<float>(2 * 3.14159265358979323846) * static_cast<float>(k) / static_cast<float>(count);
            const auto c = static_cast<float>(std::cos(static_cast<double>(angle)));
            const auto s = static_cast<float>(std::sin(static_cast<double>(angle)));
            scene.bodies.push_back(particle(x + radius * c, y + radius * s, 0.14F, group, kMass));
        }
    };
    ring(kOuter, 1);
    ring(kInner, 0.55F);
    scene.bodies.push_back(particle(x, y, 0.14F, group, kMass));
    const auto spring = [&](std::uint32_t a, std::uint32_t b) {
        join(scene, first + a, first + b, kStiffness, kDamping);
    };
    for (std::uint32_t k = 0; k < kOuter; ++k) {
        spring(k, (k + 1) % kOuter);
        spring(k, (k + 2) % kOuter);
        spring(k, kOuter + k / 2);
        spring(k, kOuter + (k % 2 == 0 ? k / 2 + kInner - 1 : k / 2 + 1) % kInner);
    }
    for (std::uint32_t k = 0; k < kInner; ++k) {
        spring(kOuter + k, kOuter + (k + 1) % kInner);
        spring(kOuter + k, kOuter + kInner);
    }
    scene.soft.push_back({first, kOuter + kInner + 1, kOuter});
}

}  // namespace

Scene softPile(int columns, int rows)
{
    Scene scene;
    scene.steps = 540;
    const double side = 15 + 1.3 * (columns - 10), height = 2.6 * (rows - 10);
    scene.bounds = {0.5 - side, -0.5, side - 0.5};
    const auto wall = [&](double x, double y, double halfX, double halfY) {
        SceneBody& body = scene.bodies.emplace_back();
        body.type = SceneBody::Type::Static;
        body.position = {x, y};
        body.shapes.emplace_back().half = {halfX, halfY};
    };
    wall(0, -1, side + 1, 1);
    wall(-side, 20 + height, 1, 30 + height);
    wall(side, 20 + height, 1, 30 + height);
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < columns; ++i)
            addBall(scene,
                    -11.7F - 1.3F * static_cast<float>(columns - 10) + 2.6F * static_cast<float>(i) +
                        (row % 2 == 1 ? 0.35F : -0.35F),
                    1.5F + 2.6F * static_cast<float>(row), columns * row + i + 1);
    return scene;
}

Scene softBalls() { return softPile(10, 10); }

Scene softSheet() { return hangingSheet(100); }

Scene hangingSheet(std::uint32_t side)
{
    constexpr double kStiffness = 452.071533, kDamping = 0.479662836, kMass = 0.025446903;  // 30 Hz, damping ratio 0.1
    Scene scene;
    scene.steps = 252;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        scene.bodies.push_back(
            particle(0.2F * static_cast<float>(i % side), -0.2F * static_cast<float>(i / side), 0.09F, 1, kMass));
        if (i < side) scene.bodies.back().type = SceneBody::Type::Static;
    }
    const auto spring = [&](std::uint32_t a, std::uint32_t b) { join(scene, a, b, kStiffness, kDamping); };
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const bool right = i % side + 1 < side, below = i / side + 1 < side;
        if (right && i >= side) spring(i, i + 1);
        if (below) spring(i, i + side);
        if (right && below) spring(i, i + side + 1), spring(i + 1, i + side);
    }
    scene.soft.push_back({0, side * side, 0});
    return scene;
}

}  // namespace jet::bench
