// The kernels over a vector type V of one instruction set; included once by each kernels_<set>.cpp. Everything here has
// internal linkage, so that no code compiled for a newer processor is ever shared with older ones.
#pragma once

#include "kernels.hpp"

#include <algorithm>
#include <immintrin.h>

namespace jet::physics::soft {
namespace {

// Springs shorter than this have no direction.
constexpr float kLeastLength = 1e-15F;  // units

inline __m128d splat(double value) { return _mm_set1_pd(value); }

/// How nodes move on: see Kernels::advance.
struct Advance {
    double h, slow;  ///< what is faster than `slow` along an axis is looked at more closely
    double driftX, driftY;

    bool drifts() const { return driftX != 0 || driftY != 0; }
};

/// One node after the other, from n on, until one has a component of velocity that is not below `slow`.
inline std::size_t advanceOne(double* position, double* velocity, std::size_t n, std::size_t nodes, const Advance& by)
{
    const __m128d step = splat(by.h), signs = splat(-0.0), least = splat(by.slow);
    const __m128d drift = _mm_setr_pd(by.driftX, by.driftY);
    const bool drifts = by.drifts();
    for (; n < nodes; ++n) {
        __m128d v = _mm_loadu_pd(velocity + 2 * n);
        if (drifts) v = _mm_add_pd(v, drift);
        if (_mm_movemask_pd(_mm_cmple_pd(_mm_andnot_pd(signs, v), least)) != 3) break;
        if (drifts) _mm_storeu_pd(velocity + 2 * n, v);
        _mm_storeu_pd(position + 2 * n, _mm_add_pd(_mm_loadu_pd(position + 2 * n), _mm_mul_pd(step, v)));
    }
    return n;
}

template <class V>
struct KernelSet {
    using F8 = typename V::F8;
    struct Offsets {
        F8 x, y, vx, vy;
    };

    /// Sums of forces, those of every fourth node together; are there nodes that never move?
    struct Sums {
        double of[4][2]{};
        bool pinned = false;

        void total(Swing& swing) const
        {
            swing.x = (of[0][0] + of[1][0]) + (of[2][0] + of[3][0]);
            swing.y = (of[0][1] + of[1][1]) + (of[2][1] + of[3][1]);
            swing.pinned = pinned;
        }
    };

    /// Tensions of one block along x and y; true where a spring may be longer than it holds.
    static bool tension(const SpringBlocks& blocks, std::size_t block, const Offsets& o, F8& fx, F8& fy)
    {
        const float* kind = blocks.kinds + 16 * std::size_t{blocks.kind[block]};
        const F8 squared = V::add(V::mul(o.x, o.x), V::mul(o.y, o.y));
        // The division does not wait for the root: both are slow, and what depends on them stands in line.
        const F8 length = V::sqrt(squared);
        F8 inverse = V::div(V::one(), squared);
        const F8 rest = V::load(blocks.rest + 8 * block), stiffness = V::load(kind);
        const F8 crushed = V::mul(V::all(kCrushed), rest);
        const bool crush = V::anyAbove(V::most(crushed, V::all(kLeastLength)), length);
        if (crush) inverse = V::zeroUnlessAbove(inverse, length, kLeastLength);
        const F8 approach = V::add(V::mul(o.vx, o.x), V::mul(o.vy, o.y));
        F8 damping = V::mul(V::load(kind + 8), approach);
        if (crush) {
            const F8 damped = V::mul(V::mul(V::all(blocks.crush), stiffness), approach);
            damping = V::add(damping, V::zeroUnlessAbove(damped, V::sub(crushed, length), 0));
        }
        const F8 pull = V::mul(V::mul(stiffness, V::sub(length, rest)), V::mul(length, inverse));
        const F8 force = V::add(pull, V::mul(damping, inverse));
        fx = V::mul(force, o.x);
        fy = V::mul(force, o.y);
        return blocks.tear && V::anyAbove(length, V::load(blocks.tear + 8 * block));
    }

    static void add(float* plane, F8 force) { V::store(plane, V::add(V::load(plane), force)); }
    static void sub(float* plane, F8 force) { V::store(plane, V::sub(V::load(plane), force)); }

    /// The runs from number i on whose first nodes are below `end`; planes start at node `base`. Runs with the same
    /// first nodes come one after the other: those are read once, and their forces summed before they are put down.
    /// Returns the next run.
    static std::size_t pullRuns(const SpringBlocks& blocks, std::size_t i, std::size_t end, const Planes& planes,
                                std::size_t base, std::size_t& torn)
    {
        const SpringBlocks of = blocks;
        const std::size_t stride = planes.stride;
        float* const start = planes.first;
        std::size_t tears = torn;
        F8 fx, fy;
        while (i < of.runCount && of.runs[i].a < end) {
            const std::uint32_t first = of.runs[i].a;
            float* const a = start + (first - base);
            const Offsets from{V::load(a), V::load(a + stride), V::load(a + 2 * stride), V::load(a + 3 * stride)};
            F8 sumX = V::zero(), sumY = V::zero();
            do {
                float* const b = start + (of.runs[i].b - base);
                const Offsets apart{V::sub(from.x, V::load(b)), V::sub(from.y, V::load(b + stride)),
                                    V::sub(from.vx, V::load(b + 2 * stride)), V::sub(from.vy, V::load(b + 3 * stride))};
                if (tension(of, i, apart, fx, fy)) of.torn[tears++] = static_cast<std::uint32_t>(i);
                sumX = V::add(sumX, fx), sumY = V::add(sumY, fy);
                add(b + 4 * stride, fx), add(b + 5 * stride, fy);
                ++i;
            } while (i < of.runCount && of.runs[i].a == first);
            sub(a + 4 * stride, sumX), sub(a + 5 * stride, sumY);
        }
        torn = tears;
        return i;
    }

    static std::size_t pull(const SpringBlocks& blocks, const Planes& planes)
    {
        std::size_t torn = 0;
        pullRuns(blocks, 0, planes.room, planes, 0, torn);
        return torn;
    }

    /// The way of one body through the planes, a portion at a time: what it reaches to is related to the frame, its
    /// springs pull, and it is moved; nothing pulls at its nodes any more.
    struct Passage {
        const SpringBlocks& blocks;
        const NodeArrays& nodes;
        const Frame& frame;
        const VelocityStep& step;
        Planes planes;
        const Stretch& part;
        Sums sums{};
        std::size_t base = part.first, moved = part.first, related = part.first;  // nodes; moved <= related
        std::size_t run = part.run, scattered = part.scattered, torn = 0;

        void go(std::size_t end)
        {
            const std::size_t reach = std::min(nodes.count, (end + blocks.reach + 7) & ~std::size_t{7});
            if (reach > related) {
                if (reach > base + planes.room) slide();
                relate(*this, reach);
                related = reach;
            }
            gather(end);
            run = pullRuns(blocks, run, end, planes, base, torn);
            if (end <= part.first + part.head) {
                copyForces(part.held + (moved - part.first), moved, end);
            } else {
                accelerate(*this, end);
            }
            moved = end;
        }
        /// Those on nodes from one to another, to planes of a head.
        void copyForces(float* to, std::size_t from, std::size_t end) const
        {
            const std::size_t room = headFor(blocks.reach);
            std::copy_n(planes[Planes::Fx] + (from - base), end - from, to);
            std::copy_n(planes[Planes::Fy] + (from - base), end - from, to + room);
        }
        /// What is still needed goes to the start of the planes.
        void slide()
        {
            const std::size_t from = moved - base, to = related - base;
            for (std::size_t k = 0; k < Planes::kCount; ++k) {
                float* plane = planes.first + k * planes.stride;
                std::copy(plane + from, plane + to, plane);
            }
            if (planes.near) std::copy(planes.near + 4 * from, planes.near + 4 * to, planes.near);
            base = moved;
        }
        /// The springs that lie anywhere, of blocks whose first node is below `end`.
        void gather(std::size_t end)
        {
            for (; scattered < blocks.scatteredCount && blocks.ends[16 * scattered] < end; ++scattered) {
                std::uint32_t at[16];
                for (std::size_t k = 0; k < 16; ++k)
                    at[k] = blocks.ends[16 * scattered + k] - static_cast<std::uint32_t>(base);
                const std::size_t block = blocks.runCount + scattered;
                F8 fx, fy;
                const Offsets apart = planes.near ? gathered(planes.near, at, at + 8) : picked(planes, at, at + 8);
                if (tension(blocks, block, apart, fx, fy)) blocks.torn[torn++] = static_cast<std::uint32_t>(block);
                scatter(planes, at, at + 8, fx, fy);
            }
        }
    };

    static Swing swing(const SpringBlocks& blocks, const NodeArrays& nodes, const Frame& frame,
                       const VelocityStep& step, const Planes& planes, const Stretch& part)
    {
        Passage way{blocks, nodes, frame, step, planes, part};
        while (way.moved < part.end) way.go(std::min(part.end, way.moved + kPortion));
        if (part.spilt) {
            std::fill_n(part.spilt, 2 * headFor(blocks.reach), 0.0F);
            way.copyForces(part.spilt, part.end, way.related);
        }
        Swing swing;
        swing.torn = way.torn;
        way.sums.total(swing);
        return swing;
    }

    static Swing join(const NodeArrays& nodes, const VelocityStep& step, const Planes& planes, const Stretch& part,
                      const float* spilt)
    {
        const SpringBlocks none;
        const Frame frame;
        Passage way{none, nodes, frame, step, planes, part};
        float *fx = planes[Planes::Fx], *fy = planes[Planes::Fy];
        for (std::size_t k = 0; k < part.head; ++k)
            fx[k] = spilt[k] + part.held[k], fy[k] = spilt[part.head + k] + part.held[part.head + k];
        accelerate(way, part.first + part.head);
        Swing swing;
        way.sums.total(swing);
        return swing;
    }

    static Offsets gathered(const float* near, const std::uint32_t* a, const std::uint32_t* b)
    {
        Offsets o;
        V::transpose(
            [=](std::uint32_t k) {
                return _mm_sub_ps(_mm_loadu_ps(near + 4 * std::size_t{a[k]}),
                                  _mm_loadu_ps(near + 4 * std::size_t{b[k]}));
            },
            o.x, o.y, o.vx, o.vy);
        return o;
    }

    static Offsets picked(const Planes& in, const std::uint32_t* a, const std::uint32_t* b)
    {
        float apart[4][kLanes];
        for (std::size_t plane = 0; plane < 4; ++plane) {
            const float* from = in.first + plane * in.stride;
            for (std::uint32_t k = 0; k < kLanes; ++k) apart[plane][k] = from[a[k]] - from[b[k]];
        }
        return {V::load(apart[0]), V::load(apart[1]), V::load(apart[2]), V::load(apart[3])};
    }

    static void scatter(const Planes& in, const std::uint32_t* a, const std::uint32_t* b, F8 fx, F8 fy)
    {
        float *toX = in[Planes::Fx], *toY = in[Planes::Fy], x[kLanes], y[kLanes];
        V::store(x, fx), V::store(y, fy);
        for (std::uint32_t k = 0; k < kLanes; ++k) {
            toX[a[k]] -= x[k], toY[a[k]] -= y[k];
            toX[b[k]] += x[k], toY[b[k]] += y[k];
        }
    }

    /// Four pairs of doubles from their origins, as four singles along x and four along y.
    template <class From, class Origin>
    static void narrow(From&& from, Origin&& origin, float* x, float* y)
    {
        const auto pair = [&](int i) {
            return _mm_cvtpd_ps(_mm_sub_pd(_mm_loadu_pd(from(i)), _mm_loadu_pd(origin(i))));
        };
        const __m128 low = _mm_movelh_ps(pair(0), pair(1)), high = _mm_movelh_ps(pair(2), pair(3));
        _mm_storeu_ps(x, _mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)));
        _mm_storeu_ps(y, _mm_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)));
    }

    /// From the first that is not in the planes, a multiple of 8, up to `to`; that is one, too, or the last.
    static void relate(const Passage& way, std::size_t to)
    {
        const Planes out = way.planes;
        float *x = out[Planes::X], *y = out[Planes::Y], *vx = out[Planes::Vx], *vy = out[Planes::Vy];
        float *fx = out[Planes::Fx], *fy = out[Planes::Fy];
        const double *position = way.nodes.position, *velocity = way.nodes.velocity;
        const Frame frame = way.frame;
        std::size_t n = way.related, at = n - way.base;
        for (; n + 4 <= to; n += 4, at += 4) {
            V::narrow(position + 2 * n, &frame.x, x + at, y + at);
            V::narrow(velocity + 2 * n, &frame.vx, vx + at, vy + at);
            _mm_storeu_ps(fx + at, _mm_setzero_ps()), _mm_storeu_ps(fy + at, _mm_setzero_ps());
            if (out.near) interleave(out, at);
        }
        for (; n < to; ++n, ++at) {
            x[at] = static_cast<float>(position[2 * n] - frame.x);
            y[at] = static_cast<float>(position[2 * n + 1] - frame.y);
            vx[at] = static_cast<float>(velocity[2 * n] - frame.vx);
            vy[at] = static_cast<float>(velocity[2 * n + 1] - frame.vy);
            fx[at] = fy[at] = 0;
            if (out.near) _mm_storeu_ps(out.near + 4 * at, _mm_setr_ps(x[at], y[at], vx[at], vy[at]));
        }
        // A block at the end of the body reaches beyond it, with lanes that hold no spring.
        if (to == way.nodes.count)
            for (std::size_t k = 0; k < Planes::kCount; ++k) V::store(out.first + k * out.stride + at, V::zero());
    }

    static void interleave(const Planes& out, std::size_t at)
    {
        __m128 node[4];
        for (std::size_t plane = 0; plane < 4; ++plane) node[plane] = _mm_loadu_ps(out.first + plane * out.stride + at);
        _MM_TRANSPOSE4_PS(node[0], node[1], node[2], node[3]);
        for (std::size_t i = 0; i < 4; ++i) _mm_storeu_ps(out.near + 4 * (at + i), node[i]);
    }

    static void relateAlike(const double* position, const double* velocity, const std::uint32_t* nodeAt,
                            std::size_t rows, const Frame* frames, const Planes& out)
    {
        float *x = out[Planes::X], *y = out[Planes::Y], *vx = out[Planes::Vx], *vy = out[Planes::Vy];
        float *fx = out[Planes::Fx], *fy = out[Planes::Fy];
        for (std::size_t half = 0; half < 8; half += 4) {
            const typename V::Origins places(&frames[half].x), moving(&frames[half].vx);
            for (std::size_t at = half; at < 8 * rows; at += 8) {
                places.narrow(position, nodeAt + at, x + at, y + at);
                moving.narrow(velocity, nodeAt + at, vx + at, vy + at);
                _mm_storeu_ps(fx + at, _mm_setzero_ps()), _mm_storeu_ps(fy + at, _mm_setzero_ps());
            }
        }
    }

    static void sumAlike(const Planes& in, std::size_t rows, double* totals)
    {
        for (int axis = 0; axis < 2; ++axis) {
            const float* f = axis == 0 ? in[Planes::Fx] : in[Planes::Fy];
            __m128d sums[4] = {_mm_setzero_pd(), _mm_setzero_pd(), _mm_setzero_pd(), _mm_setzero_pd()};
            for (std::size_t row = 0; row < rows; ++row) {
                for (int half = 0; half < 2; ++half) {
                    const __m128 four = _mm_loadu_ps(f + 8 * row + 4 * half);
                    sums[2 * half] = _mm_add_pd(sums[2 * half], _mm_cvtps_pd(four));
                    sums[2 * half + 1] = _mm_add_pd(sums[2 * half + 1], _mm_cvtps_pd(_mm_movehl_ps(four, four)));
                }
            }
            for (int i = 0; i < 4; ++i) _mm_storeu_pd(totals + 8 * axis + 2 * i, sums[i]);
        }
    }

    struct Push {
        __m128d gravity, h, kept;
        explicit Push(const VelocityStep& step)
            : gravity(_mm_setr_pd(step.gravityX, step.gravityY)), h(splat(step.h)), kept(splat(step.kept))
        {
        }
        void operator()(double* velocity, double inverseMass, __m128d force) const
        {
            const __m128d inverse = splat(inverseMass);
            const __m128d fall = _mm_and_pd(gravity, _mm_cmpgt_pd(inverse, _mm_setzero_pd()));
            const __m128d change = _mm_mul_pd(h, _mm_add_pd(fall, _mm_mul_pd(inverse, force)));
            _mm_storeu_pd(velocity, _mm_mul_pd(kept, _mm_add_pd(_mm_loadu_pd(velocity), change)));
        }
    };

    static void accelerate(double* velocity, double* force, const double* inverseMass, std::size_t nodes,
                           const VelocityStep& step)
    {
        const Push push(step);
        const __m128d zero = _mm_setzero_pd();
        for (std::size_t n = 0; n < nodes; ++n) {
            __m128d all = zero;
            if (force) all = _mm_loadu_pd(force + 2 * n), _mm_storeu_pd(force + 2 * n, zero);
            push(velocity + 2 * n, inverseMass[n], all);
        }
    }

    /// From the first that is not moved, a multiple of 4, up to `to`.
    static void accelerate(Passage& way, std::size_t to)
    {
        const NodeArrays& nodes = way.nodes;
        const float *fx = way.planes[Planes::Fx], *fy = way.planes[Planes::Fy];
        const Push push(way.step);
        const __m128d zero = _mm_setzero_pd();
        std::size_t n = way.moved, at = n - way.base;
        if (!nodes.force) n = V::accelerate(nodes, n, to, way.step, fx + at, fy + at, way.sums.of[0], way.sums.pinned);
        for (; n < to; ++n) {
            at = n - way.base;
            __m128d all = widened(fx + at, fy + at);
            double* sum = way.sums.of[n % 4];
            _mm_storeu_pd(sum, _mm_add_pd(_mm_loadu_pd(sum), all));
            way.sums.pinned |= nodes.inverseMass[n] == 0;
            if (nodes.force) {
                all = _mm_add_pd(_mm_loadu_pd(nodes.force + 2 * n), all);
                _mm_storeu_pd(nodes.force + 2 * n, zero);
            }
            push(nodes.velocity + 2 * n, nodes.inverseMass[n], all);
        }
    }

    static __m128d widened(const float* fx, const float* fy)
    {
        return _mm_cvtps_pd(_mm_unpacklo_ps(_mm_load_ss(fx), _mm_load_ss(fy)));
    }

    static void accelerateAlike(double* velocity, double* force, const double* inverseMass, const std::uint32_t* nodeAt,
                                std::size_t rows, std::size_t count, const VelocityStep* steps, const Planes& in)
    {
        const float *fx = in[Planes::Fx], *fy = in[Planes::Fy];
        // Body by body: their particles lie together.
        std::size_t lane = force ? 0 : V::accelerateAlike(velocity, inverseMass, nodeAt, rows, count, steps, in);
        for (; lane < count; ++lane) {
            const Push push(steps[lane]);
            for (std::size_t row = 0; row < rows; ++row) {
                const std::size_t at = 8 * row + lane, n = nodeAt[at];
                __m128d all = widened(fx + at, fy + at);
                if (force) {
                    all = _mm_add_pd(_mm_loadu_pd(force + 2 * n), all);
                    _mm_storeu_pd(force + 2 * n, _mm_setzero_pd());
                }
                push(velocity + 2 * n, inverseMass[n], all);
            }
        }
    }

    static void advance(double* position, double* velocity, std::size_t nodes, double h, double driftX, double driftY)
    {
        const Advance by{h, 0.7 * kMostSpeed, driftX, driftY};
        for (std::size_t n = 0; n < nodes; ++n) {
            n = V::advance(position, velocity, n, nodes, by);  // up to one that is fast
            if (n == nodes) return;
            __m128d v = _mm_loadu_pd(velocity + 2 * n);
            if (by.drifts()) v = _mm_add_pd(v, _mm_setr_pd(driftX, driftY));
            v = limited(v);
            _mm_storeu_pd(velocity + 2 * n, v);
            _mm_storeu_pd(position + 2 * n, _mm_add_pd(_mm_loadu_pd(position + 2 * n), _mm_mul_pd(splat(h), v)));
        }
    }

    static __m128d limited(__m128d v)
    {
        const __m128d squares = _mm_mul_pd(v, v);
        const __m128d sum = _mm_add_pd(squares, _mm_shuffle_pd(squares, squares, 1));
        if (!(_mm_cvtsd_f64(sum) <= 1e300)) return _mm_setzero_pd();
        const __m128d scale = _mm_div_pd(splat(kMostSpeed), _mm_sqrt_pd(sum));
        return _mm_mul_pd(v, _mm_min_pd(scale, splat(1)));
    }

    static constexpr Kernels with(const FlightKernels& flight)
    {
        return {&swing, &join, &relateAlike, &pull, &sumAlike, &accelerate, &accelerateAlike, &advance, &flight};
    }
};

}  // namespace
}  // namespace jet::physics::soft
