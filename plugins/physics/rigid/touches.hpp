// Which pairs of bodies begin and cease to touch, from the touches of their parts: an event is told when a pair's first
// parts begin to touch, and when its last ones part. What parts and touches again within a step has not parted.
//
// Order of calls: change() for each part's, then tell(), once a step.
#pragma once

#include "room.hpp"

#include <jet/physics.hpp>

namespace jet::physics {

class Touches {
public:
    /// Of parts of two bodies, by their handles; `only`: the bodies have no other pair of parts.
    void change(BodyHandle a, BodyHandle b, bool begins, double impulse, bool only);
    /// Replaces what is in `events`; ascending by bodies.
    void tell(std::vector<ContactEvent>& events);

    /// After restoring: nothing touches; then the touches there are.
    void forget() { counts_.clear(), changes_.clear(); }
    void restored(BodyHandle a, BodyHandle b);
    std::size_t bytes() const { return roomOf(counts_, merged_, changes_); }

private:
    struct Count {
        std::uint64_t pair = 0;
        std::int64_t touching = 0;  // pairs of parts
    };
    struct Change {
        std::uint64_t pair = 0;
        std::int32_t begins = 0;  // or ends, below 0
        bool only = true;
        double impulse = 0;
    };
    static std::uint64_t pairOf(BodyHandle a, BodyHandle b)
    {
        return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
    }

    std::vector<Count> counts_;  // ascending; only of bodies of several parts, for others are told at once
    std::vector<Count> merged_;
    std::vector<Change> changes_;
};

}  // namespace jet::physics
