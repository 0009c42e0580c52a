// TextItems: makes text items of <text> with its <tspan>s, one for each piece that has a place or a style of its own.
#pragma once

#include "shape_items.hpp"

namespace jet::svg {

class TextItems {
public:
    TextItems(const Document& document, StyleResolver& styles, ImportRequest& request, Report& report)
        : document_(document), styles_(styles), paints_(document, styles, report), edit_(request.edit), report_(report)
    {
    }

    void add(ElementIndex e, std::string_view name, const Place& place);
    std::size_t count() const { return count_; }
    /// Scene units: of all texts shown, by estimated widths.
    const Box& drawn() const { return drawn_; }

private:
    /// What is set in one go: one place, one style.
    struct Run {
        std::string text;
        Style style;
        Vec2 at;             // where its baseline starts or, by its anchor, has its middle or end; user units
        bool placed = true;  // says itself where it is; else it follows the one before
        ElementIndex element = kNoElement;
    };
    class Reader;

    void arrange(std::vector<Run>& runs);
    void addItem(const Run& run, const Item& container, std::string_view name, const Place& place);

    const Document& document_;
    StyleResolver& styles_;
    PaintServers paints_;
    Transaction& edit_;
    Report& report_;
    std::size_t count_ = 0;
    Box drawn_;
};

}  // namespace jet::svg
