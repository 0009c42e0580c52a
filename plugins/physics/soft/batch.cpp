#include "batch.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace jet::physics::soft {

namespace {

constexpr std::size_t kOfKind = 2 * std::size_t{kLanes};  // numbers a kind has

std::uint32_t bitsOf(float value)
{
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

/// Particle of each node of the body.
std::vector<Index> particleOf(const State& state, Index body)
{
    const BodyRecord& record = state.bodies[body];
    std::vector<Index> particle(record.nodes.count);
    for (Index p = 0; p < record.points.count; ++p)
        particle[state.points.node[record.points.first + p] - record.nodes.first] = p;
    return particle;
}

std::vector<Ends> betweenParticles(const State& state, const Candidate& candidate)
{
    const std::vector<Index> particle = particleOf(state, candidate.body);
    std::vector<Ends> ends;
    ends.reserve(candidate.ends.size());
    for (const Ends& spring : candidate.ends) ends.push_back({particle[spring.a], particle[spring.b]});
    return ends;
}

Batch alike(const State& state, const std::vector<const Candidate*>& group, const std::vector<Ends>& ends)
{
    Batch batch;
    batch.rows = group.front()->topology.particles;
    for (const Candidate* candidate : group) batch.bodies.push_back(candidate->body);
    batch.nodeAt.resize(std::size_t{batch.rows} * kLanes);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const Index body = batch.bodies[lane < batch.bodies.size() ? lane : 0];
        for (Index row = 0; row < batch.rows; ++row)
            batch.nodeAt[std::size_t{row} * kLanes + lane] = state.points.node[state.bodies[body].points.first + row];
    }
    // Springs with the same first particle one after the other, as in arrange().
    std::vector<std::uint32_t> order(ends.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) {
        return std::tuple(std::min(ends[i].a, ends[i].b), std::max(ends[i].a, ends[i].b), i);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) { return key(p) < key(q); });
    batch.blocks.seat.resize(ends.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) {
        const auto [low, high, spring] = key(order[k]);
        batch.blocks.runs.push_back({low * kLanes, high * kLanes});
        batch.blocks.seat[spring] = k * kLanes;
    }
    return batch;
}

Batch alone(const Candidate& candidate, std::map<Index, Batch*>& known)
{
    const auto found = known.find(candidate.body);
    if (found != known.end()) return std::move(*found->second);
    Batch batch;
    batch.bodies = {candidate.body};
    batch.rows = candidate.topology.particles;
    batch.blocks = arrange(candidate.ends, batch.rows);
    return batch;
}

bool equal(const std::vector<Ends>& p, const std::vector<Ends>& q)
{
    return std::equal(p.begin(), p.end(), q.begin(), q.end(),
                      [](const Ends& a, const Ends& b) { return a.a == b.a && a.b == b.b; });
}

}  // namespace

void Batch::divide()
{
    constexpr std::size_t kLeastPart = 4096, kMostParts = 4;  // nodes
    const std::size_t head = headFor(blocks.reach), least = std::max(kLeastPart, 2 * head);
    const std::size_t count = std::clamp<std::size_t>(rows / least, 1, kMostParts);
    parts.assign(count, Stretch());
    for (std::size_t k = 0; k < count; ++k) {
        Stretch& part = parts[k];
        part.first = k == 0 ? 0 : parts[k - 1].end;
        part.end = k + 1 == count ? rows : (k + 1) * rows / count / kPortion * kPortion;
        part.head = k == 0 ? 0 : head;
        const auto before = [](const Run& run, std::size_t node) { return run.a < node; };
        part.run = static_cast<std::size_t>(
            std::lower_bound(blocks.runs.begin(), blocks.runs.end(), part.first, before) - blocks.runs.begin());
        while (part.scattered * 2 * kLanes < blocks.ends.size() &&
               blocks.ends[part.scattered * 2 * kLanes] < part.first)
            ++part.scattered;
    }
}

void Batch::part()
{
    kind.resize(blocks.count());
    std::iota(kind.begin(), kind.end(), 0U);
    kinds.assign(blocks.count() * kOfKind, 0);
    shared = 0;
}

void Batch::share()
{
    std::vector<float> distinct;
    std::map<std::uint64_t, std::uint32_t> known;  // by a hash: kinds of equal ones that differ are kept twice
    for (std::uint32_t& of : kind) {
        const float* own = &kinds[of * kOfKind];
        std::uint64_t hash = 0xcbf29ce484222325U;
        for (std::size_t i = 0; i < kOfKind; ++i) hash = (hash ^ bitsOf(own[i])) * 0x100000001b3U;
        const auto next = static_cast<std::uint32_t>(distinct.size() / kOfKind);
        of = known.emplace(hash, next).first->second;
        if (of != next && std::equal(own, own + kOfKind, &distinct[of * kOfKind])) continue;
        of = next;
        distinct.insert(distinct.end(), own, own + kOfKind);
    }
    kinds = std::vector<float>(distinct.begin(), distinct.end());
    shared = static_cast<std::uint32_t>(kinds.size() / kOfKind);
}

void Batch::cut(std::uint32_t seat)
{
    std::uint32_t& of = kind[seat / kLanes];
    if (of < shared) {
        std::array<float, kOfKind> own;
        std::copy_n(&kinds[of * kOfKind], kOfKind, own.begin());
        of = static_cast<std::uint32_t>(kinds.size() / kOfKind);
        kinds.insert(kinds.end(), own.begin(), own.end());
    }
    float* at = spring(seat);
    at[0] = at[kLanes] = 0;
    tear[seat] = std::numeric_limits<float>::max();
}

std::size_t Batch::bytes() const
{
    return bodies.capacity() * sizeof(Index) + nodeAt.capacity() * sizeof(Index) +
           blocks.runs.capacity() * sizeof(Run) + parts.capacity() * sizeof(Stretch) +
           (blocks.ends.capacity() + blocks.seat.capacity()) * sizeof(std::uint32_t) +
           blocks.pattern.differences.capacity() * sizeof(std::uint32_t) + blocks.pattern.present.capacity() +
           kind.capacity() * sizeof(std::uint32_t) +
           (rest.capacity() + kinds.capacity() + tear.capacity()) * sizeof(float);
}

Topology Topology::of(const SoftBodyDef& def)
{
    Topology topology;
    topology.particles = static_cast<Index>(def.particles.size());
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto mix = [&](std::uint32_t value) { hash = (hash ^ value) * 0x100000001b3U; };
    for (const SpringDef& spring : def.springs) mix(spring.a), mix(spring.b);
    mix(static_cast<std::uint32_t>(def.springs.size()));
    topology.hash = hash;
    return topology;
}

std::vector<Batch> batchesOf(const State& state, std::vector<Candidate> candidates, std::vector<Batch> before)
{
    std::map<Index, Batch*> known;
    for (Batch& batch : before)
        if (!batch.alike()) known[batch.bodies.front()] = &batch;
    std::map<std::pair<Index, std::uint64_t>, std::vector<const Candidate*>> kinds;
    for (const Candidate& candidate : candidates)
        kinds[{candidate.topology.particles, candidate.topology.hash}].push_back(&candidate);
    std::vector<Batch> batches;
    for (const auto& [kind, members] : kinds) {
        const std::vector<Ends> ends =
            members.size() < kLeastAlike ? std::vector<Ends>() : betweenParticles(state, *members.front());
        std::vector<const Candidate*> group;
        const auto close = [&] {
            if (group.size() >= kLeastAlike) {
                batches.push_back(alike(state, group, ends));
            } else {
                for (const Candidate* candidate : group) batches.push_back(alone(*candidate, known));
            }
            group.clear();
        };
        for (const Candidate* candidate : members) {
            // Equal sums of different springs are as good as impossible, and would be wrong.
            if (members.size() < kLeastAlike || !equal(betweenParticles(state, *candidate), ends)) {
                batches.push_back(alone(*candidate, known));
                continue;
            }
            group.push_back(candidate);
            if (group.size() == kLanes) close();
        }
        close();
    }
    return batches;
}

}  // namespace jet::physics::soft
