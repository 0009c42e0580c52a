#include "clipper.hpp"

#include <jet/path_operations.hpp>
#include <jet/result.hpp>

#include <2geom/intersection-graph.h>
#include <2geom/pathvector.h>

#include <QPainterPath>
#include <QPainterPathStroker>

namespace jet::path_operations {

namespace {

// The clipper compares with absolute distances made for pixels: it works on paths brought to this size.
constexpr double kWorkingSize = 1000;

Box boundsOf(std::span<const Path> paths)
{
    Box box;
    for (const Path& path : paths) box.extend(path.bounds());
    return box;
}

Affine toWorking(const Box& box)
{
    const double size = std::max(box.size().maxCoeff(), 1e-9);
    return Affine::scaling(Vec2::Constant(kWorkingSize / size)) * Affine::translation(-box.center());
}

// Points nearer than this (working units) are the same, and sides between them are the clipper's crumbs.
constexpr double kSamePoint = 1e-5;

void addContour(Path& path, Path& single)
{
    if (single.isEmpty()) return;
    single.close();
    Contour contour = single.contours().front();
    if (contour.segments.size() > 1 && std::abs(single.area()) > kSamePoint)
        path.contours().push_back(std::move(contour));
    single = Path();
}

// --- lib2geom: exact on curves, but it gives up on outlines that touch along a length

Geom::Point geom(const Vec2& p) { return {p.x(), p.y()}; }
Vec2 fromGeom(const Geom::Point& p) { return {p.x(), p.y()}; }

Geom::PathVector toGeom(const Path& path)
{
    Geom::PathVector made;
    for (const Contour& contour : path.contours()) {
        if (contour.curveCount() == 0) continue;
        Geom::Path piece(geom(contour.segments.front().point));
        for (std::size_t i = 0; i < contour.curveCount(); ++i) {
            const Cubic curve = contour.curve(i);
            if (curve.isLine()) {
                piece.appendNew<Geom::LineSegment>(geom(curve.p[3]));
            } else {
                piece.appendNew<Geom::CubicBezier>(geom(curve.p[1]), geom(curve.p[2]), geom(curve.p[3]));
            }
        }
        piece.close();
        made.push_back(std::move(piece));
    }
    return made;
}

Path fromGeom(const Geom::PathVector& made)
{
    Path path;
    for (const Geom::Path& piece : made) {
        Path single;
        single.moveTo(fromGeom(piece.initialPoint()));
        for (const Geom::Curve& curve : piece) {
            if (const auto* cubic = dynamic_cast<const Geom::CubicBezier*>(&curve)) {
                single.cubicTo(fromGeom((*cubic)[1]), fromGeom((*cubic)[2]), fromGeom((*cubic)[3]));
            } else if ((curve.finalPoint() - curve.initialPoint()).length() > kSamePoint) {
                single.lineTo(fromGeom(curve.finalPoint()));
            }
        }
        addContour(path, single);
    }
    return path;
}

Path combineCurves(const Path& a, const Path& b, Boolean operation)
{
    Geom::PathIntersectionGraph graph(toGeom(a), toGeom(b));
    switch (operation) {
    case Boolean::Union: return fromGeom(graph.getUnion());
    case Boolean::Difference: return fromGeom(graph.getAminusB());
    case Boolean::Intersection: return fromGeom(graph.getIntersection());
    case Boolean::Exclusion: return fromGeom(graph.getXOR());
    }
    return {};
}

/// With the second area a millionth larger, so that outlines that touched along a length, or met in a segment, cross:
/// no gap between united neighbours, no film left of what is taken away. Films it makes itself are dropped.
Path combineNudged(const Path& a, const Path& b, Boolean operation)
{
    constexpr double kNudge = 2e-6, kFilm = 20 * kNudge * kWorkingSize;
    const Path larger = b.transformed(Affine::scaling(Vec2::Constant(1 + kNudge), b.bounds().center()));
    Path result = combineCurves(a, larger, operation);
    std::erase_if(result.contours(), [](const Contour& contour) {
        const Path single({contour});
        return 2 * std::abs(single.area()) < kFilm * single.length();
    });
    return result;
}

// --- Qt: takes all outlines, but makes polygons of them

QPointF qt(const Vec2& p) { return {p.x(), p.y()}; }

QPainterPath toQt(const Path& path)
{
    QPainterPath made;
    made.setFillRule(Qt::WindingFill);
    for (const Contour& contour : path.contours()) {
        if (contour.curveCount() == 0) continue;
        made.moveTo(qt(contour.segments.front().point));
        for (std::size_t i = 0; i < contour.curveCount(); ++i) {
            const Cubic curve = contour.curve(i);
            if (curve.isLine()) {
                made.lineTo(qt(curve.p[3]));
            } else {
                made.cubicTo(qt(curve.p[1]), qt(curve.p[2]), qt(curve.p[3]));
            }
        }
        made.closeSubpath();
    }
    return made;
}

Path fromQt(const QPainterPath& made)
{
    Path path, single;
    Vec2 at(0, 0);
    const auto point = [](const QPainterPath::Element& e) { return Vec2(e.x, e.y); };
    for (int i = 0; i < made.elementCount(); ++i) {
        const QPainterPath::Element& e = made.elementAt(i);
        switch (e.type) {
        case QPainterPath::MoveToElement:
            addContour(path, single);
            single.moveTo(at = point(e));
            break;
        case QPainterPath::LineToElement:
            if ((point(e) - at).norm() > kSamePoint) single.lineTo(at = point(e));
            break;
        case QPainterPath::CurveToElement: {
            const Vec2 end = point(made.elementAt(i + 2));
            single.cubicTo(point(e), point(made.elementAt(i + 1)), end);
            at = end;
            i += 2;
            break;
        }
        case QPainterPath::CurveToDataElement: break;
        }
    }
    addContour(path, single);
    return path;
}

bool inside(bool a, bool b, Boolean operation)
{
    switch (operation) {
    case Boolean::Union: return a || b;
    case Boolean::Difference: return a && !b;
    case Boolean::Intersection: return a && b;
    case Boolean::Exclusion: return a != b;
    }
    return false;
}

QPainterPath clip(const QPainterPath& a, const QPainterPath& b, Boolean operation)
{
    switch (operation) {
    case Boolean::Union: return a.united(b);
    case Boolean::Difference: return a.subtracted(b);
    case Boolean::Intersection: return a.intersected(b);
    case Boolean::Exclusion: return a.united(b).subtracted(a.intersected(b));
    }
    return {};
}

Path combinePolygons(const Path& a, const Path& b, Boolean operation)
{
    return simplifyPath(fromQt(clip(toQt(a), toQt(b), operation)), kWorkingSize * 2e-5);
}

/// Does the result hold the points it should? Asked of points spread over the bounds (R2 sequence), those near an
/// outline left out.
bool isRight(const Path& a, const Path& b, const Path& result, Boolean operation)
{
    constexpr int kProbes = 400;
    constexpr double kNear = kWorkingSize * 1e-3;
    Box box = a.bounds();
    box.extend(b.bounds());
    for (int i = 1; i <= kProbes; ++i) {
        const Vec2 at(std::fmod(i * 0.7548776662466927, 1.0), std::fmod(i * 0.5698402909980532, 1.0));
        const Vec2 probe = box.min + at.cwiseProduct(box.size());
        if (inside(a.contains(probe), b.contains(probe), operation) == result.contains(probe)) continue;
        if (a.nearest(probe).distance > kNear && b.nearest(probe).distance > kNear) return false;
    }
    return true;
}

Path combineTwo(const Path& a, const Path& b, Boolean operation)
{
    for (const auto way : {combineCurves, combineNudged, combinePolygons}) {
        try {
            Path result = orientContours(way(a, b, operation));
            if (isRight(a, b, result, operation)) return result;
        } catch (
            ...) {  // lib2geom throws several kinds, not all of them exceptions of the standard: the other way may do
        }
    }
    throw Failure(Error("these outlines could not be combined. Move one of them a little, and try again"));
}

}  // namespace

Path combine(std::span<const Path> paths, Boolean operation)
{
    if (paths.empty()) return {};
    const Affine working = toWorking(boundsOf(paths));
    Path result = paths.front().transformed(working);
    for (const Path& path : paths.subspan(1)) result = combineTwo(result, path.transformed(working), operation);
    return result.transformed(Affine(working.inverse()));
}

Path offset(const Path& path, double distance)
{
    if (distance == 0 || path.isEmpty()) return path;
    const Affine working = toWorking(path.bounds().inflated(std::abs(distance)));
    const double width = std::abs(distance) * working.meanScale();
    const QPainterPath area = toQt(path.transformed(working));
    QPainterPathStroker stroker;
    stroker.setWidth(2 * width);
    stroker.setJoinStyle(Qt::RoundJoin);
    stroker.setCurveThreshold(0.01);
    const QPainterPath band = stroker.createStroke(area).simplified();
    const QPainterPath made = distance > 0 ? area.united(band) : area.subtracted(band);
    // The stroker makes many small curves.
    const Path result = simplifyPath(orientContours(fromQt(made)), kWorkingSize * 2e-4);
    return result.transformed(Affine(working.inverse()));
}

}  // namespace jet::path_operations
