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
constexpr std::size_t kNodesABlock = 256;

template <class Real>
Softness<Real> softness(double hertz, double dampingRatio, double h)
{
    const Softness<double> s = softnessOf(hertz, dampingRatio, h);
    return {static_cast<Real>(s.biasRate), static_cast<Real>(s.massScale), static_cast<Real>(s.impulseScale)};
}

}  // namespace

template <class Real>
void Solver<Real>::begin(std::size_t bodies, const StepShape& shape, Pool& pool, Arena& arena)
{
    pool_ = &pool, arena_ = &arena;
    states_ = {}, pushes_ = {}, drifts_ = {};
    shape_ = shape;
    const double rate = 1 / shape.h, hertz = std::min(kContactHertz, kHertzPerSubstepRate * rate);
    constants_.h = static_cast<Real>(shape.h), constants_.inverseH = static_cast<Real>(rate);
    constants_.moving = softness<Real>(hertz, kContactDamping, shape.h);
    constants_.still = softness<Real>(2 * hertz, kContactDamping, shape.h);
    constants_.joint = softness<Real>(std::min(kJointHertz, kJointHertzPerSubstepRate * rate), kJointDamping, shape.h);
    constants_.linearKept = static_cast<Real>(shape.linearKept);
    constants_.angularKept = static_cast<Real>(shape.angularKept);
    constants_.restSpeed = static_cast<Real>(shape.restSpeed);
    kernels_ = &kernels<Real>(shape.choice);
    domains_.resize(bodies);
    taken_.resize(bodies, domains_.depth());
    if (colours_.empty()) colours_.resize(kColours * Domains::kNodes), jointColours_.resize(kColours * Domains::kNodes);
    std::fill(std::begin(strained_), std::end(strained_), false);
    changes_.clear();
    hardest_ = 0;
    foresees_ = false;
}

template <class Real>
template <class Work>
void Solver<Real>::eachColour(Node node, Work&& work)
{
    for (std::size_t i = 0; i < used_[node]; ++i) {
        Colour& colour = colours_[firstColourOf(node) + i];
        if (!colour.contacts.empty()) work(colour);
    }
}

template <class Real>
template <class Work>
void Solver<Real>::eachRun(Node node, Work&& work)
{
    eachColour(node, [&](Colour& c) {
        const std::size_t count = c.contacts.size();
        const std::size_t run = isLast(static_cast<std::size_t>(&c - colours_.data())) ? 1 : count;
        for (std::size_t first = 0; first < count; first += run) work(&c.contacts[first], &c.frictions[first], run);
    });
}

template <class Real>
void Solver<Real>::countUsed()
{
    std::fill(std::begin(used_), std::end(used_), std::size_t{0});
    std::fill(std::begin(usedByJoints_), std::end(usedByJoints_), std::size_t{0});
    for (std::size_t i = 0; i < colours_.size(); ++i) {
        if (!colours_[i].contacts.empty()) used_[nodeOf(i)] = i % kColours + 1;
        if (!jointColours_[i].joints.empty()) usedByJoints_[nodeOf(i)] = i % kColours + 1;
    }
}

/// Bodies of domains that constraints of borders push: in each pass, who solves those takes their states from the
/// thread that has the domain.
template <class Real>
void Solver<Real>::listShared()
{
    for (auto& slots : shared_) slots.clear();
    if (pool_->threads() <= 1) return;
    const auto add = [&](std::int32_t far) {
        if (far != 0) shared_[domains_.nodeOf(domains_.bodyAt(slotAt<Real>(far)))].push_back(slotAt<Real>(far));
    };
    const auto addLanes = [&](const auto& groups) {
        for (const auto& group : groups)
            for (std::size_t lane = 0; lane < kWidth; ++lane) add(group.a[lane]), add(group.b[lane]);
    };
    for (std::size_t node = 1; node < domains_.leaves(); ++node)
        for (std::size_t i = 0; i < kColours; ++i) {
            const std::size_t which = firstColourOf(static_cast<Node>(node)) + i;
            addLanes(colours_[which].contacts), addLanes(jointColours_[which].joints);
        }
    for (auto& slots : shared_) {
        std::sort(slots.begin(), slots.end());
        slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
    }
}

/// All at once, not one after the other as they are come upon.
template <class Real>
void Solver<Real>::askForShared(Node leaf) const
{
    for (const Index slot : shared_[leaf]) prefetchToWrite(&states_[slot]);
}

/// Warm-start impulses are per substep: scaled, they stand for the same force.
template <class Real>
void Solver<Real>::prepare(int passes)
{
    passes_ = passes;
    fresh_ = true;
    const auto ratio = static_cast<Real>(lastH_ > 0 ? shape_.h / lastH_ : 1);
    lastH_ = shape_.h;
    countUsed();
    listShared();
    eachNode([&](Node node) { foreseeNode(node); });
    if (ratio == 1 && !bounces_) return;
    eachNode([&](Node node) {
        eachColour(node, [&](Colour& c) {
            ContactLanes<Real>* contacts = c.contacts.data();
            if (ratio != 1) kernels_->scaleContacts(contacts, c.frictions.data(), c.contacts.size(), ratio);
            if (bounces_) kernels_->approachContacts(states_.data(), contacts, c.bounces.data(), c.contacts.size());
        });
    });
}

template <class Real>
void Solver<Real>::warmNode(Node node)
{
    BodyState<Real>* states = states_.data();
    for (const JointRow<Real>& row : rows_[node]) row.warm(states);
    for (std::size_t i = 0; i < usedByJoints_[node]; ++i) {
        const JointColour& c = jointColours_[firstColourOf(node) + i];
        kernels_->warmJoints(states, c.joints.data(), c.joints.size());
    }
    eachColour(node, [&](Colour& c) {
        kernels_->warmContacts(states, c.contacts.data(), c.frictions.data(), c.contacts.size());
    });
}

/// After the bodies have moved.
template <class Real>
void Solver<Real>::turnNode(Node node)
{
    bool strained = false;
    for (const TurningRows<Real>& each : turning_[node])
        strained |= each.turn(states_.data(), pushes_.data(), shape_.h, rows_[node], made_[node]);
    for (std::size_t i = 0; i < usedByJoints_[node]; ++i) {
        JointColour& c = jointColours_[firstColourOf(node) + i];
        strained |= kernels_->turnJoints(states_.data(), pushes_.data(), c.joints.data(), c.joints.size(), constants_);
    }
    if (strained && !strained_[node]) strained_[node] = true;  // others' lie in the same line
}

/// Where the joints turn in the next substep, from velocities that they allow: what warm starting and forces make of
/// them is not in balance yet, and may whirl a light body between heavy ones.
template <class Real>
void Solver<Real>::foreseeNode(Node node)
{
    for (const TurningRows<Real>& each : turning_[node])
        each.foresee(states_.data(), shape_.h, rows_[node], made_[node]);
    for (std::size_t i = 0; i < usedByJoints_[node]; ++i) {
        JointColour& c = jointColours_[firstColourOf(node) + i];
        kernels_->foreseeJoints(states_.data(), c.joints.data(), c.joints.size(), constants_);
    }
}

/// All that holds the node's bodies together, once.
template <class Real>
void Solver<Real>::pushNode(Node node)
{
    BodyState<Real>* states = states_.data();
    for (JointRow<Real>& row : rows_[node]) row.solve(states, constants_.joint, constants_.inverseH, true);
    for (int again = 0; again < kJointPushPasses; ++again) {
        for (std::size_t i = 0; i < usedByJoints_[node]; ++i) {
            JointColour& c = jointColours_[firstColourOf(node) + i];
            kernels_->pushJoints(states, c.joints.data(), c.joints.size(), constants_);
        }
    }
    eachRun(node, [&](ContactLanes<Real>* contacts, FrictionLanes<Real>*, std::size_t count) {
        kernels_->solveContacts(states, contacts, count, constants_);
    });
}

/// The same, without pushing errors out.
template <class Real>
void Solver<Real>::relaxNode(Node node, const Pass& pass)
{
    BodyState<Real>* states = states_.data();
    if (pass.again == 0) turnNode(node);
    for (JointRow<Real>& row : rows_[node]) row.solve(states, constants_.joint, constants_.inverseH, false);
    if (pass.last)
        for (JointRow<Real>& row : rows_[node])
            if (row.velocityOnly) row.given += std::max(Real(0), row.impulse * row.moving(states));
    for (std::size_t i = 0; i < usedByJoints_[node]; ++i) {
        JointColour& c = jointColours_[firstColourOf(node) + i];
        kernels_->relaxJoints(states, c.joints.data(), c.joints.size());
    }
    StepConstants<Real> constants = constants_;
    if (pass.last) constants.totalKept = pass.first ? 0 : 1, constants.totalAdded = 1;
    eachRun(node, [&](ContactLanes<Real>* contacts, FrictionLanes<Real>* frictions, std::size_t count) {
        if (pass.again % kRelaxPasses != kRelaxPasses - 1) {
            kernels_->calmContacts(states, contacts, count, constants);
        } else {
            kernels_->relaxContacts(states, contacts, frictions, count, constants);
        }
    });
    if (pass.last) foreseeNode(node);
}

/// How often constraints are relaxed in a substep.
template <class Real>
int Solver<Real>::relaxPasses() const
{
    return passes_ * kRelaxPasses;
}

/// Of a whole step: warm starting, and then the passes of each substep.
template <class Real>
typename Solver<Real>::Pass Solver<Real>::passAt(std::size_t index) const
{
    if (index == 0) return {Pass::Kind::Warm, 0, true, true, false};
    const int each = passes_ + relaxPasses(), substep = static_cast<int>(index - 1) / each,
              at = static_cast<int>(index - 1) % each;
    const bool push = at < passes_;
    const int again = push ? at : at - passes_;
    return {push ? Pass::Kind::Push : Pass::Kind::Relax, again, again == 0, substep == 0, at + 1 == each};
}

/// Warm starting is worked out once, on bodies at rest, and then kept up with by the body passes.
template <class Real>
void Solver<Real>::moveBodies(const Pass& pass, Index first, Index count)
{
    const auto moves = [](const BodyState<Real>& s) { return s.invMass > 0; };
    const auto halt = [&] {
        for (Index i = first; i < first + count; ++i) {
            BodyState<Real>& s = states_[i];
            BodyPush<Real>& p = pushes_[i];
            p.beforeX = s.velocityX, p.beforeY = s.velocityY, p.beforeW = s.spin, p.invMass = s.invMass;
            if (moves(s)) s.velocityX = s.velocityY = s.spin = 0;
        }
    };
    const auto goOn = [&] {
        for (Index i = first; i < first + count; ++i) {
            BodyState<Real>& s = states_[i];
            BodyPush<Real>& p = pushes_[i];
            if (moves(s)) {
                p.warmX = s.velocityX, p.warmY = s.velocityY, p.warmW = s.spin;
            } else {
                p.warmX = p.warmY = p.warmW = 0;
            }
            s.velocityX = p.beforeX, s.velocityY = p.beforeY, s.spin = p.beforeW;
        }
    };
    switch (pass.kind) {
    case Pass::Kind::Warm: return halt();
    case Pass::Kind::Push:
        if (pass.first) goOn();
        return kernels_->integrateVelocities(&states_[first], &pushes_[first], count, constants_);
    case Pass::Kind::Relax: return kernels_->integratePositions(&states_[first], count, constants_.h);
    }
}

template <class Real>
void Solver<Real>::moveBodies(const Pass& pass, Node node)
{
    const auto [first, last] = domains_.slotsOf(node);
    if (pass.moves && first < last) moveBodies(pass, first, last - first);
}

template <class Real>
void Solver<Real>::pass(const Pass& pass, Node node)
{
    if (domains_.isLeaf(node)) askForShared(node), moveBodies(pass, node);
    switch (pass.kind) {
    case Pass::Kind::Warm: return warmNode(node);
    case Pass::Kind::Push: return pushNode(node);
    case Pass::Kind::Relax: return relaxNode(node, pass);
    }
}

template <class Real>
void Solver<Real>::run()
{
    const int count = 1 + shape_.substeps * (passes_ + relaxPasses());
    const auto passes = static_cast<std::size_t>(count);
    // What is driven through bodies of all domains belongs to none of them, and moves before they do.
    const auto moveCommon = [&](std::size_t round) {
        if (domains_.depth() > 0 && round < passes) moveBodies(passAt(round), Domains::kRoot);
    };
    moveCommon(0);
    eachNode(passes, [&](std::size_t round, Node node) {
        pass(passAt(round), node);
        if (node == Domains::kRoot) moveCommon(round + 1);
    });
    bounce();
}

template <class Real>
void Solver<Real>::warm()
{
    eachNode([&](Node node) { warmNode(node); });
}
template <class Real>
void Solver<Real>::push()
{
    eachNode(static_cast<std::size_t>(passes_), [&](std::size_t, Node node) { pushNode(node); });
}
template <class Real>
void Solver<Real>::relax()
{
    const int passes = relaxPasses();
    eachNode(static_cast<std::size_t>(passes), [&](std::size_t round, Node node) {
        const int again = static_cast<int>(round);
        relaxNode(node, {Pass::Kind::Relax, again, false, fresh_, again + 1 == passes});
    });
    fresh_ = false;
}

template <class Real>
void Solver<Real>::bounce()
{
    if (!bounces_) return;
    const auto passes = static_cast<std::size_t>(kBouncePasses * std::min(passes_, 4));
    eachNode(passes, [&](std::size_t, Node node) {
        eachColour(node, [&](Colour& c) {
            kernels_->bounceContacts(states_.data(), c.contacts.data(), c.frictions.data(), c.bounces.data(),
                                     c.contacts.size(), constants_);
        });
    });
}

template <class Real>
void Solver<Real>::turn(Nodes& nodes, const std::function<void()>& beside) const
{
    const std::vector<double>& angles = nodes.angle.values();
    std::vector<Vec2>& directions = nodes.rotation.values();
    const auto turnBlock = [&](std::size_t block) {
        const std::size_t first = block * kNodesABlock, last = std::min(angles.size(), first + kNodesABlock);
        if (kernels_->turnBodies(&angles[first], directions[first].data(), last - first)) return;
        for (std::size_t i = first; i < last; ++i) directions[i] = direction(angles[i]);
    };
    pool_->beside((angles.size() + kNodesABlock - 1) / kNodesABlock, turnBlock, beside);
}

template <class Real>
void Solver<Real>::finish(Collider& collider, std::vector<Joint>& joints)
{
    collider.settled();
    eachNode([&](Node node) {
        std::vector<TouchChange>& changes = settling_[node].changes;
        changes.clear();
        calmJoints(node);
        eachColour(node, [&](Colour& c) {
            kernels_->carryContacts(c.contacts.data(), c.frictions.data(), c.touches.data(), c.contacts.size());
            for (std::size_t group = 0; group < c.touches.size(); ++group)
                if (c.touches[group] != c.touched[group]) noteFlip(collider, c, group, changes);
        });
    });
    noteChanges();
    keepRows(joints);
}

/// Those of all nodes.
template <class Real>
void Solver<Real>::noteChanges()
{
    for (std::size_t node = 1; node < 2 * domains_.leaves(); ++node)
        changes_.insert(changes_.end(), settling_[node].changes.begin(), settling_[node].changes.end());
}

/// Contacts of a group that began or ceased to touch.
template <class Real>
void Solver<Real>::noteFlip(Collider& collider, Colour& colour, std::size_t group, std::vector<TouchChange>& changes)
{
    std::uint32_t& touched = colour.touched[group];
    const std::uint32_t touches = colour.touches[group];
    for (std::uint32_t rest = touches ^ touched; rest != 0; rest &= rest - 1) {
        const std::size_t at = group * kWidth + static_cast<std::size_t>(__builtin_ctz(rest));
        RigidContact& c = collider.contacts()[colour.index[at]];
        fetch(c, collider.places()[colour.index[at]]);
        change(c, (touches >> (at % kWidth) & 1U) != 0, changes);
    }
    touched = touches;
}

template <class Real>
std::size_t Solver<Real>::colours() const
{
    std::size_t used = 0;
    for (std::size_t i = 0; i < colours_.size(); ++i)
        if (colours_[i].count > 0) used = std::max(used, i % kColours + 1);
    return used;
}

template <class Real>
std::size_t Solver<Real>::bytes() const
{
    std::size_t sum = taken_.bytes() + takenByJoints_.bytes();
    for (const Colour& c : colours_)
        sum += c.contacts.capacity() * (sizeof(ContactLanes<Real>) + sizeof(FrictionLanes<Real>)) +
               c.bounces.capacity() * sizeof(BounceLanes<Real>) + c.index.capacity() * sizeof(Index);
    for (const JointColour& c : jointColours_)
        sum += c.joints.capacity() * sizeof(JointLanes<Real>) + c.anchors.capacity() * sizeof(AnchorLanes<Real>) +
               c.index.capacity() * sizeof(Index);
    for (const auto& rows : rows_) sum += rows.capacity() * sizeof(JointRow<Real>);
    return sum + domains_.bytes();
}

template class Solver<float>;
template class Solver<double>;

}  // namespace jet::physics
