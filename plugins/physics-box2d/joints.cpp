// JET's joints as Box2D's. Kinds Box2D lacks are made of those it has: a rope is a distance with a greatest length, a
// driven motor one whose offset is moved on before each step.
#include "stage.hpp"
#include "units.hpp"
#include "validation.hpp"

#include <box2d/b2_distance_joint.h>
#include <box2d/b2_motor_joint.h>
#include <box2d/b2_mouse_joint.h>
#include <box2d/b2_prismatic_joint.h>
#include <box2d/b2_pulley_joint.h>
#include <box2d/b2_revolute_joint.h>
#include <box2d/b2_weld_joint.h>
#include <box2d/b2_wheel_joint.h>

namespace jet::box2d {

using Kind = JointDef::Kind;

namespace {

constexpr double kStiffMouse = 15;  // Hz, where no frequency is given

float real(double value) { return static_cast<float>(value); }

template <class Type>
Type& as(const Joint& joint)
{
    return static_cast<Type&>(*joint.joint);
}

struct Springy {
    float stiffness = 0, damping = 0;
};

Springy springy(const Joint& joint, double hertz, bool angular)
{
    Springy s;
    const auto make = angular ? b2AngularStiffness : b2LinearStiffness;
    if (hertz > 0)
        make(s.stiffness, s.damping, real(hertz), real(joint.def.dampingRatio), joint.joint->GetBodyA(),
             joint.joint->GetBodyB());
    return s;
}

template <class Def>
Def anchored(const b2Vec2& a, const b2Vec2& b, b2Body* bodyA, b2Body* bodyB)
{
    Def def;
    def.bodyA = bodyA, def.bodyB = bodyB;
    def.localAnchorA = bodyA->GetLocalPoint(a), def.localAnchorB = bodyB->GetLocalPoint(b);
    return def;
}

}  // namespace

/// A fixed body of its own, so that a target can be moved.
b2Body* Stage::background(const Vec2& at)
{
    b2BodyDef def;
    def.position = metres(at);
    return world_->CreateBody(&def);
}

JointHandle Stage::add(const JointDef& def)
{
    Joint joint;
    joint.def = def;
    joint.length = def.length < 0 ? (def.b.point - def.a.point).norm() : def.length;
    if (def.a.body == kNoHandle) joint.groundA = background(def.a.point);
    if (def.b.body == kNoHandle) joint.groundB = background(def.b.point);
    connect(joint);
    joint.restAngle = static_cast<double>(joint.joint->GetBodyB()->GetAngle() - joint.joint->GetBodyA()->GetAngle());
    configure(joint);
    const JointHandle handle = put(joints_, joint);
    // What pulls a body to a place comes and goes: states of before and after are those of the same world.
    const bool pull = def.kind == Kind::Mouse && (def.a.body == kNoHandle) != (def.b.body == kNoHandle);
    changes_ += !pull;
    if (!def.collide && def.a.body != kNoHandle && def.b.body != kNoHandle &&
        book_.joined.insert(std::minmax(def.a.body, def.b.body)).second) {
        refilter(bodies_[def.a.body]);
        refilter(bodies_[def.b.body]);
    }
    return handle;
}

void Stage::connect(Joint& joint)
{
    const JointDef& def = joint.def;
    b2Body* bodyA = joint.groundA ? joint.groundA : bodies_[def.a.body].body;
    b2Body* bodyB = joint.groundB ? joint.groundB : bodies_[def.b.body].body;
    const b2Vec2 a = metres(def.a.point), b = metres(def.b.point);
    const Vec2 unit = def.axis.norm() > 0 ? Vec2(def.axis.normalized()) : Vec2(1, 0);
    const b2Vec2 axis = bodyA->GetLocalVector(direction(unit));
    const float angle = bodyB->GetAngle() - bodyA->GetAngle();
    // Which of the joined may collide is the contact book's affair: Box2D cannot change its mind about that.
    const auto create = [&](auto&& made) {
        made.bodyA = bodyA, made.bodyB = bodyB, made.collideConnected = true;
        joint.joint = world_->CreateJoint(&made);
    };
    switch (def.kind) {
    case Kind::Revolute: {
        auto made = anchored<b2RevoluteJointDef>(a, b, bodyA, bodyB);
        made.referenceAngle = angle;
        return create(made);
    }
    case Kind::Prismatic: {
        auto made = anchored<b2PrismaticJointDef>(a, b, bodyA, bodyB);
        made.localAxisA = axis, made.referenceAngle = angle;
        return create(made);
    }
    case Kind::Weld: {
        auto made = anchored<b2WeldJointDef>(a, b, bodyA, bodyB);
        made.referenceAngle = angle;
        return create(made);
    }
    case Kind::Distance:
    case Kind::Rope: return create(anchored<b2DistanceJointDef>(a, b, bodyA, bodyB));
    case Kind::Wheel: {
        auto made = anchored<b2WheelJointDef>(a, b, bodyA, bodyB);
        made.localAxisA = axis;
        return create(made);
    }
    case Kind::Motor: {
        b2MotorJointDef made;
        made.correctionFactor = 1;
        return create(made);
    }
    case Kind::Mouse: {
        b2MouseJointDef made;
        made.target = b;  // Box2D takes it for the body's anchor, too
        made.stiffness = 1;
        create(made);
        joint.localTarget = bodyA->GetLocalPoint(a);
        return as<b2MouseJoint>(joint).SetTarget(a);
    }
    case Kind::Pulley: {
        auto made = anchored<b2PulleyJointDef>(a, b, bodyA, bodyB);
        made.groundAnchorA = metres(def.groundA), made.groundAnchorB = metres(def.groundB);
        made.lengthA = metres((def.a.point - def.groundA).norm());
        made.lengthB = metres((def.b.point - def.groundB).norm());
        made.ratio = real(def.ratio);
        return create(made);
    }
    }
}

void Stage::configure(Joint& joint)
{
    const JointDef& def = joint.def;
    switch (def.kind) {
    case Kind::Revolute: {
        auto& made = as<b2RevoluteJoint>(joint);
        made.SetLimits(real(def.lower), real(def.upper));
        made.EnableLimit(def.limited);
        made.SetMaxMotorTorque(squareMetres(def.maxTorque));
        made.SetMotorSpeed(real(def.motorSpeed));
        made.EnableMotor(def.driven);
        break;
    }
    case Kind::Prismatic: {
        auto& made = as<b2PrismaticJoint>(joint);
        made.SetLimits(metres(def.lower), metres(def.upper));
        made.EnableLimit(def.limited);
        made.SetMaxMotorForce(metres(def.maxForce));
        made.SetMotorSpeed(metres(def.motorSpeed));
        made.EnableMotor(def.driven);
        break;
    }
    case Kind::Weld: {
        const Springy s = springy(joint, def.hertz, true);
        as<b2WeldJoint>(joint).SetStiffness(s.stiffness);
        as<b2WeldJoint>(joint).SetDamping(s.damping);
        break;
    }
    case Kind::Distance:
    case Kind::Rope: {
        auto& made = as<b2DistanceJoint>(joint);
        const bool rigid = def.kind == Kind::Distance && def.hertz <= 0, rope = def.kind == Kind::Rope;
        made.SetMinLength(0);  // before the greatest one, whose limit it is
        made.SetMaxLength(rigid || rope ? metres(joint.length) : 1e9F);
        if (rigid) made.SetMinLength(metres(joint.length));
        made.SetLength(metres(joint.length));
        const Springy s = rope ? Springy() : springy(joint, def.hertz, false);
        made.SetStiffness(s.stiffness);
        made.SetDamping(s.damping);
        break;
    }
    case Kind::Wheel: {
        auto& made = as<b2WheelJoint>(joint);
        const Springy s = springy(joint, def.hertz, false);
        made.SetStiffness(s.stiffness);
        made.SetDamping(s.damping);
        const bool rigid = def.hertz <= 0 && !def.limited;
        made.SetLimits(rigid ? 0 : metres(def.lower), rigid ? 0 : metres(def.upper));
        made.EnableLimit(rigid || def.limited);
        made.SetMaxMotorTorque(squareMetres(def.maxTorque));
        made.SetMotorSpeed(real(def.motorSpeed));
        made.EnableMotor(def.driven);
        break;
    }
    case Kind::Motor:
        as<b2MotorJoint>(joint).SetMaxForce(metres(def.maxForce));
        as<b2MotorJoint>(joint).SetMaxTorque(squareMetres(def.maxTorque));
        break;
    case Kind::Mouse: {
        const Springy s = springy(joint, def.hertz > 0 ? def.hertz : kStiffMouse, false);
        as<b2MouseJoint>(joint).SetStiffness(std::max(s.stiffness, 1e-6F));
        as<b2MouseJoint>(joint).SetDamping(s.damping);
        as<b2MouseJoint>(joint).SetMaxForce(metres(def.maxForce));
        break;
    }
    case Kind::Pulley: break;
    }
    joint.joint->GetBodyA()->SetAwake(true);
    joint.joint->GetBodyB()->SetAwake(true);
}

/// Before each of Box2D's steps: what a joint aims at that goes by speeds, or follows a body.
void Stage::steer(Joint& joint, double h) const
{
    const JointDef& def = joint.def;
    b2Body &a = *joint.joint->GetBodyA(), &b = *joint.joint->GetBodyB();
    if (def.kind == Kind::Mouse && def.a.body != kNoHandle) {
        const b2Vec2 target = bodies_[def.a.body].body->GetWorldPoint(joint.localTarget);
        if ((target - as<b2MouseJoint>(joint).GetTarget()).LengthSquared() > 0)
            as<b2MouseJoint>(joint).SetTarget(target);
    }
    if (def.kind != Kind::Motor) return;
    auto& motor = as<b2MotorJoint>(joint);
    const bool driven = def.driven || !def.motorVelocity.isZero() || def.motorSpeed != 0;
    const Vec2 ahead = units(b.GetWorldCenter()) + (driven ? h : 0) * def.motorVelocity;
    // Box2D's offset is where the origin of b shall be, in a's frame.
    motor.SetLinearOffset(a.GetLocalPoint(metres(ahead)));
    motor.SetAngularOffset(b.GetAngle() - a.GetAngle() + real(h * def.motorSpeed));
}

void Stage::setJoint(JointHandle handle, const JointDef& def)
{
    Joint& joint = joints_[handle];
    JointDef next = def;
    next.kind = joint.def.kind, next.a = joint.def.a, next.b = joint.def.b;
    next.ratio = joint.def.ratio, next.groundA = joint.def.groundA, next.groundB = joint.def.groundB;
    joint.def = next;
    if (def.length >= 0) joint.length = def.length;
    if (!joint.joint) return;
    configure(joint);
    findJoined();
}

void Stage::setJointTarget(JointHandle handle, const Vec2& target)
{
    Joint& joint = joints_[handle];
    if (!joint.joint) return;
    if (joint.def.kind == Kind::Mouse && joint.groundA) {
        as<b2MouseJoint>(joint).SetTarget(metres(target));
    } else {
        (joint.groundA ? joint.groundA : joint.groundB)->SetTransform(metres(target), 0);
    }
    joint.joint->GetBodyA()->SetAwake(true);
    joint.joint->GetBodyB()->SetAwake(true);
}

void Stage::breakJoint(Joint& joint)
{
    joint.state = stateOf(joint);
    joint.state.broken = true;
    world_->DestroyJoint(joint.joint);
    joint.joint = nullptr;
    findJoined();
}

void Stage::removeJoint(JointHandle handle)
{
    Joint& joint = joints_[handle];
    if (joint.joint) world_->DestroyJoint(joint.joint);
    for (b2Body* ground : {joint.groundA, joint.groundB})
        if (ground) world_->DestroyBody(ground);
    joint = Joint();
    joint.removed = true;
    findJoined();
}

void Stage::findJoined()
{
    std::set<std::pair<BodyHandle, BodyHandle>> joined;
    for (const Joint& joint : joints_)
        if (joint.joint && !joint.def.collide && joint.def.a.body != kNoHandle && joint.def.b.body != kNoHandle)
            joined.insert(std::minmax(joint.def.a.body, joint.def.b.body));
    if (joined == book_.joined) return;
    book_.joined = std::move(joined);
    for (const Body& body : bodies_) refilter(body);
}

JointState Stage::stateOf(const Joint& joint) const
{
    if (!joint.joint) return joint.state;
    JointState state;
    const auto rate = static_cast<float>(1 / lastSubstep_);
    state.force = units(joint.joint->GetReactionForce(rate));
    state.torque = squareUnits(joint.joint->GetReactionTorque(rate));
    state.pointA = units(joint.joint->GetAnchorA()), state.pointB = units(joint.joint->GetAnchorB());
    b2Body &a = *joint.joint->GetBodyA(), &b = *joint.joint->GetBodyB();
    switch (joint.def.kind) {
    case Kind::Prismatic: state.value = units(as<b2PrismaticJoint>(joint).GetJointTranslation()); break;
    case Kind::Wheel: state.value = units(as<b2WheelJoint>(joint).GetJointTranslation()); break;
    case Kind::Distance:
    case Kind::Rope:
    case Kind::Mouse: state.value = (state.pointB - state.pointA).norm(); break;
    default: state.value = static_cast<double>(b.GetAngle() - a.GetAngle()) - joint.restAngle;
    }
    return state;
}

}  // namespace jet::box2d
