#include "weld.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace jet::physics {

namespace {

constexpr double kNear = 1e-3;  // of the typical length: ends that lie nearer are one

bool stands(const RigidBody& body) { return body.enabled && !body.moves && !body.kinematic && !body.sensor; }

/// Only what meets the same others is welded.
auto kindOf(const Rules& rules)
{
    return std::tuple(rules.layer, rules.mask, rules.group, rules.oneSidedX, rules.oneSidedY);
}

/// Numbers places; those nearer than the grain get one number.
class Places {
public:
    explicit Places(double grain) : grain_(grain) {}

    Index numberOf(const Vec2& at)
    {
        const auto x = static_cast<std::int64_t>(std::floor(at.x() / grain_)),
                   y = static_cast<std::int64_t>(std::floor(at.y() / grain_));
        for (std::int64_t i = x - 1; i <= x + 1; ++i)
            for (std::int64_t k = y - 1; k <= y + 1; ++k)
                if (const auto found = cells_.find({i, k}); found != cells_.end())
                    for (const Index number : found->second)
                        if ((places_[number] - at).norm() <= grain_) return number;
        places_.push_back(at);
        cells_[{x, y}].push_back(static_cast<Index>(places_.size() - 1));
        return static_cast<Index>(places_.size() - 1);
    }
    std::size_t size() const { return places_.size(); }

private:
    double grain_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Index>> cells_;
    std::vector<Vec2> places_;
};

struct Side {
    Index part = 0, corner = 0;
    Vec2 normal;  // scene directions
};

struct Meeting {
    std::vector<Side> leaving, arriving;           // outer sides
    std::vector<std::pair<Index, Index>> corners;  // part, corner
    bool shared = false;                           // by several bodies
};

std::uint64_t sideKey(Index from, Index to) { return static_cast<std::uint64_t>(from) << 32 | to; }

/// The parts of one kind of standing bodies.
class Welder {
public:
    Welder(std::vector<Part>& parts, const std::vector<RigidBody>& bodies, const State& state,
           std::vector<PartOutline>& outlines, Column<std::uint32_t>& outlineOf, double grain)
        : parts_(parts), bodies_(bodies), state_(state), outlines_(outlines), outlineOf_(outlineOf), places_(grain)
    {
    }

    void add(Index index)
    {
        const Part& part = parts_[index];
        if (part.count < 2 || part.radius > 0) return;
        std::vector<Index>& places = placesOf_[index];
        for (int i = 0; i < part.count; ++i) places.push_back(places_.numberOf(inScene(part, part.corners[i], true)));
        for (int i = 0; i < part.count; ++i)
            if (outer(index, i)) sides_[sideKey(places[i], places[(i + 1) % part.count])] = index;
    }

    void weld()
    {
        meetings_.resize(places_.size());
        for (const auto& [index, places] : placesOf_) collect(index, places);
        for (const auto& [index, places] : placesOf_) {
            for (int i = 0; i < parts_[index].count; ++i)
                if (outer(index, i) && flush(places, i)) edit(index).inner |= static_cast<std::uint8_t>(1U << i);
        }
        for (const Meeting& meeting : meetings_)
            if (meeting.shared && meeting.leaving.size() == 1 && meeting.arriving.size() == 1) open(meeting);
    }

private:
    Vec2 inScene(const Part& part, Vec2f v, bool place) const
    {
        const Index node = bodies_[part.body].node;
        const Vec2 turned = rotated(state_.nodes.rotation[node], Vec2(v.x, v.y));
        return place ? Vec2(state_.nodes.position[node] + turned) : turned;
    }
    Vec2f inBody(const Part& part, const Vec2& v) const
    {
        const Vec2 own = unrotated(state_.nodes.rotation[bodies_[part.body].node], v);
        return {static_cast<float>(own.x()), static_cast<float>(own.y())};
    }
    bool outer(Index part, int side) const
    {
        return !parts_[part].outlined || (outlines_[outlineOf_[part]].inner >> side & 1) == 0;
    }
    bool flush(const std::vector<Index>& places, int side) const
    {
        return sides_.count(sideKey(places[(static_cast<std::size_t>(side) + 1) % places.size()], places[side])) != 0;
    }
    void collect(Index index, const std::vector<Index>& places)
    {
        const Part& part = parts_[index];
        for (int i = 0; i < part.count; ++i) {
            Meeting &from = meetings_[places[i]], &to = meetings_[places[(i + 1) % part.count]];
            from.shared |= !from.corners.empty() && parts_[from.corners[0].first].body != part.body;
            from.corners.emplace_back(index, i);
            if (!outer(index, i) || flush(places, i)) continue;
            const Side side{index, static_cast<Index>(i), inScene(part, part.normals[i], false)};
            from.leaving.push_back(side), to.arriving.push_back(side);
        }
    }
    /// An outline of the part's own to change; one that is all outside gets its corners' directions first.
    PartOutline& edit(Index index)
    {
        Part& part = parts_[index];
        const auto known = edited_.find(index);
        if (known != edited_.end()) return outlines_[known->second];
        PartOutline outline;
        if (part.outlined) {
            outline = outlines_[outlineOf_[index]];
        } else {
            for (int i = 0; i < part.count; ++i)
                outline.before[i] = part.normals[(i + part.count - 1) % part.count], outline.after[i] = part.normals[i];
        }
        part.outlined = true;
        outlineOf_.cover(index + std::size_t{1});
        outlineOf_.edit(index) = edited_[index] = static_cast<std::uint32_t>(outlines_.size());
        outlines_.push_back(outline);
        return outlines_.back();
    }
    void open(const Meeting& meeting)
    {
        const Vec2 in = meeting.arriving[0].normal, out = meeting.leaving[0].normal;
        const bool hollow = cross(in, out) < -kFlat;
        const Vec2 half = (in + out).norm() > 1e-6 ? Vec2((in + out).normalized()) : Vec2(perpendicular(in));
        for (const auto& [index, corner] : meeting.corners) {
            PartOutline& outline = edit(index);
            Vec2 before = in, after = out;
            // Walls share the directions; see decompose.cpp.
            if (outline.wall) (corner == 0 ? before : after) = half;
            if (outline.wall) (corner == 0 ? after : before) = inScene(parts_[index], parts_[index].normals[0], false);
            outline.before[corner] = hollow ? Vec2f() : inBody(parts_[index], before);
            outline.after[corner] = hollow ? Vec2f() : inBody(parts_[index], after);
        }
    }

    static constexpr double kFlat = 1e-4;  // sine

    std::vector<Part>& parts_;
    const std::vector<RigidBody>& bodies_;
    const State& state_;
    std::vector<PartOutline>& outlines_;
    Column<std::uint32_t>& outlineOf_;  // [parts] into outlines_
    Places places_;
    std::map<Index, std::vector<Index>> placesOf_;  // part -> places of its corners
    std::unordered_map<std::uint64_t, Index> sides_;
    std::unordered_map<Index, std::uint32_t> edited_;
    std::vector<Meeting> meetings_;
};

}  // namespace

void Weld::add(const PartOutline* outline)
{
    ++parts_;
    if (outline == nullptr) return;
    ownOf_.cover(parts_);
    ownOf_.edit(parts_ - 1) = static_cast<std::uint32_t>(own_.size());
    own_.push_back(*outline);
}

bool Weld::replace(std::size_t part, const PartOutline* outline)
{
    const std::uint32_t before = ownOf_[part];
    if (before != kNoOutline && outline == nullptr) free_.push_back(before), ownOf_.edit(part) = kNoOutline;
    if (outline == nullptr) return before != kNoOutline;
    std::uint32_t row = before;
    if (row == kNoOutline && free_.empty()) {
        row = static_cast<std::uint32_t>(own_.size());
        own_.emplace_back();
    } else if (row == kNoOutline) {
        row = free_.back();
        free_.pop_back();
    }
    own_[row] = *outline;
    ownOf_.cover(part + 1);
    ownOf_.edit(part) = row;
    return true;
}

void Weld::run(std::vector<Part>& parts, const std::vector<RigidBody>& bodies, const RuleBook& rules,
               const State& state, float typicalLength)
{
    outlines_ = own_, outlineOf_ = ownOf_;
    for (std::size_t p = 0; p < parts.size(); ++p) parts[p].outlined = ownOf_[p] != kNoOutline;
    using Kind = decltype(kindOf(rules[0]));
    std::map<Kind, std::vector<Index>> kinds;
    for (Index i = 1; i < bodies.size(); ++i)
        if (stands(bodies[i])) kinds[kindOf(rules[bodies[i].rules])].push_back(i);
    for (const auto& [kind, group] : kinds) {
        if (group.size() < 2) continue;
        const double grain = std::max(kNear * static_cast<double>(typicalLength), 1e-9);
        Welder welder(parts, bodies, state, outlines_, outlineOf_, grain);
        for (const Index body : group)
            for (Index p = 0; p < bodies[body].partCount; ++p) welder.add(bodies[body].firstPart + p);
        welder.weld();
    }
}

}  // namespace jet::physics
