// Paths, transforms, pens and brushes of the SDK as Qt's.
#include "qt_convert.hpp"

#include <jet/ui/qt_painter.hpp>

#include <QPainterPath>
#include <QTransform>

#include <algorithm>
#include <numeric>

namespace jet::ui {

namespace {

// More dashes than this on one path cannot be told apart; making them only takes time.
constexpr double kMostDashes = 100'000;

// Qt drops all but the last of the stops at one offset; SVG wants a hard edge there. The step is far below one of the
// 1,024 colours Qt takes from a gradient.
constexpr double kHardEdge = 1e-6;

QGradientStops stopsOf(const std::vector<GradientStop>& stops)
{
    QGradientStops result;
    double last = -kHardEdge;
    for (const GradientStop& stop : stops) {
        last = std::max(std::clamp(stop.offset, 0.0, 1.0), last + kHardEdge);
        result.push_back({std::min(last, 1.0), toQt(stop.color)});
    }
    return result;
}

QBrush finished(QGradient& gradient, const std::vector<GradientStop>& stops, const Brush& brush)
{
    gradient.setStops(stopsOf(stops));
    gradient.setInterpolationMode(QGradient::ComponentInterpolation);  // not premultiplied, as SVG has it
    gradient.setSpread(brush.spread == GradientSpread::Reflect  ? QGradient::ReflectSpread
                       : brush.spread == GradientSpread::Repeat ? QGradient::RepeatSpread
                                                                : QGradient::PadSpread);
    QBrush result(gradient);
    result.setTransform(toQt(brush.transform));
    return result;
}

QBrush lastStop(const std::vector<GradientStop>& stops)
{
    return stops.empty() ? QBrush(Qt::NoBrush) : QBrush(toQt(stops.back().color));
}

struct BrushMaker {
    const Brush& brush;

    QBrush operator()(Color color) const { return QBrush(toQt(color)); }

    QBrush operator()(const LinearGradient& linear) const
    {
        if (linear.from == linear.to || linear.stops.size() < 2) return lastStop(linear.stops);
        QLinearGradient gradient(toQt(linear.from), toQt(linear.to));
        return finished(gradient, linear.stops, brush);
    }

    QBrush operator()(const RadialGradient& radial) const
    {
        if (!(radial.radius > 0) || radial.stops.size() < 2) return lastStop(radial.stops);
        QRadialGradient gradient(toQt(radial.center), radial.radius, toQt(radial.focus));
        return finished(gradient, radial.stops, brush);
    }
};

// A dash without length still has its caps: the dots of a dotted line. Qt leaves it out; a very short one it draws.
constexpr double kDot = 1e-3;  // pen widths

// Qt counts dashes in pen widths and wants pairs.
QList<qreal> dashPattern(const Pen& pen, double length)
{
    const double period = std::accumulate(pen.dashes.begin(), pen.dashes.end(), 0.0);
    const bool negative = std::any_of(pen.dashes.begin(), pen.dashes.end(), [](double d) { return !(d >= 0); });
    if (negative || !(period > 0) || !(length / period * double(pen.dashes.size()) < kMostDashes)) return {};
    QList<qreal> pattern;
    const int rounds = pen.dashes.size() % 2 == 0 ? 1 : 2;
    for (int round = 0; round < rounds; ++round) {
        for (const double dash : pen.dashes) {
            const bool isGap = pattern.size() % 2 == 1;
            pattern.push_back(isGap ? dash / pen.width : std::max(dash / pen.width, kDot));
        }
    }
    return pattern;
}

}  // namespace

QPainterPath toQt(const Path& path)
{
    QPainterPath result;
    for (const Contour& contour : path.contours()) {
        if (contour.segments.empty()) continue;
        result.moveTo(toQt(contour.segments.front().point));
        for (std::size_t i = 0; i < contour.curveCount(); ++i) {
            const Cubic c = contour.curve(i);
            if (c.isCornerLine()) {
                result.lineTo(toQt(c.p[3]));
            } else {
                result.cubicTo(toQt(c.p[1]), toQt(c.p[2]), toQt(c.p[3]));
            }
        }
        if (contour.closed) result.closeSubpath();
    }
    return result;
}

QTransform toQt(const Affine& m) { return {m(0, 0), m(1, 0), m(0, 1), m(1, 1), m(0, 2), m(1, 2)}; }

QBrush toQt(const Brush& brush) { return std::visit(BrushMaker{brush}, brush.fill); }

QPen toQt(const Pen& pen, double length)
{
    QPen result(toQt(pen.color), pen.width);
    result.setCosmetic(pen.cosmetic);
    result.setCapStyle(pen.cap == LineCap::Round    ? Qt::RoundCap
                       : pen.cap == LineCap::Square ? Qt::SquareCap
                                                    : Qt::FlatCap);
    // Qt::MiterJoin cuts a long miter at the limit; SvgMiterJoin bevels it, as SVG, PDF and canvas do.
    result.setJoinStyle(pen.join == LineJoin::Round   ? Qt::RoundJoin
                        : pen.join == LineJoin::Bevel ? Qt::BevelJoin
                                                      : Qt::SvgMiterJoin);
    result.setMiterLimit(pen.miterLimit);
    if (const QList<qreal> pattern = dashPattern(pen, length); !pattern.isEmpty()) {
        result.setDashPattern(pattern);
        result.setDashOffset(pen.dashOffset / pen.width);
    }
    return result;
}

}  // namespace jet::ui
