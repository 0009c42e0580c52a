#include "stage.hpp"

#include "room.hpp"
#include "speed_limit.hpp"
#include "validation.hpp"

#include <chrono>
#include <tuple>

namespace jet::physics {

namespace {

constexpr std::size_t kSmallWorld = 512;  // bodies: worlds up to here are solved in double precision
constexpr double kSmallWorldRate = 480;   // substeps a second of small worlds
constexpr int kLargeSubsteps = 4;
// Units / s²: far beyond what speed_limit.hpp leaves of it, and its square still a number in single precision.
constexpr double kMostAcceleration = 1e15;
constexpr float kHitSmall = 0.08F,
                kHitLarge = 0.6F;  // lengths a substep that make a hit
constexpr int kHitPasses = 12;
constexpr int kHitRounds = 3;

/// Passes over all constraints of a substep of h.
int passesFor(float hardestHit, bool large, double h)
{
    return hardestHit * static_cast<float>(h) > (large ? kHitLarge : kHitSmall) ? kHitPasses : 1;
}

/// Has the body moved by a quarter of its length, or more?
bool isFar(const Vec2& move, const RigidBody& body)
{
    return !(move.squaredNorm() <= 0.0625 * static_cast<double>(body.length) * static_cast<double>(body.length));
}

double millisecondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

namespace {

DrawnAs drawnAs(const BodyCommon& common)
{
    if (common.sensor) return DrawnAs::Region;
    return common.fixed ? DrawnAs::Walls : DrawnAs::Solid;
}

}  // namespace

std::vector<DrawnPart> RigidStage::partsOf(const RigidBodyDef& def, const Drawing& drawing, const Vec2& centre,
                                           double length)
{
    std::vector<DrawnPart> parts;
    if (!def.borders.empty()) parts = drawnParts(drawing, centre, length);
    for (const ShapeDef& shape : def.shapes) {
        if (shape.kind == ShapeDef::Kind::Chain) {
            for (DrawnPart& part : chainParts(shape.points, centre, length)) parts.push_back(std::move(part));
            continue;
        }
        std::vector<Vec2> corners = shape.points;
        for (Vec2& at : corners) at -= centre;
        parts.emplace_back().part = makePart(corners.data(), static_cast<int>(corners.size()),
                                             shape.kind == ShapeDef::Kind::Polygon ? 0 : shape.radius);
    }
    return parts;
}

Drawing RigidStage::takeApart(const RigidBodyDef& def)
{
    return def.borders.empty() ? Drawing() : physics::takeApart(def.borders, drawnAs(def.common));
}

void RigidStage::add(const State& state, Index handle, const RigidBodyDef& def, const std::vector<DrawnPart>& parts,
                     double gyration)
{
    RigidBody body;
    body.node = state.bodies[handle].nodes.first, body.handle = handle;
    body.moves = !def.common.fixed && !def.common.kinematic;
    body.kinematic = def.common.kinematic && !def.common.fixed, body.sensor = def.common.sensor;
    body.mayRest = def.common.allowSleep;
    body.gyration = gyration;
    if (has(handle)) {
        --removed_;
        return replace(bodyOf(handle), body, Rules(def.common), parts);
    }
    const Index index = collider_.addBody(body, Rules(def.common));
    keepBodyOf(handle, index);
    movers_ += body.moves;
    if (body.kinematic) kinematic_.push_back(index);
    for (const DrawnPart& part : parts) collider_.addPart(part.part, part.outlined ? &part.outline : nullptr);
}

void RigidStage::keepBodyOf(Index handle, Index body)
{
    if (bodyOf_.empty() && handle == ownHandles_ && body == handle + 1) {
        ++ownHandles_;
        return;
    }
    const std::size_t count = handle - ownHandles_ + std::size_t{1};
    if (bodyOf_.size() < count) makeRoom(count - bodyOf_.size(), bodyOf_), bodyOf_.resize(count, 0);
    bodyOf_[handle - ownHandles_] = body;
}

Index RigidStage::addJoint(const State& state, const JointDef& def, Index place)
{
    Joint joint;
    joint.def = def;
    const auto attach = [&](const Anchor& anchor, Index& body, Vec2& local) {
        local = anchor.point;
        if (anchor.body == kNoHandle) return 0.0;
        body = bodyOf(anchor.body);
        const Index node = collider_.bodies()[body].node;
        local = unrotated(state.nodes.rotation[node], anchor.point - state.nodes.position[node]);
        return state.nodes.angle[node];
    };
    const double angleA = attach(def.a, joint.a, joint.localA), angleB = attach(def.b, joint.b, joint.localB);
    joint.restAngle = angleB - angleA;
    const double axisLength = def.axis.norm();
    const Vec2 axis = axisLength > 0 ? Vec2(def.axis / axisLength) : Vec2(1, 0);
    joint.localAxis = joint.a == 0 ? axis : unrotated(state.nodes.rotation[collider_.bodies()[joint.a].node], axis);
    joint.length = def.length;
    if (def.kind == JointDef::Kind::Pulley) {
        joint.length = pulleyLength(def, def.a.point, def.b.point);
    } else if (def.length < 0) {
        joint.length = (def.b.point - def.a.point).norm();
    }
    if (place == kNone) {
        place = static_cast<Index>(joints_.size());
        joints_.push_back(joint);
    } else {
        // The solver's impulses are those of who was there.
        single_.releaseJoints(joints_), double_.releaseJoints(joints_);
        nets_.forget(place);
        joints_[place] = joint;
    }
    ++jointsVersion_;
    if (joint.keepsApart()) decideMeeting(joint);
    return place;
}

void RigidStage::setJoint(const State& state, Index index, const JointDef& wanted)
{
    Joint& joint = joints_[index];
    ++jointsVersion_;
    const JointDef old = joint.def;
    joint.def = liveDef(wanted, old);
    if (wanted.length >= 0 && old.kind != JointDef::Kind::Pulley) joint.length = wanted.length;
    if (wanted.ratio != old.ratio && old.kind == JointDef::Kind::Pulley) {
        const JointFrame frame = frameOf(joint, state, collider_.bodies());
        joint.length = pulleyLength(joint.def, frame.pointA, frame.pointB);
    }
    const double length = wanted.axis.norm();
    if (length > 0 && wanted.axis != old.axis) {
        const Vec2 axis = wanted.axis / length;
        joint.localAxis = joint.a == 0 ? axis : unrotated(state.nodes.rotation[collider_.bodies()[joint.a].node], axis);
    }
    decideMeeting(joint);
}

void RigidStage::removeJoint(Index index)
{
    Joint& joint = joints_[index];
    ++jointsVersion_;
    joint.removed = true;
    decideMeeting(joint);
}

/// Only one of the solvers has the contacts; they change hands with their impulses.
void RigidStage::activate(bool singles)
{
    const Active wanted = singles ? Active::Single : Active::Double;
    if (active_ == wanted) return;
    if (active_ == Active::Single) single_.release(collider_), single_.releaseJoints(joints_);
    if (active_ == Active::Double) double_.release(collider_), double_.releaseJoints(joints_);
    active_ = wanted;
}

/// What touches a sleeping group wakes it within the step.
template <class Real>
void RigidStage::refresh(Solver<Real>& solver, State& state, const WorldSettings& settings, double dt)
{
    for (;;) {
        if (woke_) collider_.releaseAwake();
        woke_ = false;
        solver.refresh(collider_, dt, settings.resolveCollisions);
        if (collider_.roused().empty()) return;
        for (const Index body : collider_.roused()) wakeGroup(state, group_[body]);
        collider_.roused().clear();
        if (alsoWake_) alsoWake_();
        collider_.settleDrifts();
    }
}

template <class Real>
void RigidStage::look(Solver<Real>& solver, State& state, const WorldSettings& settings, double dt, StepStats& stats)
{
    if (!settings.findCollisions) {
        forgetPairs();
        return;
    }
    if (resolving_ != settings.resolveCollisions) solver.release(collider_);
    resolving_ = settings.resolveCollisions;
    collider_.find(state, settings, dt, stats, pool_, arena_, solver.domains());
    const auto start = std::chrono::steady_clock::now();
    refresh(solver, state, settings, dt);
    for (int round = 0;
         round < kHitRounds && solver.foresees() && collider_.expectHits(state, settings, dt, pool_, arena_); ++round)
        refresh(solver, state, settings, dt);
    collider_.endLooks(arena_);
    stats.narrowPhaseMs += millisecondsSince(start);
}

StepShape RigidStage::shapeOf(const WorldSettings& settings, double dt, bool large) const
{
    StepShape shape;
    shape.substeps = settings.substeps > 0 ? settings.substeps
                     : large               ? kLargeSubsteps
                             : std::clamp(static_cast<int>(std::ceil(dt * kSmallWorldRate - 1e-9)), 1, 4096);
    shape.h = dt / shape.substeps;
    shape.restSpeed = 4 * (settings.applyGravity ? settings.gravity.norm() : 0) * shape.h;
    shape.choice = choiceOf(settings);
    shape.linearKept = settings.applyDamping ? decay(settings.linearDamping * shape.h) : 1;
    shape.angularKept = settings.applyDamping ? decay(settings.angularDamping * shape.h) : 1;
    return shape;
}

template <class Real>
void RigidStage::load(Solver<Real>& solver, const State& state)
{
    const Nodes& nodes = state.nodes;
    Flag astray;
    const auto take = [&](Index i, BodyState<Real>& s) {
        const RigidBody& body = collider_.bodies()[i];
        const Index node = body.node;
        s.velocityX = static_cast<Real>(nodes.velocity[node].x()),
        s.velocityY = static_cast<Real>(nodes.velocity[node].y());
        s.spin = static_cast<Real>(nodes.omega[node] * body.gyration);
        s.invMass = static_cast<Real>(nodes.invMass[node]);
        const bool turns = nodes.invMass[node] == 0 || nodes.invInertia[node] > 0;
        s.perGyration = turns ? 1 / static_cast<Real>(body.gyration) : 0;
        s.moveX = s.moveY = s.sweep = 0;
        if (!body.moves && solver.isAstray(i)) astray.raise();
    };
    solver.divide(collider_, state, joints_, false);
    solver.setBodies(take);
    if (!astray) return;
    solver.divide(collider_, state, joints_, true);
    solver.setBodies(take);
}

template <class Real>
void RigidStage::startJoints(Solver<Real>& solver, const State& state)
{
    solver.layOutJoints(joints_, collider_.bodies(), jointsVersion_);
    solver.startJoints(joints_, state, collider_.bodies());
}

void RigidStage::tellJoints()
{
    if (active_ == Active::Single) single_.tellJoints(joints_);
    if (active_ == Active::Double) double_.tellJoints(joints_);
}

void RigidStage::step(State& state, const WorldSettings& settings, double dt, StepStats& stats)
{
    const bool large =
        settings.precision == Precision::Automatic ? count() > kSmallWorld : settings.precision == Precision::Single;
    activate(large);
    if (large) {
        solve(single_, state, settings, dt, stats);
    } else {
        solve(double_, state, settings, dt, stats);
    }
    breakJoints();
}

template <class Real>
void RigidStage::solve(Solver<Real>& solver, State& state, const WorldSettings& settings, double dt, StepStats& stats)
{
    const bool large = count() > kSmallWorld;
    const StepShape shape = shapeOf(settings, dt, large);
    pool_.setThreads(settings.threads);
    const Pool::Attention attention(pool_);
    arena_.reset();
    solver.begin(collider_.bodies().size(), shape, pool_, arena_);
    substeps_ = shape.substeps;
    stats.substeps += static_cast<std::uint32_t>(shape.substeps);
    drowsy_ = false;
    scaleSleeping(shape.h);
    load(solver, state);
    look(solver, state, settings, dt, stats);
    const auto start = std::chrono::steady_clock::now();
    const Nodes& nodes = state.nodes;
    solver.pushBodies([&](Index i, BodyPush<Real>& force) {
        const RigidBody& body = collider_.bodies()[i];
        force = BodyPush<Real>();
        if (!body.moves || body.asleep) return;
        const double scale = settings.applyGravity ? state.bodies[body.handle].gravityScale : 0;
        Vec2 pull = scale * settings.gravity + nodes.invMass[body.node] * nodes.force[body.node];
        if (!(pull.squaredNorm() <= kMostAcceleration * kMostAcceleration)) pull *= kMostAcceleration / pull.norm();
        force.accelerationX = static_cast<Real>(pull.x()), force.accelerationY = static_cast<Real>(pull.y());
        force.accelerationW =
            static_cast<Real>(std::clamp(body.gyration * nodes.invInertia[body.node] * nodes.torque[body.node],
                                         -kMostAcceleration, kMostAcceleration));
    });
    startJoints(solver, state);
    solver.prepare(passesFor(solver.hardestHit(), large, shape.h));
    solver.run();
    solver.finish(collider_, joints_);
    restrain(solver, state, dt);
    advance(solver, state, dt);
    stats.colours = static_cast<std::uint32_t>(solver.colours());
    stats.solverMs += millisecondsSince(start);
}

/// While the nodes are as they were at the start of the step.
template <class Real>
void RigidStage::restrain(Solver<Real>& solver, const State& state, double dt)
{
    if (joints_.empty() || !nets_.due(joints_.size(), solver.strained(), dt)) return;
    const auto& bodies = collider_.bodies();
    const Nodes& nodes = state.nodes;
    budgets_.resize(bodies.size());
    solver.eachBody([&](Index i, const BodyState<Real>& s) {
        Nets::Budget& budget = budgets_[i] = {};
        budget.place = nodes.position[bodies[i].node] + Vec2(s.moveX, s.moveY);
        if (s.invMass == 0 || !bodies[i].takesPart()) return;
        const BodyPush<Real>& force = solver.pushOf(i);
        const double k = bodies[i].gyration, mass = 1 / static_cast<double>(s.invMass);
        const Vec2 before = nodes.velocity[bodies[i].node], after(s.velocityX, s.velocityY);
        const double spun = k * nodes.omega[bodies[i].node], spins = static_cast<double>(s.spin);
        const Vec2 acceleration(force.accelerationX, force.accelerationY);
        const double power =
            acceleration.dot(before + after) + static_cast<double>(force.accelerationW) * (spun + spins);
        budget.energy = mass / 2 * (before.squaredNorm() + spun * spun + dt * power);
        budget.jolt =
            mass / 2 * dt * dt * (acceleration.squaredNorm() + std::pow(static_cast<double>(force.accelerationW), 2));
    });
    nets_.restrain(Nets::Step<Real>{solver, collider_, joints_, budgets_, jointsVersion_, pool_});
}

/// Moves the nodes, but nothing fast through what was not foreseen.
template <class Real>
void RigidStage::advance(Solver<Real>& solver, State& state, double dt)
{
    Nodes& nodes = state.nodes;
    const std::size_t mark = arena_.mark();
    const std::span<Vec2> moves = arena_.take<Vec2>(collider_.bodies().size());
    const std::span<double> turns = arena_.take<double>(collider_.bodies().size());
    moves[0] = Vec2(0, 0), turns[0] = 0;  // the background
    Flag fast;
    solver.eachBody([&](Index i, const BodyState<Real>& s) {
        const RigidBody& body = collider_.bodies()[i];
        Vec2 move(static_cast<double>(s.moveX), static_cast<double>(s.moveY));
        double turn = static_cast<double>(s.sweep) / body.gyration;
        if (body.moves && isFar(move, body)) fast.raise();
        limitMove(move, turn, dt);
        moves[i] = move, turns[i] = turn;
    });
    const auto tell = [&] { noteTouches(solver.changes()); };
    if (fast) collider_.stopTunnelling(allowed_, moves, turns, dt, pool_, arena_, tell);
    solver.eachBody([&](Index i, const BodyState<Real>& s) {
        const RigidBody& body = collider_.bodies()[i];
        if ((!body.moves && !body.kinematic) || body.asleep) return;
        const double part = fast ? static_cast<double>(allowed_[i]) : 1;
        nodes.velocity[body.node] = {static_cast<double>(s.velocityX), static_cast<double>(s.velocityY)};
        nodes.omega.edit(body.node) = static_cast<double>(s.spin) / body.gyration;
        limitSpeed(nodes.velocity[body.node], nodes.omega.edit(body.node));
        nodes.position[body.node] += part * moves[i];
        const double turn = part * turns[i];
        collider_.travelled(i, part * moves[i].norm() + std::abs(turn) * static_cast<double>(body.reach));
        nodes.angle.edit(body.node) += turn;
    });
    arena_.release(mark);
    solver.turn(nodes, fast ? std::function<void()>([] {}) : tell);
}

void RigidStage::begin(State& state, const WorldSettings& settings, double h, double dt, StepStats& stats)
{
    activate(false);
    StepShape shape = shapeOf(settings, dt, false);
    shape.h = h;
    substeps_ = static_cast<double>(std::lround(dt / h));
    shape.restSpeed = 4 * (settings.applyGravity ? settings.gravity.norm() : 0) * h;
    pool_.setThreads(settings.threads);
    drowsy_ = false;
    scaleSleeping(h);
    arena_.reset();
    double_.begin(collider_.bodies().size(), shape, pool_, arena_);
    load(double_, state);
    start_.resize(collider_.bodies().size()), startAngle_.resize(collider_.bodies().size());
    budgets_.assign(collider_.bodies().size(), {});
    for (Index i = 1; i < collider_.bodies().size(); ++i) {
        start_[i] = state.nodes.position[collider_.bodies()[i].node];
        startAngle_[i] = state.nodes.angle[collider_.bodies()[i].node];
        budgets_[i].energy = kineticEnergy(double_.body(i));
    }
    look(double_, state, settings, dt, stats);
    double_.pushBodies([](Index, BodyPush<double>& push) { push = BodyPush<double>(); });
    startJoints(double_, state);
    double_.prepare(passesFor(double_.hardestHit(), false, h));
}

/// Between the nodes, which other stages move too, and the solver's states.
void RigidStage::exchange(State& state, bool store)
{
    Nodes& nodes = state.nodes;
    for (Index i = 1; i < collider_.bodies().size(); ++i) {
        const Index node = collider_.bodies()[i].node;
        const double gyration = collider_.bodies()[i].gyration;
        BodyState<double>& s = double_.body(i);
        if (store) {
            if (s.invMass == 0) continue;
            nodes.velocity[node] = {s.velocityX, s.velocityY}, nodes.omega.edit(node) = s.spin / gyration;
            limitSpeed(nodes.velocity[node], nodes.omega.edit(node));
            continue;
        }
        const double had = kineticEnergy(s), spun = s.spin;
        const Vec2 was(s.velocityX, s.velocityY);
        s.velocityX = nodes.velocity[node].x(), s.velocityY = nodes.velocity[node].y();
        s.spin = nodes.omega[node] * gyration;
        // By others.
        budgets_[i].energy += kineticEnergy(s) - had;
        if (s.invMass > 0) {
            const double change = (Vec2(s.velocityX, s.velocityY) - was).squaredNorm() + std::pow(s.spin - spun, 2);
            budgets_[i].jolt += substeps_ / 2 * change / s.invMass;
        }
        const Vec2 move = nodes.position[node] - start_[i];
        s.moveX = move.x(), s.moveY = move.y(), s.sweep = (nodes.angle[node] - startAngle_[i]) * gyration;
    }
}

void RigidStage::push(State& state, const std::function<void()>& midst)
{
    exchange(state, false);
    double_.warm();
    if (midst) {
        exchange(state, true);
        midst();
        exchange(state, false);
    }
    double_.push();
    exchange(state, true);
}

void RigidStage::relax(State& state)
{
    exchange(state, false);
    double_.relax();
    exchange(state, true);
}

void RigidStage::finish(State& state, bool bounce)
{
    exchange(state, false);
    if (bounce) double_.bounce();
    double_.finish(collider_, joints_);
    if (!joints_.empty() && nets_.due(joints_.size(), double_.strained(), substeps_ * double_.shape().h)) {
        for (Index i = 1; i < collider_.bodies().size(); ++i)
            budgets_[i].place = state.nodes.position[collider_.bodies()[i].node];
        nets_.restrain(Nets::Step<double>{double_, collider_, joints_, budgets_, jointsVersion_, pool_});
    }
    exchange(state, true);
    for (Index i = 1; i < collider_.bodies().size(); ++i) {
        const RigidBody& body = collider_.bodies()[i];
        const double turn = state.nodes.angle[body.node] - startAngle_[i];
        collider_.travelled(i, (state.nodes.position[body.node] - start_[i]).norm() +
                                   std::abs(turn) * static_cast<double>(body.reach));
    }
    noteTouches(double_.changes());
    breakJoints();
}

void RigidStage::breakJoints()
{
    const auto mayBreak = [](const Joint& joint) { return joint.lives() && joint.def.breakForce > 0; };
    if (brittleVersion_ != jointsVersion_) {
        brittleVersion_ = jointsVersion_;
        brittle_ = std::any_of(joints_.begin(), joints_.end(), mayBreak);
    }
    if (!brittle_) return;
    tellJoints();
    for (Joint& joint : joints_)
        if (mayBreak(joint) && joint.state.force.norm() > joint.def.breakForce) {
            joint.broken = true;
            ++jointsVersion_;
            decideMeeting(joint);
        }
}

void RigidStage::disturb(Index handle)
{
    if (has(handle)) collider_.disturb(bodyOf(handle));
}

void RigidStage::report(std::vector<Contact>& reports, std::vector<std::uint64_t>& touching) const
{
    const auto& places = collider_.places();
    for (Index i = 0; i < places.size(); ++i) {
        if (places[i] == kFree || !collider_.contacts()[i].touching) continue;
        RigidContact c = collider_.contacts()[i];
        double totals[2];
        const auto fetch = [&](const auto& solver) {
            solver.fetch(c, places[i]);
            for (int k = 0; k < 2; ++k) totals[k] = static_cast<double>(solver.total(places[i], k));
        };
        // Of what sleeps, or is not pushed, each substep is like the last.
        for (int k = 0; k < 2; ++k) totals[k] = substeps_ * static_cast<double>(c.impulse[k]);
        if (isPlaced(places[i]) && active_ == Active::Single) fetch(single_);
        if (isPlaced(places[i]) && active_ == Active::Double) fetch(double_);
        const Index a = collider_.bodies()[c.bodyA].handle, b = collider_.bodies()[c.bodyB].handle;
        const Pose& pose = collider_.poses()[c.bodyA];
        const Vec2f normal = turned(pose.turn, c.normal);
        for (int k = 0; k < std::min<int>(c.count, 2); ++k) {
            if (c.resolve && !(totals[k] > 0) && c.separation[k] > c.slop) continue;  // only near
            const Vec2f on = turned(pose.turn, c.onA[k]);
            Contact contact;
            contact.bodyA = b, contact.bodyB = a;
            contact.point = Vec2(pose.x + on.x, pose.y + on.y);
            contact.normal = Vec2(normal.x, normal.y);
            contact.penetration = -static_cast<double>(c.separation[k]);
            contact.impulse = totals[k];
            reports.push_back(contact);
        }
        touching.push_back((static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b));
    }
}

std::size_t RigidStage::bytes() const
{
    return roomOf(bodyOf_, watches_, group_) + arena_.bytes() + collider_.bytes() + single_.bytes() + double_.bytes() +
           joints_.capacity() * sizeof(Joint) + touches_.bytes();
}

}  // namespace jet::physics
