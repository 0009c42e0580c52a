#include "twins.hpp"

#include "trigonometry.hpp"

namespace jet::physics::soft {

namespace {

constexpr double kMostPhaseSquared = 0.5;  // (omega h)²
constexpr double kPhase = 0.5;             // omega h that substeps are chosen for
constexpr double kMostLoss = 0.7;          // of the velocities, in a substep
constexpr double kLeastFit = 0.2;          // of that at rest: a body turned inside out has one near 0

/// omega² of the springs to the twin, 1 / s².
double rateOf(const BodyRecord& body) { return body.soft->matter.shapeStiffness * body.nodes.count / body.soft->mass; }

}  // namespace

bool Twins::has(const BodyRecord& body, const SoftSprings& springs, BodyHandle handle)
{
    return !body.rigid && body.soft->matter.shapeStiffness > 0 && body.soft->restGyrationSquared > 0 && !body.fixed &&
           body.enabled && !springs.anyTorn(handle);
}

double Twins::swingRate(const BodyRecord& body)
{
    return body.rigid || body.fixed ? 0 : std::sqrt(rateOf(body)) / kPhase;
}

void Twins::apply(State& state, const SoftSprings& springs, double h)
{
    for (BodyHandle handle = 0; handle < state.bodies.size(); ++handle)
        if (has(state.bodies[handle], springs, handle)) apply(state, state.bodies[handle], h);
}

void Twins::apply(State& state, BodyRecord& body, double h)
{
    Nodes& nodes = state.nodes;
    SoftRecord& own = *body.soft;
    const Index first = body.nodes.first, count = body.nodes.count;
    if (change_.size() < count) change_.resize(count);
    const Cloud cloud{nodes.position[first].data(), nodes.velocity[first].data(), &nodes.mass[first],
                      own.restArms[0].data(), count};

    const CloudSums sums = kernels_->sums(cloud);
    const double fit = std::sqrt(sums.along * sums.along + sums.across * sums.across);
    const bool certain = fit > kLeastFit * own.restGyrationSquared * sums.mass;
    if (certain) own.twinTurn = Vec2(sums.along, sums.across) / fit;
    const CloudMotion motion{sums.x, sums.y, sums.vx, sums.vy, sums.omega(), own.twinTurn.x(), own.twinTurn.y()};

    const double rate = rateOf(body), held = std::min(rate, kMostPhaseSquared / (h * h));
    const double damping = own.matter.shapeDamping * count / own.mass + (rate - held) * h;
    const double loss = std::min(1 - decay(damping * h), kMostLoss);
    const CloudPulled pulled = kernels_->pull(cloud, motion, {0, h * held, loss}, change_[0].data());
    if (!pulled.any) return;

    // Rounding, a turn that is not certain, and the damping of what rests in its place would push and turn the body.
    const double turn = pulled.dampedTurn + pulled.turn;
    const double inertia = std::max(sums.inertia, 1e-12 * own.restGyrationSquared * sums.mass);
    const CloudReturn back{-(pulled.x + pulled.dampedX) / sums.mass, -(pulled.y + pulled.dampedY) / sums.mass, 0,
                           -turn / inertia};
    pinned_.clear();
    for (Index n = first; n < body.nodes.end(); ++n)
        if (nodes.invMass[n] == 0) pinned_.push_back(nodes.velocity[n]);
    kernels_->give(cloud, motion, back, change_[0].data(), nodes.velocity[first].data());
    for (Index n = first, k = 0; k < pinned_.size(); ++n)
        if (nodes.invMass[n] == 0) nodes.velocity[n] = pinned_[k++];
}

}  // namespace jet::physics::soft
