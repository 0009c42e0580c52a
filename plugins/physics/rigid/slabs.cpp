#include "slabs.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace jet::physics {

namespace {

struct Line {
    Vec2 top, bottom;  // top.y < bottom.y
    double at(double y) const { return top.x() + (bottom.x() - top.x()) * ((y - top.y()) / (bottom.y() - top.y())); }
};

struct Trapezoid {
    double top, bottom;
    std::size_t left, right;  // lines
};

class SlabCutter {
public:
    explicit SlabCutter(const std::vector<Ring>& rings)
    {
        Box bounds;
        for (const Ring& ring : rings)
            for (const Vec2& at : ring) bounds.extend(at);
        grain_ = 1e-9 * std::max(bounds.size().maxCoeff(), 1e-300);
        for (const Ring& ring : rings)
            for (std::size_t i = 0; i < ring.size(); ++i) addLine(ring[i], ring[(i + 1) % ring.size()]);
    }

    Mesh cut()
    {
        findLevels();
        for (std::size_t i = 0; i + 1 < levels_.size(); ++i) fill(levels_[i], levels_[i + 1]);
        for (const Trapezoid& t : trapezoids_) {
            mark(t.top, lines_[t.left].at(t.top)), mark(t.top, lines_[t.right].at(t.top));
            mark(t.bottom, lines_[t.left].at(t.bottom)), mark(t.bottom, lines_[t.right].at(t.bottom));
        }
        for (const Trapezoid& t : trapezoids_) addTriangles(t);
        return std::move(mesh_);
    }

private:
    void addLine(const Vec2& a, const Vec2& b)
    {
        if (std::abs(a.y() - b.y()) <= grain_) return;  // lies in a level
        lines_.push_back(a.y() < b.y() ? Line{a, b} : Line{b, a});
    }

    void findLevels()
    {
        for (const Line& line : lines_) levels_.push_back(line.top.y()), levels_.push_back(line.bottom.y());
        for (std::size_t i = 0; i < lines_.size(); ++i)
            for (std::size_t k = i + 1; k < lines_.size(); ++k) addCrossing(lines_[i], lines_[k]);
        std::sort(levels_.begin(), levels_.end());
        std::vector<double> apart;
        for (const double y : levels_)
            if (apart.empty() || y - apart.back() > 4 * grain_) apart.push_back(y);
        levels_ = std::move(apart);
    }

    void addCrossing(const Line& p, const Line& q)
    {
        const double top = std::max(p.top.y(), q.top.y()), bottom = std::min(p.bottom.y(), q.bottom.y());
        if (!(bottom > top)) return;
        const double above = p.at(top) - q.at(top), below = p.at(bottom) - q.at(bottom);
        if (above * below < 0) levels_.push_back(top + (bottom - top) * (above / (above - below)));
    }

    void fill(double top, double bottom)
    {
        const double middle = 0.5 * (top + bottom);
        std::vector<std::pair<double, std::size_t>> across;
        for (std::size_t i = 0; i < lines_.size(); ++i)
            if (lines_[i].top.y() < middle && lines_[i].bottom.y() > middle)
                across.emplace_back(lines_[i].at(middle), i);
        std::sort(across.begin(), across.end());
        for (std::size_t i = 0; i + 1 < across.size(); i += 2)
            if (across[i + 1].first - across[i].first > grain_)
                extend({top, bottom, across[i].second, across[i + 1].second});
    }

    /// Goes on with the trapezoid between the same lines that ends here.
    void extend(const Trapezoid& t)
    {
        for (auto old = trapezoids_.rbegin(); old != trapezoids_.rend() && old->bottom >= t.top; ++old) {
            if (old->left != t.left || old->right != t.right || old->bottom != t.top) continue;
            old->bottom = t.bottom;
            // Kept in the order of their ends.
            std::rotate(old.base() - 1, old.base(), trapezoids_.end());
            return;
        }
        trapezoids_.push_back(t);
    }

    std::uint32_t mark(double y, double x)
    {
        auto& level = marks_[y];
        auto near = level.lower_bound(x - 4 * grain_);
        if (near != level.end() && near->first <= x + 4 * grain_) return near->second;
        mesh_.points.push_back({x, y});
        return level[x] = static_cast<std::uint32_t>(mesh_.points.size() - 1);
    }

    /// Corners along a level from x to x, left to right.
    std::vector<std::uint32_t> along(double y, double from, double to)
    {
        std::vector<std::uint32_t> found;
        const auto& level = marks_[y];
        for (auto it = level.lower_bound(from - 4 * grain_); it != level.end() && it->first <= to + 4 * grain_; ++it)
            found.push_back(it->second);
        return found;
    }

    /// The corners of neighbours in the upper and lower sides are corners here, too, so that sides meet whole.
    void addTriangles(const Trapezoid& t)
    {
        const auto upper = along(t.top, lines_[t.left].at(t.top), lines_[t.right].at(t.top));
        const auto lower = along(t.bottom, lines_[t.left].at(t.bottom), lines_[t.right].at(t.bottom));
        std::size_t u = 0, l = 0;
        while (u + 1 < upper.size() || l + 1 < lower.size()) {
            const bool above = l + 1 >= lower.size() ||
                               (u + 1 < upper.size() && (u + 1) * (lower.size() - 1) <= (l + 1) * (upper.size() - 1));
            add(upper[u], above ? upper[u + 1] : lower[l + 1], lower[l]);
            above ? ++u : ++l;
        }
    }

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
        if (cross(mesh_.points[b] - mesh_.points[a], mesh_.points[c] - mesh_.points[a]) > 0)
            mesh_.triangles.push_back({a, b, c});
    }

    double grain_ = 0;  // units: what is nearer counts as one
    std::vector<Line> lines_;
    std::vector<double> levels_;
    std::vector<Trapezoid> trapezoids_;
    std::map<double, std::map<double, std::uint32_t>> marks_;  // level -> x -> point
    Mesh mesh_;
};

}  // namespace

Mesh slabs(const std::vector<Ring>& rings) { return SlabCutter(rings).cut(); }

}  // namespace jet::physics
