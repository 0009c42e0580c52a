// Entities a drawing declares itself (<!ENTITY st0 "fill:#fff">, as Illustrator writes them), put in place of their
// references.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace jet::svg {

struct Expansion {
    std::string text;
    /// (offset in text, offset in the source) where the two run side by side from; sorted.
    std::vector<std::pair<std::size_t, std::size_t>> places;
    /// Names of entities left as they stand: they contain themselves or grow beyond all measure ("billion laughs").
    std::vector<std::string> refused;
};

/// Only entities with a literal value are known; external ones ("SYSTEM") are never read and stay as they stand.
Expansion expandEntities(std::string_view source);

}  // namespace jet::svg
