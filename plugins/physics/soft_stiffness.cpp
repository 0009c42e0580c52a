// What the springs of soft bodies ask of a substep, and what of them it can bear (stiffness.hpp).
#include "soft_springs.hpp"

#include <limits>

namespace jet::physics {

void SoftSprings::addTo(StiffnessBounds& bounds, const State& state, const Mesh& mesh) const
{
    for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
        if (a_[i] == b_[i]) continue;
        const auto act = [&](Index node, Index other) {
            const double part = bounds.part(node, other) * state.nodes.invMass[node];
            bounds.add(node, stiffnessOf(mesh, i) * part);
            bounds.addDamping(node, dampingOf(mesh, i) * part);
        };
        act(a_[i], b_[i]), act(b_[i], a_[i]);
    }
}

/// Some steps of the power method, from all weights 1; takes those with the lowest bound.
void SoftSprings::weigh(StiffnessBounds& bounds, const State& state, const Mesh& mesh)
{
    constexpr int kSteps = 12;
    const Nodes& nodes = state.nodes;
    double lowest = std::numeric_limits<double>::infinity();
    weight_.assign(mesh.nodes.count, 1.0);
    for (int step = 0; step <= kSteps && mesh.springs.count > 0; ++step) {
        load_.assign(mesh.nodes.count, 0.0);
        for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
            if (a_[i] == b_[i]) continue;
            const Index a = a_[i] - mesh.nodes.first, b = b_[i] - mesh.nodes.first;
            const double both = stiffnessOf(mesh, i) * (weight_[a] + weight_[b]);
            load_[a] += both * nodes.invMass[a_[i]], load_[b] += both * nodes.invMass[b_[i]];
        }
        double most = 0;
        for (Index k = 0; k < mesh.nodes.count; ++k) most = std::max(most, load_[k] / weight_[k]);
        if (!(most > 0) || !std::isfinite(most)) return;
        if (most < lowest && step > 0)
            for (Index k = 0; k < mesh.nodes.count; ++k)
                bounds.weigh(mesh.nodes.first + k, static_cast<float>(weight_[k]));
        lowest = std::min(lowest, most);
        for (Index k = 0; k < mesh.nodes.count; ++k)
            weight_[k] = static_cast<double>(static_cast<float>(0.5 * (weight_[k] + load_[k] / most)));
    }
}

/// A lower rate than that of the bound which is stable, too, for small bodies: see stiffness.hpp.
double SoftSprings::provenRate(const State& state, const Mesh& mesh, double rate)
{
    constexpr Index kMostNodes = 64;
    if (mesh.nodes.count > kMostNodes || !(rate > 0)) return 0;
    for (const double part : {0.7, 0.75, 0.8, 0.85, 0.9})
        if (isStable(state, mesh, 1 / (part * rate))) return part * rate;
    return 0;
}

/// Is 2 kStableLoad M - h² K - 2 h C, with springs that pull in all directions, positive definite? By its factors.
bool SoftSprings::isStable(const State& state, const Mesh& mesh, double h)
{
    const Nodes& nodes = state.nodes;
    const std::size_t count = mesh.nodes.count;
    matrix_.assign(count * count, 0.0);
    const auto at = [&](std::size_t row, std::size_t column) -> double& { return matrix_[row * count + column]; };
    for (std::size_t k = 0; k < count; ++k) {
        const double inverse = nodes.invMass[mesh.nodes.first + k];
        at(k, k) = inverse > 0 ? 2 * kStableLoad / inverse : std::numeric_limits<double>::max();
    }
    for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
        const double inverse = nodes.invMass[a_[i]] + nodes.invMass[b_[i]];
        if (a_[i] == b_[i] || !(inverse > 0)) continue;
        const double damping = (1 - decay(h * dampingOf(mesh, i) * inverse)) / inverse;
        const double load = h * h * stiffnessOf(mesh, i) + 2 * damping;
        const Index a = a_[i] - mesh.nodes.first, b = b_[i] - mesh.nodes.first;
        at(a, a) -= load, at(b, b) -= load, at(std::max(a, b), std::min(a, b)) += load;
    }
    for (std::size_t k = 0; k < count; ++k) {
        const double least = 1e-6 / std::max(nodes.invMass[mesh.nodes.first + k], 1e-300);
        if (!(at(k, k) > least)) return false;
        for (std::size_t row = k + 1; row < count; ++row) {
            const double part = at(row, k) / at(k, k);
            for (std::size_t column = k + 1; column <= row; ++column) at(row, column) -= part * at(column, k);
        }
    }
    return true;
}

/// No motion about the shape at rest is faster, in rad / s.
double SoftSprings::fastestAtRest(const StiffnessBounds& bounds, const State& state, const Mesh& mesh, Index body)
{
    constexpr std::size_t kOfNode = 3;  // xx, xy, yy of sum ks d dᵀ / m
    const std::vector<Vec2>& rest = state.bodies[body].soft->restArms;
    load_.assign(kOfNode * mesh.nodes.count, 0.0);
    for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
        if (a_[i] == b_[i]) continue;
        const Vec2 along = rest[b_[i] - mesh.nodes.first] - rest[a_[i] - mesh.nodes.first];
        const double squared = along.squaredNorm();
        if (!(squared > 0)) return std::numeric_limits<double>::infinity();
        const auto act = [&](Index node, Index other) {
            const double rate = stiffnessOf(mesh, i) * bounds.part(node, other) * state.nodes.invMass[node] / squared;
            double* sum = &load_[kOfNode * (node - mesh.nodes.first)];
            sum[0] += rate * along.x() * along.x();
            sum[1] += rate * along.x() * along.y();
            sum[2] += rate * along.y() * along.y();
        };
        act(a_[i], b_[i]), act(b_[i], a_[i]);
    }
    double most = 0;
    for (std::size_t k = 0; k < load_.size(); k += kOfNode) {
        const double half = 0.5 * (load_[k] - load_[k + 2]);
        most = std::max(most, 0.5 * (load_[k] + load_[k + 2]) + std::sqrt(half * half + load_[k + 1] * load_[k + 1]));
    }
    return std::sqrt(2 * most);
}

double SoftSprings::swingRate(const StiffnessBounds& bounds, const BodyRecord& body, Index handle) const
{
    const double rate = bounds.fastest(body.nodes) / phaseOf(body.nodes);
    const double atRest = handle < meshes_.size() ? meshes_[handle].fastestAtRest : 0;
    return atRest > 0 ? std::min(rate, atRest / kVastPhase) : rate;
}

double SoftSprings::stableRate(const StiffnessBounds& bounds, const BodyRecord& body, Index handle) const
{
    const double proven = handle < meshes_.size() ? meshes_[handle].provenRate : 0;
    return proven > 0 ? proven : bounds.stableRate(body.nodes);
}

WideSwing SoftSprings::wideSwing(const StiffnessBounds& bounds, const BodyRecord& body, Index handle) const
{
    if (handle >= meshes_.size() || body.rigid || body.hasTwin()) return {};
    const Mesh& mesh = meshes_[handle];
    double fastest = bounds.fastest(body.nodes);
    if (mesh.fastestAtRest > 0) fastest = std::min(fastest, mesh.fastestAtRest);
    if (!(mesh.provenRate > 0)) return {bounds.stableRate(body.nodes, 2), fastest / kWidePhase};
    fastest = std::min(fastest, std::sqrt(2 * kStableLoad) * mesh.provenRate);
    return {mesh.provenRate, fastest / kWidePhase};
}

/// Torn springs count as if they were whole: what a restored world computes must not depend on when they tore.
/// Weights serve bodies whose springs pull in many directions and are taken as they are: to a lone spring the bound
/// with weights is exact, and one softened to it would ring on.
void SoftSprings::addTo(StiffnessBounds& bounds, const State& state, bool loose)
{
    for (Index body = 0; body < meshes_.size(); ++body) {
        Mesh& mesh = meshes_[body];
        const bool weighed = loose && turning_ == 0 && isLarge(mesh.nodes);
        if (weighed) weigh(bounds, state, mesh);
        addTo(bounds, state, mesh);
        mesh.fastestAtRest = weighed && isVast(mesh.nodes) ? fastestAtRest(bounds, state, mesh, body) : 0;
        const double rate = bounds.stableRate(mesh.nodes);
        mesh.provenRate =
            weighed && !state.bodies[body].hasTwin() && rate <= kHighestRate ? provenRate(state, mesh, rate) : 0;
        if (!weighed || rate <= kHighestRate) continue;
        bounds.reset(mesh.nodes);
        addTo(bounds, state, mesh);
    }
    for (std::vector<double>* scratch : {&load_, &weight_, &matrix_}) *scratch = std::vector<double>();
    for (const Angular& spring : angular_) {
        if (spring.a == kNone) continue;
        const double rate = spring.ks * spring.restCompliance;
        for (Index node : {spring.a, spring.centre, spring.b}) bounds.add(node, rate);
    }
}

/// Turns stiffness and damping as they are into those a substep can bear.
void SoftSprings::prepareMesh(const State& state, const StiffnessBounds& bounds, Mesh& mesh, const BodyRecord& body,
                              double h)
{
    const Nodes& nodes = state.nodes;
    const bool proven = mesh.provenRate > 0 && std::max(h, bounds.longest()) * mesh.provenRate <= 1 + 1e-9;
    // With a twin: see soft/twins.hpp.
    const bool twin = body.hasTwin();
    const double beside = twin ? h * h * body.soft->twinRate / 2 : 0, left = twin ? 1 - body.soft->twinLoss : 0;
    const auto stable = [&](Index n) {
        if (!twin) return proven || bounds.stable(n, h);
        return h * h * bounds.elastic(n) + beside <= 1 + left * std::max(0.0, 1 - 2 * h * bounds.damping(n));
    };
    const auto share = [&](Index n) {
        return stable(n) ? 1.0 : std::min(1.0, (1 - beside) / (h * h * bounds.elastic(n)));
    };
    load_.assign(mesh.nodes.count, 0.0);
    for (Index k = 0; k < mesh.springs.count; ++k) {
        const Index a = a_[mesh.springs.first + k], b = b_[mesh.springs.first + k];
        const double inverse = nodes.invMass[a] + nodes.invMass[b];
        const double ks = stiffness_[k];
        stiffness_[k] = ks * std::min(share(a), share(b));
        // The stiffness taken away acts on through its implicit part, h ks v.
        const double wanted = damping_[k] + h * (ks - stiffness_[k]);
        damping_[k] = inverse > 0 ? (1 - decay(h * wanted * inverse)) / (h * inverse) : 0;
        if (a == b) continue;
        load_[a - mesh.nodes.first] += h * damping_[k] * nodes.invMass[a] * bounds.part(a, b);
        load_[b - mesh.nodes.first] += h * damping_[k] * nodes.invMass[b] * bounds.part(b, a);
    }
    const double most = twin ? 0.5 : 1;  // see soft/twins.hpp
    for (Index k = 0; k < mesh.nodes.count; ++k) {
        const Index node = mesh.nodes.first + k;
        const double elastic = h * h * bounds.elastic(node);
        const double room = std::min(1 - 0.5 * (stable(node) ? elastic : std::min(elastic, 1.0)), most);
        load_[k] = !proven && load_[k] > room ? room / load_[k] : 1;
    }
    mesh.fade = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < mesh.springs.count; ++k) {
        const Index i = mesh.springs.first + k;
        damping_[k] *= std::min(load_[a_[i] - mesh.nodes.first], load_[b_[i] - mesh.nodes.first]);
        // Torn ones as well, as above.
        if (a_[i] != b_[i] && damping_[k] > 0) mesh.fade = std::min(mesh.fade, stiffness_[k] / damping_[k]);
    }
}

SoftSprings::Slowest SoftSprings::slowest(Index body) const
{
    const Mesh& mesh = meshes_[body];
    Slowest slowest;
    slowest.fade = mesh.fade;
    const auto count = [&](double ks) {
        if (ks > 0) slowest.ks = std::min(slowest.ks, ks);
    };
    if (mesh.uniform) {
        if (mesh.springs.count > 0) count(mesh.ks);
    } else {
        for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i)
            if (alive_[i]) count(kindOf(i).ks);
    }
    for (const Angular& spring : angular_)
        if (spring.body == body && spring.kd > 0) slowest.fade = std::min(slowest.fade, spring.ks / spring.kd);
    return slowest;
}

bool SoftSprings::flows(const State& state, Index body) const
{
    constexpr double kLeast = 1e-12;  // of strain: what would flow no further
    const SoftMatter& matter = state.bodies[body].soft->matter;
    if (!(matter.yield > 0) || !(matter.creep > 0)) return false;
    const Mesh& mesh = meshes_[body];
    for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
        if (!alive_[i] || !(rest_[i] > 0)) continue;
        const double strain = (state.nodes.position[a_[i]] - state.nodes.position[b_[i]]).norm() / rest_[i] - 1;
        if (!(std::abs(strain) > matter.yield + kLeast)) continue;
        const double drawn = drawn_.empty() ? rest_[i] : drawn_[i], most = matter.mostFlow * drawn;
        if (strain > 0 ? rest_[i] < drawn + most : rest_[i] > drawn - most) return true;
    }
    return false;
}

}  // namespace jet::physics
