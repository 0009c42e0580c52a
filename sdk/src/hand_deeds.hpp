// What a hand did in a run, by step, so that steps between two kept states come out as they were when one goes back to
// them. Of the simulation's thread.
#pragma once

#include <jet/simulation.hpp>

#include <cstdint>
#include <vector>

namespace jet {

struct HandDeed {
    enum class Kind : std::uint8_t { Grab, Drag, LetGo };
    Kind kind = Kind::LetGo;
    Vec2 point{0, 0};
    double reach = 0;
    std::uint64_t step = 0;  ///< steps there were before it
};

class HandDeeds {
public:
    /// Does it. Dragging and letting go count only for what was grabbed since one went back.
    void act(Simulation&, HandDeed);
    /// Before a step that is new: what was held in the state one went back to is let go, and the future that this
    /// state had is forgotten.
    void goOn(Simulation&);

    /// Between two kept states: does again what was done before the next step.
    void again(Simulation&) const;
    void wentBack();
    void forgetBefore(std::uint64_t step);
    /// Since it was last asked.
    bool moved() { return std::exchange(moved_, false); }

private:
    void does(Simulation&, HandDeed);
    void dropStray(Simulation&);

    std::vector<HandDeed> deeds_;    // before steps that were taken
    std::vector<HandDeed> pending_;  // before the next one
    bool back_ = false;              // was a state gone back to, and no step taken since?
    bool stray_ = false;             // may it hold what nobody does any more?
    bool grips_ = false;             // did the last grab take hold of something?
    bool moved_ = false;
};

}  // namespace jet
