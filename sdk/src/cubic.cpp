// One cubic Bézier piece: evaluation, exact bounds, subdivision, arc length. Farin, Curves and Surfaces for CAGD, ch.
// 4-5.
#include <jet/path.hpp>

#include "roots.hpp"

namespace jet {

namespace {

// Abscissae and weights of the 16-point Gauss-Legendre rule on [-1, 1], positive half (Abramowitz & Stegun,
// table 25.4).
constexpr std::array<double, 8> kAbscissae{0.0950125098376374402, 0.2816035507792589132, 0.4580167776572273863,
                                           0.6178762444026437484, 0.7554044083550030339, 0.8656312023878317439,
                                           0.9445750230732325761, 0.9894009349916499326};
constexpr std::array<double, 8> kWeights{0.1894506104550684963, 0.1826034150449235889, 0.1691565193950025382,
                                         0.1495959888165767321, 0.1246289712555338720, 0.0951585116824927848,
                                         0.0622535239386478929, 0.0271524594117540949};

constexpr double kLengthTolerance = 1e-11;  // of the whole; ten times below what is promised
constexpr int kLengthDepth = 24;  // a cusp needs about 18 halvings: its error falls with the square of the width

double lengthByGauss(const Cubic& curve, double t0, double t1)
{
    const double middle = 0.5 * (t0 + t1), half = 0.5 * (t1 - t0);
    double sum = 0;
    for (std::size_t i = 0; i < kAbscissae.size(); ++i) {
        const double offset = half * kAbscissae[i];
        sum += kWeights[i] * (curve.derivative(middle - offset).norm() + curve.derivative(middle + offset).norm());
    }
    return half * sum;
}

/// `noise` is the rounding error of the speed: without it a piece at a cusp would be halved for ever.
double adaptiveLength(const Cubic& curve, double t0, double t1, double whole, double tolerance, double noise, int depth)
{
    const double middle = 0.5 * (t0 + t1);
    const double left = lengthByGauss(curve, t0, middle), right = lengthByGauss(curve, middle, t1);
    if (depth == 0 || std::abs(left + right - whole) <= std::max(tolerance, noise * (t1 - t0))) return left + right;
    return adaptiveLength(curve, t0, middle, left, tolerance, noise, depth - 1) +
           adaptiveLength(curve, middle, t1, right, tolerance, noise, depth - 1);
}

/// Largest coordinate of any control point relative to the first.
double extent(const Cubic& c)
{
    double largest = 0;
    for (const Vec2& p : c.p) largest = std::max(largest, (p - c.p[0]).cwiseAbs().maxCoeff());
    return largest;
}

}  // namespace

Cubic Cubic::quadratic(const Vec2& a, const Vec2& control, const Vec2& b)
{
    return {{a, a + (2.0 / 3.0) * (control - a), b + (2.0 / 3.0) * (control - b), b}};
}

Vec2 Cubic::at(double t) const
{
    const double u = 1 - t;
    return (u * u * u) * p[0] + (3 * u * u * t) * p[1] + (3 * u * t * t) * p[2] + (t * t * t) * p[3];
}

Vec2 Cubic::derivative(double t) const
{
    const double u = 1 - t;
    return (3 * u * u) * (p[1] - p[0]) + (6 * u * t) * (p[2] - p[1]) + (3 * t * t) * (p[3] - p[2]);
}

Box Cubic::bounds() const
{
    Box box(p[0], p[3]);
    if (box.contains(p[1]) && box.contains(p[2])) return box;  // the curve lies in the hull of its control points
    for (int axis = 0; axis < 2; ++axis)
        for (const double t : cubicExtrema(p[0][axis], p[1][axis], p[2][axis], p[3][axis])) {
            const double extreme = at(t)[axis];
            box.min[axis] = std::min(box.min[axis], extreme);
            box.max[axis] = std::max(box.max[axis], extreme);
        }
    return box;
}

std::array<Cubic, 2> Cubic::split(double t) const
{
    const auto between = [t](const Vec2& a, const Vec2& b) -> Vec2 { return (1 - t) * a + t * b; };
    const Vec2 a = between(p[0], p[1]), b = between(p[1], p[2]), c = between(p[2], p[3]);
    const Vec2 ab = between(a, b), bc = between(b, c);
    const Vec2 middle = between(ab, bc);
    return {Cubic{{p[0], a, ab, middle}}, Cubic{{middle, bc, c, p[3]}}};
}

double Cubic::length(double t0, double t1) const
{
    if (t0 > t1) std::swap(t0, t1);
    if (isCornerLine()) {
        const auto share = [](double t) { return t * t * (3 - 2 * t); };
        return (share(t1) - share(t0)) * std::hypot(p[3].x() - p[0].x(), p[3].y() - p[0].y());
    }
    const double scale = extent(*this);
    if (!(scale > 0) || !std::isfinite(scale)) return scale;
    Cubic unit;  // so that squares neither overflow nor vanish
    for (std::size_t i = 0; i < 4; ++i) unit.p[i] = (p[i] - p[0]) / scale;
    const double whole = lengthByGauss(unit, t0, t1);
    return scale * adaptiveLength(unit, t0, t1, whole, kLengthTolerance * whole, 1e-14, kLengthDepth);
}

bool Cubic::isLine() const
{
    if (isCornerLine()) return true;
    const Vec2 chord = p[3] - p[0];
    const double length = std::hypot(chord.x(), chord.y());
    const double tolerance = 1e-12 * length;
    if (!(length > 0)) return p[1] == p[0] && p[2] == p[0];
    const Vec2 along = chord / length;
    const auto onChord = [&](const Vec2& q) {
        const Vec2 offset = q - p[0];
        const double place = offset.dot(along);
        return std::abs(cross(along, offset)) <= tolerance && place >= -tolerance && place <= length + tolerance;
    };
    return onChord(p[1]) && onChord(p[2]);
}

}  // namespace jet
