#include "trigonometry.hpp"

#include "trigonometry_terms.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace jet::physics {

namespace {

/// A value of the cosine and one of the sine, side by side.
typedef double Both __attribute__((vector_size(16)));

/// Cosine and sine for |x| <= pi/4.
Both nearZero(double x)
{
    const Both q = {x * x, x * x};
    Both sum = {kCosineTerms[0], kSineTerms[0]};
    for (std::size_t i = 1; i < std::size(kCosineTerms); ++i) sum = Both{kCosineTerms[i], kSineTerms[i]} + q * sum;
    return sum * Both{1, x};
}

/// Arc tangent for x in [0, 1]: above tan(pi/12) reduced by pi/6, then its alternating series.
double atanInUnit(double x)
{
    constexpr double kTanTwelfth = 0.26794919243112270647;
    constexpr double kSqrt3 = 1.73205080756887729353;
    double shift = 0;
    if (x > kTanTwelfth) {
        x = (x * kSqrt3 - 1) / (kSqrt3 + x);
        shift = kPi / 6;
    }
    const double q = x * x;
    double sum = 0;
    for (int n = 27; n >= 1; n -= 2) sum = 1.0 / n - q * sum;
    return shift + x * sum;
}

}  // namespace

Vec2 direction(double angle)
{
    if (!(std::abs(angle) < kFarAngle)) angle = std::remainder(angle, 2 * kPi);
    const double turns = (angle * (2 / kPi) + kRounds) - kRounds;
    const Both at = nearZero((angle - turns * kHalfPiHigh) - turns * kHalfPiLow);
    // No branches: what bodies turn to is as good as random.
    const auto quarter = static_cast<std::uint64_t>(static_cast<std::int64_t>(turns)) & 3;
    const bool odd = (quarter & 1) != 0;
    const auto signedBy = [](double value, std::uint64_t negative) {
        return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ (negative << 63));
    };
    return {signedBy(odd ? at[1] : at[0], ((quarter + 1) >> 1) & 1), signedBy(odd ? at[0] : at[1], quarter >> 1)};
}

double angleOf(double y, double x)
{
    const double ax = std::abs(x), ay = std::abs(y);
    if (ax == 0 && ay == 0) return 0;
    double angle = ay <= ax ? atanInUnit(ay / ax) : kPi / 2 - atanInUnit(ax / ay);
    if (x < 0) angle = kPi - angle;
    return y < 0 ? -angle : angle;
}

double decay(double x)
{
    if (!(x > 0)) return 1;
    if (x > 700) return 0;
    int squarings = 0;
    for (; x > 0.03125; x *= 0.5) ++squarings;
    double sum = 1.0;
    for (int n = 9; n >= 1; --n) sum = 1.0 - sum * x / n;
    for (; squarings > 0; --squarings) sum *= sum;
    return sum;
}

double wrapped(double angle) { return angle - 2 * kPi * std::floor(angle / (2 * kPi) + 0.5); }

}  // namespace jet::physics
