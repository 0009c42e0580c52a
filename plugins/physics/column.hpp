// A column of numbers for which most rows need no room: those past its end read as what is usual, and what is written
// there is lost. Of nodes only rigid ones turn, and of points only theirs have a place on their node.
#pragma once

#include "room.hpp"

#include <vector>

namespace jet::physics {

template <class T>
class Column {
public:
    explicit Column(const T& usual) : usual_(usual), lost_(usual) {}

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
    T& operator[](std::size_t row) { return row < values_.size() ? values_[row] : lost_ = usual_; }

private:
    std::vector<T> values_;
    T usual_, lost_;
};

}  // namespace jet::physics
