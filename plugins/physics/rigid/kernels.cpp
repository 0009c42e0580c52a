// Which kernels the processor can run.
#include "look.hpp"
#include "sift.hpp"
#include "solver_data.hpp"

namespace jet::physics {

bool hasAvx2() { return __builtin_cpu_supports("avx2") != 0; }

namespace {

bool wide(KernelChoice choice) { return choice != KernelChoice::Sse2 && hasAvx2(); }

}  // namespace

template <>
const Kernels<float>& kernels<float>(KernelChoice choice)
{
    return wide(choice) ? avx2::singles : sse2::singles;
}
template <>
const Kernels<double>& kernels<double>(KernelChoice choice)
{
    return wide(choice) ? avx2::doubles : sse2::doubles;
}

KernelChoice choiceOf(const WorldSettings& settings)
{
    switch (settings.simd) {
    case Simd::Sse2: return KernelChoice::Sse2;
    case Simd::Avx2:
    case Simd::Avx512: return KernelChoice::Avx2;  // nothing of rigid bodies is written for AVX-512
    case Simd::Automatic: break;
    }
    return KernelChoice::Best;
}

const Looker& looker(KernelChoice choice) { return wide(choice) ? avx2::pairLooker : sse2::pairLooker; }
const Sieve& sieve(KernelChoice choice) { return wide(choice) ? avx2::pairSieve : sse2::pairSieve; }

}  // namespace jet::physics
