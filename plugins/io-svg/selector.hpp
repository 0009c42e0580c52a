// Reading and testing compound selectors.
#pragma once

#include "css.hpp"

#include <optional>

namespace jet::svg {

/// "g > rect.solid" from right to left. None for what is not known here: such a rule never holds.
std::optional<std::vector<Compound>> parseSelector(std::string_view text);
/// CSS 2.1, section 6.4.3, as 8 bits for each of ids, classes and types.
std::uint64_t specificity(const std::vector<Compound>& selector);
/// Does the element itself satisfy the compound?
bool satisfies(const Element& element, const Compound& compound);
bool hasWord(std::string_view list, std::string_view word);

}  // namespace jet::svg
