// The kernels of flight.hpp over the vector type V of one instruction set; see kernels_body.hpp.
#pragma once

#include "flight.hpp"
#include "kernels_body.hpp"

#include <algorithm>
#include <cmath>

namespace jet::physics::soft {
namespace {

/// Adds to a node's place and velocity what a flight brought.
struct LandingOne {
    __m128d time, way, gain;

    LandingOne(double t, const FlightReturn& back)
        : time(splat(t)), way(_mm_setr_pd(back.wayX, back.wayY)), gain(_mm_setr_pd(back.gainX, back.gainY))
    {
    }
    void one(double* x, double* v, __m128d gained, __m128d moved) const
    {
        const __m128d before = _mm_loadu_pd(v);
        moved = _mm_add_pd(_mm_mul_pd(time, before), _mm_add_pd(moved, way));
        _mm_storeu_pd(x, _mm_add_pd(_mm_loadu_pd(x), moved));
        _mm_storeu_pd(v, _mm_add_pd(before, _mm_add_pd(gained, gain)));
    }
};

template <class V>
struct FlightSet {
    using F8 = typename V::F8;
    using Springs = KernelSet<V>;

    static std::size_t padded(std::size_t nodes) { return (nodes + 7) & ~std::size_t{7}; }

    static bool takeOff(const NodeArrays& nodes, const Frame& frame, const FlightPlanes& out, std::size_t first,
                        std::size_t end)
    {
        float* const x = out.first;
        float *const y = x + out.stride, *const vx = y + out.stride, *const vy = vx + out.stride;
        std::size_t n = first;
        for (; n + 4 <= end; n += 4) {
            V::narrow(nodes.position + 2 * n, &frame.x, x + n, y + n);
            V::narrow(nodes.velocity + 2 * n, &frame.vx, vx + n, vy + n);
        }
        for (; n < end; ++n) {
            x[n] = static_cast<float>(nodes.position[2 * n] - frame.x);
            y[n] = static_cast<float>(nodes.position[2 * n + 1] - frame.y);
            vx[n] = static_cast<float>(nodes.velocity[2 * n] - frame.vx);
            vy[n] = static_cast<float>(nodes.velocity[2 * n + 1] - frame.vy);
        }
        // Beyond the end of the body, where lanes hold no spring.
        if (end == nodes.count)
            for (std::size_t k = 0; k < FlightPlanes::kCount; ++k) V::store(x + k * out.stride + end, V::zero());
        for (std::size_t row = first; row < end; row += kLanes)
            for (std::size_t k = 0; k < 4; ++k) V::store(out.rows + row / kLanes * kFlightRow + k * kLanes, V::zero());
        __m128d least = splat(1);
        const auto weigh = [&](const double* inverse, float* to) {
            const __m128d low = _mm_loadu_pd(inverse), high = _mm_loadu_pd(inverse + 2);
            least = _mm_min_pd(least, _mm_min_pd(low, high));
            _mm_storeu_ps(to, _mm_movelh_ps(_mm_cvtpd_ps(low), _mm_cvtpd_ps(high)));
        };
        const auto inverse = [&](std::size_t node) {
            return out.rows + node / kLanes * kFlightRow + 4 * kLanes + node % kLanes;
        };
        for (n = first; n + 4 <= end; n += 4) weigh(nodes.inverseMass + n, inverse(n));
        bool pinned = _mm_movemask_pd(_mm_cmple_pd(least, _mm_setzero_pd())) != 0;
        for (; n < padded(end); ++n) {
            *inverse(n) = n < end ? static_cast<float>(nodes.inverseMass[n]) : 0;
            pinned |= n < end && nodes.inverseMass[n] == 0;
        }
        return pinned;
    }

    struct Ring {
        float* const first;
        const std::size_t size, stride, mask;

        explicit Ring(const FlightRing& ring)
            : first(ring.first), size(ring.size), stride(ring.size + kLanes), mask(ring.size - 1)
        {
        }
        float* at(std::size_t plane, std::size_t node) const { return first + plane * stride + (node & mask); }
        /// After what starts at node, a multiple of 8, was put down: for who reads across the end of the ring.
        void repeat(std::size_t planes, std::size_t node) const
        {
            if ((node & mask) != 0) return;
            for (std::size_t k = 0; k < planes; ++k) V::store(first + k * stride + size, V::load(first + k * stride));
        }
    };

    /// What pulls at 8 nodes. kCount: number of differences; 0: any.
    template <std::size_t kCount>
    static void gather(const std::size_t* differences, std::size_t any, const Ring& ring, std::size_t node, F8& x,
                       F8& y)
    {
        const std::size_t count = kCount > 0 ? kCount : any;
        x = V::zero(), y = V::zero();
#pragma GCC unroll 4
        for (std::size_t k = 0; k < count; ++k) {
            const float* from = ring.at(2 * k, node - differences[k]);
            x = V::add(x, V::load(from)), y = V::add(y, V::load(from + ring.stride));
        }
        const float* own = ring.at(2 * count, node);
        x = V::sub(x, V::load(own)), y = V::sub(y, V::load(own + ring.stride));
    }

    /// The blocks that start at nodes from one to another. On its own, as it needs all registers.
    template <std::size_t kCount>
    [[gnu::noinline]] static void pull(const SpringBlocks& blocks, const FlightPattern& pattern,
                                       const std::size_t* differences, const FlightPlanes& planes, const Ring& ring,
                                       std::size_t from, std::size_t to, std::size_t& next, std::size_t& torn)
    {
        const SpringBlocks of = blocks;
        const std::size_t count = kCount > 0 ? kCount : pattern.count, stride = planes.stride;
        std::size_t block = next, tears = torn;
        for (std::size_t node = from; node < to; node += kLanes) {
            const float* const a = planes.first + node;
            const typename Springs::Offsets at{V::load(a), V::load(a + stride), V::load(a + 2 * stride),
                                               V::load(a + 3 * stride)};
            F8 sumX = V::zero(), sumY = V::zero();
            const unsigned present = pattern.present[node / kLanes];
#pragma GCC unroll 4
            for (std::size_t k = 0; k < count; ++k) {
                F8 fx = V::zero(), fy = V::zero();
                if ((present >> k & 1U) != 0) {
                    const float* const b = a + differences[k];
                    const typename Springs::Offsets apart{V::sub(at.x, V::load(b)), V::sub(at.y, V::load(b + stride)),
                                                          V::sub(at.vx, V::load(b + 2 * stride)),
                                                          V::sub(at.vy, V::load(b + 3 * stride))};
                    if (Springs::tension(of, block, apart, fx, fy))
                        of.torn[tears++] = static_cast<std::uint32_t>(block);
                    sumX = V::add(sumX, fx), sumY = V::add(sumY, fy);
                    ++block;
                }
                float* const to = ring.at(2 * k, node);
                V::store(to, fx), V::store(to + ring.stride, fy);
            }
            float* const own = ring.at(2 * count, node);
            V::store(own, sumX), V::store(own + ring.stride, sumY);
            ring.repeat(2 * (count + 1), node);
        }
        next = block, torn = tears;
    }

    /// Moves 8 nodes at which these forces pull.
    struct Mover {
        const FlightPlanes& planes;
        F8 h, pushed, lost, gravityX, gravityY, frameVx, frameVy;
        bool damped;

        Mover(const FlightStep& step, const FlightPlanes& planes_)
            : planes(planes_), h(V::all(step.h)), pushed(V::all(step.pushed)), lost(V::all(step.lost)),
              gravityX(V::all(step.gravityX)), gravityY(V::all(step.gravityY)), frameVx(V::all(step.frameVx)),
              frameVy(V::all(step.frameVy)), damped(step.lost != 0)
        {
        }
        void operator()(std::size_t node, F8 fx, F8 fy) const
        {
            float* const own = planes.rows + node / kLanes * kFlightRow;
            const F8 inverse = V::load(own + 4 * kLanes);
            axis(planes.first + node, own, gain(gravityX, inverse, fx), frameVx);
            axis(planes.first + planes.stride + node, own + kLanes, gain(gravityY, inverse, fy), frameVy);
        }

    private:
        F8 gain(F8 gravity, F8 inverse, F8 force) const
        {
            const F8 fall = V::zeroUnlessAbove(gravity, inverse, 0);
            return V::mul(pushed, V::add(fall, V::mul(inverse, force)));
        }
        void axis(float* place, float* own, F8 gained, F8 frame) const
        {
            float* const velocity = place + 2 * planes.stride;
            const F8 before = V::load(velocity);
            if (damped) gained = V::add(gained, V::mul(lost, V::add(before, frame)));
            const F8 now = V::add(before, gained), change = V::add(V::load(own), gained);
            V::store(velocity, now);
            V::store(own, change);
            V::store(own + 2 * kLanes, V::add(V::load(own + 2 * kLanes), V::mul(h, change)));
            V::store(place, V::add(V::load(place), V::mul(h, now)));
        }
    };

    template <std::size_t kCount>
    [[gnu::noinline]] static void moveOn(const std::size_t* differences, std::size_t count, const Ring& ring,
                                         const Mover& move, std::size_t from, std::size_t to)
    {
        F8 fx, fy;
        for (std::size_t node = from; node < to; node += kLanes) {
            gather<kCount>(differences, count, ring, node, fx, fy);
            move(node, fx, fy);
        }
    }

    template <std::size_t kCount>
    static std::size_t flyOf(const SpringBlocks& blocks, const FlightPattern& pattern, const FlightStep& step,
                             const FlightPlanes& planes, const FlightRing& in, const Stretch& part)
    {
        const Ring ring(in);
        const Mover move(step, planes);
        const std::size_t count = pattern.count, room = headFor(blocks.reach);
        std::fill_n(ring.first, 2 * (count + 1) * ring.stride, 0.0F);
        std::size_t differences[kMostDifferences], block = part.run, torn = 0;
        std::copy_n(pattern.differences, count, differences);
        F8 fx, fy;
        for (std::size_t from = part.first; from < part.end; from += kPortion) {
            const std::size_t to = std::min(part.end, from + kPortion);
            pull<kCount>(blocks, pattern, differences, planes, ring, from, to, block, torn);
            if (from >= part.first + part.head) {
                moveOn<kCount>(differences, count, ring, move, from, to);
                continue;
            }
            for (std::size_t node = from; node < to; node += kLanes) {
                gather<kCount>(differences, count, ring, node, fx, fy);
                float* const held = part.held + (node - part.first);
                V::store(held, fx), V::store(held + room, fy);
            }
        }
        if (!part.spilt) return torn;
        for (std::size_t node = part.end; node < part.end + room; node += kLanes) {
            for (std::size_t k = 0; k < 2 * (count + 1); ++k) V::store(ring.at(k, node), V::zero());
            ring.repeat(2 * (count + 1), node);
            gather<kCount>(differences, count, ring, node, fx, fy);
            float* const spilt = part.spilt + (node - part.end);
            V::store(spilt, fx), V::store(spilt + room, fy);
        }
        return torn;
    }

    static std::size_t fly(const SpringBlocks& blocks, const FlightPattern& pattern, const FlightStep& step,
                           const FlightPlanes& planes, const FlightRing& ring, const Stretch& part)
    {
        switch (pattern.count) {
        case 2: return flyOf<2>(blocks, pattern, step, planes, ring, part);
        case 3: return flyOf<3>(blocks, pattern, step, planes, ring, part);
        case 4: return flyOf<4>(blocks, pattern, step, planes, ring, part);
        default: return flyOf<0>(blocks, pattern, step, planes, ring, part);
        }
    }

    static void flyHead(const FlightStep& step, const FlightPlanes& planes, const Stretch& part, const float* spilt)
    {
        const Mover move(step, planes);
        for (std::size_t k = 0; k < part.head; k += kLanes) {
            const float* const held = part.held + k;
            move(part.first + k, V::add(V::load(held), V::load(spilt + k)),
                 V::add(V::load(held + part.head), V::load(spilt + part.head + k)));
        }
    }

    static FlightSurvey survey(const NodeArrays& nodes, const double* mass, const FlightPlanes& planes, bool free,
                               std::size_t first, std::size_t end)
    {
        F8 far = V::zero(), fast = V::zero(), all = V::zero();
        for (std::size_t node = first; node < end; node += kLanes) {
            const float* const own = planes.rows + node / kLanes * kFlightRow;
            const float* const vx = planes.first + 2 * planes.stride + node;
            const F8 speed = squares(V::load(vx), V::load(vx + planes.stride));
            far = V::most(far, squares(V::load(own + 2 * kLanes), V::load(own + 3 * kLanes)));
            fast = V::most(fast, speed);
            all = V::add(all, speed);  // the greatest forgets what is not a number
        }
        float lanes[3][kLanes];
        V::store(lanes[0], far), V::store(lanes[1], fast), V::store(lanes[2], all);
        FlightSurvey found;
        for (std::size_t k = 0; k < kLanes; ++k) {
            found.farthest = std::max<double>(found.farthest, lanes[0][k]);
            found.fastest = std::isfinite(lanes[2][k]) ? std::max<double>(found.fastest, lanes[1][k]) : NAN;
            if (std::isnan(found.fastest)) break;
        }
        found.farthest = std::sqrt(found.farthest), found.fastest = std::sqrt(found.fastest);
        if (free) sum(nodes, mass, planes, first, end, found);
        return found;
    }

    static F8 squares(F8 x, F8 y) { return V::add(V::mul(x, x), V::mul(y, y)); }

    /// Sums over nodes, those of every eighth node together.
    static void sum(const NodeArrays& nodes, const double* mass, const FlightPlanes& planes, std::size_t first,
                    std::size_t end, FlightSurvey& found)
    {
        double sums[6][kLanes]{};
        for (std::size_t node = first; node < end; ++node) {
            const std::size_t k = node % kLanes;
            const float* const own = planes.rows + node / kLanes * kFlightRow + k;
            const double m = mass[node];
            for (std::size_t of = 0; of < 4; ++of) sums[of][k] += m * static_cast<double>(own[of * kLanes]);
            for (std::size_t of = 0; of < 2; ++of) sums[4 + of][k] += m * nodes.velocity[2 * node + of];
        }
        double totals[6]{};
        for (std::size_t of = 0; of < 6; ++of)
            for (std::size_t k = 0; k < kLanes; ++k) totals[of] += sums[of][k];
        found.gainX = totals[0], found.gainY = totals[1], found.wayX = totals[2], found.wayY = totals[3];
        found.startX = totals[4], found.startY = totals[5];
    }

    static void land(double* position, double* velocity, const FlightPlanes& planes, double t, const FlightReturn& back,
                     std::size_t first, std::size_t end)
    {
        const typename V::Landing settle(t, back);
        std::size_t node = first;
        for (; node + 4 <= end; node += 4) {
            const float* const own = planes.rows + node / kLanes * kFlightRow + node % kLanes;
            const __m128 dx = _mm_loadu_ps(own), dy = _mm_loadu_ps(own + kLanes);
            const __m128 hx = _mm_loadu_ps(own + 2 * kLanes), hy = _mm_loadu_ps(own + 3 * kLanes);
            settle(position + 2 * node, velocity + 2 * node, _mm_unpacklo_ps(dx, dy), _mm_unpacklo_ps(hx, hy));
            settle(position + 2 * node + 4, velocity + 2 * node + 4, _mm_unpackhi_ps(dx, dy), _mm_unpackhi_ps(hx, hy));
        }
        for (; node < end; ++node) {
            const float* const own = planes.rows + node / kLanes * kFlightRow + node % kLanes;
            settle.one(position + 2 * node, velocity + 2 * node, Springs::widened(own, own + kLanes),
                       Springs::widened(own + 2 * kLanes, own + 3 * kLanes));
        }
    }

    static constexpr FlightKernels table{&takeOff, &fly, &flyHead, &survey, &land};
};

}  // namespace
}  // namespace jet::physics::soft
