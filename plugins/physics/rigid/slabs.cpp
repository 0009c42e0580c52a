#include "slabs.hpp"

#include <jet/result.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace jet::physics {

namespace {

struct Line {
    Vec2 top, bottom;  // top.y < bottom.y
    double at(double y) const { return top.x() + (bottom.x() - top.x()) * ((y - top.y()) / (bottom.y() - top.y())); }
};

struct Trapezoid {
    double top, bottom;
    std::size_t left, right;  // lines
    std::size_t ended;        // the how manieth end of one it has
};

constexpr std::size_t kNoTrapezoid = static_cast<std::size_t>(-1);

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
        sweep();
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

    /// Scribbles have crossings by the square of their corners, and pieces by the cube.
    void spend(std::size_t looks)
    {
        constexpr std::size_t kMostLooks = 200'000'000, kMostPieces = 100'000;  // about a second, some 100 MB
        looks_ += looks;
        if (looks_ > kMostLooks || trapezoids_.size() > kMostPieces || levels_.size() > kMostLooks / 10)
            throw Failure(
                Error("crosses itself too often to be divided into convex parts; draw it with fewer crossings."));
    }

    void findLevels()
    {
        for (const Line& line : lines_) levels_.push_back(line.top.y()), levels_.push_back(line.bottom.y());
        order_.resize(lines_.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::sort(order_.begin(), order_.end(),
                  [&](std::size_t i, std::size_t k) { return lines_[i].top.y() < lines_[k].top.y(); });
        for (std::size_t i = 0; i < order_.size(); ++i) {
            const Line& line = lines_[order_[i]];
            std::size_t k = i + 1;
            for (; k < order_.size() && lines_[order_[k]].top.y() < line.bottom.y(); ++k)
                addCrossing(lines_[std::min(order_[i], order_[k])], lines_[std::max(order_[i], order_[k])]);
            spend(k - i);
        }
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

    void sweep()
    {
        lastOf_.assign(lines_.size(), kNoTrapezoid);
        std::vector<std::size_t> active;  // lines
        std::size_t next = 0;             // of order_
        for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
            const double middle = 0.5 * (levels_[i] + levels_[i + 1]);
            while (next < order_.size() && lines_[order_[next]].top.y() < middle) active.push_back(order_[next++]);
            std::erase_if(active, [&](std::size_t line) { return !(lines_[line].bottom.y() > middle); });
            spend(8 * active.size());
            fill(levels_[i], levels_[i + 1], active);
        }
        // In the order of their ends.
        std::sort(trapezoids_.begin(), trapezoids_.end(),
                  [](const Trapezoid& p, const Trapezoid& q) { return p.ended < q.ended; });
    }

    void fill(double top, double bottom, const std::vector<std::size_t>& active)
    {
        const double middle = 0.5 * (top + bottom);
        across_.clear();
        for (const std::size_t line : active) across_.emplace_back(lines_[line].at(middle), line);
        std::sort(across_.begin(), across_.end());
        for (std::size_t i = 0; i + 1 < across_.size(); i += 2)
            if (across_[i + 1].first - across_[i].first > grain_)
                extend(top, bottom, across_[i].second, across_[i + 1].second);
    }

    /// Goes on with the trapezoid between the same lines that ends here.
    void extend(double top, double bottom, std::size_t left, std::size_t right)
    {
        const std::size_t last = lastOf_[left];
        if (last != kNoTrapezoid && trapezoids_[last].right == right && trapezoids_[last].bottom == top) {
            trapezoids_[last].bottom = bottom, trapezoids_[last].ended = ++ended_;
            return;
        }
        lastOf_[left] = trapezoids_.size();
        trapezoids_.push_back({top, bottom, left, right, ++ended_});
    }

    std::uint32_t mark(double y, double x)
    {
        auto& level = marks_[y];
        auto near = level.lower_bound(x - 4 * grain_);
        if (near != level.end() && near->first <= x + 4 * grain_) return near->second;
        mesh_.points.push_back({x, y});
        return level[x] = static_cast<std::uint32_t>(mesh_.points.size() - 1);
    }

    /// Corners along a level between two lines, left to right. Where lines cross nearer to the level than grains can
    /// tell, the left one may already be right of the other.
    std::vector<std::uint32_t> along(double y, double left, double right)
    {
        std::vector<std::uint32_t> found;
        const auto& level = marks_[y];
        const auto [from, to] = std::minmax(left, right);
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
    std::vector<std::size_t> order_;  // lines from the highest top down
    std::vector<double> levels_;
    std::vector<Trapezoid> trapezoids_;
    std::vector<std::size_t> lastOf_;  // [lines] the last trapezoid to the right of it
    std::vector<std::pair<double, std::size_t>> across_;
    std::size_t ended_ = 0, looks_ = 0;
    std::map<double, std::map<double, std::uint32_t>> marks_;  // level -> x -> point
    Mesh mesh_;
};

}  // namespace

Mesh slabs(const std::vector<Ring>& rings) { return SlabCutter(rings).cut(); }

}  // namespace jet::physics
