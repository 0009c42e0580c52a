// The sieve of pairs for AVX2.
#include "sift.hpp"

#include <cmath>

namespace jet::physics::avx2 {
#include "lane_ops.inc.hpp"

#include "sift.inc.hpp"
}  // namespace jet::physics::avx2
