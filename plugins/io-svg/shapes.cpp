#include "shapes.hpp"

#include <cmath>

namespace jet::svg {

namespace {

class ShapeReader {
public:
    ShapeReader(const Document& document, ElementIndex e, const LengthContext& lengths, Report& report)
        : document_(document), e_(e), element_(document[e]), lengths_(lengths), report_(report)
    {
    }

    Path rectangle() const
    {
        const Vec2 size(length("width", Axis::X), length("height", Axis::Y));
        if (!(size.minCoeff() > 0)) return {};
        const Vec2 corner(length("x", Axis::X), length("y", Axis::Y));
        const Box box(corner, corner + size);
        const Vec2 radii = cornerRadii().cwiseMin(0.5 * size);
        return radii.minCoeff() > 0 ? rounded(box, radii) : Path::rectangle(box);
    }

    Path circle() const
    {
        const double r = length("r", Axis::Diagonal);
        return ellipseAt(Vec2(r, r));
    }

    Path ellipse() const
    {
        const auto [rx, ry] = radii();
        return ellipseAt(Vec2(rx.value_or(0), ry.value_or(0)));
    }

    Path line() const
    {
        return Path::line({length("x1", Axis::X), length("y1", Axis::Y)},
                          {length("x2", Axis::X), length("y2", Axis::Y)});
    }

    Path polyline(bool closed) const
    {
        bool complete = false;
        const std::vector<double> numbers = parseNumbers(element_.attribute("points"), &complete);
        if (!complete || numbers.size() % 2 != 0) {
            report_.note("the list of points is faulty; it is drawn up to there", document_.offsetOf(e_, "points"));
        }
        std::vector<Vec2> points;
        for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) points.emplace_back(numbers[i], numbers[i + 1]);
        return points.size() < 2 ? Path() : Path::polygon(points, closed);
    }

    Path path() const
    {
        const std::string_view data = element_.node.attribute("d").value();
        if (trimmed(data) == "none") return {};
        Error problem;
        Path result = Path::parsePrefix(data, &problem);
        if (!problem.message.empty()) {
            const auto column = std::size_t(std::max(problem.where.column, 1) - 1);
            std::string message = problem.message;
            if (message.ends_with('.')) message.pop_back();
            message.front() = lower(message.front());
            report_.note(message + "; the path is drawn up to there", document_.offsetOf(e_, "d") + column);
        }
        return result;
    }

private:
    using Radius = std::optional<double>;

    double length(const char* name, Axis axis) const { return radius(name, axis, true).value_or(0); }

    Radius radius(const char* name, Axis axis, bool negativeToo = false) const
    {
        const std::string_view text = element_.attribute(name);
        if (text.empty() || text == "auto") return {};
        const Radius value = parseLength(text, lengths_, axis);
        if (!value) {
            report_.note("'" + std::string(text.substr(0, 40)) + "' is no length for " + name + "; it is left out",
                         document_.offsetOf(e_, name));
        }
        return value && (negativeToo || *value >= 0) ? value : Radius();
    }

    // One radius stands for both where the other is missing or negative.
    std::pair<Radius, Radius> radii() const
    {
        Radius rx = radius("rx", Axis::X), ry = radius("ry", Axis::Y);
        if (!rx) rx = ry;
        if (!ry) ry = rx;
        return {rx, ry};
    }

    Vec2 cornerRadii() const
    {
        const auto [rx, ry] = radii();
        return {rx.value_or(0), ry.value_or(0)};
    }

    Path ellipseAt(const Vec2& radii) const
    {
        if (!(radii.minCoeff() > 0)) return {};
        const Vec2 center(length("cx", Axis::X), length("cy", Axis::Y));
        return Path::ellipse(Box(center - radii, center + radii));
    }

    // SVG 2, section 10.2: clockwise from the end of the top left corner.
    static Path rounded(const Box& box, const Vec2& r)
    {
        const auto [left, top] = std::pair(box.min.x(), box.min.y());
        const auto [right, bottom] = std::pair(box.max.x(), box.max.y());
        Path path;
        path.moveTo({left + r.x(), top});
        path.lineTo({right - r.x(), top});
        path.arcTo(r, 0, false, true, {right, top + r.y()});
        path.lineTo({right, bottom - r.y()});
        path.arcTo(r, 0, false, true, {right - r.x(), bottom});
        path.lineTo({left + r.x(), bottom});
        path.arcTo(r, 0, false, true, {left, bottom - r.y()});
        path.lineTo({left, top + r.y()});
        path.arcTo(r, 0, false, true, {left + r.x(), top});
        path.close();
        return path;
    }

    const Document& document_;
    ElementIndex e_;
    const Element& element_;
    const LengthContext& lengths_;
    Report& report_;
};

}  // namespace

bool isShape(Tag tag)
{
    switch (tag) {
    case Tag::Path:
    case Tag::Rect:
    case Tag::Circle:
    case Tag::Ellipse:
    case Tag::Line:
    case Tag::Polyline:
    case Tag::Polygon: return true;
    default: return false;
    }
}

Path shapePath(const Document& document, ElementIndex e, const LengthContext& lengths, Report& report)
{
    const ShapeReader reader(document, e, lengths, report);
    switch (document[e].tag) {
    case Tag::Path: return reader.path();
    case Tag::Rect: return reader.rectangle();
    case Tag::Circle: return reader.circle();
    case Tag::Ellipse: return reader.ellipse();
    case Tag::Line: return reader.line();
    case Tag::Polyline: return reader.polyline(false);
    case Tag::Polygon: return reader.polyline(true);
    default: return {};
    }
}

}  // namespace jet::svg
