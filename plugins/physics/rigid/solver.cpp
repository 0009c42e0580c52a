// The solver's schedule: joints, passes and what becomes of them.
#include "solver.hpp"

#include <cmath>

namespace jet::physics {

namespace {

constexpr double kContactHertz = 100, kHertzPerSubstepRate = 0.25, kContactDamping = 10;
constexpr double kJointHertz = 80, kJointHertzPerSubstepRate = 1.0 / 3, kJointDamping = 2;
// Relaxing once leaves piles of a hundred rows ringing for seconds; twice lets them rest, which pays for itself.
constexpr int kRelaxPasses = 2;
constexpr int kJointPushPasses = 2;  // chains of joints carry forces far
constexpr int kBouncePasses = 2;
constexpr std::size_t kGroupsABlock = 32, kBodiesABlock = 1024;

template <class Real>
Softness<Real> softness(double hertz, double dampingRatio, double h)
{
    const Softness<double> s = softnessOf(hertz, dampingRatio, h);
    return {static_cast<Real>(s.biasRate), static_cast<Real>(s.massScale), static_cast<Real>(s.impulseScale)};
}

}  // namespace

template <class Real>
void Solver<Real>::begin(std::size_t bodies, const StepShape& shape, Pool& pool)
{
    pool_ = &pool;
    shape_ = shape;
    const double rate = 1 / shape.h, hertz = std::min(kContactHertz, kHertzPerSubstepRate * rate);
    constants_.h = static_cast<Real>(shape.h), constants_.inverseH = static_cast<Real>(rate);
    constants_.moving = softness<Real>(hertz, kContactDamping, shape.h);
    constants_.still = softness<Real>(2 * hertz, kContactDamping, shape.h);
    constants_.joint = softness<Real>(std::min(kJointHertz, kJointHertzPerSubstepRate * rate), kJointDamping, shape.h);
    constants_.restSpeed = static_cast<Real>(shape.restSpeed);
    kernels_ = &kernels<Real>(shape.choice);
    states_.resize(bodies), pushes_.resize(bodies);
    states_[0] = BodyState<Real>(), pushes_[0] = BodyPush<Real>();
    taken_.resize(bodies, 0), takenByJoints_.assign(bodies, 0);
    if (colours_.empty()) colours_.resize(kColours), jointColours_.resize(kColours);
    for (JointColour& colour : jointColours_) colour.joints.clear(), colour.index.clear(), colour.count = 0;
    rows_.clear();
    changes_.clear();
    hardest_ = 0;
    foresees_ = false;
}

template <class Real>
void Solver<Real>::addJoint(Joint& joint, Index index, const State& state, const std::vector<RigidBody>& bodies)
{
    const JointFrame f = frameOf(joint, state, bodies);
    const BodyState<Real>&a = states_[joint.a], &b = states_[joint.b];
    if (!(a.invMass + a.invInertia + b.invMass + b.invInertia > 0)) return;
    addRows(joint, index, f, states_, shape_.h, rows_);
    if (!joint.hasPoint()) return;
    const int which = colourOf(joint.a, a.invMass > 0, joint.b, b.invMass > 0, takenByJoints_);
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
template <class Work>
void Solver<Real>::eachColour(Work&& work)
{
    for (std::size_t which = 0; which < colours_.size(); ++which) {
        Colour& colour = colours_[which];
        const std::size_t count = colour.contacts.size();
        // In the last colour lanes may share bodies.
        pool_->ranges(count, which == kColours - 1 ? std::max<std::size_t>(count, 1) : kGroupsABlock,
                      [&](std::size_t first, std::size_t last) { work(colour, first, last - first); });
    }
}

/// Warm-start impulses are per substep: scaled, they stand for the same force.
template <class Real>
void Solver<Real>::prepare(int passes)
{
    passes_ = passes;
    const auto ratio = static_cast<Real>(lastH_ > 0 ? shape_.h / lastH_ : 1);
    lastH_ = shape_.h;
    eachColour([&](Colour& c, std::size_t first, std::size_t count) {
        ContactLanes<Real>* contacts = &c.contacts[first];
        if (ratio != 1) kernels_->scaleContacts(contacts, &c.frictions[first], count, ratio);
        if (bounces_) kernels_->approachContacts(states_.data(), contacts, &c.bounces[first], count);
    });
}

template <class Real>
void Solver<Real>::warmAll()
{
    for (const JointRow<Real>& row : rows_) row.warm(states_.data());
    for (JointColour& c : jointColours_) kernels_->warmJoints(states_.data(), c.joints.data(), c.joints.size());
    eachColour([&](Colour& c, std::size_t first, std::size_t count) {
        kernels_->warmContacts(states_.data(), &c.contacts[first], &c.frictions[first], count);
    });
}

template <class Real>
void Solver<Real>::solveJointsOnce(bool push)
{
    for (std::size_t which = 0; which < jointColours_.size(); ++which) {
        JointColour& c = jointColours_[which];
        const std::size_t groups = c.joints.size();
        pool_->ranges(groups, which == kColours - 1 ? std::max<std::size_t>(groups, 1) : kGroupsABlock,
                      [&](std::size_t first, std::size_t last) {
                          kernels_->solveJoints(states_.data(), &c.joints[first], last - first, constants_, push);
                      });
    }
}

template <class Real>
void Solver<Real>::solveAll(bool push)
{
    BodyState<Real>* states = states_.data();
    const int passes = push ? passes_ : passes_ * kRelaxPasses;
    for (int pass = 0; pass < passes; ++pass) {
        for (JointRow<Real>& row : rows_) row.solve(states, constants_.joint, constants_.inverseH, push);
        for (int again = 0; again < (push ? kJointPushPasses : 1); ++again) solveJointsOnce(push);
        eachColour([&](Colour& c, std::size_t first, std::size_t count) {
            if (push) {
                kernels_->solveContacts(states, &c.contacts[first], count, constants_);
            } else if (pass % kRelaxPasses != kRelaxPasses - 1) {
                kernels_->calmContacts(states, &c.contacts[first], count, constants_);
            } else {
                kernels_->relaxContacts(states, &c.contacts[first], &c.frictions[first], count, constants_);
            }
        });
    }
}

template <class Real>
void Solver<Real>::noteAll()
{
    if (!bounces_) return;
    eachColour([&](Colour& c, std::size_t first, std::size_t count) {
        kernels_->noteImpulses(&c.contacts[first], &c.bounces[first], count);
    });
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
        pool_->ranges(states_.size(), kBodiesABlock, [&](std::size_t first, std::size_t last) {
            kernels_->integrateVelocities(&states_[first], &pushes_[first], last - first, constants_.h);
        });
        solveAll(true);
        noteAll();
        pool_->ranges(states_.size(), kBodiesABlock, [&](std::size_t first, std::size_t last) {
            kernels_->integratePositions(&states_[first], last - first, constants_.h);
        });
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
    for (int pass = 0; pass < kBouncePasses * std::min(passes_, 4); ++pass)
        eachColour([&](Colour& c, std::size_t first, std::size_t count) {
            kernels_->bounceContacts(states_.data(), &c.contacts[first], &c.bounces[first], count, constants_);
        });
}

template <class Real>
void Solver<Real>::finish(Collider& collider, std::vector<Joint>& joints)
{
    collider.settled();
    eachColour([&](Colour& c, std::size_t first, std::size_t count) {
        kernels_->carryContacts(states_.data(), &c.contacts[first], bounces_ ? &c.bounces[first] : nullptr,
                                &c.touches[first], count);
    });
    for (Colour& colour : colours_) {
        for (std::size_t group = 0; group < colour.touches.size(); ++group) {
            for (std::uint32_t rest = colour.touches[group] ^ colour.touched[group]; rest != 0; rest &= rest - 1) {
                const std::size_t at = group * kWidth + static_cast<std::size_t>(__builtin_ctz(rest));
                RigidContact& c = collider.contacts()[colour.index[at]];
                fetch(c, collider.places()[colour.index[at]]);
                change(c, (colour.touches[group] >> (at % kWidth) & 1U) != 0);
            }
            colour.touched[group] = colour.touches[group];
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
std::size_t Solver<Real>::colours() const
{
    std::size_t used = 0;
    for (std::size_t i = 0; i < colours_.size(); ++i)
        if (colours_[i].count > 0) used = i + 1;
    return used;
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
