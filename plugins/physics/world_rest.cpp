// What sleeps, what wakes it, and the groups bodies move in.
#include "disjoint_sets.hpp"
#include "validation.hpp"
#include "world.hpp"

#include <numeric>

namespace jet::physics {

bool World::awake(BodyHandle body) const
{
    requireBody(body);
    return !state_.bodies[body].asleep;
}

void World::wake(BodyHandle body)
{
    requireBody(body);
    rigid_.wake(state_, body);
}

void World::wakeHeld(const Anchor& anchor)
{
    if (anchor.body != kNoHandle) rigid_.wake(state_, anchor.body);
}

void World::wakeHeld(const JointDef& def) { wakeHeld(def.a), wakeHeld(def.b); }

void World::rouse(BodyHandle body)
{
    const bool stands = state_.bodies[body].fixed || state_.bodies[body].kinematic;
    if (stands) {
        rigid_.stir(state_, body);
    } else {
        rigid_.wake(state_, body);
    }
}

/// Soft bodies never sleep, nor do bodies that go by points and walls: what meets one of them is awake.
void World::wakeBesideSoft()
{
    for (const BodyPair& pair : finder_.pairs()) {
        for (const auto& [body, other] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)})
            if (state_.bodies[body].asleep && !state_.bodies[other].fixed) rigid_.wake(state_, body);
    }
}

void World::restIfDue(double dt)
{
    if (!settings_.allowSleep || settings_.method == Method::SemiImplicitEuler || rigid_.empty()) return;
    if (!rigid_.restDue(dt)) return;
    Bonds bonds;
    actuators_.eachBond([&](Index a, Index b) { bonds.pairs.emplace_back(a, b); });
    const auto keepAwake = [&](Index body, Index other) {
        if (body == kNone || other == kNone || state_.bodies[other].fixed) return;
        if (!state_.bodies[other].simple) bonds.awake.push_back(body);
    };
    for (const auto& [a, b] : bonds.pairs) keepAwake(a, b), keepAwake(b, a);
    for (Index joint = 0; joint < softJoints_.count(); ++joint) {
        if (!softJoints_.lives(joint)) continue;
        for (const Anchor* anchor : {&softJoints_.def(joint).a, &softJoints_.def(joint).b})
            if (anchor->body != kNoHandle) bonds.awake.push_back(anchor->body);
    }
    if (complex_ > 0)
        for (const BodyPair& pair : finder_.pairs()) keepAwake(pair.a, pair.b), keepAwake(pair.b, pair.a);
    rigid_.rest(state_, settings_, bonds);
}

/// Numbered by their first bodies.
const std::vector<Index>& World::islands() const
{
    reportIfAsked();
    if (islandsKnown_) return islands_;
    auto& self = const_cast<World&>(*this);  // a cache of what the last step left
    self.islandsKnown_ = true;
    self.islands_.assign(state_.bodies.size(), kNone);
    std::vector<Index> root(state_.bodies.size());
    std::iota(root.begin(), root.end(), Index{0});
    const auto grouped = [&](Index body) {
        const BodyRecord& is = state_.bodies[body];
        return !is.fixed && !is.kinematic && !is.asleep && is.enabled;
    };
    const auto join = [&](Index a, Index b) {
        if (a == kNone || b == kNone || !grouped(a) || !grouped(b)) return;
        unite(root, a, b);
    };
    for (const std::uint64_t pair : touching_) {
        const Index a = static_cast<Index>(pair >> 32), b = static_cast<Index>(pair);
        if (!state_.bodies[a].sensor && !state_.bodies[b].sensor) join(a, b);
    }
    actuators_.eachBond(join);
    for (const JointAt& at : jointsAt_) {
        const bool lives = at.soft ? softJoints_.lives(at.index) : rigid_.joint(at.index).lives();
        const JointDef& def = at.soft ? softJoints_.def(at.index) : rigid_.joint(at.index).def;
        if (lives) join(def.a.body, def.b.body);
    }
    Index count = 0;
    for (Index body = 0; body < root.size(); ++body)
        if (grouped(body)) self.islands_[body] = root[body] == body ? count++ : islands_[rootOf(root, body)];
    self.stats_.islands = count;
    return islands_;
}

std::uint32_t World::island(BodyHandle body) const
{
    requireBody(body);
    return islands()[body] == kNone ? kNoHandle : islands()[body];
}

/// Steps in which everything sleeps change nothing.
bool World::skipStep()
{
    if (!onlySimple() || !rigid_.allAsleep(state_)) return false;
    stats_ = StepStats();
    stats_.contacts = static_cast<std::uint32_t>(reports_.size());
    rigid_.skip();
    if (pushed_) std::fill(stepForces_.values().begin(), stepForces_.values().end(), Vec2(0, 0));
    pushed_ = false;
    return true;
}

}  // namespace jet::physics
