// The nearest point of a cubic. The squared distance to q has its extrema where f(t) = (P(t) - q)·P'(t) = 0, a quintic.
// In Bernstein form its coefficients change sign at least as often as it has roots, so halving the interval until there
// is at most one change isolates every root (Schneider, "Solving the nearest-point-on-curve problem", Graphics Gems,
// 1990; with Newton's steps in the brackets, where that article bisects). Sampling and Newton alone, the usual
// shortcut, misses roots.
#include <jet/path.hpp>

#include "roots.hpp"

namespace jet {

namespace {

using Quintic = std::array<double, 6>;  // Bernstein coefficients

constexpr int kDepth = 40;
constexpr int kMostHalvings = 400;  // five roots, each isolated in 40; more is rounding noise

std::array<Quintic, 2> halves(const Quintic& whole)
{
    Quintic left, right, row = whole;
    for (std::size_t level = 0; level < 6; ++level) {
        left[level] = row[0];
        right[5 - level] = row[5 - level];
        for (std::size_t i = 0; i + level < 5; ++i) row[i] = 0.5 * (row[i] + row[i + 1]);
    }
    return {left, right};
}

/// Looks for the point of `curve` nearest to the origin.
class NearestSearch {
public:
    explicit NearestSearch(const Cubic& curve) : curve_(curve), bestSquare_(curve.p[0].squaredNorm())
    {
        consider(1);
        search(distanceQuintic(), 0, 1, kDepth);
        polish();
    }

    double best() const { return best_; }

private:
    /// (P·P') as a Bernstein polynomial: products of basis functions, Farin, ch. 6.
    Quintic distanceQuintic() const
    {
        constexpr std::array<double, 4> choose3{1, 3, 3, 1};
        constexpr std::array<double, 3> choose2{1, 2, 1};
        constexpr Quintic choose5{1, 5, 10, 10, 5, 1};
        Quintic f{};
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                f[i + j] += choose3[i] * choose2[j] * curve_.p[i].dot(3 * (curve_.p[j + 1] - curve_.p[j]));
        for (std::size_t k = 0; k < 6; ++k) f[k] /= choose5[k];
        return f;
    }

    /// f and its derivative P'·P' + P·P''.
    std::pair<double, double> evaluate(double t) const
    {
        const Vec2 point = curve_.at(t), first = curve_.derivative(t);
        const auto& p = curve_.p;
        const Vec2 second = 6 * ((1 - t) * (p[2] - 2 * p[1] + p[0]) + t * (p[3] - 2 * p[2] + p[1]));
        return {point.dot(first), first.squaredNorm() + point.dot(second)};
    }

    bool consider(double t)
    {
        const double square = curve_.at(t).squaredNorm();
        if (!(square < bestSquare_)) return false;
        bestSquare_ = square;
        best_ = t;
        return true;
    }

    void search(const Quintic& f, double lo, double hi, int depth)
    {
        int changes = 0;
        double first = 0, last = 0;  // coefficients that are not rounding noise
        for (const double coefficient : f) {
            if (std::abs(coefficient) <= kNoise) continue;
            if (first == 0) first = coefficient;
            if (last != 0 && (coefficient > 0) != (last > 0)) ++changes;
            last = coefficient;
        }
        if (changes == 0) return;
        if (changes == 1) {
            consider(bracketedRoot([this](double t) { return evaluate(t); }, lo, hi, first > 0));
            return;
        }
        const double middle = 0.5 * (lo + hi);
        consider(middle);
        if (depth == 0 || ++halvings_ > kMostHalvings) return;
        const auto [left, right] = halves(f);
        search(left, lo, middle, depth - 1);
        search(right, middle, hi, depth - 1);
    }

    /// Near a cusp f is all noise in Bernstein form, but its factors are not.
    void polish()
    {
        for (int step = 0; step < 32; ++step) {
            const auto [value, slope] = evaluate(best_);
            if (!(slope > 0) || !consider(std::clamp(best_ - value / slope, 0.0, 1.0))) return;
        }
    }

    static constexpr double kNoise = 4e-15;  // of a quintic whose control points are within 1

    Cubic curve_;
    double best_ = 0;
    double bestSquare_;
    int halvings_ = 0;
};

}  // namespace

double Cubic::nearest(const Vec2& q) const
{
    Cubic relative;
    double scale = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        relative.p[i] = p[i] - q;
        scale = std::max(scale, relative.p[i].cwiseAbs().maxCoeff());
    }
    if (!(scale > 1e-290) || !std::isfinite(scale)) return 0;
    for (Vec2& point : relative.p) point /= scale;  // so that squares neither overflow nor vanish
    return NearestSearch(relative).best();
}

}  // namespace jet
