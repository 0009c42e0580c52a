// Box2D cannot save its state: warm-start impulses, the order of contacts and the tree of boxes are its own. So the
// world keeps what was done to it since it was made, a few bytes an action, and goes back by playing it again: Box2D
// does the same every time. Steps without anything between them count as one entry.
#pragma once

#include <jet/geometry.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace jet::box2d {

enum class Deed : std::uint32_t {
    Step,     ///< `count` times, x = dt
    Special,  ///< number `handle` of World's list: what numbers alone do not tell
    SetTorque,
    SetForce,
    ApplyForce,
    ApplyImpulse,
    SetVelocity,
    SetOmega,
    SetPosition,
    SetGravity,
    SetMass,
    SetEnabled,
    SetMotor,
    SetJointTarget,
    RemoveJoint,
    Wake
};

struct Entry {
    Deed deed = Deed::Step;
    std::uint32_t handle = 0, count = 1, flag = 0;
    double x = 0, y = 0;

    bool operator==(const Entry&) const = default;
};

class History {
public:
    void add(const Entry&);
    const std::vector<Entry>& entries() const { return entries_; }

    std::vector<std::byte> bytes() const;
    /// Throws a Failure when the bytes are none of bytes().
    static History read(std::span<const std::byte> bytes);

    /// What must be done after `past` to come to this one; false when `past` is not a beginning of it.
    bool continues(const History& past, std::vector<Entry>& rest) const;

private:
    std::vector<Entry> entries_;
};

}  // namespace jet::box2d
