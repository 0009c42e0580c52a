#include "edge_grid.hpp"

namespace jet::physics {

namespace {

// Reference points sit off the middle, where coordinates people draw rarely are: an edge through one is ambiguous.
constexpr double kReferenceX = 0.51371, kReferenceY = 0.48653;
constexpr int kMaxCellsPerAxis = 512;

bool straddles(double a, double b, double level) { return (a > level) != (b > level); }
double crossingX(const EdgeGrid::Edge& e, double y)
{
    return e.a.x() + (y - e.a.y()) / (e.b.y() - e.a.y()) * (e.b.x() - e.a.x());
}
double crossingY(const EdgeGrid::Edge& e, double x)
{
    return e.a.y() + (x - e.a.x()) / (e.b.x() - e.a.x()) * (e.b.y() - e.a.y());
}

}  // namespace

void EdgeGrid::build(std::span<const Edge> edges)
{
    edges_.assign(edges.begin(), edges.end());
    bounds_ = Box();
    for (const Edge& e : edges_) bounds_.extend(e.a), bounds_.extend(e.b);
    if (edges_.empty()) return;
    chooseCells();
    sortIntoCells();
    markReferences();
}

void EdgeGrid::chooseCells()
{
    // About two cells an edge, square where the box allows it.
    const Vec2 size = bounds_.size();
    const double wanted = 2.0 * static_cast<double>(edges_.size());
    const double longest = std::max(size.x(), size.y());
    const double side = std::max(std::sqrt(size.x() * size.y() / wanted), longest / wanted);
    const auto count = [&](double length) {
        return side > 0 ? std::clamp(static_cast<int>(length / side) + 1, 1, kMaxCellsPerAxis) : 1;
    };
    columns_ = count(size.x());
    rows_ = count(size.y());
    cellSize_ = {size.x() / columns_, size.y() / rows_};
    inverseCellSize_ = {size.x() > 0 ? columns_ / size.x() : 0, size.y() > 0 ? rows_ / size.y() : 0};
}

void EdgeGrid::sortIntoCells()
{
    const std::size_t cellCount = static_cast<std::size_t>(columns_) * rows_;
    cells_.resize(edges_.size());
    firstEntry_.assign(cellCount + 1, 0);
    const auto forEachCell = [&](std::size_t edge, auto&& act) {
        for (int y = cells_[edge].y0; y <= cells_[edge].y1; ++y)
            for (int x = cells_[edge].x0; x <= cells_[edge].x1; ++x) act(static_cast<std::size_t>(y) * columns_ + x);
    };
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        cells_[i] = cellsOf(edges_[i].a.cwiseMin(edges_[i].b), edges_[i].a.cwiseMax(edges_[i].b));
        forEachCell(i, [&](std::size_t cell) { ++firstEntry_[cell]; });
    }
    for (std::size_t cell = 0; cell < cellCount; ++cell) firstEntry_[cell + 1] += firstEntry_[cell];
    entries_.resize(firstEntry_.back());
    // firstEntry_ holds where cells end: filling backwards leaves each cell's edges in ascending order, and there where
    // it starts.
    for (std::size_t i = edges_.size(); i-- > 0;)
        forEachCell(i, [&](std::size_t cell) { entries_[--firstEntry_[cell]] = static_cast<std::uint32_t>(i); });
}

/// A ray from a reference point towards +x is cut by an edge right of it: each cut flips the references left of it.
void EdgeGrid::markReferences()
{
    referenceInside_.assign(static_cast<std::size_t>(columns_) * rows_, 0);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        for (int y = cells_[i].y0; y <= cells_[i].y1; ++y) {
            if (!straddles(edges_[i].a.y(), edges_[i].b.y(), referenceY(y))) continue;
            const double cut = crossingX(edges_[i], referenceY(y));
            int last = column(cut);
            while (last >= 0 && !(cut > referenceX(last))) --last;
            if (last >= 0) referenceInside_[static_cast<std::size_t>(y) * columns_ + last] ^= 1;
        }
    }
    for (int y = 0; y < rows_; ++y)
        for (int x = columns_ - 2; x >= 0; --x) {
            const std::size_t cell = static_cast<std::size_t>(y) * columns_ + x;
            referenceInside_[cell] ^= referenceInside_[cell + 1];
        }
}

bool EdgeGrid::inside(const Vec2& p) const
{
    if (edges_.empty() || !bounds_.contains(p)) return false;
    const int x = column(p.x()), y = row(p.y());
    const std::size_t cell = static_cast<std::size_t>(y) * columns_ + x;
    const double rx = referenceX(x), ry = referenceY(y);
    // From the point level to the reference's x, then upright to the reference: each cut on the way flips the answer.
    bool in = referenceInside_[cell] != 0;
    for (std::uint32_t i = firstEntry_[cell]; i < firstEntry_[cell + 1]; ++i) {
        const Edge& e = edges_[entries_[i]];
        if (straddles(e.a.y(), e.b.y(), p.y()) && straddles(p.x(), rx, crossingX(e, p.y()))) in = !in;
        if (straddles(e.a.x(), e.b.x(), rx) && straddles(p.y(), ry, crossingY(e, rx))) in = !in;
    }
    return in;
}

EdgeGrid::Cells EdgeGrid::cellsOf(const Vec2& min, const Vec2& max) const
{
    return {column(min.x()), row(min.y()), column(max.x()), row(max.y())};
}

int EdgeGrid::column(double x) const
{
    const double at = (x - bounds_.min.x()) * inverseCellSize_.x();
    return !(at > 0) ? 0 : at >= columns_ - 1 ? columns_ - 1 : static_cast<int>(at);
}

int EdgeGrid::row(double y) const
{
    const double at = (y - bounds_.min.y()) * inverseCellSize_.y();
    return !(at > 0) ? 0 : at >= rows_ - 1 ? rows_ - 1 : static_cast<int>(at);
}

double EdgeGrid::referenceX(int column) const { return bounds_.min.x() + (column + kReferenceX) * cellSize_.x(); }
double EdgeGrid::referenceY(int row) const { return bounds_.min.y() + (row + kReferenceY) * cellSize_.y(); }

bool insideOdd(std::span<const EdgeGrid::Edge> edges, const Vec2& p)
{
    bool in = false;
    for (const EdgeGrid::Edge& e : edges)
        if (straddles(e.a.y(), e.b.y(), p.y()) && p.x() < crossingX(e, p.y())) in = !in;
    return in;
}

}  // namespace jet::physics
