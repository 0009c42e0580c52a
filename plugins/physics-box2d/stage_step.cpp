// The step: forces, Box2D's own steps, then what tore or broke, and the report.
#include "stage.hpp"
#include "units.hpp"
#include "validation.hpp"

#include <box2d/b2_contact.h>

#include <numeric>

namespace jet::box2d {

namespace {

constexpr int32 kVelocityIterations = 8, kPositionIterations = 3;  // as Box2D's manual has them
constexpr double kFarthestMove = 1.9 * kUnitsPerMetre;             // Box2D cuts speeds at 2 m a step
constexpr int kMostSubsteps = 32;

}  // namespace

/// One, unless the scene asks for more or something is so fast that Box2D would slow it down.
int Stage::substepsOf(double dt) const
{
    double fastest = 0;
    for (const Body& body : bodies_) fastest = std::max(fastest, units(body.body->GetLinearVelocity().Length()));
    const int wanted = std::max(1, settings_.substeps);
    return std::clamp(static_cast<int>(std::ceil(fastest * dt / kFarthestMove)), wanted,
                      std::max(wanted, kMostSubsteps));
}

/// Box2D sweeps moving bodies against fixed ones, and against each other only where one is a "bullet".
void Stage::watchFastBodies(double h)
{
    for (const Body& body : bodies_) {
        if (body.body->GetType() != b2_dynamicBody) continue;
        body.body->SetBullet(units(body.body->GetLinearVelocity().Length()) * h > 0.25 * body.thinnest);
    }
}

/// exp(-d t) exactly; Box2D's own damping is 1 / (1 + d t).
void Stage::dampen(double h)
{
    if (!settings_.applyDamping || (settings_.linearDamping == 0 && settings_.angularDamping == 0)) return;
    const auto linear = static_cast<float>(std::exp(-settings_.linearDamping * h));
    const auto angular = static_cast<float>(std::exp(-settings_.angularDamping * h));
    for (const Body& body : bodies_) {
        if (body.body->GetType() != b2_dynamicBody || !body.body->IsAwake()) continue;
        body.body->SetLinearVelocity(linear * body.body->GetLinearVelocity());
        body.body->SetAngularVelocity(angular * body.body->GetAngularVelocity());
    }
}

void Stage::pushBodies(double h)
{
    for (const Body& body : bodies_)
        if (!body.force.isZero()) body.body->ApplyForceToCenter(metres(body.force), true);
    for (const Torque& torque : torques_)
        if (torque.body && torque.value != 0) torque.body->ApplyTorque(squareMetres(torque.value), true);
    for (const Force& force : forces_)
        if (!force.value.isZero())
            force.at.body->ApplyForce(metres(force.value), force.at.body->GetWorldPoint(force.at.local), true);
    for (AngularSpring& spring : angularSprings_) push(spring, h);
    for (Joint& joint : joints_)
        if (joint.joint) steer(joint, h);
}

/// Box2D computes in single: squares of what is taken may be more than it can hold, and differences of those nothing.
void Stage::refuseNoNumbers() const
{
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const b2Body& body = *bodies_[i].body;
        if (body.GetPosition().IsValid() && body.GetLinearVelocity().IsValid() && b2IsValid(body.GetAngle()) &&
            b2IsValid(body.GetAngularVelocity()))
            continue;
        fail(named("body", i) +
             " moves by more than this engine can compute with; give it, and what it is joined to, masses, forces and "
             "speeds nearer to one another, or choose the engine 'jet-physics'.");
    }
}

void Stage::step(double dt)
{
    const int count = substepsOf(dt);
    const double h = dt / count;
    lastSubstep_ = h;
    stats_ = StepStats();
    stats_.substeps = static_cast<std::uint32_t>(count);
    book_.beginStep(dt);
    free_.insert(removedNow_.begin(), removedNow_.end());
    removedNow_.clear();
    for (int i = 0; i < count; ++i) {
        watchFastBodies(h);
        pushBodies(h);
        world_->Step(static_cast<float>(h), kVelocityIterations, kPositionIterations);
        dampen(h);
        refuseNoNumbers();
        tearAndBreak(h);
        const b2Profile& profile = world_->GetProfile();
        stats_.broadPhaseMs += static_cast<double>(profile.broadphase);
        stats_.narrowPhaseMs += static_cast<double>(profile.collide);
        stats_.solverMs += static_cast<double>(profile.solve - profile.broadphase);
        stats_.continuousMs += static_cast<double>(profile.solveTOI);
    }
    for (Body& body : bodies_) body.force = Vec2(0, 0);
    book_.endStep(world_->GetContactList(), reports_);
    stats_.contacts = static_cast<std::uint32_t>(reports_.size());
    stats_.pairs = static_cast<std::uint32_t>(world_->GetContactCount());
    for (const Body& body : bodies_)
        stats_.awakeBodies += body.body->GetType() == b2_dynamicBody && body.body->IsAwake();
    if (settings_.allowSleep) {
        const std::vector<std::uint32_t> groups = islands();
        for (const std::uint32_t group : groups)
            if (group != kNoHandle) stats_.islands = std::max(stats_.islands, group + 1);
    }
}

/// Box2D keeps its islands for itself; these are the same groups: what touches or is joined, over bodies that move.
std::vector<std::uint32_t> Stage::islands() const
{
    std::vector<std::uint32_t> parent(bodies_.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto rootOf = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    const auto moves = [&](const b2Body& body) {
        return handleOf(body) != kNoHandle && body.GetType() == b2_dynamicBody && body.IsAwake();
    };
    const auto join = [&](const b2Body& a, const b2Body& b) {
        if (moves(a) && moves(b)) parent[rootOf(handleOf(a))] = rootOf(handleOf(b));
    };
    for (const b2Contact* c = world_->GetContactList(); c; c = c->GetNext())
        if (c->IsTouching() && c->IsEnabled() && !c->GetFixtureA()->IsSensor() && !c->GetFixtureB()->IsSensor())
            join(*c->GetFixtureA()->GetBody(), *c->GetFixtureB()->GetBody());
    for (b2Joint* j = world_->GetJointList(); j; j = j->GetNext()) join(*j->GetBodyA(), *j->GetBodyB());
    std::vector<std::uint32_t> number(bodies_.size(), kNoHandle), group(bodies_.size(), kNoHandle);
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
        if (!moves(*bodies_[i].body)) continue;
        std::uint32_t& of = number[rootOf(i)];
        if (of == kNoHandle) of = next++;
        group[i] = of;
    }
    return group;
}

}  // namespace jet::box2d
