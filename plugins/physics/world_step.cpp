// A step: forces, then substeps of (velocities, springs, contacts, positions), then what the step shows.
#include "contact_solver.hpp"
#include "integrator.hpp"
#include "soft/enclosed_area.hpp"
#include "validation.hpp"
#include "world.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace jet::physics {

namespace {

// Contacts are sought for the whole of a step: a long one is taken in parts of so many seconds.
constexpr double kLongestPart = 0.05, kLongestStep = 500;

class Stopwatch {
public:
    explicit Stopwatch(double& milliseconds) : milliseconds_(milliseconds) {}
    ~Stopwatch()
    {
        milliseconds_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    double& milliseconds_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Particles of a body from which on it is divided between threads.
constexpr std::size_t kLeastShared = 8192;

/// Lends the state the threads for a step, where there is a body large enough.
class Sharing {
public:
    Sharing(State& state, Pool& pool, int threads) : state_(state)
    {
        const auto large = [](const BodyRecord& body) { return body.nodes.count >= kLeastShared; };
        if (threads <= 1 || std::none_of(state.bodies.begin(), state.bodies.end(), large)) return;
        pool.setThreads(threads);
        attention_.emplace(pool);
        state.pool = &pool;
    }
    ~Sharing() { state_.pool = nullptr; }
    Sharing(const Sharing&) = delete;
    Sharing& operator=(const Sharing&) = delete;

private:
    State& state_;
    std::optional<Pool::Attention> attention_;
};

}  // namespace

void World::step(double dt)
{
    checks().above("the step", "its time", dt, 0);
    checks().within("the step", "its time", dt, 0, kLongestStep);
    if (!std::exchange(settled_, true)) fitRoom(state_), rigid_.fitRoom(), rigid_.arena().clear(), outlines_.forget();
    if (reports_.watched()) reportIfAsked();
    reports_.remember(state_, complex_ > 0);
    slots_.release();
    heedMaterials();
    if (skipStep()) return;
    outlines_.forget();
    stats_ = StepStats();
    islandsKnown_ = false;
    queries_.outdate();
    const int parts = static_cast<int>(std::ceil(dt / kLongestPart - 1e-9));
    const std::vector<Vec2> forces = parts > 1 ? stepForces_.values() : std::vector<Vec2>();
    const bool pushed = pushed_;
    for (int i = 0; i < parts; ++i) {
        if (i > 0) stepForces_.values() = forces, pushed_ = pushed;
        stepPart(dt / parts);
    }
}

void World::stepPart(double dt)
{
    reports_.ended().clear();
    reports_.setDue(false);
    if (onlySimple()) return stepSimple(dt);
    const Sharing sharing(state_, rigid_.pool(), settings_.threads);
    refresh();
    slumber_.drowsy() = false;
    noteStanding();
    wholes_.gather(state_);
    prepareStiffness();
    const bool plain = settings_.method == Method::SemiImplicitEuler;
    const int least = plain ? 1 : substepsFor(dt, rate_, state_.nodes.size() - slots_.nodes());
    const int count = plain ? 1 : calmed(least, dt, wideSwings_);
    stats_.substeps += static_cast<std::uint32_t>(count);
    const double h = dt / count;
    if (h != preparedFor_ || plain != plain_ || dt / least != bounds_.longest()) {
        plain_ = plain;
        bounds_.judgeAt(dt / least);
        soft::Twins::prepare(state_, h);
        springs_.prepare(state_, bounds_, h, plain);
        actuators_.prepare(bounds_, h, plain);
        preparedFor_ = h;
    }
    if (h != impulsesOf_) {
        // Warm-start impulses are per substep: scaled, they stand for the same force.
        const double ratio = impulsesOf_ > 0 ? h / impulsesOf_ : 1;
        for (ContactPoint& c : contacts_.points) c.normalImpulse *= ratio, c.tangentImpulse *= ratio;
        softContacts_.scale(ratio);
        softJoints_.scale(ratio);
        actuators_.scale(ratio);
        impulsesOf_ = h;
    }

    double soughtAt = 0;
    for (int i = 0; i < count; ++i) {
        const double now = i * h;
        if (!settings_.findCollisions) {
            finder_.clear();
            contacts_.points.clear();
            contacts_.begin(state_);
            softContacts_.clear();
        } else if (i == 0 || finder_.strayed(state_, now - soughtAt)) {
            if (i == 0) {
                finder_.seek(state_, settings_, dt, true, stats_);
                spreadWaking(false);
                rigid_.begin(state_, settings_, h, dt, stats_);
                finder_.find(state_, settings_, dt, contacts_.points, stats_);
                for (ContactPoint& c : contacts_.points) c.stepImpulse = 0;
            } else {
                softContacts_.travel(state_, finder_.positions());
                finder_.seek(state_, settings_, dt - now, false, stats_);
                spreadWaking(true);
                finder_.find(state_, settings_, dt - now, contacts_.points, stats_);
                finder_.collectEnded(contacts_.points, reports_.ended());
            }
            contacts_.begin(state_);
            softContacts_.find(state_, settings_, finder_.motions(), finder_.softPairs(), dt - now, i == 0);
            soughtAt = now;
        }
        if (i == 0 && !settings_.findCollisions) rigid_.begin(state_, settings_, h, dt, stats_);
        if (i == 0) {
            slumber_.stirred().clear();
            const Stopwatch watch(stats_.springsMs);
            flyFree(h, count);
        }
        if (!plain && i % soft::Accounts::kSubsteps == 0) {
            accounts_.close(accounted(h), soft::Accounts::kSubsteps);
            accounts_.open(accounted(h));
        }
        substep(h, i, count);
        if (i == 2 * count / 5) slumber_.watchWithin(state_);
        if (i + 1 < count) continue;
        accounts_.close(accounted(h), i % soft::Accounts::kSubsteps + 1);
        rigid_.finish(state_, true);
    }
    if (pushed_) std::fill(stepForces_.values().begin(), stepForces_.values().end(), Vec2(0, 0));
    pushed_ = false;
    for (BodyRecord& body : state_.bodies) body.flown = false;
    if (softJoints_.finish(state_, dt)) finder_.exclude(softJoints_.excluded());
    restIfDue(dt);
    springs_.flow(state_, dt, h);
    if (settings_.findCollisions) softContacts_.travel(state_, finder_.positions());
    updatePoints(state_);
    if (!outlines_.lean()) updateReadings(state_);
    reports_.setDue(true);
    cutTorn();
}

void World::noteStanding()
{
    for (BodyRecord& body : state_.bodies) body.stands = body.fixed || (body.kinematic && !state_.isDriven(body));
}

/// What depends on which springs there are, worked out again only after something was added.
void World::prepareStiffness()
{
    if (rate_ >= 0) return;
    softContacts_.outdate();
    bounds_.reset(state_.nodes.size());
    springs_.addTo(bounds_, state_, !actuators_.anySpring());
    actuators_.addTo(bounds_, state_);
    rate_ = 0;
    wideSwings_.clear();
    for (Index handle = 0; handle < state_.bodies.size(); ++handle) {
        const BodyRecord& body = state_.bodies[handle];
        const double stable = springs_.stableRate(bounds_, body, handle);
        rate_ = std::max(rate_, soft::Twins::rate(body, std::max(stable, springs_.swingRate(bounds_, body, handle))));
        const WideSwing wide = springs_.wideSwing(bounds_, body, handle);
        if (wide.calm > kHighestRate) wideSwings_.push_back(wide);
    }
    preparedFor_ = 0;
}

soft::Accounts::Scene World::accounted(double h)
{
    const Vec2 gravity = settings_.applyGravity ? settings_.gravity : Vec2(0, 0);
    return {state_, softJoints_, actuators_, springs_, shapes_, twins_, gravity, h};
}

void World::substep(double h, int index, int count)
{
    const double gravity = settings_.applyGravity ? settings_.gravity.norm() : 0;
    softContacts_.refresh(state_, h, gravity);
    const bool accounts = !plain_ && accounts_.any(), backwards = index % 2 == 1;
    const bool brakes = !plain_ && actuators_.anySpring();
    const auto brake = [&](bool back, bool warm) {
        if (accounts) accounts_.begin(state_);
        if (warm) softJoints_.warm(state_, h);
        actuators_.brake(state_, h, back);
        if (accounts) accounts_.end(state_);
    };
    {
        const Stopwatch watch(stats_.springsMs);
        if (accounts) accounts_.begin(state_);
        // Before the forces: its damping must not take from what they give, or what bears a load would yield more.
        twins_.apply(state_, springs_, h);
        const bool pushed = anyForces();
        if (pushed || springs_.anyOneByOne()) state_.nodes.coverForces();
        for (Index n = 0; pushed_ && n < stepForces_.size(); ++n) state_.nodes.force.add(n, stepForces_[n]);
        actuators_.addForces(state_);
        if (fields_.any())
            fields_.addForces(state_, rigid_, settings_.applyGravity ? settings_.gravity : Vec2(0, 0), h);
        if (accounts && pushed) accounts_.force(accounted(h));
        springs_.addForces(state_);
        if (plain_) springs_.addAngularForces(state_), actuators_.addSpringForces(state_);
        integrateVelocities(state_, settings_, springs_, h, pushed);
        if (!plain_) springs_.applyAngular(state_, h, backwards);
        soft::applyPressure(state_, h);
        const std::span<const double> offs = settings_.findCollisions ? finder_.offs() : std::span<const double>();
        if (index == 0 && !plain_ && offs.empty()) shapes_.look(state_, count * h);
        if (!plain_) shapes_.apply(state_, springs_, h, offs);
        if (!plain_) actuators_.applySprings(state_, h, backwards);
        if (accounts) accounts_.end(state_);
        if (plain_) refuseExplosion();
    }
    const Stopwatch watch(stats_.solverMs);
    wholes_.keep(state_);
    rigid_.push(state_, brakes ? std::function<void()>([&] { brake(backwards, true); }) : nullptr);
    if (accounts) accounts_.begin(state_);
    softJoints_.push(state_, h, brakes);
    if (accounts) accounts_.end(state_);
    ContactSolver solver(state_, contacts_, h, gravity);
    solver.prepare();
    solver.solve();
    softContacts_.push(state_);
    wholes_.keep(state_);
    wholes_.begin(state_);
    integratePositions(state_, springs_, h);
    wholes_.end(state_, h);
    moveKinematic(h);
    if (brakes) brake(!backwards, false);
    rigid_.relax(state_);
    if (accounts) accounts_.begin(state_);
    softJoints_.relax(state_);
    if (accounts) accounts_.end(state_);
    softContacts_.relax(state_);
    solver.relax();
    solver.finish();
    wholes_.keep(state_);
}

void World::report()
{
    reports_.begin();
    for (const ContactPoint& c : contacts_.points) reports_.add(state_, c);
    for (const ContactPoint& c : reports_.ended()) reports_.add(state_, c);
    softContacts_.keep();
    softContacts_.each(state_, [&](const ContactPoint& c) { reports_.add(state_, c); });
    reports_.addRigid(rigid_, outlines_);
    reports_.finish();
    stats_.contacts = static_cast<std::uint32_t>(reports_.contacts().size());
    stats_.awakeBodies = 0;
    for (const BodyRecord& body : state_.bodies) stats_.awakeBodies += !body.fixed && !body.asleep && !body.removed;
}

}  // namespace jet::physics
