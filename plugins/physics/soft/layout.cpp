#include "layout.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

namespace jet::physics::soft {

namespace {

constexpr std::size_t kLeastInRun = 5;  // with fewer springs, gathering them with others is cheaper
// Nodes between the first ones of scattered springs computed together, at most: large bodies are cut into parts that no
// block may reach over.
constexpr std::uint32_t kWidest = 512;
constexpr std::uint32_t kAlone = 0xffffffffU;

using Order = std::vector<std::uint32_t>;

/// Row by row: particles less than half a typical spring apart across the rows are in one row.
Order byRows(const SoftBodyDef& def, int across, double row)
{
    Order order(def.particles.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto rowOf = [&](std::uint32_t i) {
        const double at = def.particles[i][across];
        return row > 0 ? std::floor(at / row + 0.5) : at;
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const double rowA = rowOf(a), rowB = rowOf(b);
        if (rowA != rowB) return rowA < rowB;
        const double alongA = def.particles[a][1 - across], alongB = def.particles[b][1 - across];
        return alongA < alongB || (alongA == alongB && a < b);
    });
    return order;
}

double shortestSpring(const SoftBodyDef& def)
{
    double shortest = 0;
    for (const SpringDef& spring : def.springs)
        if (spring.restLength > 0 && (shortest == 0 || spring.restLength < shortest)) shortest = spring.restLength;
    return shortest;
}

std::vector<Ends> endsIn(const Order& order, const SoftBodyDef& def)
{
    std::vector<std::uint32_t> node(order.size());
    for (std::uint32_t n = 0; n < order.size(); ++n) node[order[n]] = n;
    std::vector<Ends> ends;
    for (const SpringDef& spring : def.springs) ends.push_back({node[spring.a], node[spring.b]});
    return ends;
}

/// Springs as (index difference, lower node), sorted so that runs lie together.
struct Keyed {
    std::uint32_t difference, low, spring;
    friend bool operator<(const Keyed& p, const Keyed& q)
    {
        return std::tie(p.difference, p.low, p.spring) < std::tie(q.difference, q.low, q.spring);
    }
};

std::vector<Keyed> sortedByDifference(const std::vector<Ends>& springs)
{
    std::vector<Keyed> keyed;
    for (std::uint32_t i = 0; i < springs.size(); ++i) {
        const auto [low, high] = std::minmax(springs[i].a, springs[i].b);
        keyed.push_back({high - low, low, i});
    }
    std::sort(keyed.begin(), keyed.end());
    return keyed;
}

/// Calls run(base, members) for each window of 8 nodes that holds at least so many springs, lone(spring) for all
/// others. Windows start at multiples of 8, so that those of different differences have their first nodes in common;
/// the last may reach beyond the body.
template <class RunAct, class LoneAct>
void cut(const std::vector<Keyed>& keyed, std::size_t least, RunAct&& run, LoneAct&& lone)
{
    std::size_t i = 0;
    while (i < keyed.size()) {
        const std::uint32_t difference = keyed[i].difference;
        const std::uint32_t base = keyed[i].low / kLanes * kLanes;
        std::array<const Keyed*, kLanes> members{};
        std::size_t count = 0, end = i;
        std::vector<const Keyed*> doubles;
        while (end < keyed.size() && keyed[end].difference == difference && keyed[end].low < base + kLanes) {
            const Keyed*& member = members[keyed[end].low - base];
            if (member) {
                doubles.push_back(&keyed[end]);
            } else {
                member = &keyed[end], ++count;
            }
            ++end;
        }
        if (count >= least && difference > 0) {
            run(base, difference, members);
            for (const Keyed* twin : doubles) lone(*twin);
            i = end;
        } else {
            lone(keyed[i++]);
        }
    }
}

std::size_t springsInRuns(const std::vector<Ends>& springs)
{
    std::size_t alone = 0;
    cut(
        sortedByDifference(springs), kLeastInRun, [](auto&&...) {}, [&](const Keyed&) { ++alone; });
    return springs.size() - alone;
}

/// The pattern of these springs, if they have one: with hardly more runs than there must be.
Pattern patternOf(const std::vector<Keyed>& keyed, std::uint32_t nodes)
{
    Pattern pattern;
    std::vector<std::uint32_t>& differences = pattern.differences;
    for (const Keyed& spring : keyed) {
        if (!differences.empty() && differences.back() == spring.difference) continue;
        if (differences.size() == kMostDifferences || spring.difference == 0) return {};
        differences.push_back(spring.difference);
    }
    pattern.present.assign((nodes + kLanes - 1) / kLanes, 0);
    std::size_t runs = 0, alone = 0;
    cut(
        keyed, 1,
        [&](std::uint32_t base, std::uint32_t difference, auto&&) {
            const auto k = std::lower_bound(differences.begin(), differences.end(), difference) - differences.begin();
            pattern.present[base / kLanes] |= static_cast<std::uint8_t>(1U << k);
            ++runs;
        },
        [&](const Keyed&) { ++alone; });
    return alone == 0 && runs * kLeastInRun <= keyed.size() ? pattern : Pattern();
}

/// Runs with the same first nodes one after the other: the kernels read those once.
void sortByFirst(Blocks& blocks)
{
    const std::vector<Run> runs = blocks.runs;
    std::vector<std::uint32_t> order(runs.size()), place(runs.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) { return std::tuple(runs[i].a, runs[i].b, i); };
    std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) { return key(p) < key(q); });
    for (std::uint32_t at = 0; at < order.size(); ++at) blocks.runs[at] = runs[order[at]], place[order[at]] = at;
    for (std::uint32_t& seat : blocks.seat)
        if (seat != kAlone) seat = place[seat / kLanes] * kLanes + seat % kLanes;
}

/// Nodes from the first one of a block to the last, at most.
std::uint32_t reachOf(const Blocks& blocks)
{
    std::uint32_t reach = 0;
    for (const Run& run : blocks.runs) reach = std::max(reach, run.b + kLanes - run.a);
    for (std::size_t at = 0; at < blocks.ends.size(); at += 2 * kLanes) {
        const std::uint32_t* ends = blocks.ends.data() + at;
        reach = std::max(reach, *std::max_element(ends, ends + 2 * kLanes) + 1 - ends[0]);
    }
    return reach;
}

}  // namespace

Order orderOf(const SoftBodyDef& def)
{
    Order best(def.particles.size());
    std::iota(best.begin(), best.end(), 0U);
    const auto nodes = static_cast<std::uint32_t>(best.size());
    if (nodes < kLanes || def.springs.size() < kLanes) return best;
    std::size_t most = springsInRuns(endsIn(best, def));
    const double row = 0.5 * shortestSpring(def);
    for (int across : {1, 0}) {
        Order order = byRows(def, across, row);
        const std::size_t inRuns = springsInRuns(endsIn(order, def));
        if (inRuns <= most) continue;
        most = inRuns;
        best = std::move(order);
    }
    return best;
}

Blocks arrange(const std::vector<Ends>& springs, std::uint32_t nodes)
{
    Blocks blocks;
    blocks.seat.assign(springs.size(), 0);
    std::vector<std::uint32_t> alone;
    const std::vector<Keyed> keyed = sortedByDifference(springs);
    blocks.pattern = patternOf(keyed, nodes);
    cut(
        keyed, blocks.pattern.differences.empty() ? kLeastInRun : 1,
        [&](std::uint32_t base, std::uint32_t difference, const auto& members) {
            for (std::uint32_t k = 0; k < kLanes; ++k)
                if (members[k])
                    blocks.seat[members[k]->spring] = static_cast<std::uint32_t>(blocks.runs.size()) * kLanes + k;
            blocks.runs.push_back({base, base + difference});
        },
        [&](const Keyed& spring) { alone.push_back(spring.spring), blocks.seat[spring.spring] = kAlone; });
    sortByFirst(blocks);
    // Scattered springs in the order of their nodes: neighbours in memory are computed together.
    std::sort(alone.begin(), alone.end(), [&](std::uint32_t p, std::uint32_t q) {
        const auto key = [&](std::uint32_t i) {
            return std::tuple(std::min(springs[i].a, springs[i].b), std::max(springs[i].a, springs[i].b), i);
        };
        return key(p) < key(q);
    });
    for (std::size_t at = 0, taken = 0; at < alone.size(); at += taken) {
        const auto block = static_cast<std::uint32_t>(blocks.count());
        const std::uint32_t low = std::min(springs[alone[at]].a, springs[alone[at]].b);
        taken = 0;
        blocks.ends.resize(blocks.ends.size() + 2 * kLanes, low);  // of lanes without a spring
        std::uint32_t* ends = blocks.ends.data() + blocks.ends.size() - 2 * kLanes;
        for (std::uint32_t k = 0; k < kLanes && at + k < alone.size(); ++k, ++taken) {
            const std::uint32_t spring = alone[at + k];
            if (std::min(springs[spring].a, springs[spring].b) > low + kWidest) break;
            ends[k] = std::min(springs[spring].a, springs[spring].b);
            ends[kLanes + k] = std::max(springs[spring].a, springs[spring].b);
            blocks.seat[spring] = block * kLanes + k;
        }
    }
    blocks.reach = reachOf(blocks);
    return blocks;
}

}  // namespace jet::physics::soft
