// Convex rings are cut into fans. Others are cut at the height of each corner and crossing into trapezoids, those
// between the same two sides are put together again, and then neighbours whose union is convex (Hertel-Mehlhorn's
// idea).
#include "convex_parts.hpp"

#include "validation.hpp"

#include <optional>

namespace jet::box2d {

namespace {

constexpr std::size_t kMostCorners = 8;        // b2_maxPolygonVertices
constexpr std::size_t kMostTrapezoids = 3000;  // joining neighbours takes time by their square
constexpr double kThin = 0.06;                 // scene units: Box2D takes points nearer than 0.025 for one

struct Side {
    Vec2 top, bottom;
    double at(double y) const
    {
        const double height = bottom.y() - top.y();
        return top.x() + (y - top.y()) / height * (bottom.x() - top.x());
    }
};

struct Trapezoid {
    std::size_t left = 0, right = 0;  // indices of sides
    double from = 0, to = 0;          // y
};

bool isConvex(const Ring& ring)
{
    const double side = twiceArea(ring) < 0 ? -1 : 1;
    double extent = 0, turned = 0;
    for (const Vec2& p : ring) extent = std::max(extent, (p - ring[0]).squaredNorm());
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[(i + 1) % ring.size()] - ring[i];
        const Vec2 b = ring[(i + 2) % ring.size()] - ring[(i + 1) % ring.size()];
        if (side * cross(a, b) < -1e-9 * extent) return false;
        turned += std::atan2(side * cross(a, b), a.dot(b));
    }
    return turned < 7;  // once around is 2 pi; a star goes round twice
}

/// Corners that lie on the line between their neighbours, or on them, are left out.
Ring simplified(const Ring& ring)
{
    Ring out;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2& before = out.empty() ? ring.back() : out.back();
        const Vec2 in = ring[i] - before, on = ring[(i + 1) % ring.size()] - ring[i];
        if (in.norm() < 1e-9) continue;
        if (std::abs(cross(in, on)) <= 1e-9 * in.norm() * on.norm() && in.dot(on) > 0) continue;
        out.push_back(ring[i]);
    }
    return out;
}

void addFan(std::vector<Ring>& parts, const Ring& ring)
{
    for (std::size_t from = 1; from + 1 < ring.size(); from += kMostCorners - 2) {
        Ring part{ring[0]};
        for (std::size_t i = from; i < std::min(ring.size(), from + kMostCorners - 1); ++i) part.push_back(ring[i]);
        parts.push_back(std::move(part));
    }
}

std::vector<Side> sidesOf(const Rings& rings)
{
    std::vector<Side> sides;
    for (const Ring& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
            if (a.y() != b.y()) sides.push_back(a.y() < b.y() ? Side{a, b} : Side{b, a});
        }
    return sides;
}

/// Heights at which something changes, the near ones as one.
std::vector<double> levelsOf(const Rings& rings, const std::vector<Side>& sides, bool crossing)
{
    std::vector<double> levels;
    for (const Ring& ring : rings)
        for (const Vec2& p : ring) levels.push_back(p.y());
    for (std::size_t i = 0; crossing && i < sides.size(); ++i)
        for (std::size_t k = i + 1; k < sides.size(); ++k) {
            const Vec2 a = sides[i].bottom - sides[i].top, b = sides[k].bottom - sides[k].top;
            const double across = cross(a, b);
            if (across == 0) continue;
            const double s = cross(sides[k].top - sides[i].top, b) / across;
            const double t = cross(sides[k].top - sides[i].top, a) / across;
            if (s > 0 && s < 1 && t > 0 && t < 1) levels.push_back(sides[i].top.y() + s * a.y());
        }
    std::sort(levels.begin(), levels.end());
    std::vector<double> apart;
    for (const double y : levels)
        if (apart.empty() || y - apart.back() > 0.5 * kThin) apart.push_back(y);
    return apart;
}

std::vector<Trapezoid> trapezoidsOf(const std::vector<Side>& sides, const std::vector<double>& levels)
{
    std::vector<Trapezoid> all;
    std::vector<std::size_t> open;  // those of the slab above, which may go on
    for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
        const double middle = 0.5 * (levels[l] + levels[l + 1]);
        std::vector<std::size_t> met;
        for (std::size_t s = 0; s < sides.size(); ++s)
            if (sides[s].top.y() <= middle && sides[s].bottom.y() > middle) met.push_back(s);
        std::sort(met.begin(), met.end(),
                  [&](std::size_t a, std::size_t b) { return sides[a].at(middle) < sides[b].at(middle); });
        std::vector<std::size_t> here;
        for (std::size_t i = 0; i + 1 < met.size(); i += 2) {
            const auto same = std::find_if(open.begin(), open.end(), [&](std::size_t t) {
                return all[t].left == met[i] && all[t].right == met[i + 1];
            });
            if (same != open.end()) {
                all[*same].to = levels[l + 1];
                here.push_back(*same);
            } else {
                here.push_back(all.size());
                all.push_back({met[i], met[i + 1], levels[l], levels[l + 1]});
            }
        }
        open = std::move(here);
    }
    return all;
}

Ring ringOf(const Trapezoid& t, const std::vector<Side>& sides)
{
    const Side &left = sides[t.left], &right = sides[t.right];
    const Ring corners{
        {left.at(t.from), t.from}, {right.at(t.from), t.from}, {right.at(t.to), t.to}, {left.at(t.to), t.to}};
    return simplified(corners);
}

/// The union of two parts that share a whole side, if it is convex and small enough.
std::optional<Ring> joined(const Ring& a, const Ring& b)
{
    const auto same = [](const Vec2& p, const Vec2& q) { return (p - q).squaredNorm() < 1e-12; };
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < b.size(); ++k) {
            if (!same(a[i], b[(k + 1) % b.size()]) || !same(a[(i + 1) % a.size()], b[k])) continue;
            Ring both;
            for (std::size_t n = 0; n < a.size(); ++n) both.push_back(a[(i + 1 + n) % a.size()]);
            for (std::size_t n = 2; n < b.size(); ++n) both.push_back(b[(k + n) % b.size()]);
            both = simplified(both);
            if (both.size() <= kMostCorners && isConvex(both)) return both;
        }
    return std::nullopt;
}

void joinNeighbours(std::vector<Ring>& parts)
{
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t k = i + 1; k < parts.size();) {
            auto both = joined(parts[i], parts[k]);
            if (!both) {
                ++k;
                continue;
            }
            parts[i] = std::move(*both);
            parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(k));
            k = i + 1;
        }
}

/// Box2D's hull of the part must keep three corners and an area.
bool isThick(const Ring& ring)
{
    if (ring.size() < 3) return false;
    double longest = 0;
    for (const Vec2& p : ring)
        for (const Vec2& q : ring) longest = std::max(longest, (p - q).norm());
    return longest > kThin && std::abs(twiceArea(ring)) / longest > kThin;
}

}  // namespace

std::vector<Ring> convexParts(const Rings& rings)
{
    std::vector<Ring> parts;
    if (rings.size() == 1 && isConvex(rings[0])) {
        addFan(parts, simplified(rings[0]));
    } else {
        const std::vector<Side> sides = sidesOf(rings);
        const std::vector<Trapezoid> trapezoids = trapezoidsOf(sides, levelsOf(rings, sides, sidesCross(rings)));
        if (trapezoids.size() > kMostTrapezoids)
            fail("the body's outline is too intricate: it comes to more than " + std::to_string(kMostTrapezoids) +
                 " trapezoids, which takes too long to put together; draw it with fewer corners and crossings.");
        for (const Trapezoid& t : trapezoids) parts.push_back(ringOf(t, sides));
        joinNeighbours(parts);
    }
    std::erase_if(parts, [](const Ring& part) { return !isThick(part); });
    return parts;
}

}  // namespace jet::box2d
