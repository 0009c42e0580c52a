// The kernels of contacts between soft bodies for any x86-64 processor.
#include "contact_kernels.hpp"

#include <immintrin.h>

namespace jet::physics::soft::sse2 {
#include "contact_lanes.inc.hpp"

#include "contact_kernels.inc.hpp"
}  // namespace jet::physics::soft::sse2
