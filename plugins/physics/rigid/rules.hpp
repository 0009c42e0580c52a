// What decides whom rigid bodies meet, and how. Most bodies of a world are alike in this, so they share their rules.
#pragma once

#include "state.hpp"

#include <algorithm>
#include <tuple>

namespace jet::physics {

struct Rules {
    Index material = 0;
    std::uint32_t group = 0, layer = 1, mask = ~0U;
    float oneSidedX = 0, oneSidedY = 0;  // unit, or null

    Rules() = default;
    explicit Rules(const BodyCommon& common)
        : material(common.material), group(common.group), layer(common.layer), mask(common.mask)
    {
        const double length = common.oneSided.norm();
        if (!(length > 0)) return;
        oneSidedX = static_cast<float>(common.oneSided.x() / length);
        oneSidedY = static_cast<float>(common.oneSided.y() / length);
    }
    bool isOneSided() const { return oneSidedX != 0 || oneSidedY != 0; }
    friend bool operator==(const Rules&, const Rules&) = default;
};

/// The rules of a world, in rows that are used again. Where there are many kinds, only the first are shared: to look
/// through all of them for each body would take longer than they are worth.
class RuleBook {
public:
    /// One more body has these: their row.
    Index add(const Rules& rules)
    {
        const auto known = std::min<std::size_t>(rows_.size(), kLookedAt);
        Index row = 0;
        while (row < known && (rows_[row].bodies == 0 || rows_[row].rules != rules)) ++row;
        if (row == known) row = newRow();
        rows_[row].rules = rules;
        ++rows_[row].bodies;
        return row;
    }
    /// One body less has them.
    void drop(Index row)
    {
        if (--rows_[row].bodies == 0) free_.push_back(row);
    }
    const Rules& operator[](Index row) const { return rows_[row].rules; }
    std::size_t bytes() const { return rows_.capacity() * sizeof(Row) + free_.capacity() * sizeof(Index); }

private:
    static constexpr std::size_t kLookedAt = 64;
    struct Row {
        Rules rules;
        Index bodies = 0;
    };
    Index newRow()
    {
        if (free_.empty()) {
            rows_.emplace_back();
            return static_cast<Index>(rows_.size() - 1);
        }
        const Index row = free_.back();
        free_.pop_back();
        return row;
    }

    std::vector<Row> rows_{{Rules(), 1}};  // the first is that of body 0, and of most others
    std::vector<Index> free_;
};

}  // namespace jet::physics
