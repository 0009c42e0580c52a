// Which points of a soft body may come to which walls: the candidates of contacts.hpp.
#include "border.hpp"
#include "contacts.hpp"

#include <limits>

namespace jet::physics::soft {

namespace {

constexpr std::uint8_t kSkin = 1, kCorners = 2;                                     // of skinned_
constexpr double kSharpInset = 2;                                                   // in slops
constexpr double kLean = 0.3, kFacing = 0.2, kHeldBonus = 0.5, kFoldedPenalty = 2;  // as in narrow_phase.cpp

struct View {
    double height, along, distance, length;
    Vec2 normal;
    bool valid;
};

View view(const State& state, Index wall, const Vec2& at)
{
    const Vec2& first = state.points.position[state.walls.first[wall]];
    const Vec2 edge = state.points.position[state.walls.second[wall]] - first, off = at - first;
    const double squared = edge.squaredNorm();
    View seen{};
    seen.valid = squared > 1e-24 && state.walls.outward[wall] != 0;
    if (!seen.valid) return seen;
    seen.length = std::sqrt(squared);
    seen.normal = perpendicular(edge) * (state.walls.outward[wall] / seen.length);
    seen.height = off.dot(seen.normal);
    seen.along = off.dot(edge) / squared;
    seen.distance = (off - std::clamp(seen.along, 0.0, 1.0) * edge).norm();
    return seen;
}

bool insidePiece(const State& state, const BodyRecord& body, Index piece, const Vec2& at)
{
    bool in = false;
    for (Index w = body.walls.first; w < body.walls.end(); ++w) {
        if (body.soft->pieces[state.walls.first[w] - body.points.first] != piece) continue;
        const Vec2 &p = state.points.position[state.walls.first[w]], &q = state.points.position[state.walls.second[w]];
        if ((p.y() > at.y()) != (q.y() > at.y()) &&
            at.x() < p.x() + (at.y() - p.y()) / (q.y() - p.y()) * (q.x() - p.x()))
            in = !in;
    }
    return in;
}

}  // namespace

/// The walls of the body, eight in a block.
void Contacts::skin(State& state, Index handle)
{
    if ((skinned_[handle] & kSkin) != 0) return;
    skinned_[handle] |= kSkin;
    const BodyRecord& body = state.bodies[handle];
    Skin& skin = skins_[handle];
    skin.first = static_cast<Index>(walls_.size());
    skin.count = (body.walls.count + kWide - 1) / kWide;
    if (body.walls.count == 0) return;
    skin.origin = state.points.position[state.walls.first[body.walls.first]];
    walls_.resize(walls_.size() + skin.count);
    const float nowhere = std::numeric_limits<float>::quiet_NaN();
    for (Index k = 0; k < skin.count; ++k) {
        WallBlock& block = walls_[skin.first + k];
        block = WallBlock();
        block.left = block.top = std::numeric_limits<float>::max();
        block.right = block.bottom = std::numeric_limits<float>::lowest();
        for (Index lane = 0; lane < kWide; ++lane) {
            const Index i = kWide * k + lane, wall = body.walls.first + i;
            if (i >= body.walls.count) {
                block.x[lane] = block.y[lane] = 1e30F;
                block.normalX[lane] = block.normalY[lane] = nowhere;  // nothing reaches so far that it counts as near
                continue;
            }
            const Vec2 first = state.points.position[state.walls.first[wall]] - skin.origin;
            const Vec2 second = state.points.position[state.walls.second[wall]] - skin.origin;
            const auto x = static_cast<float>(first.x()), y = static_cast<float>(first.y());
            const float edgeX = static_cast<float>(second.x()) - x, edgeY = static_cast<float>(second.y()) - y;
            const float squared = edgeX * edgeX + edgeY * edgeY;
            const bool valid = squared > 1e-24F && state.walls.outward[wall] != 0;
            const float side = valid ? static_cast<float>(state.walls.outward[wall]) / std::sqrt(squared) : nowhere;
            block.x[lane] = x, block.y[lane] = y, block.edgeX[lane] = edgeX, block.edgeY[lane] = edgeY;
            block.normalX[lane] = -edgeY * side, block.normalY[lane] = edgeX * side;
            block.inverseSquare[lane] = valid ? 1 / squared : 0;
            block.slope[lane] = edgeY != 0 ? edgeX / edgeY : 0;
            block.left = std::min({block.left, x, x + edgeX}), block.right = std::max({block.right, x, x + edgeX});
            block.top = std::min({block.top, y, y + edgeY}), block.bottom = std::max({block.bottom, y, y + edgeY});
        }
    }
}

/// The normals at the body's points, and which corners are sharp.
void Contacts::corners(State& state, Index handle)
{
    if ((skinned_[handle] & kCorners) != 0) return;
    skinned_[handle] |= kCorners;
    updateCorners(state, state.bodies[handle]);
}

/// The points of one body at the walls of the other. Where the pair has room, walls are found as far away as both may
/// come until it is used up; else as far as they may come in this step.
void Contacts::meet(State& state, const std::vector<Motion>& motions, Pair& pair, bool aOnB, double dt)
{
    const Index from = aOnB ? pair.a : pair.b, onto = aOnB ? pair.b : pair.a;
    const BodyRecord &a = state.bodies[from], &b = state.bodies[onto];
    const Skin& skin = skins_[onto];
    if (skin.count == 0) return;
    const Motion &motionA = motions[from], &motionB = motions[onto];
    near_.resize(std::max<std::size_t>(near_.size(), skin.count));
    if (!(pair.thickness > 0)) corners(state, from), corners(state, onto);
    const double margin =
        motionA.stray + motionB.stray + 4 * static_cast<double>(pair.slop) + static_cast<double>(pair.thickness);
    const auto room = static_cast<double>(pair.room);
    const double near = 4 * static_cast<double>(pair.slop) + static_cast<double>(pair.thickness) + room;
    const Box around =
        motionB.reach.inflated(motionA.range + static_cast<double>(pair.thickness) + std::max(room, 0.0));
    for (Index p = a.points.first; p < a.points.end(); ++p) {
        const Vec2& at = state.points.position[p];
        if (!around.contains(at)) continue;
        const Vec2 carried = motionB.velocity + motionB.omega * perpendicular(at - motionB.centre);
        const double reach =
            room > 0 ? near : (state.nodes.velocity[state.points.node[p]] - carried).norm() * dt + margin;
        const Vec2 local = at - skin.origin;
        // The second end of a thick wall is its neighbour's.
        const double slide = pair.thickness > 0 ? reach - static_cast<double>(pair.thickness) : reach;
        const NearQuery query{static_cast<float>(local.x()), static_cast<float>(local.y()), static_cast<float>(reach),
                              static_cast<float>(slide), static_cast<float>(kTouchDepth) * pair.slop};
        const NearResult seen = kernels_->survey(walls_.data() + skin.first, skin.count, query, near_.data());
        for (Index k = 0; k < skin.count; ++k)
            for (unsigned rest = near_[k]; rest != 0; rest &= rest - 1)
                add(state, pair, p, b.walls.first + kWide * k + static_cast<Index>(__builtin_ctz(rest)), false);
        // On the border "inside" is a matter of rounding; the walls found in front of the point answer for it.
        if (!seen.inside || seen.onSurface) continue;
        pair.room = 0;  // what is inside is looked at anew in each step
        corners(state, from), corners(state, onto);
        const Index wall = wallToLeaveThrough(state, b, p, kNone);
        if (wall != kNone) add(state, pair, p, wall, true);
    }
}

/// The points of a body at its own walls: those of other pieces of it hold as those of other bodies; of its own, where
/// it collides with itself, only walls that face the point: the skin of a smooth border overlaps its neighbours.
void Contacts::meetItself(State& state, const Motion& motion, const Pair& pair, double dt)
{
    const BodyRecord& body = state.bodies[pair.a];
    const Skin& skin = skins_[pair.a];
    corners(state, pair.a);
    near_.resize(std::max<std::size_t>(near_.size(), skin.count));
    const double behind = kTouchDepth * static_cast<double>(pair.slop);
    const bool torn = body.soft->pieceCount > 1;
    const auto pieceOf = [&](Index p) { return torn ? body.soft->pieces[p - body.points.first] : 0; };
    for (Index p = body.points.first; p < body.points.end(); ++p) {
        const Vec2& normal = state.points.normal[p];
        if (normal.isZero() && !torn) continue;  // not on the border
        const Vec2& at = state.points.position[p];
        const Vec2& own = state.nodes.velocity[state.points.node[p]];
        const double reach = (own - motion.velocity).norm() * dt + motion.stray + 4 * static_cast<double>(pair.slop) +
                             static_cast<double>(pair.thickness);
        const Vec2 local = at - skin.origin;
        // Walls it has come through before hold it too; wide enough to see them.
        const auto wide = static_cast<float>(reach);
        const NearQuery query{static_cast<float>(local.x()), static_cast<float>(local.y()), wide, wide, wide};
        kernels_->survey(walls_.data() + skin.first, skin.count, query, near_.data());
        Index deepIn = kNone;  // wall of another piece it is behind
        bool onSurface = false;
        for (Index k = 0; k < skin.count; ++k) {
            for (unsigned rest = near_[k]; rest != 0; rest &= rest - 1) {
                const Index wall = body.walls.first + kWide * k + static_cast<Index>(__builtin_ctz(rest));
                if (state.walls.first[wall] == p || state.walls.second[wall] == p) continue;
                const View seen = view(state, wall, at);
                if (!seen.valid) continue;
                const bool other = pieceOf(p) != pieceOf(state.walls.first[wall]);
                if (!other &&
                    (!body.soft->matter.selfCollision || normal.isZero() || normal.dot(seen.normal) > -kFacing))
                    continue;
                const Touch* held = heldBefore(p, wall);
                if (seen.height < -behind && other) deepIn = wall;
                if (seen.height < -behind && (other || !(held && held->stepImpulse > 0))) continue;
                onSurface |= other && seen.distance <= behind;
                add(state, pair, p, wall, false);
            }
        }
        if (deepIn == kNone || onSurface || !insidePiece(state, body, pieceOf(state.walls.first[deepIn]), at)) continue;
        const Index wall = wallToLeaveThrough(state, body, p, pieceOf(state.walls.first[deepIn]));
        if (wall != kNone) add(state, pair, p, wall, true);
    }
}

void Contacts::add(const State& state, const Pair& pair, Index point, Index wall, bool inside)
{
    // A point inside may be found twice at one wall: at its front, and to be pushed out; the latter counts.
    if (inside) {
        for (std::size_t i = touches_.size(); i > pair.first && touches_[i - 1].point == point; --i) {
            if (touches_[i - 1].wall != wall) continue;
            touches_[i - 1].inside = 1;
            return;
        }
    }
    Touch touch;
    touch.point = point, touch.wall = wall, touch.inside = inside;
    if (!inside && !(pair.thickness > 0)) touch.insets = insetsAt(state, point, wall);
    if (touch.insets != 0) {
        const Vec2 edge =
            state.points.position[state.walls.second[wall]] - state.points.position[state.walls.first[wall]];
        touch.inset = static_cast<float>(std::min(kSharpInset * static_cast<double>(pair.slop), 0.25 * edge.norm()));
    }
    touches_.push_back(touch);
}

/// Near sharp ends of the wall, is the point rather its neighbour's? Then neither catches what slides over the corner.
std::uint8_t Contacts::insetsAt(const State& state, Index point, Index wall) const
{
    const Walls& walls = state.walls;
    const auto yields = [&](WallEnd end, Index neighbour) {
        if (end != WallEnd::Sharp) return false;
        const View seen = view(state, neighbour, state.points.position[point]);
        return seen.valid && state.points.normal[point].dot(seen.normal) <= kLean;
    };
    return static_cast<std::uint8_t>((yields(walls.firstEnd[wall], walls.previous[wall]) ? 1 : 0) |
                                     (yields(walls.secondEnd[wall], walls.next[wall]) ? 2 : 0));
}

Index Contacts::wallToLeaveThrough(const State& state, const BodyRecord& body, Index point, Index piece) const
{
    const Vec2 &at = state.points.position[point], &normal = state.points.normal[point];
    Index best = kNone;
    double score = std::numeric_limits<double>::infinity();
    for (Index wall = body.walls.first; wall < body.walls.end(); ++wall) {
        if (piece != kNone && body.soft->pieces[state.walls.first[wall] - body.points.first] != piece) continue;
        const View seen = view(state, wall, at);
        if (!seen.valid || seen.height >= 0) continue;
        const Touch* held = heldBefore(point, wall);
        const double own = seen.distance * (held && held->stepImpulse > 0 ? kHeldBonus : 1) *
                           (normal.dot(seen.normal) <= 0 ? 1 : kFoldedPenalty);
        if (own < score) score = own, best = wall;
    }
    return best;
}

}  // namespace jet::physics::soft
