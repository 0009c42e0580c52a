#include "bench/physics/quality_soft.hpp"

#include <algorithm>
#include <cmath>

namespace jet::bench {

namespace {

double areaOf(const std::vector<Point>& ring)
{
    double area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point &p = ring[i], &q = ring[(i + 1) % ring.size()];
        area += 0.5 * (p.x * q.y - p.y * q.x);
    }
    return area;
}

bool inside(const std::vector<Point>& ring, const Point& at)
{
    bool in = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point &p = ring[i], &q = ring[(i + 1) % ring.size()];
        if ((p.y > at.y) != (q.y > at.y) && at.x < p.x + (at.y - p.y) / (q.y - p.y) * (q.x - p.x)) in = !in;
    }
    return in;
}

/// From the corners of one to the sides of the other.
double apart(const std::vector<Point>& corners, const std::vector<Point>& ring)
{
    double least = 1e300;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point &p = ring[i], &q = ring[(i + 1) % ring.size()];
        const double dx = q.x - p.x, dy = q.y - p.y, square = dx * dx + dy * dy;
        for (const Point& at : corners) {
            const double along = square > 0 ? ((at.x - p.x) * dx + (at.y - p.y) * dy) / square : 0;
            const double t = std::clamp(along, 0.0, 1.0);
            least = std::min(least, std::hypot(p.x + t * dx - at.x, p.y + t * dy - at.y));
        }
    }
    return least;
}

/// An outline's particles reach out of it by their radius; a centimetre between two of them is still a touch: engines
/// keep so much or less between bodies, or let them sink in.
constexpr double kTouch = 0.01;

nlohmann::ordered_json touches(const Scene& scene, const std::vector<std::vector<Point>>& rings)
{
    const double reach = 2 * scene.bodies[scene.soft[0].first].shapes.at(0).radius + kTouch;
    std::vector<int> neighbours(rings.size(), 0);
    int pairs = 0;
    for (std::size_t a = 0; a < rings.size(); ++a) {
        for (std::size_t b = a + 1; b < rings.size(); ++b) {
            if (std::min(apart(rings[a], rings[b]), apart(rings[b], rings[a])) > reach) continue;
            ++pairs, ++neighbours[a], ++neighbours[b];
        }
    }
    return {{"touching", pairs}, {"touching_none", std::count(neighbours.begin(), neighbours.end(), 0)}};
}

std::vector<Point> outline(const SceneSoft& soft, const std::vector<Pose>& now)
{
    std::vector<Point> ring;
    for (std::uint32_t i = 0; i < soft.ring; ++i) ring.push_back(now[soft.first + i].position);
    return ring;
}

bool hasOutlines(const Scene& scene)
{
    return std::any_of(scene.soft.begin(), scene.soft.end(), [](const SceneSoft& soft) { return soft.ring > 0; });
}

}  // namespace

SoftWatch::SoftWatch(const Scene& scene) : scene_(scene)
{
    if (scene.soft.empty() || hasOutlines(scene)) return;
    double lowest = 1e300;
    for (const SceneBody& body : scene.bodies) lowest = std::min(lowest, body.position.y);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (scene.bodies[i].position.y < lowest + 0.01 && scene.bodies[i].type == SceneBody::Type::Dynamic)
            bottom_.push_back(i);
}

void SoftWatch::see(const Engine& engine)
{
    if (bottom_.empty()) return;
    double height = 0;
    for (const std::size_t body : bottom_) height += engine.pose(body).position.y;
    sum_ += height / static_cast<double>(bottom_.size());
    ++steps_;
}

nlohmann::ordered_json SoftWatch::quality(const std::vector<Pose>& now) const
{
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    if (steps_ > 0) json["mean_bottom_height"] = sum_ / steps_;
    if (!hasOutlines(scene_)) return json;
    std::vector<Pose> before;
    for (const SceneBody& body : scene_.bodies) before.push_back({body.position, body.angle});
    double ratios = 0, least = 1e300;
    int inverted = 0, merged = 0;
    std::vector<std::vector<Point>> rings;
    for (const SceneSoft& soft : scene_.soft) {
        rings.push_back(outline(soft, now));
        const double ratio = areaOf(rings.back()) / areaOf(outline(soft, before));
        ratios += ratio, least = std::min(least, ratio), inverted += !(ratio > 0);
    }
    // The last particle of a ball is its middle: in another ball's outline it has come in where it never should.
    for (std::size_t a = 0; a < rings.size(); ++a)
        for (std::size_t b = 0; b < rings.size(); ++b)
            merged += a != b && inside(rings[b], now[scene_.soft[a].first + scene_.soft[a].count - 1].position);
    json["mean_area"] = ratios / static_cast<double>(rings.size());
    json["least_area"] = least;
    json["inverted"] = inverted;
    json["merged"] = merged;
    json.update(touches(scene_, rings));
    return json;
}

}  // namespace jet::bench
