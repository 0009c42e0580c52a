// Roots on the unit interval, for the derivative, distance and crossing polynomials of cubics.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace jet {

/// Up to two parameters inside (0, 1), ascending.
struct UnitRoots {
    std::array<double, 2> t{};
    int count = 0;

    const double* begin() const { return t.data(); }
    const double* end() const { return t.data() + count; }
};

/// Roots of a t² + b t + c inside (0, 1). Uses the form without cancellation (Press et al., Numerical Recipes, 5.6).
inline UnitRoots quadraticUnitRoots(double a, double b, double c)
{
    UnitRoots roots;
    const double scale = std::max({std::abs(a), std::abs(b), std::abs(c)});
    if (!(scale > 0) || !std::isfinite(scale)) return roots;
    a /= scale, b /= scale, c /= scale;
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0) return roots;
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    const auto keep = [&](double t) {
        if (t > 0 && t < 1) roots.t[static_cast<std::size_t>(roots.count++)] = t;
    };
    if (a != 0) keep(q / a);
    if (q != 0) keep(c / q);
    if (roots.count == 2 && roots.t[0] > roots.t[1]) std::swap(roots.t[0], roots.t[1]);
    return roots;
}

/// Roots inside (0, 1) of the derivative of the cubic Bernstein polynomial with coefficients c0 … c3.
inline UnitRoots cubicExtrema(double c0, double c1, double c2, double c3)
{
    const double d0 = c1 - c0, d1 = c2 - c1, d2 = c3 - c2;
    return quadraticUnitRoots(d0 - 2 * d1 + d2, 2 * (d1 - d0), d0);
}

/// The root between lo and hi of a function that is positive left of it if `fromPositive`, else negative, by Newton's
/// steps where they stay in the bracket and bisection where they do not. `f(t)` gives {value, slope}.
template <class F>
double bracketedRoot(F f, double lo, double hi, bool fromPositive)
{
    double t = 0.5 * (lo + hi);
    for (int step = 0; step < 80; ++step) {
        const auto [value, slope] = f(t);
        if (value == 0) return t;
        ((value > 0) == fromPositive ? lo : hi) = t;
        double next = t - value / slope;
        if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
        if (std::abs(next - t) <= 1e-16) return next;
        t = next;
    }
    return t;
}

}  // namespace jet
