// What sleeps, what wakes it, and the groups bodies move in.
#include "disjoint_sets.hpp"
#include "validation.hpp"
#include "world.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace jet::physics {

bool World::awake(BodyHandle body) const
{
    requireBody(body);
    return !state_.bodies[body].asleep;
}

void World::wake(BodyHandle body)
{
    requireBody(body);
    wakeUp(body);
}

void World::wakeHeld(const Anchor& anchor)
{
    if (anchor.body != kNoHandle) wakeUp(anchor.body);
}

void World::wakeHeld(const JointDef& def) { wakeHeld(def.a), wakeHeld(def.b); }

/// With all that sleeps together with it.
void World::wakeUp(BodyHandle body)
{
    if (state_.bodies[body].soft) {
        if (state_.bodies[body].asleep) softContacts_.rouse();
        slumber_.wake(state_, body);
    } else {
        rigid_.wake(state_, body);
    }
    const Index island = slumber_.islandOf(body);
    if (island == kNone) return;
    std::vector<Index>& islands = slumber_.islands();
    for (Index other = island; other < islands.size(); ++other) {
        if (islands[other] != island) continue;
        islands[other] = kNone;
        if (other != body) wakeUp(other);
    }
}

void World::wakeAll()
{
    rigid_.wakeAll(state_);
    for (Index body = 0; body < state_.bodies.size(); ++body)
        if (state_.bodies[body].soft) wakeUp(body);
}

void World::rouse(BodyHandle body)
{
    const bool stands = state_.bodies[body].fixed || state_.bodies[body].kinematic;
    if (stands) {
        stir(body);
    } else {
        wakeUp(body);
    }
}

/// What rests on it wakes; and, in the next step, what it comes near.
void World::stir(BodyHandle body)
{
    if (complex_ > 0 && anyAsleep()) {
        const auto wakeOther = [&](Index a, Index b) {
            if (a != body && b != body) return;
            const Index other = a == body ? b : a;
            if (other != kNone && state_.bodies[other].asleep) wakeUp(other);
        };
        for (const ContactPoint& c : contacts_.points) wakeOther(c.bodyA, c.bodyB);
        softContacts_.eachPair(wakeOther);
        softJoints_.eachBond(wakeOther);
        actuators_.eachBond(wakeOther);
        std::vector<Index>& stirred = slumber_.stirred();
        if (std::find(stirred.begin(), stirred.end(), body) == stirred.end()) stirred.push_back(body);
    }
    rigid_.stir(state_, body);
}

bool World::comesNear(Index body) const
{
    const BodyRecord& is = state_.bodies[body];
    if (!is.enabled || is.asleep) return false;
    const std::vector<Index>& stirred = slumber_.stirred();
    if (std::find(stirred.begin(), stirred.end(), body) != stirred.end()) return true;
    return !is.fixed && (!is.kinematic || state_.isDriven(is));
}

/// What moves wakes what it may meet in this step by points and walls, and that all it sleeps with. `midst`: of the
/// step, in which no rigid body can join any more.
void World::spreadWaking(bool midst)
{
    if (complex_ == 0 || !anyAsleep()) return;
    const auto holdsRigid = [&](Index body) {
        const std::vector<Index>& islands = slumber_.islands();
        if (state_.bodies[body].rigid) return true;
        for (Index other = 0; other < islands.size(); ++other)
            if (islands[other] == islands[body] && state_.bodies[other].rigid) return true;
        return false;
    };
    for (bool again = true; std::exchange(again, false);) {
        for (Index body = 0; body < slumber_.islands().size(); ++body)
            if (slumber_.islandOf(body) != kNone && !state_.bodies[body].asleep) wakeUp(body), again = true;
        const auto meet = [&](Index body, Index other) {
            if (!state_.bodies[body].asleep || !comesNear(other) || (midst && holdsRigid(body))) return;
            wakeUp(body);
            again = true;
        };
        finder_.eachNear([&](Index a, Index b) { meet(a, b), meet(b, a); });
    }
}

/// Where nothing soft may sleep: it keeps awake what is beside it.
Bonds World::bondsOfRigid() const
{
    Bonds bonds;
    actuators_.eachBond([&](Index a, Index b) { bonds.pairs.emplace_back(a, b); });
    actuators_.eachCreeping(state_, impulsesOf_, [&](Index body) { bonds.awake.push_back(body); });
    const auto keepAwake = [&](Index body, Index other) {
        if (body == kNone || other == kNone || state_.bodies[other].fixed) return;
        if (!state_.bodies[other].simple) bonds.awake.push_back(body);
    };
    for (const auto& [a, b] : bonds.pairs) keepAwake(a, b), keepAwake(b, a);
    if (complex_ > 0) finder_.eachNear([&](Index a, Index b) { keepAwake(a, b), keepAwake(b, a); });
    softJoints_.eachBond([&](Index a, Index b) {
        for (const Index body : {a, b})
            if (body != kNone) bonds.awake.push_back(body);
    });
    return bonds;
}

void World::restIfDue(double dt)
{
    if (!settings_.allowSleep || settings_.method == Method::SemiImplicitEuler) return;
    const bool rigidDue = !rigid_.empty() && rigid_.restDue(dt);
    if (softMovers_ == 0) {
        if (rigidDue) rigid_.rest(state_, settings_, bondsOfRigid());
        return;
    }
    slumber_.watch(state_, dt);
    if (slumber_.due(dt)) restTogether();
}

/// Groups of soft bodies that may meet or are held together, with the rigid ones beside them. Those a group holds rest
/// together, or not at all; what rigid bodies do to each other is theirs.
void World::restTogether()
{
    slumber_.judge(state_, springs_, actuators_, settings_);
    const std::vector<BodyRecord>& bodies = state_.bodies;
    const auto count = static_cast<Index>(bodies.size());
    std::vector<Index>&group = resting_.group, &firstRigid = resting_.firstRigid, &root = resting_.root;
    std::vector<std::uint8_t>&restless = resting_.restless, &soft = resting_.soft;
    Bonds& bonds = resting_.bonds;
    group.resize(count), root.resize(count), soft.assign(count, 0);
    firstRigid.assign(count, kNone), restless.assign(count, 0);
    bonds.pairs.clear(), bonds.awake.clear();
    std::iota(group.begin(), group.end(), Index{0});
    const auto moves = [&](Index body) {
        return bodies[body].enabled && !bodies[body].fixed && !bodies[body].kinematic;
    };
    for (Index body = 0; body < count; ++body) {
        if (!moves(body) || bodies[body].asleep || bodies[body].simple) continue;
        restless[body] = bodies[body].rigid || !slumber_.isStill(body) || finder_.expectsHit(body);
    }
    actuators_.eachCreeping(state_, impulsesOf_, [&](Index body) { restless[body] |= bodies[body].simple; });
    const auto hold = [&](Index a, Index b) {
        if (a == kNone || b == kNone || a == b) return;
        if (moves(a) && moves(b)) return unite(group, a, b);
        if (moves(a) && state_.isDriven(bodies[b])) restless[a] = 1;
        if (moves(b) && state_.isDriven(bodies[a])) restless[b] = 1;
    };
    actuators_.eachBond([&](Index a, Index b) { hold(a, b), bonds.pairs.emplace_back(a, b); });
    softJoints_.eachBond(hold);
    finder_.eachNear(hold);
    for (Index body = 0; body < count; ++body)
        if (restless[body] != 0) restless[rootOf(group, body)] = 1;
    for (Index body = 0; body < count; ++body) {
        if (!bodies[body].simple || !moves(body)) continue;
        const Index first = rootOf(group, body);
        if (restless[first] != 0) {
            bonds.awake.push_back(body);
        } else if (firstRigid[first] == kNone) {
            firstRigid[first] = body;
        } else {
            bonds.pairs.emplace_back(firstRigid[first], body);
        }
    }
    if (!rigid_.empty()) rigid_.rest(state_, settings_, bonds);
    for (Index body = 0; body < count; ++body)
        if (bodies[body].simple && moves(body) && !bodies[body].asleep) restless[rootOf(group, body)] = 1;
    bool any = false;
    for (Index body = 0; body < count; ++body) {
        if (!bodies[body].soft || !moves(body) || bodies[body].asleep || restless[rootOf(group, body)] != 0) continue;
        slumber_.fallAsleep(state_, body);
        any = true;
    }
    if (any) nameIslands();
}

/// Of what sleeps: by their least bodies, where one of them is soft.
void World::nameIslands()
{
    const std::vector<BodyRecord>& bodies = state_.bodies;
    const auto count = static_cast<Index>(bodies.size());
    std::vector<Index>& islands = slumber_.islands();
    islands.resize(count, kNone);
    std::vector<Index>&group = resting_.group, &root = resting_.root;
    std::vector<std::uint8_t>& soft = resting_.soft;
    std::iota(root.begin(), root.end(), Index{0});
    for (Index body = 0; body < count; ++body) {
        if (!bodies[body].asleep) continue;
        if (islands[body] != kNone) unite(root, body, islands[body]);
        if (rigid_.has(body)) unite(root, body, rigid_.groupOf(body));
        if (bodies[rootOf(group, body)].asleep) unite(root, body, rootOf(group, body));
    }
    for (Index body = 0; body < count; ++body)
        if (bodies[body].asleep && bodies[body].soft) soft[rootOf(root, body)] = 1;
    for (Index body = 0; body < count; ++body)
        islands[body] = bodies[body].asleep && soft[rootOf(root, body)] != 0 ? rootOf(root, body) : kNone;
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
    for (const std::uint64_t pair : reports_.touching()) {
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

bool World::nothingMoves() const
{
    if (!slumber_.any() || slumber_.drowsy() || !slumber_.stirred().empty() || pushed_) return false;
    if (!rigid_.empty() && !rigid_.allAsleep(state_)) return false;
    return std::all_of(state_.bodies.begin(), state_.bodies.end(), [&](const BodyRecord& body) {
        return body.fixed || body.asleep || !body.enabled || (body.kinematic && !state_.isDriven(body));
    });
}

/// Steps in which everything sleeps change nothing.
bool World::skipStep()
{
    const bool skips = onlySimple() ? rigid_.anyAsleep() && rigid_.allAsleep(state_) : nothingMoves();
    if (!skips) return false;
    stats_ = StepStats();
    stats_.contacts = static_cast<std::uint32_t>(reports_.contacts().size());
    rigid_.skip();
    if (pushed_) std::fill(stepForces_.values().begin(), stepForces_.values().end(), Vec2(0, 0));
    pushed_ = false;
    return true;
}

}  // namespace jet::physics
