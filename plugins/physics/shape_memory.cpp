#include "shape_memory.hpp"

#include "soft/mass_sums.hpp"

#include <numeric>

namespace jet::physics {

namespace {

// The tolerance as a part of the radius of gyration: an eighth of a ball's radius.
constexpr double kTolerance = 0.18;
// omega² as a multiple of sum ks / m at the mean particle: springs pushed through each other push back less.
constexpr double kStiffness = 2;
// omega h: springs take up to sqrt(2) of the 2 that symplectic Euler allows.
constexpr double kMostPhase = 0.5;
constexpr double kDampingRatio = 0.5;
// R is certain while the fit is better than this part of the fit at rest. A ball turned inside out has a fit near 0.
constexpr double kLeastFit = 0.2;
// Springs whose lengths differ by more than this from where their particles are (root mean square) do not remember the
// shape that was drawn.
constexpr double kMostStrain = 0.1;

// Of the tolerance: bodies that will stay within are not looked at in the substeps.
constexpr double kRelaxed = 0.8;

class Groups {
public:
    explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
    Index of(Index i)
    {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(Index a, Index b) { parent_[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

private:
    std::vector<Index> parent_;
};

struct GroupSprings {
    std::size_t count = 0;
    double rates = 0;    // sum of ks (1/m + 1/m)
    double strain = 0;   // sum of (distance - rest length)²
    double lengths = 0;  // sum of rest length²

    void add(const SpringDef& spring, const SoftBodyDef& def)
    {
        const double off = (def.particles[spring.a] - def.particles[spring.b]).norm() - spring.restLength;
        ++count;
        rates += spring.ks * (1 / def.masses[spring.a] + 1 / def.masses[spring.b]);
        strain += off * off;
        lengths += spring.restLength * spring.restLength;
    }
    /// Fewer than 2n - 3 bars cannot be rigid in the plane (Maxwell's count).
    bool holdShape(std::size_t particles) const
    {
        return particles >= 3 && count + 3 >= 2 * particles && strain <= kMostStrain * kMostStrain * lengths;
    }
};

bool acts(const SpringDef& spring) { return spring.a != spring.b && spring.ks > 0; }

bool isNailedDown(const SoftBodyDef& def)
{
    return def.common.fixed || std::find(def.movable.begin(), def.movable.end(), 0) != def.movable.end();
}

}  // namespace

void ShapeMemory::add(const State& state, const SoftBodyDef& def, BodyHandle handle, std::span<const Index> nodeOf)
{
    if (isNailedDown(def) || def.borders.empty()) return;
    Groups groups(def.particles.size());
    for (const SpringDef& spring : def.springs)
        if (acts(spring)) groups.join(spring.a, spring.b);
    std::vector<GroupSprings> springs(def.particles.size());
    for (const SpringDef& spring : def.springs)
        if (acts(spring)) springs[groups.of(spring.a)].add(spring, def);

    std::vector<Index> particles(def.particles.size());
    std::iota(particles.begin(), particles.end(), Index{0});
    std::sort(particles.begin(), particles.end(), [&](Index p, Index q) { return nodeOf[p] < nodeOf[q]; });
    std::vector<Lattice> lattices(def.particles.size());
    for (const Index i : particles) {
        Lattice& lattice = lattices[groups.of(i)];
        lattice.nodes.push_back(nodeOf[i]);
        lattice.rest.push_back(def.particles[i]);
        lattice.mass += def.masses[i];
    }
    for (Index group = 0; group < lattices.size(); ++group) {
        Lattice& lattice = lattices[group];
        const std::size_t count = lattice.nodes.size();
        if (!springs[group].holdShape(count)) continue;
        Vec2 centre(0, 0);
        for (std::size_t i = 0; i < count; ++i)
            centre += state.nodes.mass[lattice.nodes[i]] / lattice.mass * lattice.rest[i];
        for (std::size_t i = 0; i < count; ++i) {
            lattice.rest[i] -= centre;
            lattice.inertia += state.nodes.mass[lattice.nodes[i]] * lattice.rest[i].squaredNorm();
        }
        lattice.body = handle;
        lattice.tolerance = kTolerance * std::sqrt(lattice.inertia / lattice.mass);
        lattice.rate = kStiffness * springs[group].rates / static_cast<double>(count);
        if (lattice.inertia > 0) lattices_.push_back(std::move(lattice));
    }
}

bool ShapeMemory::anyPinned(const Nodes& nodes, const Lattice& lattice)
{
    return std::any_of(lattice.nodes.begin(), lattice.nodes.end(), [&](Index n) { return nodes.invMass[n] == 0; });
}

void ShapeMemory::look(const State& state, double dt)
{
    const Nodes& nodes = state.nodes;
    for (Lattice& lattice : lattices_) {
        // What is nailed down has no shape of its own; neither has what flows.
        lattice.relaxed = state.bodies[lattice.body].matter.yield > 0 || anyPinned(nodes, lattice);
        if (lattice.relaxed) continue;
        const Motion motion = match(nodes, lattice);
        double off = 0, speed = 0;
        for (std::size_t i = 0; i < lattice.nodes.size(); ++i) {
            const Index n = lattice.nodes[i];
            const Vec2 arm = nodes.position[n] - motion.centre;
            off = std::max(off, (rotated(lattice.rotation, lattice.rest[i]) - arm).squaredNorm());
            const Vec2 own = nodes.velocity[n] - motion.velocity - motion.omega * perpendicular(arm);
            speed = std::max(speed, own.squaredNorm());
        }
        lattice.relaxed = std::sqrt(off) + std::sqrt(speed) * dt < kRelaxed * lattice.tolerance;
    }
}

void ShapeMemory::apply(State& state, const SoftSprings& springs, double h)
{
    Nodes& nodes = state.nodes;
    for (Lattice& lattice : lattices_) {
        if (lattice.relaxed || springs.anyTorn(lattice.body)) continue;
        const Motion motion = match(nodes, lattice);
        if (!pull(nodes, lattice, motion, h)) continue;
        removeNet(nodes, lattice, motion);
        for (std::size_t i = 0; i < lattice.nodes.size(); ++i)
            nodes.velocity[lattice.nodes[i]] += elastic_[i] + damping_[i];
    }
}

ShapeMemory::Motion ShapeMemory::match(const Nodes& nodes, Lattice& lattice) const
{
    const soft::MassSums sums = soft::massSums(
        nodes, lattice.nodes.size(), [&](std::size_t i) { return lattice.nodes[i]; }, lattice.rest.data());
    Motion motion{sums.centre, sums.velocity, sums.omega(), sums.inertia};
    const double along = sums.along, across = sums.across;
    motion.fit = std::sqrt(along * along + across * across);
    motion.certain = motion.fit > kLeastFit * lattice.inertia;
    if (motion.certain) lattice.rotation = Vec2(along, across) / motion.fit;
    return motion;
}

/// Fills elastic_ and damping_ with what draws each particle to its goal; false when all are within the tolerance.
bool ShapeMemory::pull(const Nodes& nodes, const Lattice& lattice, const Motion& motion, double h)
{
    const double rate = std::min(lattice.rate, kMostPhase * kMostPhase / (h * h));
    const double damped = std::min(1.0, 2 * kDampingRatio * std::sqrt(rate) * h);
    bool any = false;
    const double tolerated = lattice.tolerance * lattice.tolerance;
    for (std::size_t i = 0; i < lattice.nodes.size(); ++i) {
        const Index n = lattice.nodes[i];
        const Vec2 arm = nodes.position[n] - motion.centre;
        const Vec2 away = rotated(lattice.rotation, lattice.rest[i]) - arm;
        const double squared = away.squaredNorm();
        if (!(squared > tolerated)) continue;
        if (!any) {
            any = true;
            elastic_.assign(lattice.nodes.size(), Vec2(0, 0));
            damping_.assign(lattice.nodes.size(), Vec2(0, 0));
        }
        elastic_[i] = h * rate * (1 - lattice.tolerance / std::sqrt(squared)) * away;
        damping_[i] = -damped * (nodes.velocity[n] - motion.velocity - motion.omega * perpendicular(arm));
    }
    return any;
}

/// Takes the net momentum and angular momentum out of both.
///
/// dU/dx through R: the angle of the fit changes by m perpendicular(R q)·dx / fit. Without a certain R, and for the
/// damping, a rigid motion of the particles as they are; taken out of the damping it can only lower what that leaves
/// of the energy, as it is its part orthogonal to rigid motions that remains.
void ShapeMemory::removeNet(const Nodes& nodes, const Lattice& lattice, const Motion& motion)
{
    Vec2 pulled(0, 0), damped(0, 0);
    double pulledTurn = 0, dampedTurn = 0;
    for (std::size_t i = 0; i < lattice.nodes.size(); ++i) {
        const Index n = lattice.nodes[i];
        const Vec2 arm = nodes.position[n] - motion.centre;
        pulled += nodes.mass[n] / lattice.mass * elastic_[i];
        damped += nodes.mass[n] / lattice.mass * damping_[i];
        pulledTurn += nodes.mass[n] * cross(arm, elastic_[i]);
        dampedTurn += nodes.mass[n] * cross(arm, damping_[i]);
    }
    const double inertia = std::max(motion.inertia, 1e-12 * lattice.inertia);
    for (std::size_t i = 0; i < lattice.nodes.size(); ++i) {
        const Vec2 across = perpendicular(nodes.position[lattice.nodes[i]] - motion.centre);
        elastic_[i] -= pulled;
        if (motion.certain) {
            elastic_[i] -= pulledTurn / motion.fit * perpendicular(rotated(lattice.rotation, lattice.rest[i]));
        } else {
            elastic_[i] -= pulledTurn / inertia * across;
        }
        damping_[i] -= damped + dampedTurn / inertia * across;
    }
}

}  // namespace jet::physics
