// The numbers of direction(), for whoever works out many at once and has to get the same bits.
#pragma once

namespace jet::physics {

// pi/2 in two parts: k * kHalfPiHigh is exact for |k| < 2^20, so the reduction keeps full precision for common angles.
inline constexpr double kHalfPiHigh = 1.57079632673412561417;
inline constexpr double kHalfPiLow = 6.07710050650619224932e-11;

inline constexpr double kFarAngle = 1e9;             // radians, and more: reduced by a remainder first
inline constexpr double kRounds = 6755399441055744;  // adding it rounds to a whole number, which the last bits count

/// Terms of the Taylor sums of cos x and sin x / x in x², for |x| <= pi/4; the first that are left out are below 1e-17.
inline constexpr double kCosineTerms[] = {-1.0 / 6402373705728000.0,
                                          1.0 / 20922789888000.0,
                                          -1.0 / 87178291200.0,
                                          1.0 / 479001600.0,
                                          -1.0 / 3628800.0,
                                          1.0 / 40320.0,
                                          -1.0 / 720.0,
                                          1.0 / 24.0,
                                          -1.0 / 2.0,
                                          1.0};
inline constexpr double kSineTerms[] = {0.0,
                                        1.0 / 355687428096000.0,
                                        -1.0 / 1307674368000.0,
                                        1.0 / 6227020800.0,
                                        -1.0 / 39916800.0,
                                        1.0 / 362880.0,
                                        -1.0 / 5040.0,
                                        1.0 / 120.0,
                                        -1.0 / 6.0,
                                        1.0};

}  // namespace jet::physics
