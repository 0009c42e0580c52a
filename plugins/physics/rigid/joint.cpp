#include "joint.hpp"

#include <cmath>
#include <tuple>

namespace jet::physics {

Softness<double> softnessOf(double hertz, double dampingRatio, double h)
{
    if (!(hertz > 0)) return {0, 1, 0};
    const double omega = 2 * kPi * hertz;
    const double a1 = 2 * dampingRatio + h * omega, a2 = h * omega * a1, a3 = 1 / (1 + a2);
    return {omega / a1, a2 * a3, a3};
}

JointDef liveDef(const JointDef& wanted, const JointDef& now)
{
    JointDef def = wanted;
    def.kind = now.kind, def.a = now.a, def.b = now.b;
    def.groundA = now.groundA, def.groundB = now.groundB;
    return def;
}

bool isLike(const JointDef& wanted, const Joint& joint)
{
    const auto parts = [](const JointDef& d) {
        return std::tie(d.limited, d.lower, d.upper, d.driven, d.motorSpeed, d.maxForce, d.maxTorque, d.hertz,
                        d.dampingRatio, d.ratio, d.breakForce, d.collide);
    };
    const JointDef& now = joint.def;
    const bool asLong = wanted.length < 0 || wanted.length == joint.length || now.kind == JointDef::Kind::Pulley;
    return asLong && parts(wanted) == parts(now) && wanted.axis == now.axis &&
           wanted.motorVelocity == now.motorVelocity;
}

double pulleyLength(const JointDef& def, const Vec2& pointA, const Vec2& pointB)
{
    return (pointA - def.groundA).norm() + def.ratio * (pointB - def.groundB).norm();
}

template <class Real>
void JointRow<Real>::apply(BodyState<Real>& stateA, BodyState<Real>& stateB, Real p) const
{
    if (stateA.invMass > 0) {
        stateA.velocityX += stateA.invMass * ax * p, stateA.velocityY += stateA.invMass * ay * p;
        stateA.spin += stateA.invMass * angularA * p;
    }
    if (stateB.invMass > 0) {
        stateB.velocityX += stateB.invMass * bx * p, stateB.velocityY += stateB.invMass * by * p;
        stateB.spin += stateB.invMass * angularB * p;
    }
}

template <class Real>
void JointRow<Real>::warm(BodyState<Real>* bodies) const
{
    apply(bodies[a], bodies[b], impulse);
}

template <class Real>
Real JointRow<Real>::moving(const BodyState<Real>* bodies) const
{
    const BodyState<Real>&stateA = bodies[a], &stateB = bodies[b];
    return ax * stateA.velocityX + ay * stateA.velocityY + angularA * stateA.spin + bx * stateB.velocityX +
           by * stateB.velocityY + angularB * stateB.spin;
}

template <class Real>
Real JointRow<Real>::moved(const BodyState<Real>* bodies) const
{
    const BodyState<Real>&stateA = bodies[a], &stateB = bodies[b];
    return ax * stateA.moveX + ay * stateA.moveY + angularA * stateA.sweep + bx * stateB.moveX + by * stateB.moveY +
           angularB * stateB.sweep;
}

template <class Real>
void JointRow<Real>::solve(BodyState<Real>* bodies, const Softness<Real>& standard, Real inverseH, bool push)
{
    BodyState<Real>&stateA = bodies[a], &stateB = bodies[b];
    const Real now = error + moved(bodies);
    Real bias = -speed, massScale = 1, impulseScale = 0;
    if (limit && now > 0) {
        bias = now * inverseH + (push ? bend : Real(0));
    } else if (!velocityOnly && (push || soft)) {
        const Softness<Real>& s = soft ? spring : standard;
        bias = s.biasRate * (soft ? now : std::clamp(now, -far, far)) + bend, massScale = s.massScale,
        impulseScale = s.impulseScale;
    }
    const Real wanted = -mass * massScale * (moving(bodies) + bias) - impulseScale * impulse;
    const Real total = std::clamp(impulse + wanted, least, most);
    const Real change = total - impulse;
    impulse = total;
    apply(stateA, stateB, change);
}

template struct JointRow<float>;
template struct JointRow<double>;

JointFrame frameOf(const Joint& joint, const State& state, const std::vector<RigidBody>& bodies)
{
    JointFrame f;
    const auto place = [&](Index body, const Vec2& local, Vec2& arm, Vec2& point) {
        if (body == 0) {
            arm = Vec2(0, 0), point = local;
            return 0.0;
        }
        const Index node = bodies[body].node;
        arm = rotated(state.nodes.rotation[node], local);
        point = state.nodes.position[node] + arm;
        return state.nodes.angle[node];
    };
    const double angleA = place(joint.a, joint.localA, f.armA, f.pointA);
    const double angleB = place(joint.b, joint.localB, f.armB, f.pointB);
    f.angle = angleB - angleA - joint.restAngle;
    f.axis = joint.a == 0 ? joint.localAxis : rotated(state.nodes.rotation[bodies[joint.a].node], joint.localAxis);
    return f;
}

namespace {

constexpr double kUnlimited = 1e30;
constexpr double kTurn = 0.5;       // radians that a push turns a body by at most
constexpr double kStrained = 0.04;  // of that
constexpr double kNearing = 0.2;    // share of the way to its limit that a motor drives at most in a substep

/// Builds rows of one joint; each has a slot in which its impulse is kept from step to step.
template <class Real>
class RowMaker {
public:
    RowMaker(const Joint& joint, Index index, const JointFrame& frame, const BodyState<Real>* states, Index a, Index b,
             double h, std::vector<JointRow<Real>>& rows)
        : joint_(joint), index_(index), frame_(frame), states_(states), a_(a), b_(b), h_(h), rows_(rows)
    {
    }

    /// Speed of b's point against a's along `direction`, which turns with a when `carried`.
    JointRow<Real>& along(const Vec2& direction, int slot, bool carried = false)
    {
        const Vec2 apart = frame_.pointB - frame_.pointA;
        const double leverA = cross(frame_.armA, direction) + (carried ? cross(apart, direction) : 0);
        return add(-direction, -leverA, direction, cross(frame_.armB, direction), slot);
    }
    JointRow<Real>& turning(int slot) { return add(Vec2(0, 0), -1, Vec2(0, 0), 1, slot); }
    JointRow<Real>& add(const Vec2& ja, double angularA, const Vec2& jb, double angularB, int slot)
    {
        JointRow<Real> row;
        row.a = a_, row.b = b_, row.joint = index_, row.slot = static_cast<Index>(slot);
        const BodyState<Real>&a = states_[a_], &b = states_[b_];
        row.ax = static_cast<Real>(ja.x()), row.ay = static_cast<Real>(ja.y()),
        row.angularA = static_cast<Real>(angularA) * a.perGyration;
        row.bx = static_cast<Real>(jb.x()), row.by = static_cast<Real>(jb.y()),
        row.angularB = static_cast<Real>(angularB) * b.perGyration;
        const Real inverse = a.invMass * (row.ax * row.ax + row.ay * row.ay + row.angularA * row.angularA) +
                             b.invMass * (row.bx * row.bx + row.by * row.by + row.angularB * row.angularB);
        row.mass = inverse > 0 ? 1 / inverse : 0;
        const Real turn = row.mass * std::max(a.invMass * a.perGyration * std::abs(row.angularA),
                                              b.invMass * b.perGyration * std::abs(row.angularB));
        row.far = static_cast<Real>(turn * kUnlimited > kTurn ? kTurn / turn : kUnlimited);
        row.impulse = static_cast<Real>(joint_.warm(slot, h_));
        row.least = static_cast<Real>(-kUnlimited), row.most = static_cast<Real>(kUnlimited);
        return rows_.emplace_back(row);
    }
    void makeSpring(JointRow<Real>& row, double hertz)
    {
        if (!(hertz > 0)) return;
        const Softness<double> s = softnessOf(hertz, joint_.def.dampingRatio, h_);
        row.soft = true;
        row.frequency = static_cast<Real>(2 * kPi * hertz);
        row.spring = {static_cast<Real>(s.biasRate), static_cast<Real>(s.massScale), static_cast<Real>(s.impulseScale)};
    }
    void makeMotor(JointRow<Real>& row, double speed, double most)
    {
        row.velocityOnly = true;
        row.speed = static_cast<Real>(speed);
        row.most = static_cast<Real>(most * h_), row.least = -row.most;
    }
    /// The motor's speed, less where its limit is near, and back from beyond it. Pressed against each other both would
    /// grow to all that the motor has, and a soft limit gives way to so much; the motor holds as well so.
    double speedWithin(double value) const
    {
        const JointDef& def = joint_.def;
        if (!def.limited) return def.motorSpeed;
        const bool up = def.motorSpeed > 0;
        const double room = up ? def.upper - value : value - def.lower;
        const double speed = std::min(std::abs(def.motorSpeed), kNearing * room / h_);
        return up ? speed : -speed;
    }
    /// `value` may not go below `lower` or above `upper`; two rows of the same direction.
    template <class Make>
    void limits(double value, Make&& make, int slot)
    {
        JointRow<Real>& low = make(slot);
        low.limit = true;
        low.error = static_cast<Real>(value - joint_.def.lower);
        low.least = 0;
        JointRow<Real>& high = make(slot + 1);
        high.ax = -high.ax, high.ay = -high.ay, high.angularA = -high.angularA;
        high.bx = -high.bx, high.by = -high.by, high.angularB = -high.angularB;
        high.limit = true;
        high.error = static_cast<Real>(joint_.def.upper - value);
        high.least = 0;
    }

private:
    const Joint& joint_;
    Index index_;
    const JointFrame& frame_;
    const BodyState<Real>* states_;
    Index a_, b_;
    double h_;
    std::vector<JointRow<Real>>& rows_;
};

template <class Real>
void addSlider(const Joint& joint, const JointFrame& f, RowMaker<Real>& make)
{
    const Vec2& axis = f.axis;
    const JointDef& def = joint.def;
    const Vec2 apart = f.pointB - f.pointA, across = perpendicular(axis);
    make.along(across, 0, true).error = static_cast<Real>(apart.dot(across));
    const double travel = apart.dot(axis);
    if (def.kind == JointDef::Kind::Prismatic) {
        make.turning(1).error = static_cast<Real>(f.angle);
        if (def.driven) make.makeMotor(make.along(axis, 2, true), make.speedWithin(travel), def.maxForce);
    } else {
        if (def.hertz > 0) {
            JointRow<Real>& spring = make.along(axis, 1, true);
            spring.error = static_cast<Real>(travel);
            make.makeSpring(spring, def.hertz);
        }
        if (def.driven) make.makeMotor(make.turning(2), def.motorSpeed, def.maxTorque);
    }
    if (def.limited)
        make.limits(
            travel, [&](int slot) -> JointRow<Real>& { return make.along(axis, slot, true); }, 3);
}

template <class Real>
void addDistance(const Joint& joint, const JointFrame& f, RowMaker<Real>& make)
{
    const Vec2 apart = f.pointB - f.pointA;
    const double length = apart.norm();
    const Vec2 along = length > 1e-12 ? Vec2(apart / length) : Vec2(1, 0);
    if (joint.def.kind == JointDef::Kind::Rope) {
        JointRow<Real>& row = make.add(along, cross(f.armA, along), -along, -cross(f.armB, along), 0);
        row.limit = true;
        row.error = static_cast<Real>(joint.length - length);
        row.least = 0;
        return;
    }
    JointRow<Real>& row = make.along(along, 0);
    row.error = static_cast<Real>(length - joint.length);
    make.makeSpring(row, joint.def.hertz);
}

template <class Real>
void addPulley(const Joint& joint, const JointFrame& f, RowMaker<Real>& make)
{
    const Vec2 ropeA = f.pointA - joint.def.groundA, ropeB = f.pointB - joint.def.groundB;
    const double lengthA = ropeA.norm(), lengthB = ropeB.norm();
    if (!(lengthA > 1e-9) || !(lengthB > 1e-9)) return;
    const Vec2 ua = ropeA / lengthA, ub = joint.def.ratio * ropeB / lengthB;
    make.add(ua, cross(f.armA, ua), ub, cross(f.armB, ub), 0).error =
        static_cast<Real>(lengthA + joint.def.ratio * lengthB - joint.length);
}

}  // namespace

template <class Real>
void addRows(const Joint& joint, Index index, const JointFrame& f, const BodyState<Real>* states, Index a, Index b,
             double h, std::vector<JointRow<Real>>& rows)
{
    RowMaker<Real> make(joint, index, f, states, a, b, h, rows);
    const JointDef& def = joint.def;
    const Vec2 apart = f.pointB - f.pointA;
    switch (def.kind) {
    case JointDef::Kind::Revolute:
        if (def.driven) make.makeMotor(make.turning(2), make.speedWithin(f.angle), def.maxTorque);
        if (def.limited)
            make.limits(
                f.angle, [&](int slot) -> JointRow<Real>& { return make.turning(slot); }, 3);
        break;
    case JointDef::Kind::Weld: {
        JointRow<Real>& row = make.turning(2);
        row.error = static_cast<Real>(f.angle);
        make.makeSpring(row, def.hertz);
        break;
    }
    case JointDef::Kind::Prismatic:
    case JointDef::Kind::Wheel: addSlider(joint, f, make); break;
    case JointDef::Kind::Distance:
    case JointDef::Kind::Rope: addDistance(joint, f, make); break;
    case JointDef::Kind::Motor:
        make.makeMotor(make.along(Vec2(1, 0), 0), def.motorVelocity.x(), def.maxForce);
        make.makeMotor(make.along(Vec2(0, 1), 1), def.motorVelocity.y(), def.maxForce);
        make.makeMotor(make.turning(2), def.motorSpeed, def.maxTorque);
        break;
    case JointDef::Kind::Mouse:
        for (int i = 0; i < 2; ++i) {
            JointRow<Real>& row = make.along(i == 0 ? Vec2(1, 0) : Vec2(0, 1), i);
            row.error = static_cast<Real>(apart[i]);
            make.makeSpring(row, def.hertz > 0 ? def.hertz : 4);
            row.most = static_cast<Real>(def.maxForce * h), row.least = -row.most;
            row.strongest = static_cast<Real>(def.maxForce);
        }
        break;
    case JointDef::Kind::Pulley: addPulley(joint, f, make); break;
    }
}

template <class Real>
JointFrame TurningRows<Real>::frameIn(const BodyState<Real>* states, double seconds) const
{
    JointFrame f = start_;
    const auto carry = [&](Index slot, Vec2& arm, Vec2& point) {
        const BodyState<Real>& s = states[slot];
        const double turn = static_cast<double>(s.turn()) + seconds * static_cast<double>(s.omega());
        const Vec2 move(static_cast<double>(s.moveX) + seconds * static_cast<double>(s.velocityX),
                        static_cast<double>(s.moveY) + seconds * static_cast<double>(s.velocityY));
        const Vec2 turned = rotated(direction(turn), arm);
        point += move + (turned - arm);
        arm = turned;
        return turn;
    };
    const double turnA = carry(a_, f.armA, f.pointA), turnB = carry(b_, f.armB, f.pointB);
    f.angle += turnB - turnA;
    f.axis = rotated(direction(turnA), f.axis);
    return f;
}

/// False: they cannot be made where the bodies are.
template <class Real>
bool TurningRows<Real>::make(const JointFrame& f, const BodyState<Real>* states, double h,
                             std::vector<JointRow<Real>>& made) const
{
    made.clear();
    addRows(*joint_, index_, f, states, a_, b_, h, made);
    return made.size() == count_;
}

/// Does its direction turn by more than half a radian, as of a short rope, or beside the wheel of a pulley? Then what
/// is foreseen, or was given, is of another way.
template <class Real>
bool turnsFar(const JointRow<Real>& now, const JointRow<Real>& then)
{
    const auto apart = [](Real x, Real y, Real u, Real v) {
        return x * u + y * v < static_cast<Real>(0.88) * std::sqrt((x * x + y * y) * (u * u + v * v));
    };
    return apart(now.ax, now.ay, then.ax, then.ay) || apart(now.bx, now.by, then.bx, then.by);
}

template <class Real>
bool TurningRows<Real>::turn(const BodyState<Real>* states, BodyPush<Real>* pushes, double h,
                             std::vector<JointRow<Real>>& rows, std::vector<JointRow<Real>>& made) const
{
    if (!make(frameIn(states, 0), states, h, made)) return true;
    bool strained = false;
    const auto follow = [&](Index slot, Real x, Real y, Real angular) {
        const BodyState<Real>& s = states[slot];
        if (s.invMass == 0) return;
        pushes[slot].warmX += s.invMass * x, pushes[slot].warmY += s.invMass * y;
        pushes[slot].warmW += s.invMass * angular;
    };
    for (std::size_t i = 0; i < count_; ++i) {
        JointRow<Real>&old = rows[first_ + i], &row = made[i];
        const bool far = turnsFar(old, row);
        const Real was = old.impulse, p = row.impulse = far ? 0 : was;
        follow(a_, row.ax * p - old.ax * was, row.ay * p - old.ay * was, row.angularA * p - old.angularA * was);
        follow(b_, row.bx * p - old.bx * was, row.by * p - old.by * was, row.angularB * p - old.angularB * was);
        strained |= far || (!row.soft && !row.velocityOnly && !(std::abs(row.error) < kStrained * row.far) &&
                            !(row.limit && row.error > 0));
        row.error -= row.moved(states);
        row.stored = old.stored, row.given = old.given;
        old = row;
    }
    return strained;
}

template <class Real>
void TurningRows<Real>::foresee(const BodyState<Real>* states, double h, std::vector<JointRow<Real>>& rows,
                                std::vector<JointRow<Real>>& made) const
{
    // A body that turns by more than a radian is not foreseen farther than that.
    const Real fastest = std::max(std::abs(states[a_].omega()), std::abs(states[b_].omega()));
    const double ahead = std::min(h, fastest > 0 ? 1 / static_cast<double>(fastest) : h);
    if (!make(frameIn(states, ahead), states, h, made)) return;
    for (std::size_t i = 0; i < count_; ++i) {
        JointRow<Real>& row = rows[first_ + i];
        if (row.soft || row.velocityOnly || turnsFar(row, made[i])) continue;
        const Real straight = row.error + row.moved(states) + static_cast<Real>(ahead) * row.moving(states);
        row.bend = (made[i].error - straight) / static_cast<Real>(h);
    }
}

template class TurningRows<float>;
template class TurningRows<double>;

template void addRows<float>(const Joint&, Index, const JointFrame&, const BodyState<float>*, Index, Index, double,
                             std::vector<JointRow<float>>&);
template void addRows<double>(const Joint&, Index, const JointFrame&, const BodyState<double>*, Index, Index, double,
                              std::vector<JointRow<double>>&);

}  // namespace jet::physics
