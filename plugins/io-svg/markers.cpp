#include "markers.hpp"

#include "transform.hpp"

#include <cmath>
#include <numbers>

namespace jet::svg {

namespace {

// Direction of a curve at its start: towards the first point that differs.
Vec2 startDirection(const Cubic& c)
{
    for (std::size_t i = 1; i < 4; ++i) {
        if (c.p[i] != c.p[0]) return (c.p[i] - c.p[0]).normalized();
    }
    return {0, 0};
}

Vec2 endDirection(const Cubic& c)
{
    for (std::size_t i = 3; i-- > 0;) {
        if (c.p[i] != c.p[3]) return (c.p[3] - c.p[i]).normalized();
    }
    return {0, 0};
}

double angleBetween(const Vec2& in, const Vec2& out)
{
    const Vec2 sum = in + out;
    const Vec2 direction = sum.squaredNorm() > 1e-18 ? sum : perpendicular(in);  // a turn on the spot: at right angles
    return std::atan2(direction.y(), direction.x());
}

void appendVertices(const Contour& contour, std::vector<MarkerVertex>& out)
{
    const std::size_t curves = contour.curveCount();
    const auto in = [&](std::size_t vertex) {
        if (curves == 0 || (vertex == 0 && !contour.closed)) return Vec2(0, 0);
        return endDirection(contour.curve((vertex + curves - 1) % curves));
    };
    const auto leaving = [&](std::size_t vertex) {
        if (curves == 0 || (vertex == curves && !contour.closed)) return Vec2(0, 0);
        return startDirection(contour.curve(vertex % curves));
    };
    for (std::size_t i = 0; i <= curves; ++i) {  // a closed contour ends with a vertex at its start
        const Vec2 point = contour.segments[i % contour.segments.size()].point;
        out.push_back({MarkerKind::Mid, point, angleBetween(in(i), leaving(i))});
    }
}

double orientation(const Element& marker, const MarkerVertex& vertex)
{
    const std::string_view orient = marker.attribute("orient");
    if (orient == "auto") return vertex.angle;
    if (orient == "auto-start-reverse") {
        return vertex.kind == MarkerKind::Start ? vertex.angle + std::numbers::pi : vertex.angle;
    }
    const std::optional<double> degrees =
        parseNumber(orient.ends_with("deg") ? orient.substr(0, orient.size() - 3) : orient);
    return degrees.value_or(0) * std::numbers::pi / 180;
}

}  // namespace

std::vector<MarkerVertex> markerVertices(const Path& path)
{
    std::vector<MarkerVertex> vertices;
    for (const Contour& contour : path.contours()) {
        if (!contour.segments.empty()) appendVertices(contour, vertices);
    }
    if (!vertices.empty()) {
        vertices.back().kind = MarkerKind::End;
        vertices.front().kind = MarkerKind::Start;
    }
    return vertices;
}

std::optional<MarkerPlacement> placeMarker(const Element& marker, const MarkerVertex& vertex, double strokeWidth,
                                           const LengthContext& lengths)
{
    const auto length = [&](const char* name, Axis axis, double fallback) {
        return parseLength(marker.attribute(name), lengths, axis).value_or(fallback);
    };
    const Vec2 size(length("markerWidth", Axis::X, 3), length("markerHeight", Axis::Y, 3));
    if (!(size.minCoeff() > 0)) return {};
    const std::optional<Box> viewBox = parseViewBox(marker.attribute("viewBox"));
    const Affine content =
        viewBox ? viewBoxTransform(*viewBox, Box({0, 0}, size), marker.attribute("preserveAspectRatio")) : Affine();
    const Vec2 reference = content * Vec2(length("refX", Axis::X, 0), length("refY", Axis::Y, 0));
    const double scale = marker.attribute("markerUnits") == "userSpaceOnUse" ? 1 : strokeWidth;

    MarkerPlacement placement;
    placement.viewport = viewBox ? viewBox->size() : size;
    placement.toUser = Affine(Affine::translation(vertex.point) * Affine::rotation(orientation(marker, vertex)) *
                              Affine::scaling({scale, scale}) * Affine::translation(-reference) * content);
    return placement;
}

}  // namespace jet::svg
