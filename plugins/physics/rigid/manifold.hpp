// The steps of collide() that outlined parts share (outlined.cpp).
#pragma once

#include "part.hpp"

#include <cstring>

namespace jet::physics::manifold {

/// Two points or directions, or a coordinate of four.
typedef float Four __attribute__((vector_size(16)));
inline Four allOf(float x) { return Four{} + x; }
inline Four load(const Vec2f* two)
{
    Four v;
    std::memcpy(&v, two, sizeof v);
    return v;
}
inline void store(Vec2f* two, Four v) { std::memcpy(static_cast<void*>(two), &v, sizeof v); }

/// B's corners and normals in A's frame.
struct Placed {
    int count;
    float radius;
    Vec2f corners[kMostCorners], normals[kMostCorners];

    Placed(const Part& part, const Relative& at) : count(part.count), radius(part.radius)
    {
        const Four along = allOf(at.turn.x), across{-at.turn.y, at.turn.y, -at.turn.y, at.turn.y};
        const Four move{at.move.x, at.move.y, at.move.x, at.move.y};
        // Two at a time, as turned() does it; of an odd number there is room for one more.
        for (int i = 0; i < count; i += 2) {
            const Four corner = load(&part.corners[i]), normal = load(&part.normals[i]);
            store(&corners[i], move + (along * corner + across * __builtin_shufflevector(corner, corner, 1, 0, 3, 2)));
            store(&normals[i], along * normal + across * __builtin_shufflevector(normal, normal, 1, 0, 3, 2));
        }
    }
};

struct Nearest {
    Vec2f onA, onB;
    float alongA = 0, alongB = 0;  // 0..1
};

Nearest nearestOfSegments(Vec2f p1, Vec2f q1, Vec2f p2, Vec2f q2);

/// The side (of a Part, or of one Placed) that faces a direction: the incident side, if that is the reference's normal.
template <class B>
int mostOpposed(const B& b, Vec2f normal)
{
    int best = 0;
    float least = dot(b.normals[0], normal);
    for (int i = 1; i < b.count; ++i) {
        const float along = dot(b.normals[i], normal);
        if (along < least) least = along, best = i;
    }
    return best;
}

ManifoldPoint pointOf(Vec2f onA, Vec2f onB, const Relative& at, float separation, int featureA, int featureB);

/// One point between two corners (or centres) that lie apart.
Manifold betweenPoints(Vec2f a, Vec2f b, float radiusA, float radiusB, const Relative& at, float reach, Vec2f fallback,
                       int featureA, int featureB);

/// What was found in B's frame as (B, A), the other way round.
Manifold reversed(Manifold m, const Relative& at);
Relative inverse(const Relative& at);

/// The incident side clipped to the reference side; `flipped`: the reference is B's.
Manifold clip(Vec2f r1, Vec2f r2, Vec2f normal, float radiusR, Vec2f i1, Vec2f i2, float radiusI, const Relative& at,
              float reach, bool flipped, const int (&features)[4]);

}  // namespace jet::physics::manifold
