// What people type into number fields: expressions and units, read as one number.
//
//   sum     = product { ("+" | "-") product }
//   product = power { ("*" | "/" | "×" | "÷") power }
//   power   = sign [ "^" power ]
//   sign    = ("-" | "+") sign | value
//   value   = ( number | "(" sum ")" | function "(" sum ")" | "pi" | "e" | "tau" | "x" ) [ unit | "%" ]
//
// Functions: sqrt abs sin cos tan asin acos atan exp ln log round floor ceil; angles are radians. "x" is the present
// value, "50%" the half of it. A decimal comma reads as a point.
#pragma once

#include <jet/result.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace jet::ui {

struct NumberContext {
    std::string unit;               ///< of the field, as the property declares it; empty: a plain number
    std::optional<double> present;  ///< none: several values that differ
};

/// The number that the text means in the field's unit. Other units of the same kind are converted: mm, cm, m, in, pt,
/// pc and px in a field of scene units (96 to an inch, as in SVG), deg, ° and turn in one of radians, ms and min in one
/// of seconds, g and t in one of kilograms. The error is a sentence for who typed it, its column where it is wrong.
/// [any thread]
JET_API Result<double> evaluateNumber(std::string_view text, const NumberContext& context);

}  // namespace jet::ui
