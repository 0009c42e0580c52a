// Paint servers as the one colour that stands for them: JET's faces have no gradients yet.
#pragma once

#include "style.hpp"

#include <optional>
#include <unordered_map>

namespace jet::svg {

class PaintServers {
public:
    PaintServers(const Document& document, StyleResolver& styles, Report& report)
        : document_(document), styles_(styles), report_(report)
    {
    }

    /// The colour a paint gives an element of that style, without its opacity. None: nothing is painted.
    std::optional<Color> colorOf(const Paint& paint, const Style& style, ElementIndex user);

private:
    std::optional<Color> serverColor(ElementIndex server, ElementIndex user);
    std::optional<Color> mean(ElementIndex gradient);
    ElementIndex ownerOfStops(ElementIndex gradient) const;

    const Document& document_;
    StyleResolver& styles_;
    Report& report_;
    std::unordered_map<ElementIndex, std::optional<Color>> means_;
};

}  // namespace jet::svg
