#include "soft_springs.hpp"

#include "room.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

namespace jet::physics {

namespace {

std::size_t strideOf(std::size_t room) { return room + soft::kLanes; }

constexpr double kCrush = 0.4;  // substeps: damping of crushed springs by their stiffness
// The kernels watch for springs longer than this part of what they hold; their lengths are single.
constexpr double kTearWatch = 0.9999;
// Fewer springs than this are computed in double, one by one.
constexpr std::size_t kFewSprings = 16;
// Numbers the kernels take; outside this range, products could leave that of single.
constexpr double kLeastSingle = 1e-15, kMostSingle = 1e15;

bool fitsKernels(const SoftBodyDef& def)
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
    meshes_.resize(std::max<std::size_t>(meshes_.size(), body + std::size_t{1}));
    torn_.resize(meshes_.size(), 0);
    Mesh& mesh = meshes_[body];
    mesh.nodes = state.bodies[body].nodes;
    mesh.springs = state.bodies[body].soft->springs;
    for (const SpringDef& spring : def.springs) mesh.tears |= spring.tearRatio > 0;
    const std::size_t count = def.springs.size();
    if (mesh.springs.first == springCount()) {
        const auto extend = [count](auto& rows) { makeRoom(count, rows), rows.resize(rows.size() + count); };
        const bool flowed = !drawn_.empty();
        extend(a_), extend(b_), extend(rest_), extend(kind_), extend(alive_);
        if (flowed) extend(drawn_);
    }
    dropUnusedKinds();
    for (Index k = 0; k < count; ++k) {
        const SpringDef& spring = def.springs[k];
        const Index i = mesh.springs.first + k;
        a_[i] = nodeOf[spring.a], b_[i] = nodeOf[spring.b];
        rest_[i] = spring.restLength;
        if (!drawn_.empty()) drawn_[i] = spring.restLength;
        kind_[i] = kindLike(spring);
        alive_[i] = spring.a != spring.b;
    }
    const bool wide = fitsKernels(def);
    anyOneByOne_ |= !wide && count > 0;
    if (wide) {
        mesh.wide = true;
        mesh.topology = soft::Topology::of(def);
        measureBias(state, mesh);
        arranged_ = false;
    }
    Index place = state.bodies[body].soft->angularSprings.first;
    for (const AngularSpringDef& spring : def.angularSprings) addAngular(state, spring, nodeOf, body, place++);
}

/// Its rows stay for another body's.
void SoftSprings::remove(Index body)
{
    Mesh& mesh = meshes_[body];
    const Range rows = mesh.springs;
    if (mesh.wide && arranged_ && !batches_[mesh.batch].alike()) batches_[mesh.batch].bodies.front() = kNone;
    if (mesh.wide) arranged_ = false;
    std::fill_n(alive_.begin() + rows.first, rows.count, std::uint8_t{0});
    std::fill_n(kind_.begin() + rows.first, rows.count, Index{0});
    for (Angular& spring : angular_) {
        if (spring.a == kNone || spring.a < mesh.nodes.first || spring.a >= mesh.nodes.end()) continue;
        spring = Angular(), --turning_;
    }
    mesh = Mesh();
    torn_[body] = 0;
    anyTorn_ = std::any_of(torn_.begin(), torn_.end(), [](Index torn) { return torn > 0; });
    anyOneByOne_ = std::any_of(meshes_.begin(), meshes_.end(),
                               [](const Mesh& other) { return !other.wide && other.springs.count > 0; });
}

/// Where bodies of ever other springs come and go.
void SoftSprings::dropUnusedKinds()
{
    constexpr std::size_t kFew = 64;
    if (kinds_.size() <= kFew + kind_.size()) return;
    std::vector<Index> numbers(kinds_.size(), kNone);
    std::vector<Kind> used;
    for (Index& kind : kind_) {
        Index& number = numbers[kind];
        if (number == kNone) number = static_cast<Index>(used.size()), used.push_back(kinds_[kind]);
        kind = number;
    }
    kinds_.swap(used);
}

/// One of the last kinds, where the spring is like it; else a new one.
Index SoftSprings::kindLike(const SpringDef& spring)
{
    constexpr std::size_t kTried = 16;
    const Kind kind{spring.ks, spring.kd, std::max(spring.tearRatio, 0.0)};
    const std::size_t oldest = kinds_.size() > kTried ? kinds_.size() - kTried : 0;
    for (std::size_t k = kinds_.size(); k-- > oldest;)
        if (kinds_[k].ks == kind.ks && kinds_[k].kd == kind.kd && kinds_[k].tearRatio == kind.tearRatio)
            return static_cast<Index>(k);
    makeRoom(1, kinds_);
    kinds_.push_back(kind);
    return static_cast<Index>(kinds_.size() - 1);
}

/// Finds which bodies are computed together.
void SoftSprings::arrange(const State& state)
{
    if (arranged_) return;
    arranged_ = true;
    drift_.assign(state.bodies.size(), Vec2(0, 0));
    std::vector<soft::Candidate> candidates;
    for (Index body = 0; body < meshes_.size(); ++body) {
        const Mesh& mesh = meshes_[body];
        if (!mesh.wide) continue;
        soft::Candidate& candidate = candidates.emplace_back();
        candidate.body = body, candidate.topology = mesh.topology;
        for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i)
            candidate.ends.push_back({a_[i] - mesh.nodes.first, b_[i] - mesh.nodes.first});
    }
    batches_ = soft::batchesOf(state, std::move(candidates), std::move(batches_));
    std::size_t room = 0, most = 0, parts = 1, head = 0;
    for (Index k = 0; k < batches_.size(); ++k) {
        soft::Batch& batch = batches_[k];
        batch.rest.assign(batch.blocks.count() * soft::kLanes, 0);
        batch.tear.clear();
        for (Index lane = 0; lane < batch.bodies.size(); ++lane)
            meshes_[batch.bodies[lane]].batch = k, meshes_[batch.bodies[lane]].lane = lane;
        room = std::max(room, soft::Planes::kCount * strideOf(batch.room()) + (batch.gathers() ? 4 * batch.room() : 0));
        most = std::max(most, batch.blocks.count());
        batch.divide();
        parts = std::max(parts, batch.parts.size());
        if (batch.parts.size() > 1) head = std::max(head, soft::headFor(batch.blocks.reach));
    }
    rooms_.resize(parts);
    for (Room& own : rooms_)
        own.planes.resize(room), own.torn.resize(most), own.held.resize(2 * head), own.spilt.resize(2 * head);
    makeFlightRoom();
}

/// From now on the kernels watch the lengths of the batch's springs.
void SoftSprings::watchTears(soft::Batch& batch)
{
    const auto tears = [&](Index body) {
        return meshes_[body].tears || (meshes_[body].uniform && meshes_[body].tearRatio > 0);
    };
    if (!batch.tear.empty() || std::none_of(batch.bodies.begin(), batch.bodies.end(), tears)) return;
    batch.tear.assign(batch.blocks.count() * soft::kLanes, std::numeric_limits<float>::max());
}

void SoftSprings::prepare(const State& state, const StiffnessBounds& bounds, double h, bool plain)
{
    arrange(state);
    crush_ = plain ? 0 : kCrush * h;
    for (soft::Batch& batch : batches_) watchTears(batch), batch.part();
    for (Index body = 0; body < meshes_.size(); ++body) {
        Mesh& mesh = meshes_[body];
        stiffness_.resize(mesh.springs.count), damping_.resize(mesh.springs.count);
        for (Index i = 0; i < mesh.springs.count; ++i)
            stiffness_[i] = stiffnessOf(mesh, mesh.springs.first + i),
            damping_[i] = dampingOf(mesh, mesh.springs.first + i);
        if (!plain) prepareMesh(state, bounds, mesh, state.bodies[body], h);
        fill(mesh);
    }
    for (soft::Batch& batch : batches_) batch.share();
    for (std::vector<double>* scratch : {&stiffness_, &damping_, &load_}) *scratch = std::vector<double>();
    if (plain) return;
    for (Angular& spring : angular_) {
        if (spring.a == kNone) continue;
        const double share =
            std::min({bounds.share(spring.a, h), bounds.share(spring.centre, h), bounds.share(spring.b, h)});
        spring.stiffness = spring.ks * share;
        spring.damping = spring.kd + h * (spring.ks - spring.stiffness);
    }
}

/// A body drawn at rest shall rest: what rounding to single adds to the lengths of springs is added to what they rest
/// at.
void SoftSprings::measureBias(const State& state, Mesh& mesh)
{
    const Vec2& origin = state.nodes.position[mesh.nodes.first];
    const auto place = [&](Index node, int axis) {
        return static_cast<float>(state.nodes.position[node][axis] - origin[axis]);
    };
    mesh.bias.reserve(mesh.springs.count);
    for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
        const Index low = std::min(a_[i], b_[i]), high = std::max(a_[i], b_[i]);
        const float x = place(low, 0) - place(high, 0), y = place(low, 1) - place(high, 1);
        const double length = (state.nodes.position[low] - state.nodes.position[high]).norm();
        mesh.bias.push_back(static_cast<float>(static_cast<double>(std::sqrt(x * x + y * y)) - length));
    }
}

/// Puts what was prepared of the body where its springs are computed.
void SoftSprings::fill(Mesh& mesh)
{
    if (!mesh.wide) {
        mesh.stiffness = stiffness_, mesh.damping = damping_;
        return;
    }
    soft::Batch& batch = batches_[mesh.batch];
    for (Index k = 0; k < mesh.springs.count; ++k) {
        const Index i = mesh.springs.first + k;
        const std::uint32_t seat = batch.seat(mesh.lane, k);
        float* at = batch.spring(seat);
        at[0] = alive_[i] ? static_cast<float>(stiffness_[k]) : 0;
        at[soft::kLanes] = alive_[i] ? static_cast<float>(damping_[k]) : 0;
        if (batch.tear.empty()) continue;
        const double longest = tearLength(mesh, i);
        batch.tear[seat] =
            alive_[i] && longest > 0 ? static_cast<float>(kTearWatch * longest) : std::numeric_limits<float>::max();
    }
    fillRests(mesh);
}

void SoftSprings::fillRests(const Mesh& mesh)
{
    if (!mesh.wide) return;
    soft::Batch& batch = batches_[mesh.batch];
    for (Index k = 0; k < mesh.springs.count; ++k)
        batch.rest[batch.seat(mesh.lane, k)] =
            static_cast<float>(rest_[mesh.springs.first + k] + static_cast<double>(mesh.bias[k]));
}

void SoftSprings::addForces(State& state)
{
    for (Index body = 0; body < meshes_.size(); ++body)
        if (!meshes_[body].wide && !state.bodies[body].asleep) pullOneByOne(state, meshes_[body]);
}

soft::Planes SoftSprings::planes(const soft::Batch& batch, Room& room)
{
    const std::size_t nodes = batch.room(), stride = strideOf(nodes);
    float* const first = room.planes.data();
    return {first, stride, batch.gathers() ? first + soft::Planes::kCount * stride : nullptr, nodes};
}

void SoftSprings::accelerate(State& state, double h, const Vec2& gravity, double kept, bool pushed)
{
    drift_.resize(state.bodies.size(), Vec2(0, 0));
    double* force = pushed ? state.nodes.force.values().data()->data() : nullptr;
    const auto asleep = [&](Index body) { return state.bodies[body].asleep; };
    for (soft::Batch& batch : batches_) {
        if (std::all_of(batch.bodies.begin(), batch.bodies.end(), asleep)) continue;
        if (batch.alike()) {
            accelerateAlike(state, batch, h, gravity, kept, force);
        } else if (!state.bodies[batch.bodies.front()].flown) {
            accelerateAlone(state, batch, {h, gravity.x(), gravity.y(), kept}, force);
        }
    }
}

soft::Frame SoftSprings::frameOf(const State& state, Index body) const
{
    const Index first = meshes_[body].nodes.first;
    const Vec2 &at = state.nodes.position[first], &moving = state.nodes.velocity[first];
    return {at.x(), at.y(), moving.x(), moving.y()};
}

soft::SpringBlocks SoftSprings::springsOf(const soft::Batch& batch, Room& room) const
{
    const soft::Blocks& blocks = batch.blocks;
    return {blocks.runs.data(), blocks.runs.size(),
            blocks.ends.data(), blocks.ends.size() / (2 * soft::kLanes),
            batch.rest.data(),  batch.kind.data(),
            batch.kinds.data(), batch.tear.empty() ? nullptr : batch.tear.data(),
            room.torn.data(),   static_cast<float>(crush_),
            blocks.reach};
}

namespace {

/// What rounding leaves of forces that sum to nothing is taken out of the whole body's acceleration.
Vec2 leftOver(double x, double y, double mass)
{
    const Vec2 net = Vec2(x, y) / mass;
    return net.squaredNorm() < 1e300 ? net : Vec2(0, 0);
}

}  // namespace

void SoftSprings::accelerateAlone(State& state, soft::Batch& batch, soft::VelocityStep step, double* force)
{
    Nodes& nodes = state.nodes;
    const Index handle = batch.bodies.front();
    const BodyRecord& body = state.bodies[handle];
    const std::size_t first = body.nodes.first;
    step.gravityX *= body.gravityScale, step.gravityY *= body.gravityScale;
    const soft::Swing swing =
        this->swing(state, batch,
                    {nodes.position[first].data(), nodes.velocity[first].data(), force ? force + 2 * first : nullptr,
                     &nodes.invMass[first], body.nodes.count},
                    step);
    // Taken out as the body moves on. Pins take it up where there are any.
    drift_[handle] =
        swing.pinned ? Vec2(0, 0) : Vec2(-step.kept * step.h * leftOver(swing.x, swing.y, body.soft->mass));
}

soft::Stretch SoftSprings::partOf(const soft::Batch& batch, std::size_t k)
{
    soft::Stretch part = batch.parts[k];
    part.held = rooms_[k].held.data();
    part.spilt = k + 1 < batch.parts.size() ? rooms_[k].spilt.data() : nullptr;
    return part;
}

/// Part by part, all at once; then what reaches from each into the next.
soft::Swing SoftSprings::swing(const State& state, soft::Batch& batch, const soft::NodeArrays& nodes,
                               const soft::VelocityStep& step)
{
    const soft::Frame frame = frameOf(state, batch.bodies.front());
    const std::size_t count = batch.parts.size();
    std::array<soft::Swing, 8> swings;
    state.run(count, [&](std::size_t k) {
        swings[k] = kernels_->swing(springsOf(batch, rooms_[k]), nodes, frame, step, planes(batch, rooms_[k]),
                                    partOf(batch, k));
    });
    if (count > 1)
        state.run(count, [&](std::size_t k) {
            if (k == 0) return;
            swings[4 + k] =
                kernels_->join(nodes, step, planes(batch, rooms_[k]), partOf(batch, k), rooms_[k - 1].spilt.data());
        });
    soft::Swing all;
    for (const soft::Swing& swing : swings) all.x += swing.x, all.y += swing.y, all.pinned |= swing.pinned;
    for (std::size_t k = 0; k < count; ++k)
        if (swings[k].torn > 0) tearIn(state, batch, {rooms_[k].torn.data(), swings[k].torn});
    return all;
}

void SoftSprings::accelerateAlike(State& state, soft::Batch& batch, double h, const Vec2& gravity, double kept,
                                  double* force)
{
    Nodes& nodes = state.nodes;
    double* velocity = nodes.velocity.data()->data();
    std::array<soft::Frame, soft::kLanes> frames;
    for (Index lane = 0; lane < soft::kLanes; ++lane) frames[lane] = frameOf(state, bodyOf(batch, lane));
    const soft::Planes planes = SoftSprings::planes(batch, rooms_.front());
    kernels_->relateAlike(nodes.position.data()->data(), velocity, batch.nodeAt.data(), batch.rows, frames.data(),
                          planes);
    const std::size_t torn = kernels_->pull(springsOf(batch, rooms_.front()), planes);
    if (torn > 0) tearIn(state, batch, {rooms_.front().torn.data(), torn});
    std::array<double, 2 * std::size_t{soft::kLanes}> left{};
    kernels_->sumAlike(planes, batch.rows, left.data());
    std::array<soft::VelocityStep, soft::kLanes> steps;
    for (Index lane = 0; lane < batch.bodies.size(); ++lane) {
        const BodyRecord& body = state.bodies[batch.bodies[lane]];
        const Vec2 fall =
            body.gravityScale * gravity - leftOver(left[lane], left[soft::kLanes + lane], body.soft->mass);
        steps[lane] = {h, fall.x(), fall.y(), kept};
    }
    kernels_->accelerateAlike(velocity, force, nodes.invMass.data(), batch.nodeAt.data(), batch.rows,
                              batch.bodies.size(), steps.data(), planes);
}

void SoftSprings::advance(State& state, Index handle, double h) const
{
    Nodes& nodes = state.nodes;
    const Range& own = state.bodies[handle].nodes;
    const Vec2 drift = handle < drift_.size() ? drift_[handle] : Vec2(0, 0);
    const auto move = [&](std::size_t first, std::size_t end) {
        kernels_->advance(nodes.position[own.first + first].data(), nodes.velocity[own.first + first].data(),
                          end - first, h, drift.x(), drift.y());
    };
    const std::size_t parts = meshes_[handle].wide ? batches_[meshes_[handle].batch].parts.size() : 1;
    if (parts <= 1) return move(0, own.count);
    // Where it was accelerated.
    const std::vector<soft::Stretch>& part = batches_[meshes_[handle].batch].parts;
    state.run(parts, [&](std::size_t k) { move(part[k].first, part[k].end); });
}

/// Lanes without a body stand for the first.
Index SoftSprings::bodyOf(const soft::Batch& batch, Index lane) const
{
    return batch.bodies[lane < batch.bodies.size() ? lane : 0];
}

/// The kernels only warn, of blocks: whether a spring of one is too long is decided in
/// double, so that it tears at exactly its length. Its last force, of a length that differs by rounding, still acts.
void SoftSprings::tearIn(const State& state, const soft::Batch& batch, std::span<std::uint32_t> blocks)
{
    std::sort(blocks.begin(), blocks.end());
    for (Index lane = 0; lane < batch.bodies.size(); ++lane) {
        Mesh& mesh = meshes_[batch.bodies[lane]];
        for (Index k = 0; k < mesh.springs.count; ++k) {
            const std::uint32_t block = batch.seat(lane, k) / soft::kLanes;
            if (!std::binary_search(blocks.begin(), blocks.end(), block)) continue;
            const Index i = mesh.springs.first + k;
            if (!alive_[i] || !(tearLength(mesh, i) > 0)) continue;
            const double length = (state.nodes.position[a_[i]] - state.nodes.position[b_[i]]).norm();
            if (length > tearLength(mesh, i)) tear(mesh, i);
        }
    }
}

void SoftSprings::tear(Mesh& mesh, Index spring)
{
    alive_[spring] = 0;
    ++torn_[&mesh - meshes_.data()];
    anyTorn_ = true;
    if (!mesh.wide) return;
    soft::Batch& batch = batches_[mesh.batch];
    batch.cut(batch.seat(mesh.lane, spring - mesh.springs.first));
}

void SoftSprings::pullOneByOne(State& state, Mesh& mesh)
{
    Nodes& nodes = state.nodes;
    for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
        if (!alive_[i]) continue;
        const Index a = a_[i], b = b_[i];
        const Vec2 apart = nodes.position[a] - nodes.position[b];
        const double length = std::sqrt(apart.squaredNorm());
        const double longest = tearLength(mesh, i);
        if (longest > 0 && length > longest) {
            tear(mesh, i);
            continue;
        }
        if (!(length > 1e-12)) continue;
        const Vec2 along = apart / length;
        const double speed = (nodes.velocity[a] - nodes.velocity[b]).dot(along);
        const Index k = i - mesh.springs.first;
        const bool crushed = length < static_cast<double>(soft::kCrushed) * rest_[i];
        const double damping = mesh.damping[k] + (crushed ? crush_ * mesh.stiffness[k] : 0);
        const Vec2 force = (mesh.stiffness[k] * (length - rest_[i]) + damping * speed) * along;
        nodes.force.add(a, -force);
        nodes.force.add(b, force);
    }
}

void SoftSprings::set(Index body, double ks, double kd, double tearRatio)
{
    Mesh& mesh = meshes_[body];
    mesh.uniform = true;
    mesh.ks = ks, mesh.kd = kd, mesh.tearRatio = std::max(tearRatio, 0.0);
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

double SoftSprings::energy(const State& state, Index body, double h) const
{
    const Mesh& mesh = meshes_[body];
    const Nodes& nodes = state.nodes;
    double twice = 0;
    for (Index k = 0; k < mesh.springs.count; ++k) {
        const Index i = mesh.springs.first + k;
        if (!alive_[i]) continue;
        const Vec2 apart = nodes.position[a_[i]] - nodes.position[b_[i]];
        const Vec2 before = apart - h * (nodes.velocity[a_[i]] - nodes.velocity[b_[i]]);
        const double ks =
            mesh.wide ? static_cast<double>(batches_[mesh.batch].spring(batches_[mesh.batch].seat(mesh.lane, k)))
                      : mesh.stiffness[k];
        twice += ks * (apart.norm() - rest_[i]) * (before.norm() - rest_[i]);
    }
    double held = 0.5 * twice;
    const Range& turning = state.bodies[body].soft->angularSprings;
    for (Index i = turning.first; i < turning.end(); ++i) held += energy(state, angular_[i], h);
    return held;
}

/// Bingham's body: elastic up to the yield, then the strain beyond it fades at the rate `creep`.
///
/// It is the strain half way along the last move that flows. What swings under symplectic Euler holds ½ ks e e', e' the
/// strain before that move: a flow d changes that by ½ ks d (d - e - e'), and so takes energy wherever d is a part of
/// (e + e') / 2. By the strain e alone it would feed what swings fast, as e and e' have opposite signs there.
void SoftSprings::flow(const State& state, double dt, double h)
{
    const Nodes& nodes = state.nodes;
    for (Index body = 0; body < meshes_.size(); ++body) {
        Mesh& mesh = meshes_[body];
        if (mesh.springs.count == 0 || !state.bodies[body].enabled || state.bodies[body].asleep) continue;
        const SoftMatter& matter = state.bodies[body].soft->matter;
        if (!(matter.yield > 0)) continue;
        const double part = 1 - decay(matter.creep * dt);
        bool flowed = false;
        for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) {
            if (!alive_[i] || !(rest_[i] > 0)) continue;
            const Vec2 apart = nodes.position[a_[i]] - nodes.position[b_[i]];
            const Vec2 before = apart - h * (nodes.velocity[a_[i]] - nodes.velocity[b_[i]]);
            const double strain = 0.5 * (apart.norm() + before.norm()) / rest_[i] - 1;
            const double beyond = strain - std::clamp(strain, -matter.yield, matter.yield);
            if (beyond == 0) continue;
            if (drawn_.empty()) drawn_ = rest_;
            rest_[i] = std::clamp(rest_[i] * (1 + part * beyond), (1 - matter.mostFlow) * drawn_[i],
                                  (1 + matter.mostFlow) * drawn_[i]);
            flowed = true;
        }
        if (flowed) fillRests(mesh);
    }
}

void SoftSprings::restored()
{
    anyTorn_ = false;
    for (std::size_t body = 0; body < meshes_.size(); ++body) {
        const Mesh& mesh = meshes_[body];
        torn_[body] = 0;
        for (Index i = mesh.springs.first; i < mesh.springs.end(); ++i) torn_[body] += !alive_[i] && a_[i] != b_[i];
        anyTorn_ |= torn_[body] > 0;
    }
}

}  // namespace jet::physics
