// The solver's kernels for AVX2.
#include "contact.hpp"
#include "solver_data.hpp"

#include <cstddef>

namespace jet::physics::avx2 {
#include "kernels.inc.hpp"
}  // namespace jet::physics::avx2
