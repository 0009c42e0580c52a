#include "bench/physics/quality.hpp"

#include "bench/physics/energy.hpp"

#include <algorithm>
#include <cmath>

namespace jet::bench {

namespace {

struct Placed {
    std::size_t body;
    bool circle = false;
    double radius = 0;
    Point centre;
    std::vector<Point> corners;
    double left, right, bottom, top;
};

Point transformed(const Pose& pose, const Point& local)
{
    const double c = std::cos(pose.angle), s = std::sin(pose.angle);
    return {pose.position.x + c * local.x - s * local.y, pose.position.y + s * local.x + c * local.y};
}

double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

Placed place(std::size_t body, const SceneShape& shape, const Pose& pose)
{
    Placed placed;
    placed.body = body;
    if (shape.kind == SceneShape::Kind::Circle) {
        placed.circle = true;
        placed.radius = shape.radius;
        placed.centre = pose.position;
        placed.left = pose.position.x - shape.radius, placed.right = pose.position.x + shape.radius;
        placed.bottom = pose.position.y - shape.radius, placed.top = pose.position.y + shape.radius;
        return placed;
    }
    placed.left = placed.bottom = 1e300, placed.right = placed.top = -1e300;
    for (const Point& corner : cornersOf(shape)) {
        const Point at = transformed(pose, corner);
        placed.corners.push_back(at);
        placed.left = std::min(placed.left, at.x), placed.right = std::max(placed.right, at.x);
        placed.bottom = std::min(placed.bottom, at.y), placed.top = std::max(placed.top, at.y);
    }
    return placed;
}

/// The greatest separation of `other` over the sides of a polygon; negative: how deep it is at least.
double separation(const std::vector<Point>& polygon, const Placed& other)
{
    double greatest = -1e300;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double length = distance(p, q);
        const Point n{(q.y - p.y) / length, (p.x - q.x) / length};
        double least = 1e300;
        if (other.circle) {
            least = (other.centre.x - p.x) * n.x + (other.centre.y - p.y) * n.y - other.radius;
        } else {
            for (const Point& at : other.corners) least = std::min(least, (at.x - p.x) * n.x + (at.y - p.y) * n.y);
        }
        greatest = std::max(greatest, least);
    }
    return greatest;
}

double cornerDistance(const std::vector<Point>& polygon, const Point& to)
{
    double least = 1e300;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double dx = q.x - p.x, dy = q.y - p.y;
        const double t = std::clamp(((to.x - p.x) * dx + (to.y - p.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
        least = std::min(least, distance({p.x + t * dx, p.y + t * dy}, to));
    }
    return least;
}

/// How deep two convex shapes overlap; at most 0 when they do not.
double overlap(const Placed& a, const Placed& b)
{
    if (a.circle && b.circle) return a.radius + b.radius - distance(a.centre, b.centre);
    if (a.circle) return overlap(b, a);
    double deepest = -separation(a.corners, b);
    if (!b.circle) return std::min(deepest, -separation(b.corners, a));
    // Beside a corner the nearest point counts, not the line of a side.
    if (deepest > 0 && deepest < b.radius) deepest = std::min(deepest, b.radius - cornerDistance(a.corners, b.centre));
    return deepest;
}

bool moves(const Scene& scene, std::size_t body) { return scene.bodies[body].type == SceneBody::Type::Dynamic; }

nlohmann::ordered_json overlaps(const Scene& scene, const std::vector<Pose>& now)
{
    std::vector<Placed> shapes;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (!scene.bodies[i].collides || !std::isfinite(now[i].position.x + now[i].position.y + now[i].angle)) continue;
        for (const SceneShape& shape : scene.bodies[i].shapes) shapes.push_back(place(i, shape, now[i]));
    }
    std::sort(shapes.begin(), shapes.end(), [](const Placed& a, const Placed& b) { return a.left < b.left; });
    double sum = 0, most = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        for (std::size_t j = i + 1; j < shapes.size() && shapes[j].left <= shapes[i].right; ++j) {
            const Placed &a = shapes[i], &b = shapes[j];
            if (a.bottom > b.top || b.bottom > a.top || a.body == b.body) continue;
            if (!moves(scene, a.body) && !moves(scene, b.body)) continue;
            const int group = scene.bodies[a.body].group;
            if (group > 0 && group == scene.bodies[b.body].group) continue;
            const double depth = overlap(a, b);
            if (depth <= 0) continue;
            sum += depth, most = std::max(most, depth);
            ++count;
        }
    }
    return {
        {"overlaps", count}, {"mean_overlap", count > 0 ? sum / static_cast<double>(count) : 0}, {"max_overlap", most}};
}

nlohmann::ordered_json jointErrors(const Scene& scene, const std::vector<Pose>& now)
{
    double sum = 0, most = 0;
    for (const SceneJoint& joint : scene.joints) {
        const double error = distance(transformed(now[joint.a], joint.localA), transformed(now[joint.b], joint.localB));
        sum += error, most = error > most ? error : most;
    }
    return {{"mean_joint_error", sum / static_cast<double>(scene.joints.size())}, {"max_joint_error", most}};
}

}  // namespace

std::vector<Pose> posesOf(const Engine& engine, std::size_t bodies)
{
    std::vector<Pose> poses(bodies);
    for (std::size_t i = 0; i < bodies; ++i) poses[i] = engine.pose(i);
    return poses;
}

nlohmann::ordered_json qualityOf(const Scene& scene, const std::vector<Pose>& before, const std::vector<Pose>& now)
{
    std::size_t escaped = 0, fallen = 0, notFinite = 0, top = 0;
    double fastest = 0, sideways = 0;
    std::size_t moving = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const Point& at = now[i].position;
        if (!std::isfinite(at.x + at.y + now[i].angle)) {
            ++notFinite;
            continue;
        }
        if (!moves(scene, i)) continue;
        ++moving, sideways += std::abs(at.x - scene.bodies[i].position.x);
        escaped += at.x < scene.bounds[0] || at.y < scene.bounds[1] || at.x > scene.bounds[2];
        fallen += distance(at, scene.bodies[i].position) > 0.5 + 0.0075 * scene.bodies[i].position.y;
        if (scene.bodies[i].position.y > scene.bodies[top].position.y) top = i;
        fastest = std::max(fastest, distance(at, before[i].position) / scene.dt);
    }
    nlohmann::ordered_json json = {{"not_finite", notFinite}, {"escaped", escaped}};
    if (scene.name == "pyramid" || scene.name == "islands") {
        json["fallen"] = fallen;
        json["apex_sinks"] = scene.bodies[top].position.y - now[top].position.y;
        json["fastest"] = fastest;
        json["drift"] = sideways / static_cast<double>(moving);
    }
    if (scene.name.rfind("bullets", 0) == 0) {
        int passed = 0;
        for (std::size_t i = 0; i < 200; ++i)
            passed += now[i].position.x > now[scene.bodies.size() > 201 ? 200 + i : 200].position.x;
        json["passed"] = passed;
    }
    if (!scene.joints.empty()) json.update(jointErrors(scene, now));
    if (scene.joints.empty() && scene.name != "soft-sheet") json.update(overlaps(scene, now));
    const Energy end = energyOf(scene, before, now);
    json["energy_start"] = energyAtStart(scene).all();
    json["energy_end"] = end.all();
    json["kinetic_end"] = end.kinetic;
    return json;
}

}  // namespace jet::bench
