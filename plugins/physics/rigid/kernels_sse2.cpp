// The solver's kernels for SSE2.
#include "solver_data.hpp"

namespace jet::physics::sse2 {
#include "kernels.inc.hpp"
}  // namespace jet::physics::sse2
