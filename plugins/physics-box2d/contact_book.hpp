// What Box2D tells about contacts while it steps, kept under JET's handles: who may touch, how pairs of materials meet,
// which way a platform holds, and the impulses of the last step.
#pragma once

#include <jet/physics.hpp>

#include <box2d/b2_contact.h>
#include <box2d/b2_world_callbacks.h>

#include <map>
#include <set>
#include <unordered_map>
#include <vector>

namespace jet::box2d {

struct Body;

class ContactBook final : public b2ContactFilter, public b2ContactListener {
public:
    ContactBook(const WorldSettings& settings, const std::vector<Body>& bodies) : settings_(settings), bodies_(bodies)
    {
    }

    /// Pairs of joined bodies that pass each other, the smaller handle first.
    std::set<std::pair<BodyHandle, BodyHandle>> joined;

    void beginStep(double dt);
    /// Reports of all contacts in the list, in the order of their bodies.
    void endStep(b2Contact* list, std::vector<Contact>& reports);
    bool touching(BodyHandle a, BodyHandle b) const;
    const std::vector<ContactEvent>& events() const { return events_; }

    bool ShouldCollide(b2Fixture* a, b2Fixture* b) override;
    void BeginContact(b2Contact*) override;
    void EndContact(b2Contact*) override;
    void PreSolve(b2Contact*, const b2Manifold*) override;
    void PostSolve(b2Contact*, const b2ContactImpulse*) override;

private:
    struct Touch {
        bool decided = false, passes = false;      // of one-sided bodies
        float impulse[b2_maxManifoldPoints] = {};  // N s, summed up over the step
    };
    using Pair = std::pair<BodyHandle, BodyHandle>;

    static Pair pairOf(b2Contact&);
    bool letsPass(b2Contact&) const;
    void report(b2Contact&, std::vector<Contact>&) const;
    void nameFeatures(Contact&) const;
    void findEvents(std::set<Pair> now);

    const WorldSettings& settings_;
    const std::vector<Body>& bodies_;
    std::unordered_map<const b2Contact*, Touch> touches_;  // looked up, never walked: its order is an accident
    std::set<Pair> touched_, last_;                        // during the step; as told last
    std::map<Pair, double> impulses_;                      // of pairs, units
    std::vector<ContactEvent> events_;
    float restSpeed_ = 1;  // m/s below which nothing bounces
};

}  // namespace jet::box2d
