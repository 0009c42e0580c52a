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

/// V: 8 lanes; W: as many as are computed at a time, of one row of 8 or two.
template <class V, class W = V>
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
        __m128d least = splat(1);
        const auto weigh = [&](const double* inverse, float* to) {
            const __m128d low = _mm_loadu_pd(inverse), high = _mm_loadu_pd(inverse + 2);
            least = _mm_min_pd(least, _mm_min_pd(low, high));
            _mm_storeu_ps(to, _mm_movelh_ps(_mm_cvtpd_ps(low), _mm_cvtpd_ps(high)));
        };
        const auto inverse = [&](std::size_t node) { return out.row(node) + 4 * kFlightLanes; };
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
            : first(ring.first), size(ring.size), stride(ring.stride()), mask(ring.size - 1)
        {
        }
        float* at(std::size_t plane, std::size_t node) const { return first + plane * stride + (node & mask); }
        /// After what starts at node, a multiple of 8, was put down: for who reads across the end of the ring.
        void repeat(std::size_t planes, std::size_t node) const
        {
            if ((node & mask) >= kFlightLanes) return;
            float* const from = first + (node & mask);
            for (std::size_t k = 0; k < planes; ++k) V::store(from + k * stride + size, V::load(from + k * stride));
        }
    };

    /// Moves the nodes at which these forces pull.
    template <class L>
    struct Mover {
        using F = typename L::F;
        FlightPlanes planes;
        F h, pushed, lost, gravityX, gravityY, frameVx, frameVy;
        bool damped, first;

        Mover(const FlightStep& step, const FlightPlanes& planes_)
            : planes(planes_), h(L::all(step.h)), pushed(L::all(step.pushed)), lost(L::all(step.lost)),
              gravityX(L::all(step.gravityX)), gravityY(L::all(step.gravityY)), frameVx(L::all(step.frameVx)),
              frameVy(L::all(step.frameVy)), damped(step.lost != 0), first(step.first)
        {
        }
        void operator()(std::size_t node, F fx, F fy) const
        {
            float* const own = planes.row(node);
            const F inverse = L::load(own + 4 * kFlightLanes);
            axis(planes.first + node, own, gain(gravityX, inverse, fx), frameVx);
            axis(planes.first + planes.stride + node, own + kFlightLanes, gain(gravityY, inverse, fy), frameVy);
        }

    private:
        F gain(F gravity, F inverse, F force) const
        {
            const F fall = L::zeroUnlessAbove(gravity, inverse, 0);
            return L::mul(pushed, L::add(fall, L::mul(inverse, force)));
        }
        void axis(float* place, float* own, F gained, F frame) const
        {
            float *const velocity = place + 2 * planes.stride, *const moved = own + 2 * kFlightLanes;
            const F before = L::load(velocity);
            if (damped) gained = L::add(gained, L::mul(lost, L::add(before, frame)));
            const F now = L::add(before, gained), change = first ? gained : L::add(L::load(own), gained);
            const F way = L::mul(h, change);
            L::store(velocity, now);
            L::store(own, change);
            L::store(moved, first ? way : L::add(L::load(moved), way));
            L::store(place, L::add(L::load(place), L::mul(h, now)));
        }
    };

    /// The way of a part through its nodes: their springs pull, and a little behind, when all that pulls at them is
    /// known and written, they are moved. kCount: number of differences; 0: any.
    template <std::size_t kCount>
    struct Passage {
        const SpringBlocks of;
        const std::uint8_t* const presence;
        const FlightPlanes planes;
        const Ring ring;
        const Stretch part;
        const Mover<V> move;
        const Mover<W> moveMany;
        const std::size_t any, room;
        std::size_t differences[kMostDifferences];
        std::size_t block, torn = 0;

        static constexpr std::size_t kWide = W::kRows * kLanes;
        static constexpr std::size_t kBehind = 96;  // nodes; forces should be in the cache, not on their way there
        static_assert(kBehind % kWide == 0 && kPortion % kWide == 0);

        Passage(const SpringBlocks& blocks, const FlightPattern& pattern, const FlightStep& step,
                const FlightPlanes& planes_, const FlightRing& in, const Stretch& part_)
            : of(blocks), presence(pattern.present), planes(planes_), ring(in), part(part_), move(step, planes_),
              moveMany(step, planes_), any(pattern.count), room(headFor(blocks.reach)), block(part_.run)
        {
            std::copy_n(pattern.differences, any, differences);
            std::fill_n(ring.first, 2 * (any + 1) * ring.stride, 0.0F);
        }
        std::size_t count() const { return kCount > 0 ? kCount : any; }

        void go()
        {
            const std::size_t end = padded(part.end);
            std::size_t node = part.first, settled = part.first;
            for (; node + kWide <= end; node += kWide) {
                if (!pullWhole<W>(node)) {
                    pull(node);
                    if constexpr (W::kRows == 2) pull(node + kLanes);
                }
                for (std::size_t row = node; row < node + kWide; row += kLanes) ring.repeat(2 * (count() + 1), row);
                if (node < settled + kBehind) continue;
                settle<W>(settled, moveMany);
                settled += kWide;
            }
            for (; node < end; node += kLanes) {
                pull(node);
                ring.repeat(2 * (count() + 1), node);
            }
            for (; settled < end; settled += kLanes) settle<V>(settled, move);
            if (part.spilt) spill();
        }

    private:
        void pull(std::size_t node)
        {
            if (W::kRows == 1 || !pullWhole<V>(node)) pullRow(node);
        }
        /// The blocks that start at these nodes, if there is one for each difference, and none tears or is crushed.
        template <class L>
        bool pullWhole(std::size_t node)
        {
            using F = typename L::F;
            if constexpr (kCount == 0) return false;
            if (of.tear) return false;
            for (std::size_t row = 0; row < L::kRows; ++row)
                if (presence[node / kLanes + row] != (1U << kCount) - 1) return false;
            const std::size_t stride = planes.stride;
            const float* const a = planes.first + node;
            const F x = L::load(a), y = L::load(a + stride);
            const F vx = L::load(a + 2 * stride), vy = L::load(a + 3 * stride);
            F sumX = L::zero(), sumY = L::zero();
            typename L::Mask crushed = L::none();
            float* to = ring.at(0, node);
#pragma GCC unroll 4
            for (std::size_t k = 0; k < kCount; ++k) {
                const float* const b = a + differences[k];
                const F offX = L::sub(x, L::load(b)), offY = L::sub(y, L::load(b + stride));
                const F offVx = L::sub(vx, L::load(b + 2 * stride)), offVy = L::sub(vy, L::load(b + 3 * stride));
                // As in KernelSet::tension.
                const F squared = squares<L>(offX, offY);
                const F length = L::sqrt(squared), inverse = L::div(L::one(), squared);
                const std::uint32_t* const kind = of.kind + block + k;
                const auto each = [&](const float* kinds) {
                    return L::rows([=](std::size_t row) { return kinds + 16 * std::size_t{kind[row * kCount]}; });
                };
                const F rest = L::rows([&](std::size_t row) { return of.rest + 8 * (block + row * kCount + k); });
                const F least = L::most(L::mul(L::all(kCrushed), rest), L::all(kLeastLength));
                crushed = L::either(crushed, L::above(least, length));
                const F approach = L::add(L::mul(offVx, offX), L::mul(offVy, offY));
                const F pull = L::mul(L::mul(each(of.kinds), L::sub(length, rest)), L::mul(length, inverse));
                const F force = L::add(pull, L::mul(L::mul(each(of.kinds + 8), approach), inverse));
                const F fx = L::mul(force, offX), fy = L::mul(force, offY);
                sumX = L::add(sumX, fx), sumY = L::add(sumY, fy);
                L::store(to, fx), L::store(to + ring.stride, fy);
                to += 2 * ring.stride;
            }
            L::store(to, sumX), L::store(to + ring.stride, sumY);
            if (L::any(crushed)) return false;
            block += L::kRows * kCount;
            return true;
        }
        /// The blocks that start at 8 nodes, whatever they are.
        [[gnu::noinline]] void pullRow(std::size_t node)
        {
            const std::size_t stride = planes.stride;
            const float* const a = planes.first + node;
            const typename Springs::Offsets at{V::load(a), V::load(a + stride), V::load(a + 2 * stride),
                                               V::load(a + 3 * stride)};
            F8 sumX = V::zero(), sumY = V::zero();
            for (std::size_t k = 0; k < count(); ++k) {
                F8 fx = V::zero(), fy = V::zero();
                if ((presence[node / kLanes] >> k & 1) != 0) {
                    const float* const b = a + differences[k];
                    const typename Springs::Offsets apart{V::sub(at.x, V::load(b)), V::sub(at.y, V::load(b + stride)),
                                                          V::sub(at.vx, V::load(b + 2 * stride)),
                                                          V::sub(at.vy, V::load(b + 3 * stride))};
                    if (Springs::tension(of, block, apart, fx, fy)) of.torn[torn++] = static_cast<std::uint32_t>(block);
                    sumX = V::add(sumX, fx), sumY = V::add(sumY, fy);
                    ++block;
                }
                float* const to = ring.at(2 * k, node);
                V::store(to, fx), V::store(to + ring.stride, fy);
            }
            float* const own = ring.at(2 * count(), node);
            V::store(own, sumX), V::store(own + ring.stride, sumY);
        }
        /// What pulls at these nodes.
        template <class L>
        void gather(std::size_t node, typename L::F& x, typename L::F& y) const
        {
            const std::size_t count = kCount > 0 ? kCount : any;
            x = L::zero(), y = L::zero();
#pragma GCC unroll 4
            for (std::size_t k = 0; k < count; ++k) {
                const float* from = ring.at(2 * k, node - differences[k]);
                x = L::add(x, L::load(from)), y = L::add(y, L::load(from + ring.stride));
            }
            const float* own = ring.at(2 * count, node);
            x = L::sub(x, L::load(own)), y = L::sub(y, L::load(own + ring.stride));
        }
        template <class L>
        void settle(std::size_t node, const Mover<L>& mover)
        {
            typename L::F fx, fy;
            gather<L>(node, fx, fy);
            if (node >= part.first + part.head) return mover(node, fx, fy);
            float* const held = part.held + (node - part.first);
            L::store(held, fx), L::store(held + room, fy);
        }
        void spill()
        {
            F8 fx, fy;
            for (std::size_t node = part.end; node < part.end + room; node += kLanes) {
                for (std::size_t k = 0; k < 2 * (count() + 1); ++k) V::store(ring.at(k, node), V::zero());
                ring.repeat(2 * (count() + 1), node);
                gather<V>(node, fx, fy);
                float* const spilt = part.spilt + (node - part.end);
                V::store(spilt, fx), V::store(spilt + room, fy);
            }
        }
    };

    template <std::size_t kCount>
    static std::size_t flyOf(const SpringBlocks& blocks, const FlightPattern& pattern, const FlightStep& step,
                             const FlightPlanes& planes, const FlightRing& ring, const Stretch& part)
    {
        Passage<kCount> passage(blocks, pattern, step, planes, ring, part);
        passage.go();
        return passage.torn;
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
        const Mover<V> move(step, planes);
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
            const float* const own = planes.row(node);
            const float* const vx = planes.first + 2 * planes.stride + node;
            const F8 speed = squares<V>(V::load(vx), V::load(vx + planes.stride));
            far = V::most(far, squares<V>(V::load(own + 2 * kFlightLanes), V::load(own + 3 * kFlightLanes)));
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

    template <class L>
    static typename L::F squares(typename L::F x, typename L::F y)
    {
        return L::add(L::mul(x, x), L::mul(y, y));
    }

    /// Sums over nodes, those of every eighth node together.
    static void sum(const NodeArrays& nodes, const double* mass, const FlightPlanes& planes, std::size_t first,
                    std::size_t end, FlightSurvey& found)
    {
        double sums[6][kLanes]{};
        for (std::size_t node = first; node < end; ++node) {
            const std::size_t k = node % kLanes;
            const float* const own = planes.row(node);
            const double m = mass[node];
            for (std::size_t of = 0; of < 4; ++of) sums[of][k] += m * static_cast<double>(own[of * kFlightLanes]);
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
            const float* const own = planes.row(node);
            const __m128 dx = _mm_loadu_ps(own), dy = _mm_loadu_ps(own + kFlightLanes);
            const __m128 hx = _mm_loadu_ps(own + 2 * kFlightLanes), hy = _mm_loadu_ps(own + 3 * kFlightLanes);
            settle(position + 2 * node, velocity + 2 * node, _mm_unpacklo_ps(dx, dy), _mm_unpacklo_ps(hx, hy));
            settle(position + 2 * node + 4, velocity + 2 * node + 4, _mm_unpackhi_ps(dx, dy), _mm_unpackhi_ps(hx, hy));
        }
        for (; node < end; ++node) {
            const float* const own = planes.row(node);
            settle.one(position + 2 * node, velocity + 2 * node, Springs::widened(own, own + kFlightLanes),
                       Springs::widened(own + 2 * kFlightLanes, own + 3 * kFlightLanes));
        }
    }

    static constexpr FlightKernels table{&takeOff, &fly, &flyHead, &survey, &land};
};

}  // namespace
}  // namespace jet::physics::soft
