// Collision of rigid bodies that are made of simple parts: poses -> boxes -> pairs -> points, once a step.
#pragma once

#include "pairs.hpp"

#include <jet/physics.hpp>

namespace jet::physics {

class Collider {
public:
    /// Begins a body; its parts follow.
    Index addBody(const RigidBody&);
    void addPart(Part);

    /// Two bodies that shall not collide, because a joint holds them.
    void exclude(Index a, Index b) { excluded_.insert(bodyKey(a, b)); }
    void include(Index a, Index b) { excluded_.erase(bodyKey(a, b)); }

    /// Finds the points that serve the coming dt seconds.
    void find(const State&, const WorldSettings&, double dt, StepStats&);
    /// The part of its move (0..1) after which a fast body would pass through something that was not foreseen; 1: none.
    void stopTunnelling(std::vector<float>& allowed, const std::vector<Vec2>& moves, const std::vector<double>& turns,
                        double dt) const;

    std::vector<RigidBody>& bodies() { return bodies_; }
    const std::vector<RigidBody>& bodies() const { return bodies_; }
    const std::vector<Part>& parts() const { return parts_; }
    const std::vector<Pose>& poses() const { return poses_; }
    std::vector<RigidContact>& contacts() { return contacts_; }
    const std::vector<RigidContact>& contacts() const { return contacts_; }
    /// Pairs that touched in the step before and are too far apart now, since the last find().
    const std::vector<RigidContact>& ended() const { return ended_; }
    /// Does a body close in by more than `part` of its size in a substep of h?
    bool anyHit(float part, double h) const { return worstHit_ * static_cast<float>(h) > part; }
    void forgetPairs();
    std::size_t bytes() const;

    template <class Archive>
    void archive(Archive& with)
    {
        with.list(contacts_, [&](RigidContact& c) { with(c); });
        with(sweep_.boxes());
    }
    /// After restoring: what follows from what was restored.
    void rebuild();

private:
    static std::uint64_t bodyKey(Index a, Index b)
    {
        return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
    }
    void takePoses(const State&, const WorldSettings&, double dt);
    void fitBoxes(double dt);
    void fitBox(Index part, const Pose&, float room, double dt);
    void findPairs(const WorldSettings&);
    bool expectHits(double dt);
    void addPair(Index partA, Index partB, const WorldSettings&);
    bool apart(Index partA, Index partB) const;
    Relative relative(Index bodyA, Index bodyB) const;
    bool update(RigidContact&, double dt);
    bool reuse(RigidContact&, const Relative&, float reach) const;
    void renew(RigidContact&, const Manifold&, const Relative&, float reach) const;
    void foresee(RigidContact&, const Relative&, double dt) const;
    void decideSide(RigidContact&) const;

    std::vector<RigidBody> bodies_{RigidBody()};
    std::vector<Part> parts_;
    std::vector<Pose> poses_;
    std::vector<Pose> fitted_;     // as of the body's last fitting
    std::vector<float> room_;      // [bodies] units a part may move in its box
    std::vector<float> surprise_;  // [bodies] units a hit may carry it in this step
    PairSweep sweep_;
    KeySet known_, excluded_;
    std::vector<RigidContact> contacts_, ended_;
    float typical_ = 0;   // length of a moving part in the middle
    float worstHit_ = 0;  // lengths / s
};

/// When the parts come to touch, as a part of dt, moving with the velocities of their poses; > 1: not in this step.
float timeOfImpact(const Part& a, const Part& b, const Pose& poseA, const Pose& poseB, double dt, float target);

}  // namespace jet::physics
