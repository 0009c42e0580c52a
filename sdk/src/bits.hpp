// Equality of reals bit by bit: -0 differs from 0, a NaN equals itself. Undo and file round trips are exact in this
// sense.
#pragma once

#include <jet/path.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>

namespace jet {

inline bool sameBits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
inline bool sameBits(const Vec2& a, const Vec2& b) { return sameBits(a.x(), b.x()) && sameBits(a.y(), b.y()); }

inline bool sameBits(const Segment& a, const Segment& b)
{
    return sameBits(a.point, b.point) && sameBits(a.in, b.in) && sameBits(a.out, b.out) &&
           a.intermediate == b.intermediate;
}

inline bool sameBits(const Path& a, const Path& b)
{
    const auto sameContour = [](const Contour& x, const Contour& y) {
        return x.closed == y.closed &&
               std::ranges::equal(x.segments, y.segments,
                                  [](const Segment& s, const Segment& t) { return sameBits(s, t); });
    };
    return a.sharesPoints(b) || std::ranges::equal(a.contours(), b.contours(), sameContour);
}

}  // namespace jet
