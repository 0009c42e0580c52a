// The sieve of pairs for SSE2, or whatever the compiler makes of it elsewhere.
#include "sift.hpp"

#include <cmath>

namespace jet::physics::sse2 {
#include "lane_ops.inc.hpp"

#include "sift.inc.hpp"
}  // namespace jet::physics::sse2
