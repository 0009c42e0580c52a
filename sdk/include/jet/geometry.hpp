// Vectors, boxes and affine maps of the scene plane: scene units, y down, angles in radians growing clockwise on
// screen.
#pragma once

#include <jet/version.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace jet {

/// A point or a direction, in scene units. Value-initialised to zero (JET's targets define
/// EIGEN_INITIALIZE_MATRICES_BY_ZERO).
using Vec2 = Eigen::Vector2d;

inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
/// `v` turned a quarter turn clockwise on screen (x right, y down).
inline Vec2 perpendicular(const Vec2& v) { return {-v.y(), v.x()}; }
inline bool isFinite(const Vec2& v) { return std::isfinite(v.x()) && std::isfinite(v.y()); }

/// An affine map of the plane; the default is the identity. `a * b` applies b first.
class Affine : public Eigen::Transform<double, 2, Eigen::AffineCompact> {
public:
    using Base = Eigen::Transform<double, 2, Eigen::AffineCompact>;

    Affine() : Base(Base::Identity()) {}
    template <class Other>
    Affine(const Other& other) : Base(other)
    {
    }

    // In the library: inline, their products of maps would be instantiated in every file that sees this one, which is
    // half of the time of a small one.
    JET_API static Affine translation(const Vec2& by);
    JET_API static Affine scaling(const Vec2& factor, const Vec2& about = Vec2::Zero());
    /// Turns by `angle` radians, clockwise on screen.
    JET_API static Affine rotation(double angle, const Vec2& about = Vec2::Zero());
    /// SVG's matrix(a b c d e f): x' = a x + c y + e, y' = b x + d y + f.
    static Affine fromSvg(double a, double b, double c, double d, double e, double f)
    {
        Affine m;
        m(0, 0) = a, m(1, 0) = b, m(0, 1) = c, m(1, 1) = d, m(0, 2) = e, m(1, 2) = f;
        return m;
    }

    bool isIdentity() const { return matrix() == Base::Identity().matrix(); }
    bool isInvertible() const { return std::abs(linear().determinant()) > 1e-300; }
    /// The factor by which areas grow, as a length: sqrt(|det|).
    double meanScale() const { return std::sqrt(std::abs(linear().determinant())); }
};

/// An axis-parallel box, in scene units. The default box is empty: extending it by a point makes it that point.
struct Box {
    Vec2 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Vec2 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

    Box() = default;
    /// The box of two opposite corners, in any order.
    Box(const Vec2& a, const Vec2& b) : min(a.cwiseMin(b)), max(a.cwiseMax(b)) {}

    /// Nothing in it, not even a point.
    bool isNull() const { return min.x() > max.x() || min.y() > max.y(); }
    /// No area.
    bool isEmpty() const { return !(min.x() < max.x() && min.y() < max.y()); }
    Vec2 size() const { return isNull() ? Vec2(0, 0) : Vec2(max - min); }
    Vec2 center() const { return 0.5 * (min + max); }
    double width() const { return size().x(); }
    double height() const { return size().y(); }

    void extend(const Vec2& p) { min = min.cwiseMin(p), max = max.cwiseMax(p); }
    void extend(const Box& b) { min = min.cwiseMin(b.min), max = max.cwiseMax(b.max); }
    Box inflated(double by) const
    {
        Box b = *this;
        b.min -= Vec2(by, by), b.max += Vec2(by, by);
        return b;
    }
    bool contains(const Vec2& p) const
    {
        return p.x() >= min.x() && p.x() <= max.x() && p.y() >= min.y() && p.y() <= max.y();
    }
    bool contains(const Box& b) const { return contains(b.min) && contains(b.max); }
    bool intersects(const Box& b) const
    {
        return min.x() <= b.max.x() && b.min.x() <= max.x() && min.y() <= b.max.y() && b.min.y() <= max.y();
    }
    bool operator==(const Box& b) const { return min == b.min && max == b.max; }
};

}  // namespace jet
