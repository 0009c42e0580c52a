// A column of numbers for which most rows need no room: those past its end read as what is usual. Of nodes only rigid
// ones turn, and of points only theirs have a place on their node. Who writes says what he knows of the row: edit() of
// one that has room, set() and add() of one that may have none, where nothing but the usual may be written then.
#pragma once

#include "room.hpp"

#include <jet/geometry.hpp>

#include <cassert>
#include <cmath>
#include <type_traits>
#include <vector>

namespace jet::physics {

template <class T>
class Column {
public:
    explicit Column(const T& usual) : usual_(usual) {}

    /// Room for rows below `count`.
    void cover(std::size_t count)
    {
        if (values_.size() >= count) return;
        makeRoom(count - values_.size(), values_);
        values_.resize(count, usual_);
    }
    /// No rows from `count` on.
    void cut(std::size_t count)
    {
        if (values_.size() > count) values_.resize(count, usual_);
    }
    void fit() { values_.shrink_to_fit(); }
    std::size_t capacity() const { return values_.capacity(); }
    /// Rows that have room.
    std::size_t size() const { return values_.size(); }
    std::vector<T>& values() { return values_; }
    const std::vector<T>& values() const { return values_; }

    const T& operator[](std::size_t row) const { return row < values_.size() ? values_[row] : usual_; }
    T& edit(std::size_t row)
    {
        assert(row < values_.size());
        return values_[row];
    }
    void set(std::size_t row, const T& value)
    {
        assert(row < values_.size() || isUsual(value));
        if (row < values_.size()) values_[row] = value;
    }
    /// Past the end only what leaves the usual as it is.
    void add(std::size_t row, const T& value)
    {
        assert(row < values_.size() || isUsual(T(usual_ + value)));
        if (row < values_.size()) values_[row] += value;
    }

private:
    /// Or is no number, which is stopped where it moves something (speed_limit.hpp).
    bool isUsual(const T& value) const
    {
        if constexpr (std::is_floating_point_v<T>)
            return value == usual_ || !std::isfinite(value);
        else
            return value == usual_ || !isFinite(value);
    }

    std::vector<T> values_;
    T usual_;
};

}  // namespace jet::physics
