#include "soft_springs.hpp"

#include <limits>

namespace jet::physics {

namespace {

/// The gradient of the angle from arm a to arm b; that of the centre is minus the sum, so forces and torques sum to
/// zero.
struct AngleGradient {
    Vec2 a, b;
    bool valid;

    AngleGradient(const Vec2& armA, const Vec2& armB)
    {
        const double lengthA = armA.squaredNorm(), lengthB = armB.squaredNorm();
        valid = lengthA > 1e-24 && lengthB > 1e-24;
        if (valid) a = -perpendicular(armA) / lengthA, b = perpendicular(armB) / lengthB;
    }
    Vec2 centre() const { return -(a + b); }
    double compliance(double invA, double invCentre, double invB) const
    {
        return invA * a.squaredNorm() + invCentre * centre().squaredNorm() + invB * b.squaredNorm();
    }
};

double angleBetween(const Vec2& armA, const Vec2& armB) { return angleOf(cross(armA, armB), armA.dot(armB)); }

// Collapsing arms make an angular spring ever stiffer (as 1 / length²). Up to this multiple of the stiffness at rest is
// inside the step's reserve; beyond it the torque is held back.
constexpr double kStiffeningReserve = 2.0;

// The kernels watch for springs longer than this part of what they hold; their lengths are single.
constexpr double kTearWatch = 0.9999;
// Fewer springs than this are computed in double, one by one.
constexpr std::size_t kFewSprings = 16;
// Numbers the kernels take; outside this range, products could leave that of single.
constexpr double kLeastSingle = 1e-15, kMostSingle = 1e15;

bool isWide(const SoftBodyDef& def)
{
    const auto fits = [](double value) { return value == 0 || (value >= kLeastSingle && value <= kMostSingle); };
    if (def.springs.size() < kFewSprings || def.particles.size() < soft::kLanes) return false;
    for (double mass : def.masses)
        if (!fits(mass)) return false;
    for (const SpringDef& s : def.springs)
        if (!fits(s.ks) || !fits(s.kd) || !fits(std::abs(s.restLength))) return false;
    return true;
}

}  // namespace

void SoftSprings::add(const State& state, const SoftBodyDef& def, BodyHandle body, std::span<const Index> nodeOf)
{
    meshes_.resize(body + std::size_t{1});
    torn_.resize(body + std::size_t{1}, 0);
    Mesh& mesh = meshes_[body];
    mesh.nodes = state.bodies[body].nodes;
    mesh.springs = {springCount(), static_cast<Index>(def.springs.size())};
    std::vector<soft::Ends> ends;
    for (const SpringDef& spring : def.springs) {
        a_.push_back(nodeOf[spring.a]);
        b_.push_back(nodeOf[spring.b]);
        rest_.push_back(spring.restLength);
        if (!drawn_.empty()) drawn_.push_back(spring.restLength);
        ks_.push_back(spring.ks);
        kd_.push_back(spring.kd);
        tear_.push_back(std::max(spring.tearRatio, 0.0));
        alive_.push_back(spring.a != spring.b);
        stiffness_.push_back(0);
        damping_.push_back(0);
        mesh.tears |= spring.tearRatio > 0;
        ends.push_back({a_.back() - mesh.nodes.first, b_.back() - mesh.nodes.first});
    }
    if (isWide(def)) {
        mesh.blocks = soft::arrange(ends, mesh.nodes.count);
        mesh.coefficients.assign(mesh.blocks.count() * 3 * soft::kLanes, 0);
        measureBias(state, mesh);
        if (mesh.tears) watchTears(mesh);
    }
    for (const AngularSpringDef& spring : def.angularSprings) addAngular(state, spring, nodeOf);
}

/// From now on the kernels watch the lengths of the body's springs.
void SoftSprings::watchTears(Mesh& mesh)
{
    if (mesh.coefficients.empty() || !mesh.tear.empty()) return;
    mesh.tear.assign(mesh.blocks.count() * soft::kLanes, std::numeric_limits<float>::max());
    mesh.springAt.assign(mesh.tear.size(), kNone);
    for (Index i = 0; i < mesh.springs.count; ++i) mesh.springAt[mesh.blocks.seat[i]] = mesh.springs.first + i;
}

void SoftSprings::addAngular(const State& state, const AngularSpringDef& def, std::span<const Index> nodeOf)
{
    Angular spring{nodeOf[def.a], nodeOf[def.centre], nodeOf[def.b], def.restAngle, def.ks, def.kd, 0, 0};
    const Nodes& nodes = state.nodes;
    const Vec2 armA = nodes.position[spring.a] - nodes.position[spring.centre];
    const Vec2 armB = nodes.position[spring.b] - nodes.position[spring.centre];
    spring.angle = def.restAngle + wrapped(angleBetween(armA, armB) - def.restAngle);
    const AngleGradient gradient(armA, armB);
    if (gradient.valid)
        spring.restCompliance =
            gradient.compliance(nodes.invMass[spring.a], nodes.invMass[spring.centre], nodes.invMass[spring.b]);
    angular_.push_back(spring);
}

/// Torn springs count as if they were whole: what a restored world computes must not depend on when they tore.
void SoftSprings::addTo(StiffnessBounds& bounds, const State& state) const
{
    for (const Mesh& mesh : meshes_) {
        for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
            if (a_[i] == b_[i]) continue;
            for (Index node : {a_[i], b_[i]}) {
                bounds.add(node, stiffnessOf(mesh, i) * state.nodes.invMass[node]);
                bounds.addDamping(node, dampingOf(mesh, i) * state.nodes.invMass[node]);
            }
        }
    }
    for (const Angular& spring : angular_) {
        const double rate = spring.ks * spring.restCompliance;
        for (Index node : {spring.a, spring.centre, spring.b}) bounds.add(node, rate);
    }
}

void SoftSprings::prepare(const State& state, const StiffnessBounds& bounds, double h, bool plain)
{
    if (plain) return prepareAsTheyAre();
    for (Mesh& mesh : meshes_) prepareMesh(state, bounds, mesh, h);
    for (Angular& spring : angular_) {
        const double share =
            std::min({bounds.share(spring.a, h), bounds.share(spring.centre, h), bounds.share(spring.b, h)});
        spring.stiffness = spring.ks * share;
        spring.damping = spring.kd + h * (spring.ks - spring.stiffness);
    }
}

void SoftSprings::prepareAsTheyAre()
{
    for (Mesh& mesh : meshes_) {
        for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i)
            stiffness_[i] = stiffnessOf(mesh, i), damping_[i] = dampingOf(mesh, i);
        fillLanes(mesh);
    }
}

void SoftSprings::prepareMesh(const State& state, const StiffnessBounds& bounds, Mesh& mesh, double h)
{
    const Nodes& nodes = state.nodes;
    const auto stable = [&](Index n) { return h * h * bounds.elastic(n) + 2 * h * bounds.damping(n) <= 2; };
    const auto share = [&](Index n) { return stable(n) ? 1.0 : bounds.share(n, h); };
    load_.assign(mesh.nodes.count, 0.0);
    for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
        const double inverse = nodes.invMass[a_[i]] + nodes.invMass[b_[i]];
        const double ks = stiffnessOf(mesh, i);
        stiffness_[i] = ks * std::min(share(a_[i]), share(b_[i]));
        // The stiffness taken away acts on through its implicit part, h ks v.
        const double wanted = dampingOf(mesh, i) + h * (ks - stiffness_[i]);
        damping_[i] = inverse > 0 ? (1 - decay(h * wanted * inverse)) / (h * inverse) : 0;
        if (a_[i] == b_[i]) continue;
        for (Index node : {a_[i], b_[i]}) load_[node - mesh.nodes.first] += h * damping_[i] * nodes.invMass[node];
    }
    for (Index k = 0; k < mesh.nodes.count; ++k) {
        const Index node = mesh.nodes.first + k;
        const double elastic = h * h * bounds.elastic(node);
        const double room = 1 - 0.5 * (stable(node) ? elastic : std::min(elastic, 1.0));
        load_[k] = load_[k] > room ? room / load_[k] : 1;
    }
    for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i)
        damping_[i] *= std::min(load_[a_[i] - mesh.nodes.first], load_[b_[i] - mesh.nodes.first]);
    fillLanes(mesh);
}

/// A body drawn at rest shall rest: what rounding to single adds to the lengths of springs is added to what they rest
/// at.
void SoftSprings::measureBias(const State& state, Mesh& mesh)
{
    const Vec2& origin = state.nodes.position[mesh.nodes.first];
    const auto place = [&](Index node, int axis) {
        return static_cast<float>(state.nodes.position[node][axis] - origin[axis]);
    };
    for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
        const Index low = std::min(a_[i], b_[i]), high = std::max(a_[i], b_[i]);
        const float x = place(low, 0) - place(high, 0), y = place(low, 1) - place(high, 1);
        const double length = (state.nodes.position[low] - state.nodes.position[high]).norm();
        mesh.bias.push_back(static_cast<float>(static_cast<double>(std::sqrt(x * x + y * y)) - length));
    }
}

void SoftSprings::fillLanes(Mesh& mesh)
{
    if (mesh.coefficients.empty()) return;
    for (Index k = 0; k < mesh.springs.count; ++k) {
        const Index i = mesh.springs.first + k;
        const std::uint32_t block = mesh.blocks.seat[k] / soft::kLanes, lane = mesh.blocks.seat[k] % soft::kLanes;
        float* at = mesh.coefficients.data() + std::size_t{block} * 3 * soft::kLanes + lane;
        at[0] = static_cast<float>(rest_[i] + mesh.bias[k]);
        at[soft::kLanes] = alive_[i] ? static_cast<float>(stiffness_[i]) : 0;
        at[2 * soft::kLanes] = alive_[i] ? static_cast<float>(damping_[i]) : 0;
        if (mesh.tear.empty()) continue;
        const double longest = tearLength(mesh, i);
        mesh.tear[mesh.blocks.seat[k]] =
            alive_[i] && longest > 0 ? static_cast<float>(kTearWatch * longest) : std::numeric_limits<float>::max();
    }
}

void SoftSprings::addForces(State& state, double h)
{
    static_cast<void>(h);
    for (Mesh& mesh : meshes_) {
        if (mesh.springs.count == 0) continue;
        if (mesh.coefficients.empty()) {
            pullOneByOne(state, mesh);
        } else {
            pullWide(state, mesh);
        }
    }
}

void SoftSprings::pullWide(State& state, Mesh& mesh)
{
    Nodes& nodes = state.nodes;
    const Index first = mesh.nodes.first;
    const Vec2 &at = nodes.position[first], &moving = nodes.velocity[first];
    relative_.resize(std::max<std::size_t>(relative_.size(), 4 * std::size_t{mesh.nodes.count}));
    tornBlocks_.resize(std::max(tornBlocks_.size(), mesh.blocks.count()));
    kernels_->relate(nodes.position[first].data(), nodes.velocity[first].data(), mesh.nodes.count,
                     {at.x(), at.y(), moving.x(), moving.y()}, relative_.data());
    const soft::SpringBlocks blocks{mesh.blocks.runs.data(),  mesh.blocks.runs.size(),
                                    mesh.blocks.ends.data(),  mesh.blocks.ends.size() / (2 * soft::kLanes),
                                    mesh.coefficients.data(), mesh.tear.empty() ? nullptr : mesh.tear.data(),
                                    tornBlocks_.data()};
    const std::size_t torn = kernels_->pull(blocks, relative_.data(), nodes.force[first].data());
    for (std::size_t i = 0; i < torn; ++i) tearIn(state, mesh, tornBlocks_[i]);
}

/// The kernels only warn: whether a spring of the block is too long is decided in double, so that it tears at exactly
/// its length. Its last force, of a length that differs by rounding, still acts.
void SoftSprings::tearIn(const State& state, Mesh& mesh, std::size_t block)
{
    for (Index lane = 0; lane < soft::kLanes; ++lane) {
        const Index i = mesh.springAt[block * soft::kLanes + lane];
        if (i == kNone || !alive_[i] || !(tearLength(mesh, i) > 0)) continue;
        const double length = (state.nodes.position[a_[i]] - state.nodes.position[b_[i]]).norm();
        if (length > tearLength(mesh, i)) tear(mesh, i);
    }
}

void SoftSprings::tear(Mesh& mesh, Index spring)
{
    alive_[spring] = 0;
    ++torn_[&mesh - meshes_.data()];
    anyTorn_ = true;
    if (mesh.coefficients.empty()) return;
    const std::uint32_t seat = mesh.blocks.seat[spring - mesh.springs.first];
    float* at = mesh.coefficients.data() + std::size_t{seat / soft::kLanes} * 3 * soft::kLanes + seat % soft::kLanes;
    at[soft::kLanes] = at[2 * soft::kLanes] = 0;
    mesh.tear[seat] = std::numeric_limits<float>::max();
}

void SoftSprings::pullOneByOne(State& state, const Mesh& mesh)
{
    Nodes& nodes = state.nodes;
    for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
        if (!alive_[i]) continue;
        const Index a = a_[i], b = b_[i];
        const Vec2 apart = nodes.position[a] - nodes.position[b];
        const double length = std::sqrt(apart.squaredNorm());
        const double longest = tearLength(mesh, i);
        if (longest > 0 && length > longest) {
            tear(const_cast<Mesh&>(mesh), i);
            continue;
        }
        if (!(length > 1e-12)) continue;
        const Vec2 along = apart / length;
        const double speed = (nodes.velocity[a] - nodes.velocity[b]).dot(along);
        const Vec2 force = (stiffness_[i] * (length - rest_[i]) + damping_[i] * speed) * along;
        nodes.force[a] -= force;
        nodes.force[b] += force;
    }
}

void SoftSprings::set(Index body, double ks, double kd, double tearRatio)
{
    Mesh& mesh = meshes_[body];
    mesh.uniform = true;
    mesh.ks = ks, mesh.kd = kd, mesh.tearRatio = std::max(tearRatio, 0.0);
    if (mesh.tearRatio > 0) watchTears(mesh);
}

double SoftSprings::tension(const State& state, Index body, Index spring) const
{
    if (!alive_[spring]) return 0;
    const Nodes& nodes = state.nodes;
    const Vec2 apart = nodes.position[a_[spring]] - nodes.position[b_[spring]];
    const double length = apart.norm();
    if (!(length > 0)) return 0;
    const double speed = (nodes.velocity[a_[spring]] - nodes.velocity[b_[spring]]).dot(apart) / length;
    const Mesh& mesh = meshes_[body];
    return stiffnessOf(mesh, spring) * (length - rest_[spring]) + dampingOf(mesh, spring) * speed;
}

/// Bingham's body: elastic up to the yield, then the strain beyond it fades at the rate `creep`.
void SoftSprings::flow(const State& state, double dt)
{
    for (Index body = 0; body < meshes_.size(); ++body) {
        Mesh& mesh = meshes_[body];
        if (mesh.springs.count == 0 || !(state.bodies[body].matter.yield > 0)) continue;
        const SoftMatter& matter = state.bodies[body].matter;
        const double part = 1 - decay(matter.creep * dt);
        bool flowed = false;
        for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
            if (!alive_[i] || !(rest_[i] > 0)) continue;
            const double strain = (state.nodes.position[a_[i]] - state.nodes.position[b_[i]]).norm() / rest_[i] - 1;
            const double beyond = strain - std::clamp(strain, -matter.yield, matter.yield);
            if (beyond == 0) continue;
            if (drawn_.empty()) drawn_ = rest_;
            rest_[i] = std::clamp(rest_[i] * (1 + part * beyond), (1 - matter.mostFlow) * drawn_[i],
                                  (1 + matter.mostFlow) * drawn_[i]);
            flowed = true;
        }
        if (flowed) fillLanes(mesh);
    }
}

void SoftSprings::restored()
{
    anyTorn_ = false;
    for (std::size_t body = 0; body < meshes_.size(); ++body) {
        Mesh& mesh = meshes_[body];
        torn_[body] = 0;
        if (mesh.uniform && mesh.tearRatio > 0) watchTears(mesh);
        for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) torn_[body] += !alive_[i] && a_[i] != b_[i];
        anyTorn_ |= torn_[body] > 0;
        fillLanes(mesh);
    }
}

void SoftSprings::applyAngular(State& state, double h, bool backwards)
{
    for (std::size_t i = 0; i < angular_.size(); ++i)
        applyAngularSpring(state, angular_[backwards ? angular_.size() - 1 - i : i], h);
}

void SoftSprings::addAngularForces(State& state)
{
    Nodes& nodes = state.nodes;
    for (Angular& spring : angular_) {
        const Vec2 armA = nodes.position[spring.a] - nodes.position[spring.centre];
        const Vec2 armB = nodes.position[spring.b] - nodes.position[spring.centre];
        const AngleGradient gradient(armA, armB);
        if (!gradient.valid) continue;
        spring.angle += wrapped(angleBetween(armA, armB) - spring.angle);
        const double rate = nodes.velocity[spring.a].dot(gradient.a) +
                            nodes.velocity[spring.centre].dot(gradient.centre()) +
                            nodes.velocity[spring.b].dot(gradient.b);
        const double torque = -spring.ks * (spring.angle - spring.restAngle) - spring.kd * rate;
        nodes.force[spring.a] += torque * gradient.a;
        nodes.force[spring.centre] += torque * gradient.centre();
        nodes.force[spring.b] += torque * gradient.b;
    }
}

void SoftSprings::applyAngularSpring(State& state, Angular& spring, double h)
{
    Nodes& nodes = state.nodes;
    const Vec2 armA = nodes.position[spring.a] - nodes.position[spring.centre];
    const Vec2 armB = nodes.position[spring.b] - nodes.position[spring.centre];
    const AngleGradient gradient(armA, armB);
    if (!gradient.valid) return;
    spring.angle += wrapped(angleBetween(armA, armB) - spring.angle);
    const double invA = nodes.invMass[spring.a], invC = nodes.invMass[spring.centre], invB = nodes.invMass[spring.b];
    const double compliance = gradient.compliance(invA, invC, invB);
    if (!(compliance > 0)) return;
    const double hold = std::min(1.0, kStiffeningReserve * spring.restCompliance / compliance);
    const double elastic = -h * spring.stiffness * hold * (spring.angle - spring.restAngle);
    const Vec2 atCentre = gradient.centre();
    const double rate = nodes.velocity[spring.a].dot(gradient.a) + nodes.velocity[spring.centre].dot(atCentre) +
                        nodes.velocity[spring.b].dot(gradient.b) + compliance * elastic;
    const double impulse = elastic - h * spring.damping / (1 + h * spring.damping * compliance) * rate;
    nodes.velocity[spring.a] += invA * impulse * gradient.a;
    nodes.velocity[spring.centre] += invC * impulse * atCentre;
    nodes.velocity[spring.b] += invB * impulse * gradient.b;
}

}  // namespace jet::physics
