// Touching points of two rounded convex parts, by separating axes and clipping (Catto, "Contact manifolds", GDC 2007).
#include "manifold.hpp"

#include "look.hpp"

#include <algorithm>
#include <cmath>

namespace jet::physics {

namespace manifold {

/// The nearest points of the segments p1 q1 and p2 q2 (Ericson, "Real-Time Collision Detection", 5.1.9).
Nearest nearestOfSegments(Vec2f p1, Vec2f q1, Vec2f p2, Vec2f q2)
{
    const Vec2f d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
    const float a = dot(d1, d1), e = dot(d2, d2), f = dot(d2, r), c = dot(d1, r), b = dot(d1, d2);
    const auto unit = [](float x) { return std::clamp(x, 0.0F, 1.0F); };
    Nearest n;
    if (a <= 0 && e <= 0) {
        n.alongA = n.alongB = 0;
    } else if (a <= 0) {
        n.alongB = unit(f / e);
    } else if (e <= 0) {
        n.alongA = unit(-c / a);
    } else {
        const float denominator = a * e - b * b;
        if (denominator > 1e-6F * a * e) n.alongA = unit((b * f - c * e) / denominator);
        n.alongB = (b * n.alongA + f) / e;
        if (n.alongB < 0) {
            n.alongB = 0, n.alongA = unit(-c / a);
        } else if (n.alongB > 1) {
            n.alongB = 1, n.alongA = unit((b - c) / a);
        }
    }
    n.onA = p1 + n.alongA * d1, n.onB = p2 + n.alongB * d2;
    return n;
}

/// The side of `a` that the other's corners lie farthest out of; `separation`: how far. Empty for points.
template <class A, class B>
int farthestSide(const A& a, const B& b, float& separation)
{
    int best = 0;
    separation = -3e38F;
    for (int first = 0; first < a.count; first += 4) {
        // Four sides at once against each corner; those beyond the last are not looked at.
        const auto x = [](Four p, Four q) { return __builtin_shufflevector(p, q, 0, 2, 4, 6); };
        const auto y = [](Four p, Four q) { return __builtin_shufflevector(p, q, 1, 3, 5, 7); };
        const Four n0 = load(&a.normals[first]), n1 = load(&a.normals[first + 2]);
        const Four c0 = load(&a.corners[first]), c1 = load(&a.corners[first + 2]);
        const Four nx = x(n0, n1), ny = y(n0, n1), offset = nx * x(c0, c1) + ny * y(c0, c1);
        Four least = nx * b.corners[0].x + ny * b.corners[0].y;
        for (int j = 1; j < b.count; ++j) {
            const Four along = nx * b.corners[j].x + ny * b.corners[j].y;
            least = along < least ? along : least;
        }
        least -= offset;
        for (int i = 0; i < 4 && first + i < a.count; ++i)
            if (least[i] > separation) separation = least[i], best = first + i;
    }
    return best;
}

ManifoldPoint pointOf(Vec2f onA, Vec2f onB, const Relative& at, float separation, int featureA, int featureB)
{
    ManifoldPoint p;
    p.onA = onA;
    p.onB = turnedBack(at.turn, onB - at.move);
    p.separation = separation;
    p.id = static_cast<std::uint16_t>(featureA << 8 | featureB);
    return p;
}

/// One point between two corners (or centres) that lie apart.
Manifold betweenPoints(Vec2f a, Vec2f b, float radiusA, float radiusB, const Relative& at, float reach, Vec2f fallback,
                       int featureA, int featureB)
{
    Manifold m;
    const Vec2f apart = b - a;
    const float squared = dot(apart, apart), radius = radiusA + radiusB;
    const float length = std::sqrt(squared);
    m.gap = length - radius;
    if (squared > (radius + reach) * (radius + reach)) return m;
    m.normal = length > 1e-12F ? (1 / length) * apart : fallback;
    m.count = 1;
    m.points[0] = pointOf(a + radiusA * m.normal, b - radiusB * m.normal, at, length - radius, featureA, featureB);
    return m;
}

/// A polygon or segment and a rounded point.
template <class A>
Manifold withPoint(const A& a, float radiusA, Vec2f b, float radiusB, const Relative& at, float reach)
{
    int best = 0;
    float separation = -3e38F;
    for (int i = 0; i < a.count; ++i) {
        const float s = dot(a.normals[i], b - a.corners[i]);
        if (s > separation) separation = s, best = i;
    }
    Manifold m;
    m.gap = separation - radiusA - radiusB;
    if (separation > reach + radiusA + radiusB) return m;
    const int next = best + 1 < a.count ? best + 1 : 0;
    const Vec2f v1 = a.corners[best], v2 = a.corners[next], normal = a.normals[best];
    if (separation > 1e-7F) {
        if (dot(b - v1, v2 - v1) < 0) return betweenPoints(v1, b, radiusA, radiusB, at, reach, normal, best, 0);
        if (dot(b - v2, v1 - v2) < 0) return betweenPoints(v2, b, radiusA, radiusB, at, reach, normal, next, 0);
    }
    m.normal = normal;
    m.count = 1;
    m.points[0] = pointOf(b + (radiusA - separation) * normal, b - radiusB * normal, at, separation - radiusA - radiusB,
                          0x40 + best, 0);
    return m;
}

Manifold reversed(Manifold m, const Relative& at)
{
    // Was found in B's frame as (B, A): normal from B to A there.
    m.normal = turned(at.turn, -m.normal);
    for (int i = 0; i < m.count; ++i) {
        ManifoldPoint& p = m.points[i];
        std::swap(p.onA, p.onB);
        p.id = static_cast<std::uint16_t>(p.id << 8 | p.id >> 8);
    }
    return m;
}

Relative inverse(const Relative& at)
{
    Relative back;
    back.turn = {at.turn.x, -at.turn.y};
    back.move = -turnedBack(at.turn, at.move);
    return back;
}

/// The incident side clipped to the reference side; `flipped`: the reference is B's.
Manifold clip(Vec2f r1, Vec2f r2, Vec2f normal, float radiusR, Vec2f i1, Vec2f i2, float radiusI, const Relative& at,
              float reach, bool flipped, const int (&features)[4])
{
    Manifold m;
    const Vec2f tangent{-normal.y, normal.x};
    const float lower = dot(tangent, r1), upper = dot(tangent, r2);
    // The incident side runs against the reference's.
    const float a = dot(tangent, i1), b = dot(tangent, i2);
    Vec2f p1 = i2, p2 = i1;  // nearest the reference's first, second corner
    if (b < lower && a - b > 1e-9F) p1 = i2 + ((lower - b) / (a - b)) * (i1 - i2);
    if (a > upper && a - b > 1e-9F) p2 = i2 + ((upper - b) / (a - b)) * (i1 - i2);
    const float radius = radiusR + radiusI;
    const auto add = [&](Vec2f onIncident, int featureR, int featureI) {
        const float separation = dot(normal, onIncident - r1);
        if (separation > reach + radius) return;
        const Vec2f onR = onIncident + (radiusR - separation) * normal, onI = onIncident - radiusI * normal;
        m.points[m.count++] = flipped ? pointOf(onI, onR, at, separation - radius, featureI, featureR)
                                      : pointOf(onR, onI, at, separation - radius, featureR, featureI);
    };
    add(p1, features[0], features[3]);
    add(p2, features[1], features[2]);
    m.normal = flipped ? -normal : normal;
    return m;
}

static Manifold sides(const Part& a, const Placed& b, const Relative& at, float reach)
{
    float separationA = 0, separationB = 0;
    int sideA = farthestSide(a, b, separationA);
    const float radius = a.radius + b.radius;
    Manifold none;
    none.gap = separationA - radius;
    if (separationA > reach + radius) return none;
    int sideB = farthestSide(b, a, separationB);
    none.gap = separationB - radius;
    if (separationB > reach + radius) return none;
    // A prefers its own sides, so that the choice does not change from step to step.
    const bool flipped = separationB > separationA + 1e-3F * std::min(a.length, 1e6F);
    if (flipped) {
        sideA = mostOpposed(a, b.normals[sideB]);
    } else {
        sideB = mostOpposed(b, a.normals[sideA]);
    }
    const int nextA = (sideA + 1) % a.count, nextB = (sideB + 1) % b.count;
    const Vec2f a1 = a.corners[sideA], a2 = a.corners[nextA], b1 = b.corners[sideB], b2 = b.corners[nextB];
    const float separation = std::max(separationA, separationB);
    if (separation > 1e-4F * a.length) {
        // Apart: corners may be farther from each other than any side says. Where they are not, two sides face each
        // other whose corners lie opposite; they meet at both ends at once.
        const Nearest n = nearestOfSegments(a1, a2, b1, b2);
        const bool cornerA = n.alongA == 0 || n.alongA == 1, cornerB = n.alongB == 0 || n.alongB == 1;
        if (cornerA && cornerB && dot(n.onB - n.onA, n.onB - n.onA) > 1.001F * separation * separation) {
            Manifold m = betweenPoints(n.onA, n.onB, a.radius, b.radius, at, reach, a.normals[sideA],
                                       n.alongA == 0 ? sideA : nextA, n.alongB == 0 ? sideB : nextB);
            m.gap = separation - radius;  // other corners may be nearer
            return m;
        }
    }
    if (flipped)
        return clip(b1, b2, b.normals[sideB], b.radius, a1, a2, a.radius, at, reach, true,
                    {sideB, nextB, sideA, nextA});
    return clip(a1, a2, a.normals[sideA], a.radius, b1, b2, b.radius, at, reach, false, {sideA, nextA, sideB, nextB});
}

}  // namespace manifold

using namespace manifold;

Manifold collide(const Part& a, const Part& b, const Relative& at, float reach)
{
    if (a.count == 1) {
        if (b.count == 1)
            return betweenPoints(a.corners[0], at.move + turned(at.turn, b.corners[0]), a.radius, b.radius, at, reach,
                                 {1, 0}, 0, 0);
        const Relative back = inverse(at);
        return reversed(withPoint(b, b.radius, back.move + turned(back.turn, a.corners[0]), a.radius, back, reach), at);
    }
    if (b.count == 1) return withPoint(a, a.radius, at.move + turned(at.turn, b.corners[0]), b.radius, at, reach);
    return sides(a, Placed(b, at), at, reach);
}

Distance distanceOf(const Part& a, const Part& b, const Relative& at, const Looker& looker)
{
    const SidePoints nearest = looker.nearestSides(a, b, at);
    Distance d;
    d.onA = nearest.onA, d.onB = nearest.onB;
    const Placed placed(b, at);
    float inside = 3e38F;
    Vec2f normal{1, 0};
    if (a.count > 2 || placed.count > 2) {
        float separationA = -3e38F, separationB = -3e38F;
        const int sideA = a.count > 1 ? farthestSide(a, placed, separationA) : 0;
        const int sideB = placed.count > 1 ? farthestSide(placed, a, separationB) : 0;
        inside = std::max(separationA, separationB);
        normal = separationA >= separationB ? a.normals[sideA] : -placed.normals[sideB];
    }
    const float length = std::sqrt(nearest.squared);
    d.distance = (inside < 0 ? inside : length) - a.radius - b.radius;
    d.normal = inside < 0 || length < 1e-12F ? normal : (1 / length) * (d.onB - d.onA);
    d.onA = d.onA + a.radius * d.normal, d.onB = d.onB - b.radius * d.normal;
    return d;
}

}  // namespace jet::physics
