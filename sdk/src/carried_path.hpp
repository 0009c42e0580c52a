// How the path of an item without a body of its own follows the bodies it holds while playing: joints, springs, forces.
#pragma once

#include "world_builder.hpp"

#include <optional>

namespace jet {

/// A point of a path is at the anchor the item asked for there; what is between two anchors is between them then, in
/// proportion to its place along the path. What broke has no path any more.
class CarriedPath {
public:
    /// `bodies` as they are when play starts. Nothing where the item holds no body that moves.
    static std::optional<CarriedPath> of(const Item& item, const ItemParts& parts,
                                         const std::vector<BodyBinding>& bodies);
    const Path& at(const PhysicsWorld& world, const std::vector<BodyBinding>& bodies);

private:
    struct Carrier {
        Vec2 point;  ///< as drawn
        std::size_t binding = 0;
        std::optional<std::uint32_t> particle;  ///< of a soft body: the one nearest to the point
        Vec2 rest;                              ///< where that was
        bool moves = false;                     ///< else it is the background
    };
    Affine motionOf(const Carrier& carrier, const BodyStates& states, const std::vector<BodyBinding>& bodies) const;
    void follow(const JointDef& joint, const JointState& state);

    Path drawn_, now_;
    std::vector<Carrier> carriers_;
    std::optional<JointDef> joint_;
    JointHandle handle_ = kNoHandle;
    double longest_ = 0;  ///< units a spring has when it tears; 0: it does not
};

}  // namespace jet
