#include "twins.hpp"

#include "trigonometry.hpp"

namespace jet::physics::soft {

namespace {

constexpr double kPhase = 0.5;             // omega h that substeps are chosen for
constexpr double kMostPhaseSquared = 0.5;  // (omega h)²
constexpr double kBeside = 1.5;            // times the substeps that the own springs need without it
constexpr double kLeastFit = 0.2;          // of that at rest: a body turned inside out has one near 0

/// omega² of the springs to the twin, 1 / s².
double rateOf(const BodyRecord& body) { return body.soft->matter.shapeStiffness * body.nodes.count / body.soft->mass; }

/// Of the velocities against it, 1 / s.
double dampingOf(const BodyRecord& body) { return body.soft->matter.shapeDamping * body.nodes.count / body.soft->mass; }

}  // namespace

double Twins::rate(const BodyRecord& body, double own)
{
    return body.hasTwin() ? std::max(kBeside * own, std::sqrt(rateOf(body)) / kPhase) : own;
}

void Twins::prepare(State& state, double h)
{
    for (BodyRecord& body : state.bodies) {
        if (!body.hasTwin()) continue;
        const double rate = rateOf(body);
        body.soft->twinRate = std::min(rate, kMostPhaseSquared / (h * h));
        body.soft->twinLoss = 1 - decay((dampingOf(body) + h * (rate - body.soft->twinRate)) * h);
    }
}

bool Twins::pulls(const BodyRecord& body, const SoftSprings& springs, BodyHandle handle)
{
    return body.hasTwin() && body.enabled && !springs.anyTorn(handle);
}

double Twins::energy(const State& state, BodyHandle handle, double h) const
{
    const BodyRecord& body = state.bodies[handle];
    const SoftRecord& own = *body.soft;
    const Nodes& nodes = state.nodes;
    const Index first = body.nodes.first;
    const Cloud cloud{nodes.position[first].data(), nodes.velocity[first].data(), &nodes.mass[first],
                      own.restArms[0].data(), body.nodes.count};
    const CloudSums sums = kernels_->sums(cloud);
    const double fit = std::sqrt(sums.along * sums.along + sums.across * sums.across);
    const bool certain = fit > kLeastFit * own.restGyrationSquared * sums.mass;
    const Vec2 turn = certain ? Vec2(Vec2(sums.along, sums.across) / fit) : own.twinTurn;
    const CloudMotion motion{sums.x, sums.y, sums.vx, sums.vy, sums.omega(), turn.x(), turn.y()};
    return 0.5 * own.twinRate * drawn(cloud, motion, 0, h);
}

void Twins::apply(State& state, const SoftSprings& springs, double h)
{
    for (BodyHandle handle = 0; handle < state.bodies.size(); ++handle) {
        BodyRecord& body = state.bodies[handle];
        if (!body.asleep && pulls(body, springs, handle)) apply(state, body, h);
    }
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

    const CloudPulled pulled = kernels_->pull(cloud, motion, {0, h * own.twinRate, own.twinLoss}, change_[0].data());
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
