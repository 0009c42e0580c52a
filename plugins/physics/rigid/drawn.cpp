#include "drawn.hpp"

namespace jet::physics {

namespace {

constexpr double kSmallest = 1e-6;  // units: smaller bodies are lost in the gaps of single precision

Vec2f single(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

double areaOf(const std::vector<Vec2>& ring)
{
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        twice += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
    return 0.5 * twice;
}

DrawnPart wallPart(const ChainSide& side, const Vec2& centre, double length)
{
    const Vec2 ends[2] = {side.a - centre, side.b - centre};
    DrawnPart drawn;
    drawn.part = makePart(ends, 2, 0);
    drawn.part.length = static_cast<float>(length);
    // Thin as it is, nothing passes it without coming out of its other side by its own size first.
    drawn.part.thickness = static_cast<float>(length);
    drawn.outlined = true;
    drawn.outline.wall = true;
    drawn.outline.inner = 2;  // its back
    const Vec2f normal = drawn.part.normals[0];
    const auto cone = [&](int corner, const Vec2& before, const Vec2& after, bool first) {
        const Vec2& own = first ? before : after;
        if (own.squaredNorm() == 0) return;
        drawn.outline.before[corner] = first ? single(before) : normal;
        drawn.outline.after[corner] = first ? normal : single(after);
    };
    cone(0, side.before, side.after, true);
    cone(1, side.before, side.after, false);
    return drawn;
}

std::vector<DrawnPart> wallParts(const std::vector<ChainSide>& sides, const Vec2& centre, double length)
{
    std::vector<DrawnPart> parts;
    parts.reserve(sides.size());
    for (const ChainSide& side : sides) parts.push_back(wallPart(side, centre, length));
    return parts;
}

/// One convex ring of few corners: nothing to take apart.
bool isConvex(const std::vector<Ring>& rings)
{
    if (rings.size() != 1 || rings[0].size() > kMostCorners || !areSimple(rings)) return false;
    const Ring& ring = rings[0];
    const double area = areaOf(ring);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 in = ring[(i + 1) % ring.size()] - ring[i],
                   out = ring[(i + 2) % ring.size()] - ring[(i + 1) % ring.size()];
        if (cross(in, out) * area < 0) return false;
    }
    return area != 0;
}

std::vector<DrawnPart> solidParts(const Pieces& pieces, const Vec2& centre, double length, bool outlined)
{
    std::vector<DrawnPart> parts;
    for (const Piece& piece : pieces.pieces) {
        std::vector<Vec2> corners;
        for (const std::uint32_t corner : piece.corners) corners.push_back(pieces.points[corner] - centre);
        if (!(areaOf(corners) > 0)) continue;
        DrawnPart& drawn = parts.emplace_back();
        drawn.part = makePart(corners.data(), static_cast<int>(corners.size()), 0);
        drawn.part.length = static_cast<float>(length);
        drawn.outlined = outlined;
        drawn.outline.inner = piece.inner;
        for (std::size_t i = 0; i < corners.size(); ++i)
            drawn.outline.before[i] = single(piece.before[i]), drawn.outline.after[i] = single(piece.after[i]);
    }
    return parts;
}

}  // namespace

Drawing takeApart(const std::vector<Ring>& borders, DrawnAs as)
{
    Drawing drawing;
    drawing.as = as;
    const std::vector<Ring> rings = cleaned(borders);
    Box bounds;
    for (const Ring& ring : rings)
        for (const Vec2& at : ring) bounds.extend(at);
    if (bounds.isNull() || bounds.size().maxCoeff() < kSmallest) return drawing;
    if (isConvex(rings)) {
        drawing.convex = rings[0];
    } else if (as == DrawnAs::Walls) {
        drawing.sides = outlineSides(rings);
    } else {
        drawing.pieces = decompose(rings);
    }
    return drawing;
}

std::vector<DrawnPart> drawnParts(const Drawing& drawing, const Vec2& centre, double length)
{
    if (drawing.as == DrawnAs::Walls && drawing.convex.empty()) return wallParts(drawing.sides, centre, length);
    if (drawing.convex.empty()) return solidParts(drawing.pieces, centre, length, drawing.as == DrawnAs::Solid);
    Ring corners = drawing.convex;
    for (Vec2& at : corners) at -= centre;
    DrawnPart whole;
    whole.part = makePart(corners.data(), static_cast<int>(corners.size()), 0);
    return {whole};
}

std::vector<DrawnPart> chainParts(const std::vector<Vec2>& line, const Vec2& centre, double length)
{
    return wallParts(chainSides(line), centre, length);
}

}  // namespace jet::physics
