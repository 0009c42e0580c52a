// The sieve of pairs for AVX2.
#include "sift.hpp"

#include <cmath>

namespace jet::physics::avx2 {
#include "sift.inc.hpp"
}  // namespace jet::physics::avx2
