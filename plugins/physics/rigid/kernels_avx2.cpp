// The solver's kernels for AVX2.
#include "solver_data.hpp"

namespace jet::physics::avx2 {
#include "kernels.inc.hpp"
}  // namespace jet::physics::avx2
