#include "shape_items.hpp"

#include "shapes.hpp"

#include <cmath>

namespace jet::svg {

namespace {

constexpr double kFarthest = 1e9;  // scene units; beyond, coordinates lose the pixel
constexpr double kWidest = 1e6;    // what the stroke effect takes
constexpr double kMostMiter = 1e6;

bool isInBounds(const Path& path)
{
    for (const Contour& contour : path.contours()) {
        for (const Segment& s : contour.segments) {
            for (const Vec2& p : {s.point, s.in, s.out}) {
                if (!(p.cwiseAbs().maxCoeff() < kFarthest)) return false;  // also not for NaN
            }
        }
    }
    return true;
}

Color withOpacity(Color color, double opacity)
{
    color.a = std::uint8_t(std::lround(color.a * opacity));
    return color;
}

// Scene units; 0 where nothing is stroked. A width knows no direction: under a transform that stretches one way only it
// grows by the mean.
double strokeWidth(const Place& place)
{
    const Style& style = place.style;
    if (style.stroke.kind == Paint::Kind::None) return 0;
    return std::min(style.strokeWidth * (style.fixedStroke ? 1 : place.toScene.meanScale()), kWidest);
}

// pathLength says how long the author takes the path to be; dashes are measured in that.
double dashScale(const Element& element, const Path& path)
{
    const std::optional<double> declared = parseNumber(element.attribute("pathLength"));
    return declared && *declared > 0 ? path.length() / *declared : 1;
}

std::string dashText(const Style& style, double scale)
{
    std::string text;
    if (!style.dashes) return text;
    for (const double dash : *style.dashes) {
        if (!text.empty()) text += ' ';
        appendNumber(text, dash * scale);
    }
    return text;
}

}  // namespace

void ShapeItems::add(ElementIndex e, std::string_view name, const Place& place)
{
    const Path path = shapePath(document_, e, place.lengths, report_);
    if (path.isEmpty() || !place.toScene.isInvertible()) return;
    Path placed = path.transformed(place.toScene);
    if (!isInBounds(placed)) {
        report_.count("a shape has coordinates beyond all bounds; it is left out", document_.offsetOf(e));
        return;
    }
    if (place.shown && place.style.visible) drawn_.extend(placed.bounds().inflated(0.5 * strokeWidth(place)));
    const Item& item = edit_.add<ShapeItem>(*place.container, std::move(placed));
    ++count_;
    if (!name.empty()) edit_.set(item, "name", name);
    if (!place.shown || !place.style.visible) edit_.set(item, "visible", false);
    if (place.style.order.strokeFirst) addStroke(item, e, place, dashScale(document_[e], path));
    addFace(item, e, place);
    if (!place.style.order.strokeFirst) addStroke(item, e, place, dashScale(document_[e], path));
}

void ShapeItems::addFace(const Item& item, ElementIndex e, const Place& place)
{
    const Style& style = place.style;
    if (document_[e].tag == Tag::Line) return;  // has no inside
    const std::optional<Color> color = paints_.colorOf(style.fill, style, e);
    if (!color) return;
    addEffect(item, e, "polygon-face",
              {{"color", withOpacity(*color, style.fillOpacity * place.opacity)},
               {"curved", true},
               {"fill-rule", style.fillRule == FillRule::EvenOdd ? "evenodd" : "nonzero"}});
}

void ShapeItems::addStroke(const Item& item, ElementIndex e, const Place& place, double dashScale)
{
    const Style& style = place.style;
    if (!(strokeWidth(place) > 0)) return;
    const std::optional<Color> color = paints_.colorOf(style.stroke, style, e);
    if (!color) return;
    const double scale = style.fixedStroke ? 1 : place.toScene.meanScale();
    addEffect(item, e, "stroke",
              {{"color", withOpacity(*color, style.strokeOpacity * place.opacity)},
               {"width", strokeWidth(place)},
               {"cap", style.cap},
               {"join", style.join},
               {"miter-limit", std::min(style.miterLimit, kMostMiter)},
               {"dashes", dashText(style, scale * dashScale)},
               {"dash-offset", std::clamp(style.dashOffset * scale * dashScale, -kFarthest, kFarthest)}});
}

void ShapeItems::addEffect(const Item& item, ElementIndex e, std::string_view type, Properties properties)
{
    if (missing_.contains(type)) return;
    try {
        edit_.addEffect(item, type, std::move(properties));
    } catch (const Failure& failure) {
        missing_.emplace(type);
        report_.note("shapes are drawn without the effect '" + std::string(type) + "': " + failure.error().message,
                     document_.offsetOf(e));
    }
}

}  // namespace jet::svg
