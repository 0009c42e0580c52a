// The kernels for processors with AVX2. Compiled with -mavx2; called only where hasAvx2().
#include "avx2_lanes.hpp"

namespace jet::physics::soft {

const Kernels& kernelsAvx2()
{
    static constexpr Kernels kernels = KernelSet<Avx2>::with(FlightSet<Avx2>::table);
    return kernels;
}

}  // namespace jet::physics::soft
