// A full look at eight pairs at once: where they are, whether the points they had will do, else touching points by
// separating axes and clipping, with the impulses of those that stay. What one pair gets is what Collider::update()
// gives it alone, to the last bit.
#pragma once

#include "contact.hpp"
#include "solver_data.hpp"

namespace jet::physics {

inline constexpr float kSpeculative = 6;  // slops: nearer than this a pair gets points even without closing speed;
                                          // quiet bodies may come two of them nearer before the pair is looked at again
inline constexpr float kReuseMove = 1.0F, kReuseTurn = 0.01F;  // slops, radians: points are kept
inline constexpr float kSameWay = 0.95F;                       // cosine between normals of what may be one point
inline constexpr float kFast = 0.5F;  // lengths a step: faster pairs are foreseen by their time of impact

/// A point that lies alone on a side, as an apex does, may be clipped at either end of the side from one step to the
/// next, and is the same nevertheless.
inline bool samePoint(const RigidContact& c, const Manifold& m)
{
    if (c.count != 1 || m.count != 1 || dot(c.normal, m.normal) <= kSameWay) return false;
    const std::uint16_t before = c.ids[0], now = m.points[0].id;
    return before >> 8 == now >> 8 || (before & 0xff) == (now & 0xff);
}

struct LookInput {
    RigidContact* contacts = nullptr;
    const Pose* poses = nullptr;      // [bodies]
    const FatBox* boxes = nullptr;    // [parts]
    const Part* parts = nullptr;      // [parts]
    const float* surprise = nullptr;  // [bodies] units a hit may carry it in this step; null: nobody is hit
    float dt = 0;                     // seconds
};

/// What was seen: a bit for each pair.
struct Seen {
    std::uint32_t meet = 0;    // their boxes do; the others are as they were
    std::uint32_t apart = 0;   // without points, and so far apart that none were sought
    std::uint32_t reused = 0;  // the points they had were kept
    std::uint32_t fast = 0;    // may come nearer by more than kFast of the smaller part
    float gap[8] = {};         // units apart at least, or null
    float speed[8] = {};       // of the first point, in lengths of the smaller part a second: Collider::hitSpeed()
};

struct SidePoints {
    Vec2f onA, onB;
    float squared = 0;  // distance
};

/// Eight pairs of parts without outlines, none of them one-sided; some may be the same.
struct Looker {
    static constexpr int kPairs = 8;
    /// Of two circles.
    void (*circles)(const LookInput&, const Index* which, Seen&) = nullptr;
    /// Of a polygon or capsule and a circle; `most`: corners.
    void (*discs)(const LookInput&, const Index* which, int most, Seen&) = nullptr;
    /// Of two polygons or capsules.
    void (*polygons)(const LookInput&, const Index* which, int mostA, int mostB, Seen&) = nullptr;
    /// The nearest points of the sides of two parts, in A's frame: the first such pair, side by side of A.
    SidePoints (*nearestSides)(const Part& a, const Part& b, const Relative& bInA) = nullptr;
};
const Looker& looker(KernelChoice);

namespace sse2 {
extern const Looker pairLooker;
}  // namespace sse2
namespace avx2 {
extern const Looker pairLooker;
}  // namespace avx2

}  // namespace jet::physics
