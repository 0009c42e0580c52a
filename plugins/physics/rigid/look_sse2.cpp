// Full looks at eight pairs for SSE2, or whatever the compiler makes of it elsewhere.
#include "look.hpp"

#include <cmath>

namespace jet::physics::sse2 {
#include "lane_ops.inc.hpp"

#include "look.inc.hpp"
}  // namespace jet::physics::sse2
