// Which of eight pairs without points are still so far apart that nothing of them is to be worked out? Most pairs that
// are looked at in a moving heap are: they are sifted out side by side, with the rule of Collider::update(). And which
// of eight boxes comes to meet another?
#pragma once

#include "contact.hpp"
#include "solver_data.hpp"

namespace jet::physics {

struct SiftInput {
    const RigidContact* contacts = nullptr;
    const Pose* poses = nullptr;    // [bodies]
    const FatBox* boxes = nullptr;  // [parts]
    float dt = 0;                   // seconds
    float speculative = 0;          // slops: nearer than this a pair gets points in any case
};

/// Boxes of parts in the order of their cells, and those before they were moved; readable for Sieve::kPairs beyond the
/// last. `reach`: units to the part's farthest point.
struct BoxesInCells {
    const float *minX, *minY, *maxX, *maxY;
    const float *wasMinX, *wasMinY, *wasMaxX, *wasMaxY;
    const float* reach;
};
/// A box that others are sought for.
struct SoughtBox {
    FatBox now, was;
    float reach = 0;
};
struct Stretch {
    Index first = 0, last = 0;  // [first, last)
};

struct Sieve {
    static constexpr int kPairs = 8;
    static constexpr std::size_t kMost = 1024;  // boxes looked through at once
    static constexpr float kLonger = 3;
    /// A bit for each contact without points whose boxes meet and whose bodies cannot touch in this step, though they
    /// move; `until`: units they may come nearer before it gets points. `which`: eight contacts, some may be the same.
    std::uint32_t (*stayApart)(const SiftInput&, const Index* which, float* until) = nullptr;
    /// Which boxes of the stretches, kMost together, meet the box and did not before, or are more than kLonger times
    /// longer or shorter. `hits` has room for kMost + kPairs; how many there are is returned.
    std::size_t (*near)(const BoxesInCells&, const SoughtBox&, const Stretch*, std::size_t count,
                        Index* hits) = nullptr;
};
const Sieve& sieve(KernelChoice);
KernelChoice choiceOf(const WorldSettings&);

namespace sse2 {
extern const Sieve pairSieve;
}  // namespace sse2
namespace avx2 {
extern const Sieve pairSieve;
}  // namespace avx2

}  // namespace jet::physics
