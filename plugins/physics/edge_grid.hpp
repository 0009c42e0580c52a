// A uniform grid over the walls of one body: which walls lie near a box, and is a point inside the region?
// Both cost what the neighbourhood holds, not what the body holds: a level's outline may have thousands of walls.
// Built once for rigid and fixed bodies, in the body's frame; rebuilt each time contacts are sought for soft ones.
#pragma once

#include <jet/geometry.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace jet::physics {

class EdgeGrid {
public:
    struct Edge {
        Vec2 a, b;
    };

    void build(std::span<const Edge> edges);

    /// Inside an odd number of closed borders?
    bool inside(const Vec2& point) const;

    const Box& bounds() const { return bounds_; }

    /// Calls visit(index) once for each edge whose box may meet `region`, in a fixed order.
    template <class Visit>
    void visit(const Box& region, Visit&& visit) const
    {
        if (edges_.empty() || !bounds_.intersects(region)) return;
        const Cells query = cellsOf(region.min, region.max);
        for (int row = query.y0; row <= query.y1; ++row) {
            for (int column = query.x0; column <= query.x1; ++column) {
                const std::size_t cell = static_cast<std::size_t>(row) * columns_ + column;
                for (std::uint32_t i = firstEntry_[cell]; i < firstEntry_[cell + 1]; ++i) {
                    // An edge lies in several cells: it is reported from the first of them that the query reaches.
                    const Cells& own = cells_[entries_[i]];
                    if (column == std::max(query.x0, own.x0) && row == std::max(query.y0, own.y0)) visit(entries_[i]);
                }
            }
        }
    }

private:
    struct Cells {
        int x0, y0, x1, y1;  // inclusive
    };

    Cells cellsOf(const Vec2& min, const Vec2& max) const;
    int column(double x) const;
    int row(double y) const;
    double referenceX(int column) const;
    double referenceY(int row) const;
    void chooseCells();
    void sortIntoCells();
    void markReferences();

    std::vector<Edge> edges_;
    Box bounds_;
    Vec2 cellSize_, inverseCellSize_;
    int columns_ = 0, rows_ = 0;
    std::vector<Cells> cells_;                   // [edges]
    std::vector<std::uint32_t> firstEntry_;      // [cells + 1] into entries_
    std::vector<std::uint32_t> entries_;         // edge indices
    std::vector<std::uint8_t> referenceInside_;  // [cells] is the cell's reference point inside?
};

/// Is the point inside an odd number of the closed borders these edges form? The slow, gridless answer.
bool insideOdd(std::span<const EdgeGrid::Edge> edges, const Vec2& point);

}  // namespace jet::physics
