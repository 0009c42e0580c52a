#include "shape_memory.hpp"

#include <algorithm>
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
        const bool whole = count == def.particles.size();
        lattice.tolerance = kTolerance * std::sqrt(lattice.inertia / lattice.mass);
        lattice.rate = kStiffness * springs[group].rates / static_cast<double>(count);
        if (whole) lattice.nodes = std::vector<Index>(), lattice.rest = std::vector<Vec2>();
        if (lattice.inertia > 0) lattices_.push_back(std::move(lattice));
    }
}

bool ShapeMemory::anyPinned(const State& state, const Lattice& lattice)
{
    const auto pinned = [&](Index n) { return state.nodes.invMass[n] == 0; };
    if (!lattice.nodes.empty()) return std::any_of(lattice.nodes.begin(), lattice.nodes.end(), pinned);
    const Range& own = state.bodies[lattice.body].nodes;
    const auto first = state.nodes.invMass.begin() + own.first;
    return std::find(first, first + own.count, 0.0) != first + own.count;
}

/// The lattice's particles one after the other: as they lie, or copied.
soft::Cloud ShapeMemory::cloudOf(State& state, const Lattice& lattice)
{
    const Nodes& nodes = state.nodes;
    const BodyRecord& body = state.bodies[lattice.body];
    const std::size_t count = lattice.nodes.empty() ? body.nodes.count : lattice.nodes.size();
    if (change_.size() < count) change_.resize(count);
    if (lattice.nodes.empty()) {
        const Index first = body.nodes.first;
        return {nodes.position[first].data(), nodes.velocity[first].data(), &nodes.mass[first],
                body.soft->restArms[0].data(), count};
    }
    position_.clear(), velocity_.clear(), mass_.clear();
    for (const Index n : lattice.nodes)
        position_.push_back(nodes.position[n]), velocity_.push_back(nodes.velocity[n]), mass_.push_back(nodes.mass[n]);
    return {position_[0].data(), velocity_[0].data(), mass_.data(), lattice.rest[0].data(), count};
}

/// What is nailed down has no shape of its own, neither has what flows; a twin (soft/twins.hpp) does it better.
bool ShapeMemory::forgets(const State& state, const Lattice& lattice)
{
    const SoftMatter& matter = state.bodies[lattice.body].soft->matter;
    return matter.yield > 0 || matter.shapeStiffness > 0 || anyPinned(state, lattice);
}

void ShapeMemory::look(State& state, double dt)
{
    for (Lattice& lattice : lattices_)
        if (!state.bodies[lattice.body].flown && !state.bodies[lattice.body].asleep)
            lattice.relaxed = relaxes(state, lattice, dt);
}

bool ShapeMemory::relaxes(State& state, Lattice& lattice, double dt)
{
    if (forgets(state, lattice)) return true;
    const soft::Cloud cloud = cloudOf(state, lattice);
    const soft::CloudMotion motion = match(cloud, lattice).rigid;
    lattice.rotation = Vec2(motion.c, motion.s);
    const soft::CloudStray stray = kernels_->stray(cloud, motion);
    return std::sqrt(stray.off) + std::sqrt(stray.speed) * dt < kRelaxed * lattice.tolerance;
}

bool ShapeMemory::relaxes(State& state, Index body, double dt)
{
    return std::all_of(lattices_.begin(), lattices_.end(),
                       [&](Lattice& lattice) { return lattice.body != body || relaxes(state, lattice, dt); });
}

void ShapeMemory::apply(State& state, const SoftSprings& springs, double h, std::span<const double> offs)
{
    const auto isRelaxed = [&](const Lattice& lattice) {
        if (offs.empty()) return lattice.relaxed;
        return (lattice.nodes.empty() && offs[lattice.body] <= lattice.tolerance) || forgets(state, lattice);
    };
    for (Lattice& lattice : lattices_) {
        if (state.bodies[lattice.body].flown || state.bodies[lattice.body].asleep || isRelaxed(lattice) ||
            springs.anyTorn(lattice.body))
            continue;
        const soft::Cloud cloud = cloudOf(state, lattice);
        const Motion motion = match(cloud, lattice);
        lattice.rotation = Vec2(motion.rigid.c, motion.rigid.s);
        const double rate = rateAt(lattice, h);
        const double damped = std::min(1.0, 2 * kDampingRatio * std::sqrt(rate) * h);
        double* change = change_.front().data();
        const soft::CloudPulled pulled =
            kernels_->pull(cloud, motion.rigid, {lattice.tolerance, h * rate, damped}, change);
        if (!pulled.any) continue;
        const soft::CloudReturn back = netOf(pulled, lattice, motion);
        if (lattice.nodes.empty()) {
            Vec2& first = state.nodes.velocity[state.bodies[lattice.body].nodes.first];
            kernels_->give(cloud, motion.rigid, back, change, first.data());
            continue;
        }
        kernels_->give(cloud, motion.rigid, back, change, velocity_.front().data());
        for (std::size_t i = 0; i < lattice.nodes.size(); ++i) state.nodes.velocity[lattice.nodes[i]] = velocity_[i];
    }
}

double ShapeMemory::rateAt(const Lattice& lattice, double h)
{
    return std::min(lattice.rate, kMostPhase * kMostPhase / (h * h));
}

double ShapeMemory::energy(State& state, const Lattice& lattice, double h)
{
    const soft::Cloud cloud = cloudOf(state, lattice);
    return 0.5 * rateAt(lattice, h) * soft::drawn(cloud, match(cloud, lattice).rigid, lattice.tolerance, h);
}

ShapeMemory::Motion ShapeMemory::match(const soft::Cloud& cloud, const Lattice& lattice) const
{
    const soft::CloudSums sums = kernels_->sums(cloud);
    Motion motion;
    motion.inertia = sums.inertia;
    motion.fit = std::sqrt(sums.along * sums.along + sums.across * sums.across);
    motion.certain = motion.fit > kLeastFit * lattice.inertia;
    const Vec2 rotation = motion.certain ? Vec2(Vec2(sums.along, sums.across) / motion.fit) : lattice.rotation;
    motion.rigid = {sums.x, sums.y, sums.vx, sums.vy, sums.omega(), rotation.x(), rotation.y()};
    return motion;
}

/// Takes the net momentum and angular momentum out of both parts of the pull.
///
/// dU/dx through R: the angle of the fit changes by m perpendicular(R q)·dx / fit. Without a certain R, and for the
/// damping, a rigid motion of the particles as they are; taken out of the damping it can only lower what that leaves
/// of the energy, as it is its part orthogonal to rigid motions that remains.
soft::CloudReturn ShapeMemory::netOf(const soft::CloudPulled& pulled, const Lattice& lattice, const Motion& motion)
{
    const double inertia = std::max(motion.inertia, 1e-12 * lattice.inertia);
    soft::CloudReturn back{-(pulled.x + pulled.dampedX) / lattice.mass, -(pulled.y + pulled.dampedY) / lattice.mass, 0,
                           -pulled.dampedTurn / inertia};
    if (motion.certain) {
        back.goal = -pulled.turn / motion.fit;
    } else {
        back.place -= pulled.turn / inertia;
    }
    return back;
}

}  // namespace jet::physics
