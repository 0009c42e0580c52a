// What a step leaves to be told: contacts, which bodies touch, and which of these touches began and ended.
//
//   remember()                                   before a step
//   begin() · (add() | addRigid())* · finish()   when somebody asks for what it left
//   events()                                     after that
#pragma once

#include "contact_point.hpp"
#include "outlines.hpp"
#include "rigid/stage.hpp"
#include "state.hpp"

#include <jet/physics.hpp>

#include <span>
#include <vector>

namespace jet::physics {

class Reports {
public:
    std::span<const Contact> contacts() const { return contacts_; }
    /// Sorted pairs of handles, the smaller one high.
    std::span<const std::uint64_t> touching() const { return touching_; }
    bool touch(BodyHandle a, BodyHandle b) const;

    /// Is the last step not told yet?
    bool due() const { return due_; }
    void setDue(bool due) { due_ = due; }
    void begin();
    /// By points and walls.
    void add(const State&, const ContactPoint&);
    /// Those of simple bodies.
    void addRigid(const RigidStage&, const Outlines&);
    void finish();

    /// Pushed in this step, but are over.
    std::vector<ContactPoint>& ended() { return ended_; }

    /// Simple rigid bodies have events of their own. Those of others come from the touches that are told anyway,
    /// compared with those of the step before. As telling takes time, that is done only once somebody asked for events:
    /// the first time all that touch begin.
    bool watched() const { return watched_; }
    void remember(const State&, bool anyComplex);
    std::span<const ContactEvent> events(const State&, std::span<const ContactEvent> ofSimple);

    /// Contacts of a body that goes; that it touched is told to have ended.
    void forget(BodyHandle);
    template <class Archive>
    void archive(Archive& with)
    {
        with.list(contacts_, [&](Contact& c) {
            with(c.bodyA), with(c.bodyB), with(c.particle), with(c.wall), with(c.point), with(c.edgeParameter),
                with(c.normal);
            with(c.penetration), with(c.impulse);
        });
        with.list(touching_, [&](std::uint64_t& pair) { with(pair); });
    }
    /// What was restored began before.
    void restored();
    std::size_t bytes() const { return contacts_.capacity() * sizeof(Contact); }

private:
    void tellEvents(const State&, std::span<const ContactEvent> ofSimple);
    double impulseBetween(std::uint64_t pair) const;

    std::vector<Contact> contacts_;
    std::vector<ContactPoint> ended_;
    std::vector<std::uint64_t> touching_, touchedBefore_;
    std::vector<ContactEvent> events_;
    bool due_ = false;
    bool watched_ = false;     // did somebody ask for events?
    bool eventsTold_ = false;  // are they those of the last step?
};

}  // namespace jet::physics
