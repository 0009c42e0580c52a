#include "region.hpp"

#include <algorithm>

namespace jet::lattice {

namespace {

constexpr std::size_t kMostBands = 1024;

double distanceToSegment(const Vec2& p, const Vec2& a, const Vec2& b)
{
    const Vec2 d = b - a;
    const double length2 = d.squaredNorm();
    const double t = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
    return (p - (a + t * d)).norm();
}

/// Half-open in y, so that a line through a corner meets exactly one of the two walls there.
bool meets(const Vec2& a, const Vec2& b, double y) { return (a.y() <= y) != (b.y() <= y); }

double crossingX(const Vec2& a, const Vec2& b, double y)
{
    return a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

}  // namespace

Region::Region(const std::vector<Ring>& rings)
{
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
            walls_.push_back({a, b, Box(a, b)});
            bounds_.extend(a);
        }
    }
    tolerance_ = 1e-9 * std::max(bounds_.width(), bounds_.height());
    bands_.resize(std::clamp<std::size_t>(walls_.size(), 1, kMostBands));
    if (bounds_.height() > 0) bandHeight_ = bounds_.height() / static_cast<double>(bands_.size());
    for (std::uint32_t i = 0; i < walls_.size(); ++i) {
        walls_[i].firstBand = static_cast<std::uint32_t>(band(walls_[i].box.min.y()));
        for (std::size_t k = walls_[i].firstBand; k <= band(walls_[i].box.max.y()); ++k) bands_[k].push_back(i);
    }
}

std::size_t Region::band(double y) const
{
    const double k = std::floor((y - bounds_.min.y()) / bandHeight_);
    return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(bands_.size() - 1)));
}

template <class Visit>
void Region::visitWalls(const Box& box, Visit&& visit) const
{
    if (walls_.empty()) return;
    const std::size_t first = band(box.min.y()), last = band(box.max.y());
    for (std::size_t k = first; k <= last; ++k) {
        wallsSeen_ += bands_[k].size();
        for (const std::uint32_t index : bands_[k]) {
            const Wall& wall = walls_[index];
            if (!wall.box.intersects(box)) continue;
            if (k != std::max<std::size_t>(first, wall.firstBand)) continue;  // seen in an earlier band
            if (!visit(wall)) return;
        }
    }
}

double Region::area() const
{
    // Summed over rows: right for nested and for overlapping rings alike, and near enough to choose a cell size by.
    constexpr int kRows = 512;
    double sum = 0;
    const double height = bounds_.height() / kRows;
    for (int row = 0; row < kRows; ++row) {
        const auto xs = crossings(bounds_.min.y() + (row + 0.5) * height);
        for (std::size_t i = 0; i + 1 < xs.size(); i += 2) sum += (xs[i + 1] - xs[i]) * height;
    }
    return sum;
}

bool Region::contains(const Vec2& p) const
{
    if (walls_.empty() || !bounds_.contains(p)) return false;
    bool inside = false;
    const auto& walls = bands_[band(p.y())];
    wallsSeen_ += walls.size();
    for (const std::uint32_t index : walls) {
        const Wall& wall = walls_[index];
        if (meets(wall.a, wall.b, p.y()) && crossingX(wall.a, wall.b, p.y()) > p.x()) inside = !inside;
    }
    return inside;
}

bool Region::hasWallWithin(const Vec2& p, const Vec2& radii) const
{
    const Vec2 scale = radii.cwiseInverse();
    bool found = false;
    visitWalls(Box(p - radii, p + radii), [&](const Wall& wall) {
        const Vec2 a = (wall.a - p).cwiseProduct(scale), b = (wall.b - p).cwiseProduct(scale);
        found = distanceToSegment(Vec2::Zero(), a, b) < 1;
        return !found;
    });
    return found;
}

std::vector<double> Region::crossings(double y) const
{
    std::vector<double> xs;
    if (walls_.empty()) return xs;
    for (const std::uint32_t index : bands_[band(y)]) {
        const Wall& wall = walls_[index];
        if (meets(wall.a, wall.b, y)) xs.push_back(crossingX(wall.a, wall.b, y));
    }
    std::sort(xs.begin(), xs.end());
    return xs;
}

bool Region::isOnWall(const Vec2& p) const
{
    bool on = false;
    visitWalls(Box(p, p).inflated(tolerance_), [&](const Wall& wall) {
        on = distanceToSegment(p, wall.a, wall.b) <= tolerance_;
        return !on;
    });
    return on;
}

bool Region::holds(const Vec2& a, const Vec2& b) const
{
    const Vec2 d = b - a;
    const double length = d.norm();
    if (length <= tolerance_) return contains(a) || isOnWall(a);

    // Where it touches a wall's end it may pass from inside to outside without properly crossing any wall, so it is cut
    // there and each piece is tested by its middle.
    std::vector<double> cuts{0, 1};
    bool crosses = false;
    visitWalls(Box(a, b).inflated(tolerance_), [&](const Wall& wall) {
        const Vec2 along = wall.b - wall.a;
        const double wallLength = along.norm();
        const double sideA = cross(d, wall.a - a) / length, sideB = cross(d, wall.b - a) / length;
        for (const auto& [side, end] : {std::pair(sideA, wall.a), std::pair(sideB, wall.b)}) {
            const double t = (end - a).dot(d) / (length * length);
            if (std::abs(side) <= tolerance_ && t > 0 && t < 1) cuts.push_back(t);
        }
        const bool straddlesWall =
            std::abs(sideA) > tolerance_ && std::abs(sideB) > tolerance_ && (sideA > 0) != (sideB > 0);
        if (!straddlesWall || wallLength <= tolerance_) return true;
        const double from = cross(along, a - wall.a) / wallLength, to = cross(along, b - wall.a) / wallLength;
        crosses = std::abs(from) > tolerance_ && std::abs(to) > tolerance_ && (from > 0) != (to > 0);
        return !crosses;
    });
    if (crosses) return false;

    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        if ((cuts[i + 1] - cuts[i]) * length <= 2 * tolerance_) continue;
        const Vec2 middle = a + 0.5 * (cuts[i] + cuts[i + 1]) * d;
        if (!contains(middle) && !isOnWall(middle)) return false;
    }
    return true;
}

}  // namespace jet::lattice
