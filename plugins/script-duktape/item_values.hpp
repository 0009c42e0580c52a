// Properties of items as JavaScript values, by the kinds the item type declares.
#pragma once

#include "native.hpp"

#include <jet/value.hpp>

#include <string>

namespace jet::duktape {

bool hasProperty(Native& call, const Item& item, const std::string& property);
/// Pushes the stored value, else the default. Throws Complaint for an unknown property, naming the known ones.
void pushProperty(Native& call, const Item& item, const std::string& property);
/// The argument as a value for that property. Throws Complaint when it is of another kind.
Value propertyFrom(Native& call, const Item& item, const std::string& property, duk_idx_t index);

}  // namespace jet::duktape
