#include "viewport.hpp"

#include "transform.hpp"

namespace jet::svg {

namespace {

// CSS's size of a replaced element that says nothing about its own.
const Vec2 kDefaultSize(300, 150);

Viewport viewportAt(const Vec2& corner, const Vec2& size, const std::optional<Box>& viewBox, std::string_view aspect)
{
    Viewport viewport;
    viewport.size = size;
    viewport.userSize = viewBox ? viewBox->size() : size;
    viewport.toOuter =
        viewBox ? viewBoxTransform(*viewBox, Box(corner, corner + size), aspect) : Affine::translation(corner);
    return viewport;
}

// A length in pixels; none where it is missing or relative to a page that is not there.
std::optional<double> absoluteLength(std::string_view text, double fontSize)
{
    if (text.empty() || text == "auto" || text.ends_with('%')) return {};
    return parseLength(text, {kDefaultSize, kDefaultSize, fontSize}, Axis::X);
}

}  // namespace

std::optional<Viewport> outermostViewport(const Element& svg, double fontSize)
{
    const std::optional<double> width = absoluteLength(svg.attribute("width"), fontSize);
    const std::optional<double> height = absoluteLength(svg.attribute("height"), fontSize);
    const std::optional<Box> viewBox = parseViewBox(svg.attribute("viewBox"));
    const Vec2 natural = viewBox ? viewBox->size() : kDefaultSize;
    // A missing side keeps the proportions of the viewBox.
    Vec2 size = natural;
    if (width) size = {*width, viewBox && !height ? *width * natural.y() / natural.x() : size.y()};
    if (height) size = {width ? *width : viewBox ? *height * natural.x() / natural.y() : size.x(), *height};
    if (!(size.minCoeff() > 0)) return {};
    Viewport viewport = viewportAt({0, 0}, size, viewBox, svg.attribute("preserveAspectRatio"));
    viewport.sized = viewBox || (width && height);
    return viewport;
}

std::optional<Viewport> innerViewport(const Element& element, const Element* use, const LengthContext& lengths)
{
    const auto side = [&](const char* name, Axis axis) {
        std::string_view text = use ? use->attribute(name) : std::string_view();
        if (text.empty()) text = element.attribute(name);
        return parseLength(text.empty() || text == "auto" ? "100%" : text, lengths, axis).value_or(0);
    };
    const auto place = [&](const char* name, Axis axis) {
        return element.tag == Tag::Symbol ? 0 : parseLength(element.attribute(name), lengths, axis).value_or(0);
    };
    const Vec2 size(side("width", Axis::X), side("height", Axis::Y));
    if (!(size.minCoeff() > 0)) return {};
    return viewportAt({place("x", Axis::X), place("y", Axis::Y)}, size, parseViewBox(element.attribute("viewBox")),
                      element.attribute("preserveAspectRatio"));
}

}  // namespace jet::svg
