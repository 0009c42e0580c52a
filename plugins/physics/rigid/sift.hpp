// Which of eight pairs without points are still so far apart that nothing of them is to be worked out? Most pairs that
// are looked at in a moving heap are: they are sifted out side by side, with the rule of Collider::update().
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

struct Sieve {
    static constexpr int kPairs = 8;
    /// A bit for each contact whose boxes meet and whose bodies cannot touch in this step, though they move; `gaps`:
    /// units they are apart at least. `which`: eight contacts, some may be the same.
    std::uint32_t (*stayApart)(const SiftInput&, const Index* which, float* gaps) = nullptr;
};
const Sieve& sieve(KernelChoice);

namespace sse2 {
extern const Sieve pairSieve;
}  // namespace sse2
namespace avx2 {
extern const Sieve pairSieve;
}  // namespace avx2

}  // namespace jet::physics
