// Sums over the particles of a body, in one pass: where it is, how it moves, and how a shape at rest fits it best.
// SSE2, two doubles at a time: x and y.
#pragma once

#include "state.hpp"

#include <emmintrin.h>

namespace jet::physics::soft {

struct MassSums {
    double mass = 0;
    Vec2 centre = Vec2(0, 0), velocity = Vec2(0, 0);
    double inertia = 0;   // sum m |p|², p from the centre
    double momentum = 0;  // sum m p x v
    // With a shape at rest q, whose own sum m q is null:
    double along = 0, across = 0;  // sum m q·p, sum m q x p

    double omega() const { return inertia > 0 ? momentum / inertia : 0; }
};

/// nodeOf(i): the i-th node; rest: [count] arms at rest, or null.
template <class NodeOf>
inline MassSums massSums(const Nodes& nodes, std::size_t count, NodeOf&& nodeOf, const Vec2* rest)
{
    MassSums sums;
    if (count == 0) return sums;
    const auto swapped = [](__m128d v) { return _mm_shuffle_pd(v, v, 1); };
    const auto total = [](__m128d v) { return _mm_cvtsd_f64(v) + _mm_cvtsd_f64(_mm_unpackhi_pd(v, v)); };
    const auto difference = [](__m128d v) { return _mm_cvtsd_f64(v) - _mm_cvtsd_f64(_mm_unpackhi_pd(v, v)); };
    const Vec2 origin = nodes.position[nodeOf(0)];
    const __m128d from = _mm_loadu_pd(origin.data());
    __m128d place = _mm_setzero_pd(), moving = place, squares = place, turning = place, along = place, across = place;
    for (std::size_t i = 0; i < count; ++i) {
        const Index n = nodeOf(i);
        const __m128d mass = _mm_set1_pd(nodes.mass[n]);
        const __m128d at = _mm_sub_pd(_mm_loadu_pd(nodes.position[n].data()), from);
        const __m128d weighed = _mm_mul_pd(mass, at), speed = _mm_loadu_pd(nodes.velocity[n].data());
        sums.mass += nodes.mass[n];
        place = _mm_add_pd(place, weighed);
        moving = _mm_add_pd(moving, _mm_mul_pd(mass, speed));
        squares = _mm_add_pd(squares, _mm_mul_pd(weighed, at));
        turning = _mm_add_pd(turning, _mm_mul_pd(weighed, swapped(speed)));
        if (!rest) continue;
        const __m128d arm = _mm_loadu_pd(rest[i].data());
        along = _mm_add_pd(along, _mm_mul_pd(arm, weighed));
        across = _mm_add_pd(across, _mm_mul_pd(arm, swapped(weighed)));
    }
    Vec2 centre;
    _mm_storeu_pd(centre.data(), place);
    _mm_storeu_pd(sums.velocity.data(), moving);
    centre /= sums.mass;
    sums.velocity /= sums.mass;
    sums.inertia = std::max(total(squares) - sums.mass * centre.squaredNorm(), 0.0);
    sums.momentum = difference(turning) - sums.mass * cross(centre, sums.velocity);
    sums.along = total(along);
    sums.across = difference(across);
    sums.centre = origin + centre;
    return sums;
}

inline MassSums massSums(const Nodes& nodes, Range range, const Vec2* rest = nullptr)
{
    return massSums(
        nodes, range.count, [&](std::size_t i) { return range.first + static_cast<Index>(i); }, rest);
}

/// Of those that may move: pinned particles have no say in how a body moves.
inline MassSums freeSums(const Nodes& nodes, Range range)
{
    std::vector<Index> moving;
    for (Index n = range.first; n < range.end(); ++n)
        if (nodes.invMass[n] > 0) moving.push_back(n);
    return massSums(
        nodes, moving.size(), [&](std::size_t i) { return moving[i]; }, nullptr);
}

}  // namespace jet::physics::soft
