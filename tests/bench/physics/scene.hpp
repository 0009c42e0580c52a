// A benchmark's scene as every engine loads it: y up, metres, kilograms, seconds. Made by code, or, where it was poured
// at random, kept as a table beside this file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace jet::bench {

struct Point {
    double x = 0, y = 0;
};

struct SceneShape {
    enum class Kind { Circle, Box, Polygon };
    Kind kind = Kind::Box;
    double radius = 0;           // circle
    Point half, centre;          // box
    std::vector<Point> corners;  // convex polygon, counter-clockwise
};

struct SceneBody {
    enum class Type { Static, Kinematic, Dynamic };
    Type type = Type::Dynamic;
    Point position, velocity;
    double angle = 0, omega = 0;
    int group = 0;    // bodies of one group above 0 do not collide
    double mass = 0;  // 0: from the area, density 1
    bool collides = true;
    bool fixedRotation = false;
    std::vector<SceneShape> shapes;
};

/// Local points of a and b that coincide.
struct SceneJoint {
    std::uint32_t a, b;
    Point localA, localB;
};

/// Between the centres of two bodies.
struct SceneSpring {
    std::uint32_t a, b;
    double restLength, stiffness, damping;
};

/// Bodies [first, first + count) are the particles of one soft body; the first `ring` of them are its outline.
struct SceneSoft {
    std::uint32_t first, count, ring;
};

struct Scene {
    std::string name;
    int warmUpSteps = 60, steps = 300;
    double dt = 1.0 / 60;
    Point gravity{0, -10};
    double friction = 0.6, restitution = 0;
    std::array<double, 3> bounds{-1e9, -1e9, 1e9};  // least x, least y, greatest x: whoever is beyond has escaped
    std::vector<SceneBody> bodies;
    std::vector<SceneJoint> joints;
    std::vector<SceneSpring> springs;
    std::vector<SceneSoft> soft;
};

/// Corners of a box or polygon in the body's frame.
std::vector<Point> cornersOf(const SceneShape&);
struct AreaMoments {
    double area = 0, secondMoment = 0;  // the latter about the body's origin
    Point centroid;
};
AreaMoments momentsOf(const SceneBody&);

/// All scenes this program makes, in the order of the report.
std::vector<std::string> sceneNames();
Scene makeScene(const std::string& name);
/// The same from a file (the format of the shared scenes).
Scene loadScene(const std::string& file);
/// Empty when they are equal, else the first difference.
std::string difference(const Scene&, const Scene&);

}  // namespace jet::bench
