// Outlines of rigid bodies. As long as nothing in a world goes by points and walls, a body of one shape has none: its
// part says all, and its outline is worked out when somebody asks. The first body that goes by points and walls makes
// all others have them.
#pragma once

#include "border.hpp"
#include "rigid/stage.hpp"
#include "state.hpp"

#include <jet/physics.hpp>

#include <span>
#include <vector>

namespace jet::physics {

class Outlines {
public:
    /// Of the bodies of `state`; both outlive this.
    Outlines(State& state, RigidStage& rigid) : state_(state), rigid_(rigid) {}

    /// Has nothing needed the points and walls of bodies of one shape yet?
    bool lean() const { return lean_; }
    /// Appends points and walls to the body, which is the last of those that have any.
    void add(BodyRecord&, const std::vector<std::vector<Vec2>>& outlines, Inside);
    /// Points and walls in the order of bodies, for all of them; all that is read of bodies is to be read anew then.
    /// False where they have them.
    bool addAll();

    /// While lean: all bodies as they are now. It lies where steps have what they work on, as the next step ends its
    /// time.
    BodyStates tell();
    /// While lean: what is told of the body, after it was changed between steps.
    void retell(Index body);
    /// A step ends the time of what was told.
    void forget() { told_ = 0; }

    /// Which border point and which wall of the bodies' outlines meet in a contact of simple shapes.
    void nameFeatures(Contact&) const;

private:
    void copy(BodyRecord&, const Points&, const Walls&);
    template <class Visit>
    void eachPoint(Index body, Visit&& visit) const;
    template <class Visit>
    void eachWall(Index body, Visit&& visit) const;

    State& state_;
    RigidStage& rigid_;
    bool lean_ = true;
    Index told_ = 0;         // first bodies that are told as they are now,
    std::span<Box> bounds_;  // in memory of steps
    std::span<Vec2> points_;
};

}  // namespace jet::physics
