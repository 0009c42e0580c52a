// Instances in scene files: a line says which symbol and where, the ids of the items that come from it, nothing more.
#pragma once

#include "symbol_links.hpp"

#include <jet/result.hpp>

#include <string>
#include <vector>

namespace jet {

/// What a file says of an instance.
struct InstanceRecord {
    ItemId instance;
    std::vector<ItemId> ids;  ///< of its items, parents before what is in them; may be too few or too many
    Location where;
};

/// `<instance symbol="20" matrix="1 0 0 1 40 0" ids="7-9 12"/>`, without the indentation.
void appendInstance(std::string& out, const Item& instance);
/// As in SVG, without parentheses: a b c d e f. None for other text.
std::optional<Affine> parseMatrix(std::string_view text);
/// Numbers and ranges. None for other text.
std::optional<std::vector<ItemId>> parseIds(std::string_view text);
/// Makes the items of all instances, of those in symbols first. Throws Failure at the place of an instance whose symbol
/// is not there or would be a part of itself, and of one whose ids are taken.
void expandInstances(Scene& scene, const std::vector<InstanceRecord>& records);

}  // namespace jet
