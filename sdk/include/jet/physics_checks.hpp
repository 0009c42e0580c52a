// What a physics engine refuses before it can do harm. For engine plugins: keep one PhysicsChecks with the engine's
// name and reach, and ask it first in every function of a world. It throws a Failure whose sentence names the item by
// its handle, the field, the value and the range; the world is still as it was then.
#pragma once

#include <jet/physics.hpp>

#include <string>
#include <string_view>

namespace jet {

class JET_API PhysicsChecks {
public:
    /// What an engine can compute with.
    struct Reach {
        double farthest = 1e12;  ///< scene units from the origin, along x and along y
        double largest = 1e30;   ///< any other number; with squares and products still in the range of double
    };
    PhysicsChecks(std::string engine, const Reach& reach) : engine_(std::move(engine)), reach_(reach) {}

    /// "<engine>: <sentence>"
    [[noreturn]] void fail(const std::string& sentence) const;

    /// `item` and `field` make "body 3: mass is -1; it must be above 0.". Not-a-number is in no range.
    void number(std::string_view item, std::string_view field, double value) const;
    void number(std::string_view item, std::string_view field, const Vec2& value) const;
    void atLeast(std::string_view item, std::string_view field, double value, double least) const;
    void above(std::string_view item, std::string_view field, double value, double limit) const;
    void within(std::string_view item, std::string_view field, double value, double least, double most) const;
    void place(std::string_view item, std::string_view field, const Vec2& at) const;
    /// A handle or an index: "body 9 does not exist; there are 2."
    void index(std::string_view what, std::size_t index, std::size_t count) const;

    void check(const WorldSettings&) const;
    /// `handle` in what follows: of the item, or the one it is about to get.
    void check(BodyHandle handle, const BodyCommon&, std::uint32_t materialCount) const;
    void check(BodyHandle handle, const RigidBodyDef&, std::uint32_t materialCount) const;
    void check(BodyHandle handle, const SoftBodyDef&, std::uint32_t materialCount) const;
    void check(BodyHandle handle, const SoftMatter&) const;
    void checkMass(BodyHandle handle, double mass) const;
    /// `item`: "body 3", or "a cast" for shapes of queries. A chain is of fixed bodies only.
    void check(std::string_view item, const ShapeDef&, bool fixed) const;
    void check(std::string_view item, const Anchor&, std::size_t bodyCount) const;
    void check(ActuatorHandle handle, const ForceFieldDef&) const;
    void check(ActuatorHandle handle, const SpringActuatorDef&, std::size_t bodyCount) const;
    void check(ActuatorHandle handle, const AngularSpringActuatorDef&, std::size_t bodyCount) const;
    /// All but its anchors, as what may be changed later.
    void check(JointHandle handle, const JointDef&) const;
    void checkAnchors(JointHandle handle, const JointDef&, std::size_t bodyCount) const;
    /// Stiffness, damping and tear ratio of any spring.
    void spring(std::string_view item, double ks, double kd, double tearRatio = 0) const;

private:
    [[noreturn]] void refuse(std::string_view item, std::string_view field, double value,
                             const std::string& range) const;
    std::string engine_;
    Reach reach_;
};

}  // namespace jet
