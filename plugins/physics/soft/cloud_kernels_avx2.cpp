// The passes over the particles of a body for processors with AVX2.
#include "cloud_kernels.hpp"

#include "rigid/lanes.hpp"

#include <immintrin.h>

namespace jet::physics::soft::avx2 {
#include "cloud_lanes.inc.hpp"

#include "cloud_kernels.inc.hpp"
}  // namespace jet::physics::soft::avx2
