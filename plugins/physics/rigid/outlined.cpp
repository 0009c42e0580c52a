#include "outlined.hpp"

#include "manifold.hpp"

#include <algorithm>
#include <cmath>

namespace jet::physics {

namespace {

using namespace manifold;

constexpr float kLean = 0.002F;   // radians, about: how far a direction may lie beyond those of a corner
constexpr float kDeepSlops = 2;   // deeper than this an axis must stand its comparison with those that do not count
constexpr float kDeepest = 4;     // ... by this factor
constexpr float kSlop = 0.002F;   // of the length, as in collider.cpp
constexpr float kOnSeam = 1e-5F;  // of the length: on the line of a seam both parts answer

/// May the corner be touched from direction n (unit, in the part's frame)?
bool faces(const Part& part, const PartOutline* outline, int corner, Vec2f n)
{
    if (outline == nullptr) return true;
    const int previous = (corner + part.count - 1) % part.count;
    const auto along = [&](int side) {
        return (outline->inner >> side & 1) == 0 && dot(part.normals[side], n) > 1 - 0.5F * kLean * kLean;
    };
    if (along(corner) || along(previous)) return true;
    const Vec2f before = outline->before[corner], after = outline->after[corner];
    return dot(before + after, n) > 0 && cross(before, n) >= -kLean && cross(n, after) >= -kLean;
}

/// The axes of a pair: the best that counts, and the best that does not.
struct Axes {
    float best = -3e38F, other = -3e38F;
    int side = -1;
    bool ofB = false;
    bool behind = false;  // the other part lies wholly behind the side
    bool apart = false;
};

/// Looks at the sides of `a` against b's corners. `toB` turns directions into b's own frame.
template <class A, class B, class ToB>
void lookAt(const A& a, const Part& partA, const PartOutline* outlineA, const B& b, const Part& partB,
            const PartOutline* outlineB, ToB&& toB, float reach, bool ofB, Axes& axes)
{
    const float seam = kOnSeam * partA.length, radius = partA.radius + partB.radius;
    for (int i = 0; i < a.count && !axes.apart; ++i) {
        const Vec2f n = a.normals[i];
        const float offset = dot(n, a.corners[i]);
        float least = 3e38F, most = -3e38F;
        int support = 0;
        for (int k = 0; k < b.count; ++k) {
            const float s = dot(n, b.corners[k]) - offset;
            if (s < least) least = s, support = k;
            most = std::max(most, s);
        }
        if (least > reach + radius) axes.apart = true;
        if (outlineA != nullptr && (outlineA->inner >> i & 1) != 0) {
            // What lies beyond a side within is the matter of the part there.
            if (least > seam) axes.apart = true;
            axes.other = std::max(axes.other, least);
            continue;
        }
        if (!faces(partB, outlineB, support, toB(-n))) {
            axes.other = std::max(axes.other, least);
            continue;
        }
        // A prefers its own sides, so that the choice does not change from step to step.
        if (least > axes.best + (ofB ? 1e-3F * std::min(partA.length, partB.length) : 0.0F))
            axes.best = least, axes.side = i, axes.ofB = ofB, axes.behind = most + partB.radius < 0;
    }
}

/// Is the best axis one through which the other part can have come?
bool plausible(const Axes& axes, float length)
{
    if (axes.side < 0) return false;
    if (axes.best >= axes.other || axes.best > 0) return true;
    if (axes.other > kOnSeam * length) return false;  // apart, and what is nearest is the neighbour's
    if (axes.behind) return false;
    return -axes.best <= kDeepSlops * kSlop * length || -axes.best <= -kDeepest * axes.other;
}

Manifold sides(const Part& a, const PartOutline* outlineA, const Part& partB, const PartOutline* outlineB,
               const Relative& at, float reach)
{
    const Placed b(partB, at);
    const auto same = [](Vec2f v) { return v; };
    const auto intoB = [&](Vec2f v) { return turnedBack(at.turn, v); };
    Axes axes;
    lookAt(a, a, outlineA, b, partB, outlineB, intoB, reach, false, axes);
    lookAt(b, partB, outlineB, a, a, outlineA, same, reach, true, axes);
    const float length = std::min(a.length, partB.length);
    if (axes.apart || !plausible(axes, length)) return {};
    const int sideA = axes.ofB ? mostOpposed(a, b.normals[axes.side]) : axes.side;
    const int sideB = axes.ofB ? axes.side : mostOpposed(b, a.normals[axes.side]);
    const int nextA = (sideA + 1) % a.count, nextB = (sideB + 1) % b.count;
    const Vec2f a1 = a.corners[sideA], a2 = a.corners[nextA], b1 = b.corners[sideB], b2 = b.corners[nextB];
    if (axes.best > 1e-4F * length) {
        const Nearest n = nearestOfSegments(a1, a2, b1, b2);
        if ((n.alongA == 0 || n.alongA == 1) && (n.alongB == 0 || n.alongB == 1)) {
            const int cornerA = n.alongA == 0 ? sideA : nextA, cornerB = n.alongB == 0 ? sideB : nextB;
            const Manifold m =
                betweenPoints(n.onA, n.onB, a.radius, b.radius, at, reach, a.normals[sideA], cornerA, cornerB);
            const bool met = m.count > 0 && faces(a, outlineA, cornerA, m.normal) &&
                             faces(partB, outlineB, cornerB, intoB(-m.normal));
            return met ? m : Manifold();
        }
    }
    // Beside each other there is nothing to clip.
    const Vec2f r1 = axes.ofB ? b1 : a1, r2 = axes.ofB ? b2 : a2, i1 = axes.ofB ? a1 : b1, i2 = axes.ofB ? a2 : b2;
    const Vec2f n = axes.ofB ? b.normals[sideB] : a.normals[sideA], tangent{-n.y, n.x};
    const float first = dot(tangent, i1), second = dot(tangent, i2), seam = kOnSeam * length;
    if (std::max(first, second) < dot(tangent, r1) - seam || std::min(first, second) > dot(tangent, r2) + seam)
        return {};
    if (axes.ofB)
        return clip(b1, b2, b.normals[sideB], b.radius, a1, a2, a.radius, at, reach, true,
                    {sideB, nextB, sideA, nextA});
    return clip(a1, a2, a.normals[sideA], a.radius, b1, b2, b.radius, at, reach, false, {sideA, nextA, sideB, nextB});
}

/// A disc about `b`, in a's frame.
Manifold withDisc(const Part& a, const PartOutline& outline, Vec2f b, const Part& disc, const Relative& at, float reach)
{
    float best = -3e38F, other = -3e38F;
    int side = -1;
    for (int i = 0; i < a.count; ++i) {
        const float s = dot(a.normals[i], b - a.corners[i]);
        if ((outline.inner >> i & 1) == 0) {
            if (s > best) best = s, side = i;
            continue;
        }
        if (s > kOnSeam * a.length) return {};
        other = std::max(other, s);
    }
    const float radius = a.radius + disc.radius, slop = kDeepSlops * kSlop * disc.length;
    if (side < 0 || best > reach + radius) return {};
    if (best < other && -best > slop && (best + disc.radius < 0 || -best > -kDeepest * other)) return {};
    const int next = (side + 1) % a.count;
    const Vec2f v1 = a.corners[side], v2 = a.corners[next], normal = a.normals[side];
    if (best > 1e-7F) {
        const int corner = dot(b - v1, v2 - v1) < 0 ? side : dot(b - v2, v1 - v2) < 0 ? next : -1;
        if (corner >= 0) {
            const Manifold m = betweenPoints(a.corners[corner], b, a.radius, disc.radius, at, reach, normal, corner, 0);
            return m.count > 0 && faces(a, &outline, corner, m.normal) ? m : Manifold();
        }
    }
    Manifold m;
    m.normal = normal;
    m.count = 1;
    m.points[0] = pointOf(b + (a.radius - best) * normal, b - disc.radius * normal, at, best - radius, 0x40 + side, 0);
    return m;
}

}  // namespace

Manifold collideOutlined(const Part& a, const PartOutline* outlineA, const Part& b, const PartOutline* outlineB,
                         const Relative& at, float reach)
{
    if (a.count == 1) {
        const Relative back = inverse(at);
        return reversed(withDisc(b, *outlineB, back.move + turned(back.turn, a.corners[0]), a, back, reach), at);
    }
    if (b.count == 1) return withDisc(a, *outlineA, at.move + turned(at.turn, b.corners[0]), b, at, reach);
    return sides(a, outlineA, b, outlineB, at, reach);
}

}  // namespace jet::physics
