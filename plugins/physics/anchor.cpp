#include "anchor.hpp"

#include <Eigen/Dense>

#include <numeric>

namespace jet::physics {

Vec2 AnchorPoint::arm(const State& state) const
{
    if (count != 1 || !state.bodies[body].rigid) return Vec2(0, 0);
    return rotated(state.nodes.rotation[node[0]], local);
}

Vec2 AnchorPoint::position(const State& state) const
{
    if (count == 0) return local;
    if (state.bodies[body].rigid) return state.nodes.position[node[0]] + arm(state);
    Vec2 sum = local;
    for (int i = 0; i < count; ++i) sum += weight[i] * state.nodes.position[node[i]];
    return sum;
}

Vec2 AnchorPoint::velocity(const State& state) const
{
    if (count == 0) return {0, 0};
    Vec2 sum(0, 0);
    const Vec2 lever = arm(state);
    for (int i = 0; i < count; ++i) sum += weight[i] * state.nodes.velocityAt(node[i], lever);
    return sum;
}

void AnchorPoint::applyImpulse(State& state, const Vec2& impulse) const
{
    const Vec2 lever = arm(state);
    for (int i = 0; i < count; ++i) state.nodes.applyImpulse(node[i], lever, weight[i] * impulse);
}

void AnchorPoint::addForce(State& state, const Vec2& force) const
{
    const Vec2 lever = arm(state);
    for (int i = 0; i < count; ++i) {
        state.nodes.force.add(node[i], weight[i] * force);
        state.nodes.torque.add(node[i], cross(lever, weight[i] * force));
    }
}

void AnchorPoint::addTo(StiffnessBounds& bounds, const State& state, double ks) const
{
    double total = 0;
    for (int i = 0; i < count; ++i) total += std::abs(weight[i]);
    for (int i = 0; i < count; ++i) {
        const double turning = state.nodes.invInertia[node[i]] * local.squaredNorm();
        bounds.add(node[i], ks * total * std::abs(weight[i]) * (state.nodes.invMass[node[i]] + turning));
    }
}

double AnchorPoint::share(const StiffnessBounds& bounds, double h) const
{
    double least = 1;
    for (int i = 0; i < count; ++i) least = std::min(least, bounds.share(node[i], h));
    return least;
}

namespace {

/// Weights of particles around `at` whose weighted mean is `at`, by moving least squares: near particles weigh most.
void weigh(const State& state, AnchorPoint& anchor, const Vec2& at, double length)
{
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    std::array<Eigen::Vector3d, AnchorPoint::kMostNodes> basis;
    std::array<double, AnchorPoint::kMostNodes> nearness;
    double totalNearness = 0;
    for (int i = 0; i < anchor.count; ++i) {
        const Vec2 offset = (state.nodes.position[anchor.node[i]] - at) / length;
        basis[i] = {1, offset.x(), offset.y()};
        nearness[i] = 1 / (offset.squaredNorm() + 1e-4);
        totalNearness += nearness[i];
        moments += nearness[i] * basis[i] * basis[i].transpose();
    }
    const Eigen::Vector3d multipliers = moments.fullPivLu().solve(Eigen::Vector3d(1, 0, 0));
    double sum = 0, largest = 0;
    for (int i = 0; i < anchor.count; ++i) {
        anchor.weight[i] = nearness[i] * basis[i].dot(multipliers);
        sum += anchor.weight[i];
        largest = std::max(largest, std::abs(anchor.weight[i]));
    }
    if (std::abs(sum - 1) < 1e-6 && largest <= 2) return;
    // Particles on a line, or the point far outside them: plain nearness, the rest is a constant offset.
    for (int i = 0; i < anchor.count; ++i) anchor.weight[i] = nearness[i] / totalNearness;
}

AnchorPoint anchorInSoftBody(const State& state, const BodyRecord& body, const Vec2& at)
{
    AnchorPoint anchor;
    std::vector<Index> nearest(body.nodes.count);
    std::iota(nearest.begin(), nearest.end(), body.nodes.first);
    const auto distance = [&](Index node) { return (state.nodes.position[node] - at).squaredNorm(); };
    std::sort(nearest.begin(), nearest.end(),
              [&](Index a, Index b) { return distance(a) < distance(b) || (distance(a) == distance(b) && a < b); });
    const bool atParticle = !nearest.empty() && distance(nearest[0]) <= 1e-12 * body.length * body.length;
    anchor.count = atParticle ? 1 : std::min<int>(AnchorPoint::kMostNodes, static_cast<int>(nearest.size()));
    for (int i = 0; i < anchor.count; ++i) anchor.node[i] = nearest[i], anchor.weight[i] = 1;
    if (anchor.count > 1) weigh(state, anchor, at, body.length);
    anchor.local = at;
    for (int i = 0; i < anchor.count; ++i) anchor.local -= anchor.weight[i] * state.nodes.position[anchor.node[i]];
    return anchor;
}

}  // namespace

AnchorPoint resolveAnchor(const State& state, const Anchor& def)
{
    AnchorPoint anchor;
    anchor.local = def.point;
    if (def.body == kNoHandle) return anchor;
    const BodyRecord& body = state.bodies[def.body];
    if (body.rigid) {
        const Index node = body.nodes.first;
        anchor.count = 1;
        anchor.node[0] = node;
        anchor.weight[0] = 1;
        anchor.local = unrotated(state.nodes.rotation[node], def.point - state.nodes.position[node]);
    } else {
        anchor = anchorInSoftBody(state, body, def.point);
    }
    anchor.body = def.body;
    return anchor;
}

void AnchorJacobian::add(const State& state, const AnchorPoint& anchor, const Vec2& direction)
{
    const Vec2 lever = anchor.arm(state);
    for (int i = 0; i < anchor.count; ++i) {
        const Vec2 linear = anchor.weight[i] * direction;
        const double angular = cross(lever, linear);
        int at = 0;
        while (at < count_ && entries_[at].node != anchor.node[i]) ++at;
        if (at == count_) entries_[count_++] = {anchor.node[i], 0, 0, 0};
        entries_[at].x += linear.x(), entries_[at].y += linear.y();
        entries_[at].angular += angular;
    }
}

double AnchorJacobian::rate(const State& state) const
{
    double sum = 0;
    for (int i = 0; i < count_; ++i) {
        const Entry& e = entries_[i];
        sum += e.linear().dot(state.nodes.velocity[e.node]) + e.angular * state.nodes.omega[e.node];
    }
    return sum;
}

double AnchorJacobian::compliance(const State& state) const
{
    double sum = 0;
    for (int i = 0; i < count_; ++i) {
        const Entry& e = entries_[i];
        sum += state.nodes.invMass[e.node] * e.linear().squaredNorm() +
               state.nodes.invInertia[e.node] * e.angular * e.angular;
    }
    return sum;
}

void AnchorJacobian::addForce(State& state, double force) const
{
    for (int i = 0; i < count_; ++i) {
        state.nodes.force.add(entries_[i].node, force * entries_[i].linear());
        state.nodes.torque.add(entries_[i].node, force * entries_[i].angular);
    }
}

void AnchorJacobian::apply(State& state, double impulse) const
{
    for (int i = 0; i < count_; ++i) {
        const Entry& e = entries_[i];
        state.nodes.velocity[e.node] += state.nodes.invMass[e.node] * impulse * e.linear();
        state.nodes.omega.add(e.node, state.nodes.invInertia[e.node] * impulse * e.angular);
    }
}

double AnchorJacobian::turns(const State& state, double impulse) const
{
    double most = 0;
    for (int i = 0; i < count_; ++i) {
        const Entry& e = entries_[i];
        const double omega = state.nodes.omega[e.node];
        const double turned = std::abs(omega + state.nodes.invInertia[e.node] * impulse * e.angular);
        if (turned > std::abs(omega)) most = std::max(most, turned);
    }
    return most;
}

void AnchorJacobian::applyTurning(State& state, double impulse, double most) const
{
    for (int i = 0; i < count_; ++i) {
        const Entry& e = entries_[i];
        const double omega = state.nodes.omega[e.node], allowed = std::max(most, std::abs(omega));
        state.nodes.velocity[e.node] += state.nodes.invMass[e.node] * impulse * e.linear();
        const double pushed = omega + state.nodes.invInertia[e.node] * impulse * e.angular;
        state.nodes.omega.set(e.node, std::clamp(pushed, -allowed, allowed));
    }
}

}  // namespace jet::physics
