#include "trigonometry.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace jet::physics {

namespace {

// pi/2 in two parts: k * kHalfPiHigh is exact for |k| < 2^20, so the reduction keeps full precision for common angles.
constexpr double kHalfPiHigh = 1.57079632673412561417;
constexpr double kHalfPiLow = 6.07710050650619224932e-11;

/// A value of the cosine and one of the sine, side by side.
typedef double Both __attribute__((vector_size(16)));

/// Taylor sums of cos x and sin x for |x| <= pi/4; the first terms left out are below 1e-17.
Both nearZero(double x)
{
    constexpr Both kTerms[] = {{-1.0 / 6402373705728000.0, 0.0},
                               {1.0 / 20922789888000.0, 1.0 / 355687428096000.0},
                               {-1.0 / 87178291200.0, -1.0 / 1307674368000.0},
                               {1.0 / 479001600.0, 1.0 / 6227020800.0},
                               {-1.0 / 3628800.0, -1.0 / 39916800.0},
                               {1.0 / 40320.0, 1.0 / 362880.0},
                               {-1.0 / 720.0, -1.0 / 5040.0},
                               {1.0 / 24.0, 1.0 / 120.0},
                               {-1.0 / 2.0, -1.0 / 6.0},
                               {1.0, 1.0}};
    const Both q = {x * x, x * x};
    Both sum = kTerms[0];
    for (std::size_t i = 1; i < std::size(kTerms); ++i) sum = kTerms[i] + q * sum;
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
    constexpr double kRounds = 6755399441055744;  // adding it rounds to a whole number
    if (!(std::abs(angle) < 1e9)) angle = std::remainder(angle, 2 * kPi);
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
