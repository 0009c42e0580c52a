// Scenes from files, and whether they are what the code makes.
#include "bench/physics/scene.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <stdexcept>

namespace jet::bench {

namespace {

using Json = nlohmann::json;

Point pointOf(const Json& json) { return {json.at(0), json.at(1)}; }

SceneShape shapeOf(const Json& json)
{
    SceneShape shape;
    if (json.contains("circle")) {
        shape.kind = SceneShape::Kind::Circle;
        shape.radius = json["circle"];
    } else if (json.contains("polygon")) {
        shape.kind = SceneShape::Kind::Polygon;
        for (const Json& corner : json["polygon"]) shape.corners.push_back(pointOf(corner));
    } else {
        shape.half = pointOf(json.at("box"));
        if (json.contains("centre")) shape.centre = pointOf(json["centre"]);
    }
    return shape;
}

SceneBody bodyOf(const Json& json)
{
    SceneBody body;
    const std::string type = json.at("type");
    body.type = type == "static"      ? SceneBody::Type::Static
                : type == "kinematic" ? SceneBody::Type::Kinematic
                                      : SceneBody::Type::Dynamic;
    body.position = pointOf(json.at("position"));
    if (json.contains("velocity")) body.velocity = pointOf(json["velocity"]);
    body.angle = json.value("angle", 0.0);
    body.omega = json.value("omega", 0.0);
    body.group = json.value("group", 0);
    body.mass = json.value("mass", 0.0);
    body.collides = json.value("collides", true);
    body.fixedRotation = json.value("fixed_rotation", false);
    for (const Json& shape : json.at("shapes")) body.shapes.push_back(shapeOf(shape));
    return body;
}

bool same(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y; }

bool same(const SceneShape& a, const SceneShape& b)
{
    if (a.kind != b.kind || a.radius != b.radius || !same(a.half, b.half) || !same(a.centre, b.centre) ||
        a.corners.size() != b.corners.size())
        return false;
    for (std::size_t i = 0; i < a.corners.size(); ++i)
        if (!same(a.corners[i], b.corners[i])) return false;
    return true;
}

bool same(const SceneBody& a, const SceneBody& b)
{
    if (a.type != b.type || !same(a.position, b.position) || !same(a.velocity, b.velocity) || a.angle != b.angle ||
        a.omega != b.omega || a.group != b.group || a.mass != b.mass || a.collides != b.collides ||
        a.fixedRotation != b.fixedRotation || a.shapes.size() != b.shapes.size())
        return false;
    for (std::size_t i = 0; i < a.shapes.size(); ++i)
        if (!same(a.shapes[i], b.shapes[i])) return false;
    return true;
}

}  // namespace

Scene loadScene(const std::string& file)
{
    std::ifstream in(file);
    if (!in) throw std::runtime_error("The scene " + file + " cannot be read.");
    const Json json = Json::parse(in);
    Scene scene;
    scene.name = json.at("name");
    scene.warmUpSteps = json.at("warm_up_steps");
    scene.steps = json.at("steps");
    scene.dt = json.at("dt");
    scene.gravity = pointOf(json.at("gravity"));
    scene.friction = json.at("friction");
    scene.restitution = json.at("restitution");
    for (int i = 0; i < 3; ++i) scene.bounds[i] = json.at("bounds").at(i);
    for (const Json& body : json.at("bodies")) scene.bodies.push_back(bodyOf(body));
    for (const Json& j : json.at("joints"))
        scene.joints.push_back({j.at(0), j.at(1), {j.at(2), j.at(3)}, {j.at(4), j.at(5)}});
    for (const Json& s : json.at("springs")) scene.springs.push_back({s.at(0), s.at(1), s.at(2), s.at(3), s.at(4)});
    for (const Json& s : json.at("soft")) scene.soft.push_back({s.at(0), s.at(1), s.at(2)});
    return scene;
}

std::string difference(const Scene& a, const Scene& b)
{
    if (a.warmUpSteps != b.warmUpSteps || a.steps != b.steps || a.dt != b.dt || !same(a.gravity, b.gravity) ||
        a.friction != b.friction || a.restitution != b.restitution || a.bounds != b.bounds)
        return "the settings";
    if (a.bodies.size() != b.bodies.size() || a.joints.size() != b.joints.size() ||
        a.springs.size() != b.springs.size() || a.soft.size() != b.soft.size())
        return "the counts";
    for (std::size_t i = 0; i < a.bodies.size(); ++i)
        if (!same(a.bodies[i], b.bodies[i])) return "body " + std::to_string(i);
    for (std::size_t i = 0; i < a.joints.size(); ++i) {
        const SceneJoint &j = a.joints[i], &k = b.joints[i];
        if (j.a != k.a || j.b != k.b || !same(j.localA, k.localA) || !same(j.localB, k.localB))
            return "joint " + std::to_string(i);
    }
    for (std::size_t i = 0; i < a.springs.size(); ++i) {
        const SceneSpring &s = a.springs[i], &t = b.springs[i];
        if (s.a != t.a || s.b != t.b || s.restLength != t.restLength || s.stiffness != t.stiffness ||
            s.damping != t.damping)
            return "spring " + std::to_string(i);
    }
    return {};
}

}  // namespace jet::bench
