// The computed style of an element: presentation attributes, style sheets and the style attribute, in their order, over
// what is inherited.
#pragma once

#include "css.hpp"
#include "length.hpp"

#include <jet/path.hpp>
#include <jet/value.hpp>

#include <array>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace jet::svg {

/// What fills or strokes: nothing, a colour, or a paint server with a colour in reserve.
struct Paint {
    enum class Kind { None, Color, CurrentColor, Server };
    Kind kind = Kind::None;
    Color color;
    std::string_view server = {};  ///< id, for kind Server
    Kind fallback = Kind::None;    ///< Color: `color`
    bool hasFallback = false;
};

/// paint-order, as far as it can be kept: markers between fill and stroke come last.
struct PaintOrder {
    bool strokeFirst = false, markersFirst = false;
};

struct Style {
    // inherited
    Color color{0, 0, 0, 255};
    double fontSize = 12;
    Paint fill{.kind = Paint::Kind::Color, .color = {0, 0, 0, 255}};
    Paint stroke;
    double fillOpacity = 1, strokeOpacity = 1;
    FillRule fillRule = FillRule::NonZero;
    double strokeWidth = 1;
    std::string_view cap = "butt", join = "miter";
    double miterLimit = 4;
    std::shared_ptr<const std::vector<double>> dashes;  ///< null: solid
    double dashOffset = 0;
    bool visible = true;
    PaintOrder order;
    std::array<std::string_view, 3> markers;  ///< ids of marker-start, -mid and -end; empty: none
    std::string_view fontFamily;              ///< a list, as written
    std::string_view anchor = "start";
    bool bold = false, italic = false;
    std::string_view whiteSpace;  ///< the CSS property; empty: xml:space tells
    // not inherited
    std::string_view baseline = "auto";  ///< dominant-baseline
    bool display = true;
    double opacity = 1;
    bool hasClipPath = false, hasMask = false, hasFilter = false;
    bool overflowVisible = false;
    bool fixedStroke = false;    ///< vector-effect: non-scaling-stroke
    std::string_view transform;  ///< the CSS property; empty: none
    Color stopColor{0, 0, 0, 255};
    double stopOpacity = 1;
};

/// One property that JET draws: how its value is read, and how it is inherited.
struct PropertyRule {
    std::string_view name;
    bool inherited = false;
    /// False, and nothing changed, for a value that is none of this property.
    bool (*read)(Style& style, std::string_view value, const LengthContext& lengths) = nullptr;
    void (*copy)(Style& style, const Style& from) = nullptr;
    bool attribute = true;  ///< may also be written as an attribute of its own
};

/// All of them; those that others depend on come first.
std::span<const PropertyRule> propertyRules();
/// Index into propertyRules(), or -1.
int findProperty(std::string_view name);

/// Computes styles. Views in a Style live as long as the document and this.
class StyleResolver {
public:
    explicit StyleResolver(const Document& document) : document_(document), sheet_(document) {}

    Style compute(ElementIndex e, const Style& parent, const LengthContext& lengths);
    /// Of an element outside of the drawing's flow (a gradient's stop): through all its ancestors.
    Style computeFromRoot(ElementIndex e);

private:
    struct Winner;
    void gather(ElementIndex e, std::span<Winner> winners);

    const Document& document_;
    StyleSheet sheet_;
    std::deque<std::string> texts_;  // style attributes that had comments
};

}  // namespace jet::svg
