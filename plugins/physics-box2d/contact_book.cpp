#include "stage.hpp"
#include "units.hpp"

#include <box2d/b2_fixture.h>

namespace jet::box2d {

namespace {

constexpr float kFacing = 0.5F;  // cosine: a platform holds what touches it within 60° of its direction

BodyHandle bodyOf(const b2Fixture& fixture) { return handleOf(*fixture.GetBody()); }

}  // namespace

void ContactBook::beginStep(double dt)
{
    // What falls for two steps only is at rest.
    const double gravity = settings_.applyGravity ? settings_.gravity.norm() : 0;
    restSpeed_ = std::max(1e-4F, metres(2 * gravity * dt));
    touched_.clear();
    impulses_.clear();
    for (auto& [contact, touch] : touches_) touch.impulse[0] = touch.impulse[1] = 0;
}

bool ContactBook::ShouldCollide(b2Fixture* fixtureA, b2Fixture* fixtureB)
{
    const BodyHandle handleA = bodyOf(*fixtureA), handleB = bodyOf(*fixtureB);
    if (!settings_.findCollisions || handleA == kNoHandle || handleB == kNoHandle) return false;
    const BodyCommon &a = bodies_[handleA].common, &b = bodies_[handleB].common;
    if (a.group > 0 && a.group == b.group) return false;
    if ((a.layer & b.mask) == 0 || (b.layer & a.mask) == 0) return false;
    if (!settings_.materials[a.material * settings_.materialCount + b.material].collides) return false;
    return joined.empty() || !joined.contains(std::minmax(handleA, handleB));
}

ContactBook::Pair ContactBook::pairOf(b2Contact& contact)
{
    return std::minmax(bodyOf(*contact.GetFixtureA()), bodyOf(*contact.GetFixtureB()));
}

void ContactBook::BeginContact(b2Contact* contact)
{
    touches_[contact] = {};
    touched_.insert(pairOf(*contact));
}

void ContactBook::EndContact(b2Contact* contact) { touches_.erase(contact); }

/// A platform holds what comes against its direction. What came from another side passes until it has left.
bool ContactBook::letsPass(b2Contact& contact) const
{
    const b2Body &bodyA = *contact.GetFixtureA()->GetBody(), &bodyB = *contact.GetFixtureB()->GetBody();
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    const auto passes = [&](const b2Body& platform, const b2Body& other, b2Vec2 outward) {
        const Vec2& side = bodies_[handleOf(platform)].common.oneSided;
        if (side.isZero()) return false;
        const b2Vec2 up = direction(side.normalized());
        const b2Vec2 speed = other.GetLinearVelocityFromWorldPoint(manifold.points[0]) -
                             platform.GetLinearVelocityFromWorldPoint(manifold.points[0]);
        return b2Dot(outward, up) < kFacing || b2Dot(speed, up) > 0.1F;
    };
    return passes(bodyA, bodyB, manifold.normal) || passes(bodyB, bodyA, -manifold.normal);
}

void ContactBook::PreSolve(b2Contact* contact, const b2Manifold*)
{
    const Body &a = bodies_[bodyOf(*contact->GetFixtureA())], &b = bodies_[bodyOf(*contact->GetFixtureB())];
    const MaterialPair& pair = settings_.materials[a.common.material * settings_.materialCount + b.common.material];
    contact->SetFriction(static_cast<float>(pair.friction));
    contact->SetRestitution(static_cast<float>(pair.restitution));
    contact->SetRestitutionThreshold(restSpeed_);
    if (!settings_.resolveCollisions) return contact->SetEnabled(false);
    if (a.common.oneSided.isZero() && b.common.oneSided.isZero()) return;
    Touch& touch = touches_[contact];
    if (!touch.decided && contact->GetManifold()->pointCount > 0) {
        touch.decided = true;
        touch.passes = letsPass(*contact);
    }
    if (touch.passes) contact->SetEnabled(false);
}

void ContactBook::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse)
{
    Touch& touch = touches_[contact];
    double sum = 0;
    for (int32 i = 0; i < impulse->count; ++i) {
        touch.impulse[i] += impulse->normalImpulses[i];
        sum += units(impulse->normalImpulses[i]);
    }
    impulses_[pairOf(*contact)] += sum;
    touched_.insert(pairOf(*contact));
}

/// Which border point of A and which wall of B are nearest.
void ContactBook::nameFeatures(Contact& contact) const
{
    const Body &a = bodies_[contact.bodyA], &b = bodies_[contact.bodyB];
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < a.local.size(); ++i) {
        const double away = (placeOf(a, a.local[i]) - contact.point).squaredNorm();
        if (away < nearest) nearest = away, contact.particle = i;
    }
    nearest = std::numeric_limits<double>::infinity();
    std::size_t begin = 0;
    for (const std::size_t end : b.ringEnds) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vec2 first = placeOf(b, b.local[i]);
            const Vec2 edge = placeOf(b, b.local[i + 1 < end ? i + 1 : begin]) - first, off = contact.point - first;
            if (!(edge.squaredNorm() > 0)) continue;
            const double along = std::clamp(off.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
            const double away = (off - along * edge).squaredNorm();
            if (away >= nearest) continue;
            nearest = away;
            contact.wall = static_cast<std::uint32_t>(i);
            contact.edgeParameter = along;
        }
        begin = end;
    }
}

void ContactBook::report(b2Contact& contact, std::vector<Contact>& reports) const
{
    b2Fixture &fixtureA = *contact.GetFixtureA(), &fixtureB = *contact.GetFixtureB();
    const bool sensor = fixtureA.IsSensor() || fixtureB.IsSensor();
    b2Manifold manifold = *contact.GetManifold();
    const b2Transform &poseA = fixtureA.GetBody()->GetTransform(), &poseB = fixtureB.GetBody()->GetTransform();
    if (sensor) contact.Evaluate(&manifold, poseA, poseB);  // Box2D only asks whether they overlap
    b2WorldManifold world;
    world.Initialize(&manifold, poseA, fixtureA.GetShape()->m_radius, poseB, fixtureB.GetShape()->m_radius);
    const auto touch = touches_.find(&contact);
    for (int32 i = 0; i < manifold.pointCount; ++i) {
        Contact one;
        one.bodyA = bodyOf(fixtureB), one.bodyB = bodyOf(fixtureA);  // Box2D's normal goes from A to B
        one.point = units(world.points[i]);
        one.normal = Vec2(static_cast<double>(world.normal.x), static_cast<double>(world.normal.y));
        one.penetration = -units(world.separations[i]);
        one.impulse = sensor || touch == touches_.end() ? 0 : units(touch->second.impulse[i]);
        nameFeatures(one);
        reports.push_back(one);
    }
}

void ContactBook::endStep(b2Contact* list, std::vector<Contact>& reports)
{
    reports.clear();
    std::set<Pair> now = touched_;
    for (b2Contact* contact = list; contact; contact = contact->GetNext()) {
        if (!contact->IsTouching()) continue;
        const auto touch = touches_.find(contact);
        if (touch != touches_.end() && touch->second.passes) {
            now.erase(pairOf(*contact));
            continue;
        }
        now.insert(pairOf(*contact));
        report(*contact, reports);
    }
    std::stable_sort(reports.begin(), reports.end(), [](const Contact& a, const Contact& b) {
        return std::minmax(a.bodyA, a.bodyB) < std::minmax(b.bodyA, b.bodyB);
    });
    findEvents(std::move(now));
}

void ContactBook::findEvents(std::set<Pair> now)
{
    events_.clear();
    std::set<Pair> all = now;
    all.insert(last_.begin(), last_.end());
    for (const Pair& pair : all) {
        const bool began = !last_.contains(pair), ended = !now.contains(pair);
        if (!began && !ended) continue;
        const auto impulse = impulses_.find(pair);
        events_.push_back({pair.first, pair.second, began, began && impulse != impulses_.end() ? impulse->second : 0});
    }
    last_ = std::move(now);
}

bool ContactBook::touching(BodyHandle a, BodyHandle b) const { return last_.contains(std::minmax(a, b)); }

}  // namespace jet::box2d
