// ShapeItems: makes scene items of shapes, with the effects that draw them as the SVG says.
#pragma once

#include "paint_server.hpp"

#include <jet/format.hpp>

#include <set>
#include <string>

namespace jet::svg {

/// Where and how something is drawn.
struct Place {
    const Item* container = nullptr;
    Affine toScene;  ///< user units to scene units
    Style style;
    LengthContext lengths;
    double opacity = 1;  ///< of the element and of all groups around it
    bool shown = true;   ///< false: display is none, here or at the <use> that leads here
    int depth = 0;       ///< containers around it
};

class ShapeItems {
public:
    ShapeItems(const Document& document, StyleResolver& styles, ImportRequest& request, Report& report)
        : document_(document), paints_(document, styles, report), edit_(request.edit), report_(report)
    {
    }

    /// Adds the shape element `e`, unless it has no extent or lies beyond all bounds.
    void add(ElementIndex e, std::string_view name, const Place& place);
    std::size_t count() const { return count_; }
    /// Scene units: of all shapes shown, with the widths of their strokes.
    const Box& drawn() const { return drawn_; }

private:
    void addFace(const Item& item, ElementIndex e, const Place& place);
    void addStroke(const Item& item, ElementIndex e, const Place& place, double dashScale);
    void addEffect(const Item& item, ElementIndex e, std::string_view type, Properties properties);

    const Document& document_;
    PaintServers paints_;
    Transaction& edit_;
    Report& report_;
    std::set<std::string, std::less<>> missing_;  // effects that could not be added
    std::size_t count_ = 0;
    Box drawn_;
};

}  // namespace jet::svg
