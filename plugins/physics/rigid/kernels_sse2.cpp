// The solver's kernels for SSE2.
#include "contact.hpp"
#include "solver_data.hpp"

#include <cstddef>

namespace jet::physics::sse2 {
#include "kernels.inc.hpp"
}  // namespace jet::physics::sse2
