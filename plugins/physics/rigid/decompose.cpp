#include "decompose.hpp"

#include <jet/result.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

namespace jet::physics {

namespace {

constexpr double kFlat = 1e-6;  // sine: corners flatter than this count as straight

std::uint64_t sideKey(std::uint32_t from, std::uint32_t to) { return static_cast<std::uint64_t>(from) << 32 | to; }

Vec2 outward(const Vec2& from, const Vec2& to) { return -perpendicular(Vec2(to - from)).normalized(); }

/// Directions from which a corner between two sides may be touched; null where it is hollow.
void openCorner(const Vec2& arriving, const Vec2& leaving, Vec2& before, Vec2& after)
{
    const bool hollow = cross(arriving, leaving) < -kFlat;
    before = hollow ? Vec2(0, 0) : arriving;
    after = hollow ? Vec2(0, 0) : leaving;
}

/// Merges pieces over their common sides, longest first (Hertel and Mehlhorn, 1983).
class Merger {
public:
    explicit Merger(const Mesh& mesh) : points_(mesh.points)
    {
        for (const Mesh::Triangle& t : mesh.triangles) pieces_.push_back({t.begin(), t.end()});
        for (std::uint32_t p = 0; p < pieces_.size(); ++p) claim(p);
    }

    std::vector<std::vector<std::uint32_t>> merge()
    {
        std::vector<std::pair<double, std::uint64_t>> inner;
        for (const auto& [key, piece] : owner_) {
            const auto from = static_cast<std::uint32_t>(key >> 32), to = static_cast<std::uint32_t>(key);
            if (from < to && owner_.count(sideKey(to, from)) != 0)
                inner.emplace_back(-(points_[from] - points_[to]).squaredNorm(), key);
        }
        std::sort(inner.begin(), inner.end());
        for (const auto& [length, key] : inner)
            join(static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key));
        std::vector<std::vector<std::uint32_t>> kept;
        for (auto& piece : pieces_)
            if (!piece.empty()) kept.push_back(std::move(piece));
        return kept;
    }

private:
    using List = std::vector<std::uint32_t>;

    void claim(std::uint32_t piece)
    {
        const List& list = pieces_[piece];
        for (std::size_t i = 0; i < list.size(); ++i) owner_[sideKey(list[i], list[(i + 1) % list.size()])] = piece;
    }
    /// The piece's corners, beginning with that one.
    static List from(const List& list, std::uint32_t corner)
    {
        List turned = list;
        std::rotate(turned.begin(), std::find(turned.begin(), turned.end(), corner), turned.end());
        return turned;
    }
    bool convex(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
    {
        const Vec2 in = points_[b] - points_[a], out = points_[c] - points_[b];
        return cross(in, out) >= -1e-9 * in.norm() * out.norm();
    }
    void join(std::uint32_t u, std::uint32_t v)
    {
        const std::uint32_t p = owner_[sideKey(u, v)], q = owner_[sideKey(v, u)];
        if (p == q || pieces_[p].size() + pieces_[q].size() > kMostCorners + 2) return;
        // P is v ... u, Q is u ... v.
        const List a = from(pieces_[p], v), b = from(pieces_[q], u);
        if (!convex(b[b.size() - 2], v, a[1]) || !convex(a[a.size() - 2], u, b[1])) return;
        owner_.erase(sideKey(u, v));
        owner_.erase(sideKey(v, u));
        List both = a;
        both.insert(both.end(), b.begin() + 1, b.end() - 1);
        pieces_[p] = std::move(both);
        pieces_[q].clear();
        claim(p);
    }

    const std::vector<Vec2>& points_;
    std::vector<List> pieces_;
    std::unordered_map<std::uint64_t, std::uint32_t> owner_;
};

/// Which sides lie within, and from where the corners may be touched.
class SeamMarker {
public:
    explicit SeamMarker(Pieces& pieces) : pieces_(pieces)
    {
        for (std::uint32_t p = 0; p < pieces_.pieces.size(); ++p) {
            const auto& corners = pieces_.pieces[p].corners;
            for (std::uint32_t i = 0; i < corners.size(); ++i)
                owner_[sideKey(corners[i], corners[(i + 1) % corners.size()])] = {p, i};
        }
    }

    void mark()
    {
        for (Piece& piece : pieces_.pieces) {
            piece.before.assign(piece.corners.size(), Vec2(0, 0)), piece.after = piece.before;
            for (std::uint32_t i = 0; i < piece.corners.size(); ++i)
                if (across(piece, i)) piece.inner |= static_cast<std::uint8_t>(1U << i);
        }
        for (Piece& piece : pieces_.pieces)
            for (std::uint32_t i = 0; i < piece.corners.size(); ++i)
                if ((piece.inner >> i & 1) == 0) markCorner(piece, i);
    }

private:
    struct Place {
        std::uint32_t piece, side;
    };
    std::uint32_t corner(const Piece& piece, std::uint32_t i) const { return piece.corners[i % piece.corners.size()]; }
    const Place* across(const Piece& piece, std::uint32_t side) const
    {
        const auto found = owner_.find(sideKey(corner(piece, side + 1), corner(piece, side)));
        return found == owner_.end() ? nullptr : &found->second;
    }
    Vec2 normal(const Piece& piece, std::uint32_t side) const
    {
        return outward(pieces_.points[corner(piece, side)], pieces_.points[corner(piece, side + 1)]);
    }
    /// Walks from the outer side that leaves corner i round the corner, from piece to piece, to the one that arrives.
    void markCorner(const Piece& first, std::uint32_t i)
    {
        const Vec2 leaving = normal(first, i);
        std::vector<Place> passed{{static_cast<std::uint32_t>(&first - pieces_.pieces.data()), i}};
        for (;;) {
            const Piece& piece = pieces_.pieces[passed.back().piece];
            const auto count = static_cast<std::uint32_t>(piece.corners.size());
            const std::uint32_t arriving = (passed.back().side + count - 1) % count;
            const Place* next = across(piece, arriving);
            if (next == nullptr) {
                setCorners(passed, normal(piece, arriving), leaving);
                return;
            }
            if (passed.size() > 1000) return;
            passed.push_back(*next);  // its side leaves this corner
        }
    }
    void setCorners(const std::vector<Place>& passed, const Vec2& arriving, const Vec2& leaving)
    {
        Vec2 before, after;
        openCorner(arriving, leaving, before, after);
        for (const Place& at : passed) {
            pieces_.pieces[at.piece].before[at.side] = before;
            pieces_.pieces[at.piece].after[at.side] = after;
        }
    }

    Pieces& pieces_;
    std::unordered_map<std::uint64_t, Place> owner_;
};

/// Lets the ends of neighbours be touched each from its own half of the directions between them.
void shareCorner(ChainSide& arriving, ChainSide& leaving)
{
    const Vec2 in = outward(arriving.a, arriving.b), out = outward(leaving.a, leaving.b);
    if (cross(in, out) < -kFlat) {
        arriving.after = leaving.before = Vec2(0, 0);
        return;
    }
    Vec2 half = in + out;
    // A tip: half way round is along the wall.
    half = half.norm() > 1e-6 ? Vec2(half.normalized()) : Vec2(perpendicular(in));
    arriving.after = leaving.before = half;
}

std::vector<ChainSide> closedSides(const Ring& ring)
{
    std::vector<ChainSide> sides;
    for (std::size_t i = 0; i < ring.size(); ++i) sides.push_back({ring[i], ring[(i + 1) % ring.size()], {}, {}});
    for (std::size_t i = 0; i < sides.size(); ++i) shareCorner(sides[i], sides[(i + 1) % sides.size()]);
    return sides;
}

/// The outline of triangles as rings; where it touches itself, any of the ways on is taken.
std::vector<Ring> ringsOf(const Mesh& mesh)
{
    std::unordered_map<std::uint64_t, bool> sides;
    std::vector<std::uint64_t> order;
    for (const Mesh::Triangle& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            sides[sideKey(t[i], t[(i + 1) % 3])] = true;
            order.push_back(sideKey(t[i], t[(i + 1) % 3]));
        }
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> ways;
    std::vector<std::uint32_t> starts;
    for (const std::uint64_t key : order) {
        const auto from = static_cast<std::uint32_t>(key >> 32), to = static_cast<std::uint32_t>(key);
        if (sides.count(sideKey(to, from)) != 0) continue;
        ways[from].push_back(to);
        starts.push_back(from);
    }
    std::vector<Ring> rings;
    for (const std::uint32_t start : starts) {
        Ring ring;
        for (std::uint32_t at = start; !ways[at].empty();) {
            ring.push_back(mesh.points[at]);
            const std::uint32_t next = ways[at].back();
            ways[at].pop_back();
            at = next;
        }
        if (ring.size() >= 3) rings.push_back(std::move(ring));
    }
    return rings;
}

/// What follows takes time by their square, at worst.
constexpr std::size_t kMostCornersDivided = 10'000, kMostWalls = 200'000;

void requireFewCorners(const std::vector<Ring>& rings, std::size_t most, const std::string& otherwise)
{
    std::size_t corners = 0;
    for (const Ring& ring : rings) corners += ring.size();
    if (corners > most)
        throw Failure(Error("has " + std::to_string(corners) + " corners, more than " + std::to_string(most) + "; " +
                            otherwise + "."));
}

/// Pairs of long sides are looked at all by all in the first step: their boxes share one cell.
void requireFewLongSides(const std::vector<Ring>& rings)
{
    constexpr double kLong = 0.125;  // of the extent
    constexpr double kMostLooks = 4e8;
    Box bounds;
    for (const Ring& ring : rings)
        for (const Vec2& at : ring) bounds.extend(at);
    const double least = bounds.isNull() ? 0 : kLong * bounds.size().maxCoeff();
    double all = 0, spanning = 0;
    for (const Ring& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i)
            ++all, spanning += (ring[(i + 1) % ring.size()] - ring[i]).norm() > least;
    if (all * spanning > kMostLooks)
        throw Failure(Error("has " + std::to_string(static_cast<std::size_t>(spanning)) +
                            " sides that reach across much of it, too many to find what they touch; draw it with "
                            "fewer."));
}

}  // namespace

Pieces decompose(const std::vector<Ring>& rings)
{
    requireFewCorners(rings, kMostCornersDivided,
                      "it is divided into convex parts, which takes too long for more; draw it with fewer (that of a "
                      "fixed body may have " +
                          std::to_string(kMostWalls) + ")");
    Mesh mesh = triangulate(rings);
    improve(mesh);
    Pieces result;
    for (auto& corners : Merger(mesh).merge()) result.pieces.push_back({std::move(corners), 0, {}, {}});
    result.points = std::move(mesh.points);
    SeamMarker(result).mark();
    return result;
}

std::vector<ChainSide> outlineSides(const std::vector<Ring>& drawn)
{
    std::vector<Ring> rings = cleaned(drawn);
    requireFewCorners(rings, kMostWalls, "draw it with fewer");
    requireFewLongSides(rings);
    rings = areSimple(rings) ? oriented(std::move(rings)) : ringsOf(triangulate(rings));
    std::vector<ChainSide> sides;
    for (const Ring& ring : rings) {
        const std::vector<ChainSide> more = closedSides(ring);
        sides.insert(sides.end(), more.begin(), more.end());
    }
    return sides;
}

std::vector<ChainSide> chainSides(const std::vector<Vec2>& line)
{
    std::vector<ChainSide> sides;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if ((line[i + 1] - line[i]).norm() > 0) sides.push_back({line[i], line[i + 1], {}, {}});
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) shareCorner(sides[i], sides[i + 1]);
    if (sides.empty()) return sides;
    // The ends may be touched from ahead as well, as those of a plank.
    const Vec2 first = sides.front().b - sides.front().a, last = sides.back().b - sides.back().a;
    sides.front().before = -first.normalized();
    sides.back().after = last.normalized();
    return sides;
}

}  // namespace jet::physics
