// Bodies that are changed or switched while the world runs.
#include "stage.hpp"

#include <algorithm>
#include <tuple>

namespace jet::physics {

namespace {

/// Whatever decides what a body meets, and how.
auto meetingsOf(const RigidBody& body) { return std::tuple(body.enabled, body.moves, body.kinematic, body.sensor); }

}  // namespace

void RigidStage::set(const State& state, Index handle, const BodyCommon& common)
{
    if (!has(handle)) return;
    const Index index = bodyOf(handle);
    RigidBody& body = collider_.bodies()[index];
    RigidBody wanted = body;
    const Rules rules(common);
    wanted.sensor = common.sensor, wanted.mayRest = common.allowSleep;
    wanted.moves = state.nodes.invMass[body.node] > 0;
    wanted.kinematic = state.bodies[handle].kinematic;
    const bool meetsOthers = meetingsOf(wanted) != meetingsOf(body) || rules != collider_.rulesOf(body);
    if (meetsOthers) forgetContacts(index);
    body = wanted;
    ++jointsVersion_;
    collider_.setRules(body, rules);
    if (meetsOthers) changed(index);
    collider_.disturb(index);
}

bool RigidStage::isSet(Index handle, const BodyCommon& common) const
{
    if (!has(handle)) return true;
    const RigidBody& body = collider_.bodies()[bodyOf(handle)];
    return body.mayRest == common.allowSleep && collider_.rulesOf(body) == Rules(common);
}

void RigidStage::enable(const State& state, Index handle, bool enabled)
{
    if (!has(handle)) return;
    const Index index = bodyOf(handle);
    forgetContacts(index);
    RigidBody& body = collider_.bodies()[index];
    const auto stands = [&] { return body.enabled && !body.moves && !body.kinematic; };
    const bool stood = stands();
    body.enabled = enabled;
    ++jointsVersion_;
    body.moves = state.nodes.invMass[body.node] > 0;
    body.kinematic = state.bodies[handle].kinematic;
    collider_.seekAgain(index);
    if (stood || stands()) collider_.rearrange();
    countMovers();
}

void RigidStage::remove(const State&, Index handle)
{
    const Index index = bodyOf(handle);
    RigidBody& body = collider_.bodies()[index];
    body.sensor = false, body.mayRest = true, body.looks = 0;
    collider_.setRules(body, Rules());
    ++removed_;
    countMovers();
}

/// One takes over the place of a removed one with as many parts, of whom nothing stays.
void RigidStage::replace(Index index, const RigidBody& body, const Rules& rules, const std::vector<DrawnPart>& parts)
{
    collider_.replaceBody(index, body, rules);
    for (std::size_t i = 0; i < parts.size(); ++i)
        collider_.replacePart(index, static_cast<Index>(i), parts[i].part,
                              parts[i].outlined ? &parts[i].outline : nullptr);
    if (index < watches_.size()) watches_[index] = Watch();
    if (index < group_.size()) group_[index] = kNone;
    ++jointsVersion_;
    countMovers();
}

void RigidStage::setMotor(Index index, bool driven, double speed)
{
    JointDef& def = joints_[index].def;
    if (def.driven != driven) ++jointsVersion_;
    def.driven = driven, def.motorSpeed = speed;
}

void RigidStage::setTarget(Index index, const Vec2& target)
{
    Joint& joint = joints_[index];
    Vec2& end = joint.a == 0 ? joint.localA : joint.localB;
    if (joint.hasPoint() && end != target) ++jointsVersion_;
    end = target;
}

/// Before the body is changed: the constraints of its contacts are those of what it was.
void RigidStage::forgetContacts(Index body)
{
    forgetContactsIf([body](const RigidContact& c) { return c.bodyA == body || c.bodyB == body; });
}

/// What a joint holds, or held, meets as the joints there are say.
void RigidStage::decideMeeting(const Joint& changed)
{
    const Index a = changed.a, b = changed.b;
    if (a == 0 || b == 0) return;
    const bool apart = changed.keepsApart() || std::any_of(joints_.begin(), joints_.end(), [&](const Joint& joint) {
                           return joint.keepsApart() && std::minmax(joint.a, joint.b) == std::minmax(a, b);
                       });
    if (apart == collider_.excludes(a, b)) return;
    if (apart) {
        collider_.exclude(a, b);
        forgetContactsIf([&](const RigidContact& c) { return std::minmax(c.bodyA, c.bodyB) == std::minmax(a, b); });
    } else {
        // They were found before, and would not be found again while their boxes meet.
        collider_.include(a, b);
        collider_.seekAgain(a), collider_.seekAgain(b);
    }
}

void RigidStage::forgetContactsIf(const std::function<bool(const RigidContact&)>& isMeant)
{
    for (Index i = 0; i < collider_.places().size(); ++i) {
        const RigidContact& c = collider_.contacts()[i];
        if (collider_.places()[i] == kFree || !isMeant(c)) continue;
        part(c);
        if (active_ == Active::Single) single_.suspend(collider_, i);
        if (active_ == Active::Double) double_.suspend(collider_, i);
        collider_.forget(i);
    }
}

void RigidStage::part(const RigidContact& c)
{
    const auto& bodies = collider_.bodies();
    if (c.touching) ended_.push_back({bodies[c.bodyA].handle, bodies[c.bodyB].handle});
}

void RigidStage::forgetPairs()
{
    if (active_ == Active::Single) single_.release(collider_);
    if (active_ == Active::Double) double_.release(collider_);
    for (Index i = 0; i < collider_.places().size(); ++i)
        if (collider_.places()[i] != kFree) part(collider_.contacts()[i]);
    collider_.forgetPairs();
}

void RigidStage::changed(Index body)
{
    collider_.seekAgain(body);
    if (!collider_.bodies()[body].moves) collider_.rearrange();
    countMovers();
}

void RigidStage::countMovers()
{
    movers_ = 0;
    kinematic_.clear();
    const auto& bodies = collider_.bodies();
    for (Index i = 1; i < bodies.size(); ++i) {
        movers_ += bodies[i].moves;
        if (bodies[i].kinematic) kinematic_.push_back(i);
    }
}

bool RigidStage::haveOnlyPair(Index a, Index b) const
{
    return collider_.bodies()[a].partCount == 1 && collider_.bodies()[b].partCount == 1;
}

void RigidStage::noteTouches(const std::vector<TouchChange>& changes)
{
    const auto& bodies = collider_.bodies();
    for (const TouchChange& c : changes)
        touches_.change(bodies[c.bodyA].handle, bodies[c.bodyB].handle, c.begins, static_cast<double>(c.impulse),
                        haveOnlyPair(c.bodyA, c.bodyB));
    for (const Parting& parting : ended_)
        touches_.change(parting.a, parting.b, false, 0, haveOnlyPair(bodyOf(parting.a), bodyOf(parting.b)));
    ended_.clear();
    touches_.tell(events_);
}

/// What is restored has begun before.
void RigidStage::recountTouches()
{
    events_.clear();
    touches_.forget();
    const auto& bodies = collider_.bodies();
    const auto count = [&](Index a, Index b) {
        if (!haveOnlyPair(a, b)) touches_.restored(bodies[a].handle, bodies[b].handle);
    };
    for (Index i = 0; i < collider_.places().size(); ++i) {
        const RigidContact& c = collider_.contacts()[i];
        if (collider_.places()[i] != kFree && c.touching) count(c.bodyA, c.bodyB);
    }
    for (const Parting& parting : ended_) count(bodyOf(parting.a), bodyOf(parting.b));
}

}  // namespace jet::physics
