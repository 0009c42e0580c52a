// Full looks at eight pairs for AVX2.
#include "look.hpp"

#include <cmath>

namespace jet::physics::avx2 {
#include "lane_ops.inc.hpp"

#include "look.inc.hpp"
}  // namespace jet::physics::avx2
