#include "triangulate.hpp"

#include "slabs.hpp"

#include <jet/result.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace jet::physics {

namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - b); }

double signedArea(const Ring& ring)
{
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        twice += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
    return 0.5 * twice;
}

bool insideRing(const Ring& ring, const Vec2& at)
{
    bool inside = false;
    for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++) {
        const Vec2 &a = ring[i], &b = ring[k];
        if ((a.y() > at.y()) != (b.y() > at.y()) &&
            at.x() < (b.x() - a.x()) * (at.y() - a.y()) / (b.y() - a.y()) + a.x())
            inside = !inside;
    }
    return inside;
}

/// Do the closed segments meet?
bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const double s = turn(a, b, c), t = turn(a, b, d), u = turn(c, d, a), v = turn(c, d, b);
    if (s != 0 || t != 0 || u != 0 || v != 0) return s * t <= 0 && u * v <= 0;
    for (int axis = 0; axis < 2; ++axis)
        if (std::max(a[axis], b[axis]) < std::min(c[axis], d[axis]) ||
            std::max(c[axis], d[axis]) < std::min(a[axis], b[axis]))
            return false;
    return true;
}

struct Side {
    Vec2 a, b;
    std::size_t ring, index, count;
};

/// Neighbours share a corner; they touch elsewhere only when one runs back over the other.
bool touch(const Side& p, const Side& q)
{
    if (p.ring == q.ring && (p.index + 1) % p.count == q.index)
        return turn(p.a, p.b, q.b) == 0 && (p.b - p.a).dot(q.b - q.a) < 0;
    if (p.ring == q.ring && (q.index + 1) % q.count == p.index)
        return turn(q.a, q.b, p.b) == 0 && (q.b - q.a).dot(p.b - p.a) < 0;
    return meet(p.a, p.b, q.a, q.b);
}

std::vector<int> depthsOf(const std::vector<Ring>& rings)
{
    std::vector<int> depths(rings.size(), 0);
    for (std::size_t i = 0; i < rings.size(); ++i)
        for (std::size_t k = 0; k < rings.size(); ++k)
            if (i != k) depths[i] += insideRing(rings[k], rings[i][0]);
    return depths;
}

/// Clips ears off one ring of a mesh's points, in which bridges may make a point occur more than once.
class EarClipper {
public:
    EarClipper(Mesh& mesh, std::vector<std::uint32_t> ring) : mesh_(mesh), ring_(std::move(ring)) {}

    /// False when no ear was left: the ring is not simple.
    bool clip()
    {
        const std::size_t count = ring_.size();
        if (count < 3) return false;
        next_.resize(count), previous_.resize(count), reflex_.resize(count);
        for (std::size_t i = 0; i < count; ++i) next_[i] = (i + 1) % count, previous_[i] = (i + count - 1) % count;
        for (std::size_t i = 0; i < count; ++i) reflex_[i] = !(turnAt(i) > 0);
        std::size_t left = count, at = 0, failures = 0;
        while (left > 3) {
            if (isEar(at)) {
                cut(at);
                --left;
                failures = 0;
                at = next_[next_[at]];  // skipping one keeps fans from forming
                continue;
            }
            at = next_[at];
            if (++failures > left) return false;
        }
        cut(at);
        return true;
    }

private:
    const Vec2& point(std::size_t node) const { return mesh_.points[ring_[node]]; }
    double turnAt(std::size_t node) const { return turn(point(previous_[node]), point(node), point(next_[node])); }

    bool isEar(std::size_t node) const
    {
        if (reflex_[node]) return false;
        const std::size_t before = previous_[node], after = next_[node];
        const Vec2 &a = point(before), &b = point(node), &c = point(after);
        for (std::size_t other = next_[after]; other != before; other = next_[other]) {
            if (!reflex_[other]) continue;
            const std::uint32_t index = ring_[other];
            if (index == ring_[before] || index == ring_[node] || index == ring_[after]) continue;
            const Vec2& p = point(other);
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
        }
        return true;
    }

    void cut(std::size_t node)
    {
        const std::size_t before = previous_[node], after = next_[node];
        if (turnAt(node) > 0) mesh_.triangles.push_back({ring_[before], ring_[node], ring_[after]});
        next_[before] = after, previous_[after] = before;
        for (const std::size_t end : {before, after}) reflex_[end] = !(turnAt(end) > 0);
    }

    Mesh& mesh_;
    std::vector<std::uint32_t> ring_;
    std::vector<std::size_t> next_, previous_;
    std::vector<std::uint8_t> reflex_;
};

/// Where a bridge from the hole's rightmost point may reach the ring: a corner that is seen from it (Eberly,
/// "Triangulation by Ear Clipping", 2002). Size of the ring where there is none.
std::size_t bridgeEnd(const Mesh& mesh, const std::vector<std::uint32_t>& ring, const Vec2& from)
{
    const std::size_t count = ring.size();
    const auto at = [&](std::size_t i) -> const Vec2& { return mesh.points[ring[i % count]]; };
    std::size_t best = count;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 &a = at(i), &b = at(i + 1);
        // Of sides that run downwards past the ray the inside is to their left.
        if (!(a.y() <= from.y() && b.y() >= from.y()) || a.y() == b.y()) continue;
        const double x = a.x() + (b.x() - a.x()) * (from.y() - a.y()) / (b.y() - a.y());
        if (x < from.x() || x >= nearest) continue;
        nearest = x;
        best = a.x() > b.x() ? i : (i + 1) % count;
    }
    if (best == count) return count;
    // Corners within the triangle of `from`, the hit and that corner are in the way: the one at the least angle is
    // seen.
    const Vec2 hit(nearest, from.y());
    const Vec2& corner = at(best);
    double least = std::numeric_limits<double>::infinity();
    std::size_t seen = best;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2& p = at(i);
        if (p == corner || turn(at(i + count - 1), p, at(i + 1)) > 0) continue;
        const double s = turn(from, hit, p), t = turn(hit, corner, p), u = turn(corner, from, p);
        if (!((s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0)) || p.x() <= from.x()) continue;
        const double angle = std::abs(p.y() - from.y()) / (p.x() - from.x());
        if (angle < least) least = angle, seen = i;
    }
    return seen;
}

bool addHole(const Mesh& mesh, std::vector<std::uint32_t>& ring, const std::vector<std::uint32_t>& hole)
{
    const auto x = [&](std::uint32_t i) { return mesh.points[i].x(); };
    const auto start = std::max_element(hole.begin(), hole.end(), [&](auto a, auto b) { return x(a) < x(b); });
    const std::size_t end = bridgeEnd(mesh, ring, mesh.points[*start]);
    if (end == ring.size()) return false;
    std::vector<std::uint32_t> detour(start, hole.end());
    detour.insert(detour.end(), hole.begin(), start + 1);
    detour.push_back(ring[end]);
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(end) + 1, detour.begin(), detour.end());
    return true;
}

/// One outer ring with the holes right inside it.
bool clipRegion(Mesh& mesh, const std::vector<Ring>& rings, std::size_t outer, std::vector<std::size_t> holes)
{
    const auto indices = [&](const Ring& ring) {
        std::vector<std::uint32_t> list(ring.size());
        std::iota(list.begin(), list.end(), static_cast<std::uint32_t>(mesh.points.size()));
        mesh.points.insert(mesh.points.end(), ring.begin(), ring.end());
        return list;
    };
    const auto right = [&](std::size_t ring) {
        double most = rings[ring][0].x();
        for (const Vec2& at : rings[ring]) most = std::max(most, at.x());
        return most;
    };
    std::vector<std::uint32_t> ring = indices(rings[outer]);
    std::stable_sort(holes.begin(), holes.end(), [&](std::size_t a, std::size_t b) { return right(a) > right(b); });
    for (const std::size_t hole : holes)
        if (!addHole(mesh, ring, indices(rings[hole]))) return false;
    return EarClipper(mesh, std::move(ring)).clip();
}

bool clipAll(Mesh& mesh, const std::vector<Ring>& rings)
{
    const std::vector<int> depths = depthsOf(rings);
    for (std::size_t i = 0; i < rings.size(); ++i) {
        if (depths[i] % 2 != 0) continue;
        std::vector<std::size_t> holes;
        for (std::size_t k = 0; k < rings.size(); ++k)
            if (depths[k] == depths[i] + 1 && insideRing(rings[i], rings[k][0])) holes.push_back(k);
        if (!clipRegion(mesh, rings, i, std::move(holes))) return false;
    }
    return true;
}

}  // namespace

double Mesh::area() const
{
    double sum = 0;
    for (const Triangle& t : triangles) sum += 0.5 * cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
    return sum;
}

std::vector<Ring> cleaned(const std::vector<Ring>& rings)
{
    Box bounds;
    for (const Ring& ring : rings)
        for (const Vec2& at : ring) bounds.extend(at);
    const double same = bounds.isNull() ? 0 : 1e-9 * bounds.size().maxCoeff();
    std::vector<Ring> kept;
    for (const Ring& ring : rings) {
        Ring clean;
        for (const Vec2& at : ring)
            if (clean.empty() || (at - clean.back()).norm() > same) clean.push_back(at);
        while (clean.size() > 1 && (clean.front() - clean.back()).norm() <= same) clean.pop_back();
        if (clean.size() >= 3) kept.push_back(std::move(clean));
    }
    return kept;
}

bool areSimple(const std::vector<Ring>& rings)
{
    std::vector<Side> sides;
    for (std::size_t r = 0; r < rings.size(); ++r)
        for (std::size_t i = 0; i < rings[r].size(); ++i)
            sides.push_back({rings[r][i], rings[r][(i + 1) % rings[r].size()], r, i, rings[r].size()});
    // Along the axis on which the sides are shorter: fewer lie beside each other.
    Vec2 lengths(0, 0);
    for (const Side& side : sides) lengths += (side.b - side.a).cwiseAbs();
    const int axis = lengths.y() < lengths.x() ? 1 : 0;
    const auto left = [&](const Side& s) { return std::min(s.a[axis], s.b[axis]); };
    std::sort(sides.begin(), sides.end(), [&](const Side& p, const Side& q) { return left(p) < left(q); });
    std::size_t looks = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const double right = std::max(sides[i].a[axis], sides[i].b[axis]);
        std::size_t k = i + 1;
        for (; k < sides.size() && left(sides[k]) <= right; ++k)
            if (touch(sides[i], sides[k])) return false;
        constexpr std::size_t kMostLooks = 200'000'000;  // about a second
        looks += k - i;
        if (looks > kMostLooks)
            throw Failure(Error("has " + std::to_string(sides.size()) +
                                " corners and too many sides beside each other; draw it with fewer corners."));
    }
    return true;
}

std::vector<Ring> oriented(std::vector<Ring> rings)
{
    const std::vector<int> depths = depthsOf(rings);
    for (std::size_t i = 0; i < rings.size(); ++i)
        if ((signedArea(rings[i]) > 0) != (depths[i] % 2 == 0)) std::reverse(rings[i].begin(), rings[i].end());
    return rings;
}

Mesh triangulate(const std::vector<Ring>& drawn)
{
    std::vector<Ring> rings = cleaned(drawn);
    if (rings.empty()) return {};
    if (areSimple(rings)) {
        rings = oriented(std::move(rings));
        double area = 0;
        for (const Ring& ring : rings) area += signedArea(ring);
        Mesh mesh;
        if (clipAll(mesh, rings) && std::abs(mesh.area() - area) <= 1e-9 * area) return mesh;
    }
    return slabs(rings);
}

namespace {

std::uint64_t sideKey(std::uint32_t from, std::uint32_t to) { return static_cast<std::uint64_t>(from) << 32 | to; }

/// Does the circle around a, b, c hold d?
bool circleHolds(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const Vec2 p = a - d, q = b - d, r = c - d;
    const double determinant =
        p.squaredNorm() * cross(q, r) - q.squaredNorm() * cross(p, r) + r.squaredNorm() * cross(p, q);
    const double scale = p.squaredNorm() * q.norm() * r.norm() + q.squaredNorm() * p.norm() * r.norm() +
                         r.squaredNorm() * p.norm() * q.norm();
    return determinant > 1e-10 * scale;
}

}  // namespace

void improve(Mesh& mesh)
{
    std::unordered_map<std::uint64_t, std::uint32_t> owner;
    std::vector<std::uint64_t> open;
    const auto claim = [&](std::uint32_t triangle) {
        const Mesh::Triangle& t = mesh.triangles[triangle];
        for (int i = 0; i < 3; ++i) {
            owner[sideKey(t[i], t[(i + 1) % 3])] = triangle;
            open.push_back(sideKey(t[i], t[(i + 1) % 3]));
        }
    };
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) claim(t);
    std::size_t flips = 0;
    const std::size_t most = 64 * mesh.triangles.size();  // rounding may make two diagonals equally bad
    while (!open.empty() && flips < most) {
        const auto from = static_cast<std::uint32_t>(open.back() >> 32), to = static_cast<std::uint32_t>(open.back());
        open.pop_back();
        const auto here = owner.find(sideKey(from, to)), there = owner.find(sideKey(to, from));
        if (here == owner.end() || there == owner.end()) continue;
        const std::uint32_t t = here->second, u = there->second;
        const auto opposite = [&](std::uint32_t triangle) {
            for (const std::uint32_t corner : mesh.triangles[triangle])
                if (corner != from && corner != to) return corner;
            return from;
        };
        const std::uint32_t c = opposite(t), d = opposite(u);
        const auto& at = mesh.points;
        if (!circleHolds(at[from], at[to], at[c], at[d])) continue;
        if (!(turn(at[c], at[from], at[d]) > 0) || !(turn(at[d], at[to], at[c]) > 0)) continue;
        owner.erase(here);
        owner.erase(owner.find(sideKey(to, from)));
        mesh.triangles[t] = {c, from, d};
        mesh.triangles[u] = {d, to, c};
        claim(t), claim(u);
        ++flips;
    }
}

}  // namespace jet::physics
