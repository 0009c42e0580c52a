// Eight floats or four doubles worked on at once, by the compiler's vector types: the same source makes SSE2 pairs and
// AVX2 registers, and the same bits from both (no fused multiply-add, no reassociation).
//
// Only for the kernels' own files: everything is inlined there, so that no function compiled for AVX2 is shared.
#pragma once

#include <cstddef>
#include <cstdint>

#pragma GCC diagnostic ignored "-Wpsabi"

#define JET_INLINED __attribute__((always_inline))
#define JET_INLINE inline JET_INLINED

namespace jet::physics {

template <class Real>
inline constexpr int kLanes = 32 / sizeof(Real);

template <class Real>
struct LaneTypes;
template <>
struct LaneTypes<float> {
    typedef float Values __attribute__((vector_size(32)));
    typedef std::int32_t Mask __attribute__((vector_size(32)));
};
template <>
struct LaneTypes<double> {
    typedef double Values __attribute__((vector_size(32)));
    typedef std::int64_t Mask __attribute__((vector_size(32)));
};
template <class Real>
using Lanes = typename LaneTypes<Real>::Values;

}  // namespace jet::physics
