#include "tears.hpp"

#include "border.hpp"

#include <limits>
#include <numeric>

namespace jet::physics::soft {

/// Springs of one body, by particle.
struct Tears::Mesh {
    struct Link {
        Index to;  // particle
        bool whole;
    };
    std::vector<Index> first;  // [particles + 1] into links
    std::vector<Link> links;
    std::vector<Vec2> rest;  // [particles]

    Mesh(const State& state, const SoftSprings& springs, const BodyRecord& body)
    {
        const Index count = body.points.count;
        std::vector<Index> particleOf(body.nodes.count);
        for (Index p = 0; p < count; ++p) particleOf[state.points.node[body.points.first + p] - body.nodes.first] = p;
        first.assign(count + std::size_t{1}, 0);
        rest.resize(count);
        for (Index k = 0; k < count; ++k) rest[particleOf[k]] = body.soft->restArms[k];
        const auto ends = [&](Index i) {
            return std::pair(particleOf[springs.endA(i) - body.nodes.first],
                             particleOf[springs.endB(i) - body.nodes.first]);
        };
        for (Index i = body.soft->springs.first; i < body.soft->springs.end(); ++i) {
            const auto [a, b] = ends(i);
            ++first[a + 1], ++first[b + 1];
        }
        std::partial_sum(first.begin(), first.end(), first.begin());
        links.resize(first.back());
        std::vector<Index> next(first.begin(), first.end() - 1);
        for (Index i = body.soft->springs.first; i < body.soft->springs.end(); ++i) {
            const auto [a, b] = ends(i);
            links[next[a]++] = {b, springs.alive(i)};
            links[next[b]++] = {a, springs.alive(i)};
        }
    }

    std::span<const Link> at(Index particle) const
    {
        return {links.data() + first[particle], first[particle + 1] - first[particle]};
    }
    bool joined(Index a, Index b) const
    {
        for (const Link& link : at(a))
            if (link.to == b) return true;
        return false;
    }
    /// A wall without a spring, as drawn, holds; else one of its springs must.
    bool holds(Index a, Index b) const
    {
        bool any = false;
        for (const Link& link : at(a)) {
            if (link.to != b) continue;
            if (link.whole) return true;
            any = true;
        }
        return !any;
    }
    /// Of the region at rest, as the ring goes round it.
    double area(std::span<const Index> ring) const
    {
        double twice = 0;
        for (std::size_t i = 0; i < ring.size(); ++i)
            twice += cross(rest[ring[i]] - rest[ring[0]], rest[ring[(i + 1) % ring.size()]] - rest[ring[0]]);
        return 0.5 * twice;
    }
    /// The particle behind the wall, on the side `inward` times the clockwise normal; kNone: there is none.
    Index behind(Index p, Index q, double inward) const
    {
        Index best = kNone;
        double least = std::numeric_limits<double>::infinity();
        const Vec2 normal = inward * perpendicular(rest[q] - rest[p]);
        for (const Link& link : at(p)) {
            const Index c = link.to;
            if (c == q || c == p || !joined(c, q)) continue;
            const Vec2 toP = rest[p] - rest[c], toQ = rest[q] - rest[c];
            if (!(-toP.dot(normal) > 0)) continue;
            const double cosine = toP.dot(toQ) / std::sqrt(toP.squaredNorm() * toQ.squaredNorm());
            if (cosine < least) least = cosine, best = c;
        }
        return best;
    }
};

namespace {

using Ring = std::vector<Index>;

/// Opens the first wall that does not hold, if there is one: `ring` becomes what is left of it, `more` what was cut
/// off.
template <class Mesh>
bool openOne(const Mesh& mesh, Ring& ring, Ring& more, double inward)
{
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Index p = ring[i], q = ring[(i + 1) % ring.size()];
        if (mesh.holds(p, q)) continue;
        const Index c = mesh.behind(p, q, inward);
        if (c == kNone) {
            ring.clear();  // nothing behind: what was a hoop is a string
            return true;
        }
        const auto met = std::find(ring.begin(), ring.end(), c);
        if (met == ring.end()) {
            ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1, c);
            return true;
        }
        // The cut comes to another part of the ring, which falls in two: c .. p, and q .. c.
        std::rotate(ring.begin(), met, ring.end());
        const auto end = std::find(ring.begin(), ring.end(), p) + 1;
        more.assign(end, ring.end());
        more.push_back(c);
        ring.erase(end, ring.end());
        return true;
    }
    return false;
}

template <class Mesh>
std::vector<Ring> openAll(const Mesh& mesh, const Ring& border, double inward)
{
    std::vector<Ring> whole, waiting{border};
    std::size_t budget = 4 * mesh.links.size() + 64;  // each opening takes away some flesh; guards against none
    while (!waiting.empty()) {
        Ring ring = std::move(waiting.back());
        waiting.pop_back();
        Ring more;
        while (ring.size() >= 3 && openOne(mesh, ring, more, inward)) {
            if (more.size() >= 3) waiting.push_back(more);
            more.clear();
            if (budget-- == 0) return whole;
        }
        if (ring.size() >= 3) whole.push_back(std::move(ring));
    }
    return whole;
}

/// Of a border and what inside it is on: what is left of it.
template <class Mesh>
std::vector<Ring> leftOf(const Mesh& mesh, const Ring& border, double inward)
{
    std::vector<Ring> left = openAll(mesh, border, inward);
    // Diagonals cross: where two cuts took the same flesh there is a ring around less than nothing.
    const auto isHole = [&](const Ring& ring) { return !(inward * mesh.area(ring) > 0); };
    if (!isHole(border)) std::erase_if(left, isHole);
    return left;
}

}  // namespace

/// Of the walls of the ring, on which side is the outside? 0: they bound nothing.
int Tears::sideOf(const State& state, const BodyRecord& body, const Ring& ring)
{
    for (Index w = body.walls.first; w < body.walls.end(); ++w) {
        const auto at = std::find(ring.begin(), ring.end(), state.walls.first[w] - body.points.first);
        if (at == ring.end() || state.walls.outward[w] == 0) continue;
        const auto next = at + 1 == ring.end() ? ring.begin() : at + 1;
        if (state.walls.second[w] - body.points.first == *next) return state.walls.outward[w];
    }
    return 0;
}

std::vector<std::vector<Index>> Tears::rings(const State& state, Index handle)
{
    const BodyRecord& body = state.bodies[handle];
    std::vector<Ring> rings;
    std::vector<std::uint8_t> seen(body.walls.count, 0);
    for (Index w = body.walls.first; w < body.walls.end(); ++w) {
        if (seen[w - body.walls.first] != 0) continue;
        Ring& ring = rings.emplace_back();
        for (Index at = w; seen[at - body.walls.first] == 0; at = state.walls.next[at]) {
            seen[at - body.walls.first] = 1;
            ring.push_back(state.walls.first[at] - body.points.first);
        }
    }
    return rings;
}

Tears::Cut& Tears::cutOf(Index body)
{
    auto at = std::lower_bound(cuts_.begin(), cuts_.end(), body, [](const Cut& cut, Index b) { return cut.body < b; });
    if (at == cuts_.end() || at->body != body) at = cuts_.insert(at, Cut()), at->body = body;
    return *at;
}

void Tears::remember(const State& state)
{
    drawn_ = state.walls;
    drawnRanges_.clear();
    for (const BodyRecord& body : state.bodies) drawnRanges_.push_back(body.walls);
}

void Tears::undo(State& state)
{
    for (const Cut& cut : cuts_) {
        BodyRecord& body = state.bodies[cut.body];
        body.walls = drawnRanges_[cut.body];
        const auto back = [&](auto& now, const auto& drawn) {
            std::copy(drawn.begin() + body.walls.first, drawn.begin() + body.walls.end(),
                      now.begin() + body.walls.first);
        };
        Walls& walls = state.walls;
        back(walls.first, drawn_.first), back(walls.second, drawn_.second);
        back(walls.previous, drawn_.previous), back(walls.next, drawn_.next), back(walls.outward, drawn_.outward);
        back(walls.firstEnd, drawn_.firstEnd), back(walls.secondEnd, drawn_.secondEnd);
        body.soft->open = false, body.soft->pieceCount = 1;
        body.soft->pieces.clear();
    }
    // What is cut again shall get the same numbers again.
    if (state.bodies.size() == drawnRanges_.size()) state.walls = drawn_;
    cuts_.clear();
}

void Tears::forget(State& state, Index body)
{
    const auto cut = std::find_if(cuts_.begin(), cuts_.end(), [body](const Cut& c) { return c.body == body; });
    if (cut == cuts_.end() || cut->room == 0) return;
    BodyRecord& record = state.bodies[body];
    record.walls = cut->drawn;
    std::fill_n(state.walls.outward.begin() + record.walls.first, record.walls.count, std::int8_t{0});
    record.soft->open = false, record.soft->pieceCount = 1;
    record.soft->pieces.clear();
    cut->torn = cut->room = 0;
}

bool Tears::due(const State& state, const SoftSprings& springs) const
{
    if (!springs.anyTorn()) return false;
    auto cut = cuts_.begin();
    for (Index handle = 0; handle < state.bodies.size(); ++handle) {
        const Index torn = springs.tornCount(handle);
        if (torn == 0) continue;
        while (cut != cuts_.end() && cut->body < handle) ++cut;
        if (cut == cuts_.end() || cut->body != handle || cut->torn != torn) return true;
    }
    return false;
}

void Tears::look(State& state, const SoftSprings& springs)
{
    for (Index handle = 0; handle < state.bodies.size(); ++handle) {
        const Index torn = springs.tornCount(handle);
        if (torn == 0) continue;
        if (!any()) remember(state);
        Cut& cut = cutOf(handle);
        if (cut.torn == torn) continue;
        cut.torn = torn;
        BodyRecord& body = state.bodies[handle];
        const Mesh mesh(state, springs, body);
        // Outer borders and holes are walked in the order drawn; each keeps the side its outside is on.
        std::vector<Ring> both[2];
        for (const Ring& ring : rings(state, handle)) {
            const int side = sideOf(state, body, ring);
            if (side != 0) both[side > 0].push_back(ring);
        }
        const auto before = both[0].size() + both[1].size();
        std::vector<Ring> kept[2];
        for (const int side : {0, 1})
            for (const Ring& border : both[side])
                for (Ring& ring : leftOf(mesh, border, side == 0 ? 1 : -1)) kept[side].push_back(std::move(ring));
        body.soft->open |= kept[0] != both[0] || kept[1] != both[1] || before != kept[0].size() + kept[1].size();
        if (cut.room == 0) cut.room = body.walls.count, cut.drawn = body.walls;
        std::vector<Ring> all = kept[0];
        all.insert(all.end(), kept[1].begin(), kept[1].end());
        write(state, cut, all, -1);
        const Index split =
            static_cast<Index>(std::accumulate(kept[0].begin(), kept[0].end(), std::size_t{0},
                                               [](std::size_t sum, const Ring& ring) { return sum + ring.size(); }));
        for (Index w = body.walls.first + split; w < body.walls.end(); ++w) state.walls.outward[w] = 1;
        Tears::split(state, mesh, handle);
    }
}

/// The walls of the body anew; where its range is full, in a new one of twice the room.
void Tears::write(State& state, Cut& cut, const std::vector<Ring>& rings, std::int8_t outward)
{
    BodyRecord& body = state.bodies[cut.body];
    Walls& walls = state.walls;
    std::size_t count = 0;
    for (const Ring& ring : rings) count += ring.size();
    if (count > cut.room && count <= cut.spare.count) {
        body.walls.first = cut.spare.first, cut.room = cut.spare.count;
    } else if (count > cut.room) {
        cut.room = static_cast<Index>(2 * count);
        body.walls.first = static_cast<Index>(walls.size());
        const std::size_t size = walls.size() + cut.room;
        walls.first.resize(size, 0), walls.second.resize(size, 0), walls.previous.resize(size, 0);
        walls.next.resize(size, 0), walls.outward.resize(size, 0);
        walls.firstEnd.resize(size, WallEnd::Blunt), walls.secondEnd.resize(size, WallEnd::Blunt);
        cut.spare = {body.walls.first, cut.room};
    }
    body.walls.count = static_cast<Index>(count);
    Index start = body.walls.first;
    for (const Ring& ring : rings) {
        const auto size = static_cast<Index>(ring.size());
        for (Index i = 0; i < size; ++i) {
            const Index wall = start + i;
            walls.first[wall] = body.points.first + ring[i];
            walls.second[wall] = body.points.first + ring[(i + 1) % size];
            walls.previous[wall] = start + (i + size - 1) % size, walls.next[wall] = start + (i + 1) % size;
            walls.outward[wall] = outward;
        }
        start += size;
    }
}

void Tears::split(State& state, const Mesh& mesh, Index handle)
{
    BodyRecord& body = state.bodies[handle];
    const Index count = body.points.count;
    body.soft->pieces.assign(count, kNone);
    body.soft->pieceCount = 0;
    std::vector<Index> waiting;
    for (Index p = 0; p < count; ++p) {
        if (body.soft->pieces[p] != kNone) continue;
        body.soft->pieces[p] = body.soft->pieceCount;
        waiting.assign(1, p);
        while (!waiting.empty()) {
            const Index at = waiting.back();
            waiting.pop_back();
            for (const Mesh::Link& link : mesh.at(at)) {
                if (!link.whole || body.soft->pieces[link.to] != kNone) continue;
                body.soft->pieces[link.to] = body.soft->pieceCount;
                waiting.push_back(link.to);
            }
        }
        ++body.soft->pieceCount;
    }
}

std::size_t Tears::bytes() const
{
    return cuts_.capacity() * sizeof(Cut) + drawn_.first.capacity() * (4 * sizeof(Index) + 3) +
           drawnRanges_.capacity() * sizeof(Range);
}

}  // namespace jet::physics::soft
