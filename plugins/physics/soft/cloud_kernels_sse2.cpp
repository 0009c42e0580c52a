// The passes over the particles of a body for any x86-64 processor.
#include "cloud_kernels.hpp"

#include "rigid/lanes.hpp"

#include <immintrin.h>

namespace jet::physics::soft::sse2 {
#include "cloud_lanes.inc.hpp"

#include "cloud_kernels.inc.hpp"
}  // namespace jet::physics::soft::sse2
