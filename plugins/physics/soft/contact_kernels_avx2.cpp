// The kernels of contacts between soft bodies for processors with AVX2.
#include "contact_kernels.hpp"

#include <immintrin.h>

namespace jet::physics::soft::avx2 {
#include "contact_lanes.inc.hpp"

#include "contact_kernels.inc.hpp"
}  // namespace jet::physics::soft::avx2
