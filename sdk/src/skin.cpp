#include "skin.hpp"

#include <utility>

namespace jet {

namespace {

struct Edge {
    std::uint32_t a, b;
};

std::vector<Edge> borderEdges(const SoftBodyDef& body)
{
    std::vector<Edge> edges;
    for (const auto& ring : body.borders)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Edge edge{ring[i], ring[(i + 1) % ring.size()]};
            if (edge.a != edge.b && (body.particles[edge.b] - body.particles[edge.a]).squaredNorm() > 1e-18)
                edges.push_back(edge);
        }
    return edges;
}

double squaredDistance(const Vec2& p, const Vec2& a, const Vec2& b)
{
    const Vec2 ab = b - a;
    const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    return (a + t * ab - p).squaredNorm();
}

}  // namespace

Path splitAtIntermediatePoints(Path path)
{
    for (std::size_t c = 0; c < path.contours().size(); ++c)
        for (std::size_t i = 0; i < path.contours()[c].curveCount(); ++i) {
            const int count = std::exchange(path.contours()[c].segments[i].intermediate, 0);
            for (int left = count; left > 0; --left, ++i) path.split(c, i, 1.0 / (left + 1));
        }
    return path;
}

Skin::Skin(const Path& path, const SoftBodyDef& body) : rest_(splitAtIntermediatePoints(path))
{
    const std::vector<Edge> edges = borderEdges(body);
    const auto bind = [&](const Vec2& p) {
        Binding binding;
        binding.rest = p;
        double best = std::numeric_limits<double>::infinity();
        for (const Edge& edge : edges) {
            const Vec2& a = body.particles[edge.a];
            const Vec2& b = body.particles[edge.b];
            const double distance = squaredDistance(p, a, b);
            if (distance >= best) continue;
            best = distance;
            const Vec2 ab = b - a;
            binding.a = edge.a, binding.b = edge.b;
            binding.u = (p - a).dot(ab) / ab.squaredNorm();
            binding.v = (p - a).dot(perpendicular(ab)) / ab.squaredNorm();
        }
        bindings_.push_back(binding);
    };
    for (const Contour& contour : rest_.contours())
        for (const Segment& segment : contour.segments) bind(segment.point), bind(segment.in), bind(segment.out);
}

Path Skin::deformed(std::span<const Vec2> particles) const
{
    Path path = rest_;
    auto binding = bindings_.begin();
    const auto place = [&](Vec2& p) {
        const Binding& at = *binding++;
        if (at.a == kNoHandle) return;
        const Vec2& a = particles[at.a];
        const Vec2 ab = particles[at.b] - a;
        p = a + at.u * ab + at.v * perpendicular(ab);
    };
    for (Contour& contour : path.contours())
        for (Segment& segment : contour.segments) place(segment.point), place(segment.in), place(segment.out);
    return path;
}

}  // namespace jet
