#include "lattice.hpp"

#include <jet/value.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

namespace jet::lattice {

namespace {

// Inside particles keep this part of a cell clear of the walls, so that no spring is much shorter than the others.
constexpr double kClearance = 0.4;
// A cell chosen for the user is a wall long, but leaves room for at least 12 and at most 300 cells.
constexpr double kFewestCells = 12, kMostCells = 300;
// How far a border particle looks for inside particles, in cells, and how many it may try.
constexpr int kFarthestCells = 32;
constexpr int kMostTries = 256;
// Half a second of looking which springs stay inside.
constexpr std::uint64_t kMostWallsSeen = 100'000'000;

// Outlines beyond these sizes have areas a double cannot hold.
constexpr double kSmallest = 1e-100, kLargest = 1e100;

const char* const kNoArea =
    "the outline encloses no area; draw a closed shape, or give its segments intermediate points";

[[noreturn]] void fail(std::string message) { throw Failure(Error(std::move(message))); }

std::string most(std::size_t count) { return "more than " + std::to_string(count); }

// --- Border ---

/// All points on a line, give or take `tolerance`. (The signed area would not do: that of a figure eight is zero.)
bool isFlat(const Ring& ring, double tolerance)
{
    Vec2 longest = Vec2::Zero();
    for (const Vec2& p : ring)
        if ((p - ring[0]).norm() > longest.norm()) longest = p - ring[0];
    return std::all_of(ring.begin(), ring.end(), [&](const Vec2& p) {
        return std::abs(jet::cross(longest, p - ring[0])) <= tolerance * longest.norm();
    });
}

double ringLength(const Ring& ring)
{
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) sum += (ring[(i + 1) % ring.size()] - ring[i]).norm();
    return sum;
}

/// Without points that repeat the one before them; empty when what is left encloses nothing.
Ring cleaned(const Ring& ring, double size)
{
    const double tolerance = 1e-9 * size;
    Ring kept;
    for (const Vec2& p : ring)
        if (kept.empty() || (p - kept.back()).norm() > tolerance) kept.push_back(p);
    while (kept.size() > 1 && (kept.back() - kept.front()).norm() <= tolerance) kept.pop_back();
    return isFlat(kept, tolerance) ? Ring{} : kept;
}

std::vector<Ring> ringsOf(const std::vector<Polyline>& polylines, double size)
{
    std::vector<Ring> rings;
    for (const Polyline& line : polylines)
        if (line.closed)
            if (Ring ring = cleaned(line.points, size); !ring.empty()) rings.push_back(std::move(ring));
    return rings;
}

/// `count` points evenly along the ring, the first on its first point.
Ring resampled(const Ring& ring, std::size_t count)
{
    const double step = ringLength(ring) / static_cast<double>(count);
    Ring points;
    double reached = 0;  // length of the walls before wall i
    for (std::size_t i = 0; i < ring.size() && points.size() < count; ++i) {
        const Vec2 d = ring[(i + 1) % ring.size()] - ring[i];
        const double length = d.norm();
        for (double at = step * static_cast<double>(points.size()); points.size() < count && at < reached + length;
             at = step * static_cast<double>(points.size()))
            points.push_back(ring[i] + d * ((at - reached) / length));
        reached += length;
    }
    return points;
}

std::vector<Ring> evenRings(const Path& path, int count, double size)
{
    std::vector<Ring> rings = ringsOf(path.flatten(1e-4 * size), size);
    double total = 0;
    for (const Ring& ring : rings) total += ringLength(ring);
    for (Ring& ring : rings) {
        const double share = std::round(count * ringLength(ring) / total);
        ring = cleaned(resampled(ring, static_cast<std::size_t>(std::max(share, 3.0))), size);
    }
    std::erase_if(rings, [](const Ring& ring) { return ring.empty(); });
    return rings;
}

std::vector<Ring> segmentRings(const Path& path, double size)
{
    std::size_t count = 0;
    for (const Contour& contour : path.contours())
        for (const Segment& s : contour.segments) count += 1 + static_cast<std::size_t>(std::max(s.intermediate, 0));
    if (count > kMostParticles)
        fail("the outline has " + std::to_string(count) + " segments and intermediate points, " + most(kMostParticles) +
             "; give its segments fewer intermediate points");
    return ringsOf(path.polygonized(), size);
}

// --- Inside ---

/// Particles on the points of a grid, row by row. The grid lies in the middle of the region's box.
class Grid {
public:
    /// Collects the grid points in `region`; throws Failure when there are more than `limit`.
    Grid(const Region& region, const Vec2& cell, std::size_t limit) : cell_(cell)
    {
        const Box& box = region.bounds();
        columns_ = along(box.width(), cell.x(), limit);
        const int rows = along(box.height(), cell.y(), limit);
        first_ = box.center() - 0.5 * Vec2((columns_ - 1) * cell.x(), (rows - 1) * cell.y());
        std::size_t candidates = 0;
        for (int row = 0; row < rows; ++row) {
            rowStart_.push_back(points_.size());
            const double y = first_.y() + row * cell.y();
            const std::vector<double> xs = region.crossings(y);
            for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
                const int from = column(std::ceil((xs[i] - first_.x()) / cell.x()));
                const int to = column(std::floor((xs[i + 1] - first_.x()) / cell.x()) + 1);
                candidates += static_cast<std::size_t>(std::max(to - from, 0));
                if (candidates > limit) tooMany();
                for (int c = from; c < to; ++c) addIfClear(region, c, Vec2(first_.x() + c * cell.x(), y));
            }
        }
        rowStart_.push_back(points_.size());
    }

    const std::vector<Vec2>& points() const { return points_; }
    int rows() const { return static_cast<int>(rowStart_.size()) - 1; }
    int columns() const { return columns_; }

    /// Index among points() of the one at (column, row).
    std::optional<std::size_t> find(int column, int row) const
    {
        if (column < 0 || column >= columns_ || row < 0 || row >= rows()) return {};
        const auto begin = columnOf_.begin() + static_cast<std::ptrdiff_t>(rowStart_[row]);
        const auto end = columnOf_.begin() + static_cast<std::ptrdiff_t>(rowStart_[row + 1]);
        const auto found = std::lower_bound(begin, end, column);
        if (found == end || *found != column) return {};
        return static_cast<std::size_t>(found - columnOf_.begin());
    }

    /// Calls visit(index, column, row) for every point.
    template <class Visit>
    void forEach(Visit&& visit) const
    {
        for (int row = 0; row < rows(); ++row)
            for (std::size_t i = rowStart_[row]; i < rowStart_[row + 1]; ++i) visit(i, columnOf_[i], row);
    }

    /// The points from near to far, as far as kFarthestCells. visit(index) returns false to stop.
    template <class Visit>
    void visitNearest(const Vec2& p, Visit&& visit) const;

private:
    // As many points as leave three quarters to five quarters of a cell at both ends; one if there is room for just
    // that.
    int along(double length, double cell, std::size_t limit) const
    {
        const double count = std::max(std::round(length / cell) - 1, length >= cell * (1 - 1e-9) ? 1.0 : 0.0);
        if (!(count <= static_cast<double>(limit))) tooMany();
        return static_cast<int>(count);
    }

    int column(double c) const { return static_cast<int>(std::clamp(c, 0.0, static_cast<double>(columns_))); }

    void addIfClear(const Region& region, int column, const Vec2& p)
    {
        if (region.hasWallWithin(p, kClearance * cell_)) return;
        points_.push_back(p);
        columnOf_.push_back(column);
    }

    [[noreturn]] void tooMany() const
    {
        fail("a cell size of " + numberText(cell_.x()) + " × " + numberText(cell_.y()) + " makes " +
             most(kMostParticles) + " particles; set a larger cell-size, or 0 to have it chosen");
    }

    Vec2 cell_, first_;  // first_: the grid's top-left point, scene units
    int columns_ = 0;
    std::vector<Vec2> points_;
    std::vector<int> columnOf_;          // one a point
    std::vector<std::size_t> rowStart_;  // [rows + 1] ranges into points_
};

template <class Visit>
void Grid::visitNearest(const Vec2& p, Visit&& visit) const
{
    if (points_.empty()) return;
    const Vec2 place = (p - first_).cwiseQuotient(cell_);
    const int column = static_cast<int>(std::round(place.x())), row = static_cast<int>(std::round(place.y()));
    const int farthest = std::min(kFarthestCells, std::max(columns_, rows()) + 2);
    std::set<std::pair<double, std::size_t>> waiting;  // by distance

    // A square ring of the grid at a time. What lies beyond ring r is farther than r + ½ cells, so all nearer points
    // are known.
    for (int r = 0; r <= farthest; ++r) {
        const auto consider = [&](int c, int l) {
            if (const auto index = find(c, l)) waiting.emplace((points_[*index] - p).norm(), *index);
        };
        for (int c = column - r; c <= column + r; ++c) {
            consider(c, row - r);
            if (r > 0) consider(c, row + r);
        }
        for (int l = row - r + 1; l < row + r; ++l) {
            consider(column - r, l);
            consider(column + r, l);
        }
        const double known = r == farthest ? std::numeric_limits<double>::infinity() : (r + 0.5) * cell_.minCoeff();
        while (!waiting.empty() && waiting.begin()->first <= known) {
            if (!visit(waiting.begin()->second)) return;
            waiting.erase(waiting.begin());
        }
    }
}

/// Near the mean wall; smaller where the region is too thin to hold any particle.
Grid chosenGrid(const Region& region, const std::vector<Ring>& rings, std::size_t limit, Vec2& cell)
{
    double length = 0, walls = 0;
    for (const Ring& ring : rings) length += ringLength(ring), walls += static_cast<double>(ring.size());
    const double area = region.area();
    double side = std::clamp(length / walls, std::sqrt(area / kMostCells), std::sqrt(area / kFewestCells));
    for (int attempt = 0;; ++attempt, side *= 0.75) {
        cell = Vec2(side, side);
        Grid grid(region, cell, limit);
        if (!grid.points().empty() || attempt == 8) return grid;
    }
}

// --- Springs ---

class Builder {
public:
    Builder(const Path& path, const Options& options) : options_(options), region_({})
    {
        const Vec2 size = path.bounds().size();
        const double extent = std::max(size.x(), size.y());
        if (!(extent > kSmallest)) fail(kNoArea);
        if (!(extent < kLargest)) fail("the outline is too large to be measured");
        std::vector<Ring> rings =
            options.borderOnSegments ? segmentRings(path, extent) : evenRings(path, options.borderCount, extent);
        if (rings.empty()) fail(kNoArea);
        region_ = Region(rings);
        for (const Ring& ring : rings) addRing(ring);
        lattice_.borderCount = lattice_.particles.size();
        if (options.borderSprings) joinBorder();
        if (options.axisAligned || options.cross) fillInside(rings);
    }

    Lattice take() { return std::move(lattice_); }

private:
    void addRing(const Ring& ring)
    {
        auto& indices = lattice_.rings.emplace_back(ring.size());
        std::iota(indices.begin(), indices.end(), static_cast<std::uint32_t>(lattice_.particles.size()));
        lattice_.particles.insert(lattice_.particles.end(), ring.begin(), ring.end());
    }

    void fillInside(const std::vector<Ring>& rings)
    {
        const std::size_t limit = kMostParticles - std::min(kMostParticles, lattice_.borderCount);
        Vec2 cell = options_.cell;
        if (cell.x() <= 0) cell.x() = cell.y();
        if (cell.y() <= 0) cell.y() = cell.x();
        const Grid grid = cell.x() > 0 ? Grid(region_, cell, limit) : chosenGrid(region_, rings, limit, cell);
        lattice_.cell = cell;
        lattice_.particles.insert(lattice_.particles.end(), grid.points().begin(), grid.points().end());
        joinInside(grid);
        joinBorderToInside(grid);
        dropLoose();
    }

    // Distance k one way round a ring of n is n - k the other way round: each pair once.
    void joinBorder()
    {
        for (const auto& ring : lattice_.rings) {
            const int n = static_cast<int>(ring.size());
            std::set<int> distances;
            for (int k = options_.border.from; k <= options_.border.to && k <= n; ++k)
                distances.insert(std::min(k, n - k));
            distances.erase(0);
            for (const int k : distances)
                for (int i = 0; i < (2 * k == n ? k : n); ++i) {
                    const std::uint32_t a = ring[i], b = ring[(i + k) % n];
                    if (k == 1 || sees(at(a), at(b))) add(a, b, SpringKind::Border);
                }
        }
    }

    void joinInside(const Grid& grid)
    {
        grid.forEach([&](std::size_t index, int column, int row) {
            for (int k = options_.inside.from; k <= options_.inside.to; ++k) {
                if (k > grid.columns() && k > grid.rows()) break;
                if (options_.axisAligned) {
                    joinIfSeen(grid, index, column + k, row);
                    joinIfSeen(grid, index, column, row + k);
                }
                if (options_.cross) {
                    joinIfSeen(grid, index, column + k, row + k);
                    joinIfSeen(grid, index, column - k, row + k);
                }
            }
        });
    }

    void joinIfSeen(const Grid& grid, std::size_t index, int column, int row)
    {
        const auto other = grid.find(column, row);
        if (other && sees(grid.points()[index], grid.points()[*other]))
            add(inside(index), inside(*other), SpringKind::Inside);
    }

    void joinBorderToInside(const Grid& grid)
    {
        if (options_.borderToInside <= 0) return;
        for (std::uint32_t border = 0; border < lattice_.borderCount; ++border) {
            int joined = 0, tries = 0;
            grid.visitNearest(at(border), [&](std::size_t index) {
                if (sees(at(border), grid.points()[index])) {
                    add(border, inside(index), SpringKind::BorderToInside);
                    ++joined;
                }
                return joined < options_.borderToInside && ++tries < kMostTries;
            });
        }
    }

    /// Leaves out the inside particles from which no chain of springs leads to the border.
    void dropLoose()
    {
        std::vector<std::uint32_t> parent(lattice_.particles.size());
        std::iota(parent.begin(), parent.end(), 0U);
        const auto rootOf = [&](std::uint32_t i) {
            while (parent[i] != i) i = parent[i] = parent[parent[i]];
            return i;
        };
        for (std::uint32_t i = 1; i < lattice_.borderCount; ++i) parent[i] = 0;  // the border is one
        for (const Spring& s : lattice_.springs) parent[rootOf(s.a)] = rootOf(s.b);

        constexpr std::uint32_t kDropped = 0xffffffffU;
        std::vector<std::uint32_t> newIndex(lattice_.particles.size(), kDropped);
        std::vector<Vec2> kept;
        for (std::uint32_t i = 0; i < lattice_.particles.size(); ++i) {
            if (rootOf(i) != rootOf(0)) continue;
            newIndex[i] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(lattice_.particles[i]);
        }
        if (kept.size() == lattice_.particles.size()) return;
        lattice_.particles = std::move(kept);
        std::erase_if(lattice_.springs, [&](const Spring& s) { return newIndex[s.a] == kDropped; });
        for (Spring& s : lattice_.springs) s.a = newIndex[s.a], s.b = newIndex[s.b];
    }

    /// Springs that would leave the region are not counted among kMostSprings, but looking for them takes its time.
    bool sees(const Vec2& a, const Vec2& b)
    {
        if (region_.wallsSeen() > kMostWallsSeen)
            fail(
                "the lattice would take too long to make; set fewer intermediate points, a larger cell-size or shorter "
                "spring ranges");
        return region_.holds(a, b);
    }

    void add(std::uint32_t a, std::uint32_t b, SpringKind kind)
    {
        if ((at(a) - at(b)).norm() <= region_.tolerance()) return;
        if (lattice_.springs.size() == kMostSprings)
            fail("the lattice would have " + most(kMostSprings) +
                 " springs; set a larger cell-size or shorter spring ranges");
        lattice_.springs.push_back({a, b, kind});
    }

    const Vec2& at(std::uint32_t particle) const { return lattice_.particles[particle]; }
    std::uint32_t inside(std::size_t index) const { return static_cast<std::uint32_t>(lattice_.borderCount + index); }

    const Options& options_;
    Region region_;
    Lattice lattice_;
};

}  // namespace

Lattice build(const Path& path, const Options& options) { return Builder(path, options).take(); }

}  // namespace jet::lattice
