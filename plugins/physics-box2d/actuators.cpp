// Springs between bodies, angular springs, torques and forces.
#include "stage.hpp"
#include "units.hpp"

#include <box2d/b2_distance_joint.h>

#include <numbers>

namespace jet::box2d {

End Stage::end(const Anchor& anchor)
{
    if (anchor.body == kNoHandle) return {ground_, metres(anchor.point)};
    b2Body* body = bodies_[anchor.body].body;
    return {body, body->GetLocalPoint(metres(anchor.point))};
}

ActuatorHandle Stage::add(const SpringActuatorDef& def)
{
    Spring spring;
    spring.def = def;
    if (def.restLength < 0) spring.def.restLength = (def.b.point - def.a.point).norm();
    const End a = end(def.a), b = end(def.b);
    b2DistanceJointDef made;
    made.bodyA = a.body, made.localAnchorA = a.local;
    made.bodyB = b.body, made.localAnchorB = b.local;
    made.collideConnected = true;
    // A spring from a body to itself, or within the background, does nothing.
    if (a.body != b.body) spring.joint = static_cast<b2DistanceJoint*>(world_->CreateJoint(&made));
    const ActuatorHandle handle = put(springs_, spring);
    applySpring(springs_[handle]);
    ++changes_;
    return handle;
}

/// Box2D's distance joint with a stiffness is a spring computed with the state at the end of the step: it cannot
/// explode. Stiffness and damping are per length and have the same numbers in units and metres.
void Stage::applySpring(Spring& spring)
{
    if (!spring.joint) return;
    spring.joint->SetMinLength(0);
    spring.joint->SetMaxLength(1e9F);
    spring.joint->SetLength(metres(spring.def.restLength));
    // Without any stiffness Box2D leaves out the damping, too.
    spring.joint->SetStiffness(std::max(static_cast<float>(spring.def.ks), 1e-9F));
    spring.joint->SetDamping(static_cast<float>(spring.def.kd));
    spring.joint->GetBodyA()->SetAwake(true);
    spring.joint->GetBodyB()->SetAwake(true);
}

void Stage::setSpring(ActuatorHandle handle, double restLength, double ks, double kd, double tearRatio)
{
    SpringActuatorDef& def = springs_[handle].def;
    if (restLength >= 0) def.restLength = restLength;
    def.ks = ks, def.kd = kd, def.tearRatio = tearRatio;
    applySpring(springs_[handle]);
}

namespace {

Vec2 placeOf(const End& end) { return units(end.body->GetWorldPoint(end.local)); }
Vec2 velocityOf(const End& end) { return units(end.body->GetLinearVelocityFromLocalPoint(end.local)); }

double angleAt(const AngularSpring& s)
{
    const Vec2 a = placeOf(s.a) - placeOf(s.centre), b = placeOf(s.b) - placeOf(s.centre);
    return std::atan2(cross(a, b), a.dot(b));
}

/// How much a force along `direction` at the end speeds it up in that direction.
double mobility(const End& end, const Vec2& direction)
{
    if (end.body->GetType() != b2_dynamicBody) return 0;
    const double arm = cross(placeOf(end) - units(end.body->GetWorldCenter()), direction);
    const double inertia = squareUnits(end.body->GetInertia());
    return direction.squaredNorm() / static_cast<double>(end.body->GetMass()) + (inertia > 0 ? arm * arm / inertia : 0);
}

void pull(const End& end, const Vec2& force)
{
    end.body->ApplyForce(metres(force), end.body->GetWorldPoint(end.local), true);
}

}  // namespace

ActuatorHandle Stage::add(const AngularSpringActuatorDef& def)
{
    AngularSpring spring;
    spring.def = def;
    spring.a = end(def.a), spring.centre = end(def.centre), spring.b = end(def.b);
    spring.angle = angleAt(spring);
    spring.rest = def.restFromPose ? spring.angle : def.restAngle;
    ++changes_;
    return put(angularSprings_, spring);
}

void Stage::setAngularSpring(ActuatorHandle handle, std::optional<double> restAngle, double ks, double kd)
{
    AngularSpring& spring = angularSprings_[handle];
    spring.def.ks = ks, spring.def.kd = kd;
    for (const End& held : {spring.a, spring.centre, spring.b}) held.body->SetAwake(true);
    if (!restAngle || *restAngle == spring.rest) return;
    spring.rest = *restAngle;
    spring.angle = spring.rest + std::remainder(spring.angle - spring.rest, 2 * std::numbers::pi);
}

/// The torque ks (rest - angle) - kd rate, taken at the end of the step so that no stiffness explodes, as two forces at
/// right angles to the legs; what holds the centre makes forces and torques sum to zero.
void Stage::push(AngularSpring& s, double h) const
{
    if (s.removed) return;
    const Vec2 a = placeOf(s.a) - placeOf(s.centre), b = placeOf(s.b) - placeOf(s.centre);
    const double squaredA = a.squaredNorm(), squaredB = b.squaredNorm();
    if (!(squaredA > 1e-12) || !(squaredB > 1e-12)) return;
    s.angle += std::remainder(angleAt(s) - s.angle, 2 * std::numbers::pi);
    const Vec2 onA = -perpendicular(a) / squaredA, onB = perpendicular(b) / squaredB, onCentre = -(onA + onB);
    const double rate = velocityOf(s.a).dot(onA) + velocityOf(s.b).dot(onB) + velocityOf(s.centre).dot(onCentre);
    const double inverse = mobility(s.a, onA) + mobility(s.b, onB) + mobility(s.centre, onCentre);
    const double torque =
        (s.def.ks * (s.rest - s.angle - h * rate) - s.def.kd * rate) / (1 + h * (s.def.kd + h * s.def.ks) * inverse);
    pull(s.a, torque * onA);
    pull(s.b, torque * onB);
    pull(s.centre, torque * onCentre);
}

ActuatorHandle Stage::add(const TorqueActuatorDef& def)
{
    ++changes_;
    return put(torques_, Torque{def.at.body == kNoHandle ? nullptr : bodies_[def.at.body].body, def.value});
}

ActuatorHandle Stage::add(const ForceActuatorDef& def)
{
    ++changes_;
    return put(forces_, Force{end(def.at), def.force});
}

void Stage::setTorque(ActuatorHandle handle, double value) { torques_[handle].value = value; }
void Stage::setForce(ActuatorHandle handle, const Vec2& value) { forces_[handle].value = value; }

void Stage::tearAndBreak(double h)
{
    for (Spring& spring : springs_) {
        if (!spring.joint || spring.def.tearRatio <= 0) continue;
        if (units(spring.joint->GetCurrentLength()) <= spring.def.tearRatio * spring.def.restLength) continue;
        world_->DestroyJoint(spring.joint);
        spring.joint = nullptr, spring.torn = true;
    }
    for (Joint& joint : joints_) {
        if (!joint.joint || joint.def.breakForce <= 0) continue;
        const double force = units(joint.joint->GetReactionForce(static_cast<float>(1 / h)).Length());
        if (force > joint.def.breakForce) breakJoint(joint);
    }
}

}  // namespace jet::box2d
