#include "solver.hpp"

#include <cmath>

namespace jet::physics {

namespace {

constexpr double kContactHertz = 60, kHertzPerSubstepRate = 0.25, kContactDamping = 10;
constexpr double kJointHertz = 60, kJointDamping = 2;
constexpr float kPushLengths = 4;  // overlaps are pushed out no faster than this many lengths a second
constexpr float kSlopsPerLength = 500;
constexpr int kBouncePasses = 2;
constexpr int kJointPasses = 2;  // chains of joints carry forces far; once leaves a third more error

template <class Real>
Softness<Real> softness(double hertz, double dampingRatio, double h)
{
    const Softness<double> s = softnessOf(hertz, dampingRatio, h);
    return {static_cast<Real>(s.biasRate), static_cast<Real>(s.massScale), static_cast<Real>(s.impulseScale)};
}

}  // namespace

template <class Real>
void Solver<Real>::begin(std::size_t bodies, const StepShape& shape)
{
    shape_ = shape;
    const double rate = 1 / shape.h, hertz = std::min(kContactHertz, kHertzPerSubstepRate * rate);
    constants_.h = static_cast<Real>(shape.h), constants_.inverseH = static_cast<Real>(rate);
    constants_.moving = softness<Real>(hertz, kContactDamping, shape.h);
    constants_.still = softness<Real>(2 * hertz, kContactDamping, shape.h);
    constants_.joint = softness<Real>(std::min(kJointHertz, kHertzPerSubstepRate * rate), kJointDamping, shape.h);
    constants_.restSpeed = static_cast<Real>(shape.restSpeed);
    kernels_ = &kernels<Real>(shape.choice);
    states_.resize(bodies), pushes_.resize(bodies);
    states_[0] = BodyState<Real>(), pushes_[0] = BodyPush<Real>();
    taken_.assign(bodies, 0), takenByJoints_.assign(bodies, 0);
    if (colours_.empty()) colours_.resize(kColours), jointColours_.resize(kColours);
    for (Colour& colour : colours_) {
        colour.contacts.clear(), colour.frictions.clear(), colour.bounces.clear(), colour.index.clear();
        colour.count = 0;
    }
    for (JointColour& colour : jointColours_) colour.joints.clear(), colour.index.clear(), colour.count = 0;
    rows_.clear();
    used_ = 0;
    bounces_ = false;
}

/// The first colour neither body is in yet; what does not move is in none.
template <class Real>
int Solver<Real>::colourOf(Index a, Index b, std::vector<std::uint32_t>& taken)
{
    const bool movesA = states_[a].invMass > 0, movesB = states_[b].invMass > 0;
    const std::uint32_t both = (movesA ? taken[a] : 0) | (movesB ? taken[b] : 0);
    const int colour = std::min(__builtin_ctz(~both | 1U << (kColours - 1)), kColours - 1);
    if (colour == kColours - 1) return colour;
    if (movesA) taken[a] |= 1U << colour;
    if (movesB) taken[b] |= 1U << colour;
    return colour;
}

template <class Real>
std::size_t Solver<Real>::laneOf(Colour& colour, bool alone)
{
    constexpr std::size_t lanes = kLanes<Real>;
    if (alone) colour.count = groups(colour.count) * lanes;
    const std::size_t lane = colour.count++;
    if (lane % lanes == 0) {
        colour.contacts.emplace_back(ContactLanes<Real>{});
        colour.frictions.emplace_back(FrictionLanes<Real>{});
        if (bounces_) colour.bounces.resize(colour.contacts.size(), BounceLanes<Real>{});
        colour.index.resize(colour.contacts.size() * lanes, kNone);
    }
    return lane;
}

template <class Real>
void Solver<Real>::addContact(RigidContact& c, Index index, const RigidBody&, const RigidBody&, const Pose& poseA,
                              const Pose& poseB)
{
    const BodyState<Real>&a = states_[c.bodyA], &b = states_[c.bodyB];
    const int which = colourOf(c.bodyA, c.bodyB, taken_);
    Colour& colour = colours_[static_cast<std::size_t>(which)];
    used_ = std::max(used_, static_cast<std::size_t>(which) + 1);
    if (c.restitution > 0) bounces_ = true;
    const std::size_t at = laneOf(colour, which == kColours - 1), group = at / kLanes<Real>, lane = at % kLanes<Real>;
    if (bounces_ && colour.bounces.size() < colour.contacts.size())
        colour.bounces.resize(colour.contacts.size(), BounceLanes<Real>{});
    colour.index[at] = index;
    ContactLanes<Real>& g = colour.contacts[group];
    FrictionLanes<Real>& f = colour.frictions[group];
    g.a[lane] =
        a.invMass > 0 || a.velocityX != 0 || a.velocityY != 0 || a.omega != 0 ? static_cast<std::int32_t>(c.bodyA) : 0;
    g.b[lane] =
        b.invMass > 0 || b.velocityX != 0 || b.velocityY != 0 || b.omega != 0 ? static_cast<std::int32_t>(c.bodyB) : 0;
    const Vec2f n = turned(poseA.turn, c.normal);
    const Real nx = n.x, ny = n.y;
    g.normalX[lane] = nx, g.normalY[lane] = ny;
    g.mostPush[lane] = kPushLengths * kSlopsPerLength * c.slop;
    f.friction[lane] = c.friction;
    const Real inverse = a.invMass + b.invMass;
    for (int k = 0; k < c.count; ++k) {
        // Both arms end in one place, half way between the surfaces.
        // Far ones, of foreseen hits, act on the surfaces.
        const Vec2f half = (c.separation[k] < 20 * c.slop ? 0.5F * c.separation[k] : 0.0F) * n;
        const Vec2f armA = turned(poseA.turn, c.onA[k]) + half, armB = turned(poseB.turn, c.onB[k]) - half;
        auto& p = g.points[k];
        auto& q = f.points[k];
        const Real leverA = armA.x * ny - armA.y * nx, leverB = armB.x * ny - armB.y * nx;
        const Real slideA = armA.x * nx + armA.y * ny, slideB = armB.x * nx + armB.y * ny;
        p.leverA[lane] = leverA, p.leverB[lane] = leverB;
        q.leverA[lane] = slideA, q.leverB[lane] = slideB;
        p.separation[lane] = c.separation[k] + c.slop;
        const Real k1 = inverse + a.invInertia * leverA * leverA + b.invInertia * leverB * leverB;
        const Real k2 = inverse + a.invInertia * slideA * slideA + b.invInertia * slideB * slideB;
        p.mass[lane] = k1 > 0 ? 1 / k1 : 0, q.mass[lane] = k2 > 0 ? 1 / k2 : 0;
        p.impulse[lane] = c.impulse[k], q.impulse[lane] = c.tangentImpulse[k];
        if (!bounces_) continue;
        BounceLanes<Real>& r = colour.bounces[group];
        r.restitution[lane] = c.restitution;
        r.approach[k][lane] =
            nx * (b.velocityX - a.velocityX) + ny * (b.velocityY - a.velocityY) + leverB * b.omega - leverA * a.omega;
    }
}

template <class Real>
void Solver<Real>::addJoint(Joint& joint, Index index, const State& state, const std::vector<RigidBody>& bodies)
{
    const JointFrame f = frameOf(joint, state, bodies);
    const BodyState<Real>&a = states_[joint.a], &b = states_[joint.b];
    if (!(a.invMass + a.invInertia + b.invMass + b.invInertia > 0)) return;
    addRows(joint, index, f, states_, shape_.h, rows_);
    if (!joint.hasPoint()) return;
    const int which = colourOf(joint.a, joint.b, takenByJoints_);
    JointColour& colour = jointColours_[static_cast<std::size_t>(which)];
    constexpr std::size_t lanes = kLanes<Real>;
    if (which == kColours - 1) colour.count = groups(colour.count) * lanes;
    const std::size_t at = colour.count++, lane = at % lanes;
    if (lane == 0) {
        colour.joints.emplace_back(JointLanes<Real>{});
        colour.index.resize(colour.joints.size() * lanes, kNone);
    }
    colour.index[at] = index;
    JointLanes<Real>& g = colour.joints[at / lanes];
    g.a[lane] = static_cast<std::int32_t>(joint.a), g.b[lane] = static_cast<std::int32_t>(joint.b);
    const Real ax = static_cast<Real>(f.armA.x()), ay = static_cast<Real>(f.armA.y());
    const Real bx = static_cast<Real>(f.armB.x()), by = static_cast<Real>(f.armB.y());
    g.armAX[lane] = ax, g.armAY[lane] = ay, g.armBX[lane] = bx, g.armBY[lane] = by;
    g.errorX[lane] = static_cast<Real>(f.pointB.x() - f.pointA.x());
    g.errorY[lane] = static_cast<Real>(f.pointB.y() - f.pointA.y());
    const Real xx = a.invMass + b.invMass + a.invInertia * ay * ay + b.invInertia * by * by;
    const Real yy = a.invMass + b.invMass + a.invInertia * ax * ax + b.invInertia * bx * bx;
    const Real xy = -a.invInertia * ax * ay - b.invInertia * bx * by;
    const Real determinant = xx * yy - xy * xy;
    const Real inverse = determinant > 0 ? 1 / determinant : 0;
    g.inverseXX[lane] = yy * inverse, g.inverseYY[lane] = xx * inverse, g.inverseXY[lane] = -xy * inverse;
    g.impulseX[lane] = static_cast<Real>(joint.impulse[0]), g.impulseY[lane] = static_cast<Real>(joint.impulse[1]);
}

template <class Real>
void Solver<Real>::warmAll()
{
    if (bounces_)
        for (Colour& c : colours_) c.bounces.resize(c.contacts.size(), BounceLanes<Real>{});
    for (const JointRow<Real>& row : rows_) row.warm(states_.data());
    for (JointColour& c : jointColours_) kernels_->warmJoints(states_.data(), c.joints.data(), c.joints.size());
    for (Colour& c : colours_)
        kernels_->warmContacts(states_.data(), c.contacts.data(), c.frictions.data(), c.contacts.size());
}

template <class Real>
void Solver<Real>::solveAll(bool push)
{
    BodyState<Real>* states = states_.data();
    for (int pass = 0; pass < shape_.passes; ++pass) {
        for (JointRow<Real>& row : rows_) row.solve(states, constants_.joint, constants_.inverseH, push);
        for (int again = 0; again < kJointPasses; ++again)
            for (JointColour& c : jointColours_)
                if (c.count > 0) kernels_->solveJoints(states, c.joints.data(), c.joints.size(), constants_, push);
        for (Colour& c : colours_) {
            if (c.count == 0) continue;
            if (push) {
                kernels_->solveContacts(states, c.contacts.data(), c.contacts.size(), constants_);
            } else {
                kernels_->relaxContacts(states, c.contacts.data(), c.frictions.data(), c.contacts.size(), constants_);
            }
        }
    }
}

template <class Real>
void Solver<Real>::noteAll()
{
    if (!bounces_) return;
    for (Colour& c : colours_)
        if (c.count > 0) kernels_->noteImpulses(c.contacts.data(), c.bounces.data(), c.contacts.size());
}

template <class Real>
void Solver<Real>::run()
{
    // Warm starting is worked out once, on bodies at rest, and then kept up with by the body passes.
    for (std::size_t i = 0; i < states_.size(); ++i) {
        BodyState<Real>& s = states_[i];
        BodyPush<Real>& p = pushes_[i];
        p.beforeX = s.velocityX, p.beforeY = s.velocityY, p.beforeW = s.omega;
        if (s.invMass > 0 || s.invInertia > 0) s.velocityX = s.velocityY = s.omega = 0;
    }
    warmAll();
    for (std::size_t i = 0; i < states_.size(); ++i) {
        BodyState<Real>& s = states_[i];
        BodyPush<Real>& p = pushes_[i];
        if (s.invMass > 0 || s.invInertia > 0) {
            p.warmX = s.velocityX, p.warmY = s.velocityY, p.warmW = s.omega;
        } else {
            p.warmX = p.warmY = p.warmW = 0;
        }
        s.velocityX = p.beforeX, s.velocityY = p.beforeY, s.omega = p.beforeW;
    }
    for (int i = 0; i < shape_.substeps; ++i) {
        kernels_->integrateVelocities(states_.data(), pushes_.data(), states_.size(), constants_.h);
        solveAll(true);
        noteAll();
        kernels_->integratePositions(states_.data(), states_.size(), constants_.h);
        solveAll(false);
        noteAll();
    }
    bounce();
}

template <class Real>
void Solver<Real>::warm()
{
    warmAll();
}
template <class Real>
void Solver<Real>::push()
{
    solveAll(true);
    noteAll();
}
template <class Real>
void Solver<Real>::relax()
{
    solveAll(false);
    noteAll();
}

template <class Real>
void Solver<Real>::bounce()
{
    if (!bounces_) return;
    for (int pass = 0; pass < kBouncePasses * std::min(shape_.passes, 4); ++pass)
        for (Colour& c : colours_)
            if (c.count > 0)
                kernels_->bounceContacts(states_.data(), c.contacts.data(), c.bounces.data(), c.contacts.size(),
                                         constants_);
}

template <class Real>
void Solver<Real>::finish(std::vector<RigidContact>& contacts, std::vector<Joint>& joints)
{
    for (const Colour& colour : colours_) {
        for (std::size_t at = 0; at < colour.count; ++at) {
            if (colour.index[at] == kNone) continue;
            RigidContact& c = contacts[colour.index[at]];
            const std::size_t group = at / kLanes<Real>, lane = at % kLanes<Real>;
            const ContactLanes<Real>& g = colour.contacts[group];
            c.stepImpulse = 0;
            for (int k = 0; k < c.count; ++k) {
                c.impulse[k] = static_cast<float>(g.points[k].impulse[lane]);
                c.tangentImpulse[k] = static_cast<float>(colour.frictions[group].points[k].impulse[lane]);
                c.stepImpulse += bounces_ ? static_cast<float>(colour.bounces[group].most[k][lane]) : c.impulse[k];
            }
            c.touching = c.stepImpulse > 0;
        }
    }
    for (const JointColour& colour : jointColours_) {
        for (std::size_t at = 0; at < colour.count; ++at) {
            if (colour.index[at] == kNone) continue;
            Joint& joint = joints[colour.index[at]];
            joint.impulse[0] = static_cast<double>(colour.joints[at / kLanes<Real>].impulseX[at % kLanes<Real>]);
            joint.impulse[1] = static_cast<double>(colour.joints[at / kLanes<Real>].impulseY[at % kLanes<Real>]);
            joint.state.force += Vec2(joint.impulse[0], joint.impulse[1]) / shape_.h;
        }
    }
    for (const JointRow<Real>& row : rows_) {
        Joint& joint = joints[row.joint];
        joint.impulse[row.slot] = static_cast<double>(row.impulse);
        joint.state.force += static_cast<double>(row.impulse) / shape_.h * Vec2(row.bx, row.by);
        if (row.bx == 0 && row.by == 0)
            joint.state.torque += static_cast<double>(row.impulse * row.angularB) / shape_.h;
    }
}

template <class Real>
std::size_t Solver<Real>::bytes() const
{
    std::size_t sum = states_.capacity() * (sizeof(BodyState<Real>) + sizeof(BodyPush<Real>) + 8);
    for (const Colour& c : colours_)
        sum += c.contacts.capacity() * (sizeof(ContactLanes<Real>) + sizeof(FrictionLanes<Real>)) +
               c.bounces.capacity() * sizeof(BounceLanes<Real>) + c.index.capacity() * sizeof(Index);
    for (const JointColour& c : jointColours_) sum += c.joints.capacity() * sizeof(JointLanes<Real>);
    return sum + rows_.capacity() * sizeof(JointRow<Real>);
}

template class Solver<float>;
template class Solver<double>;

}  // namespace jet::physics
