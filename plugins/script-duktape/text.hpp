// Text between C++ (UTF-8) and Duktape, whose strings are CESU-8: characters beyond U+FFFF are two surrogates there.
#pragma once

#include <duktape.h>

#include <string>
#include <string_view>

namespace jet::duktape {

void pushText(duk_context* ctx, std::string_view utf8);
/// Any value as text, as String(value) gives it; may run the script's own toString().
std::string textAt(duk_context* ctx, duk_idx_t index);
/// The string at index; empty for another type. Never runs a script.
std::string stringAt(duk_context* ctx, duk_idx_t index);

/// Lone surrogates and what is no UTF-8 at all become U+FFFD.
std::string utf8FromCesu8(std::string_view text);
std::string cesu8FromUtf8(std::string_view text);

/// At most `bytes` of it, cut between characters, with a remark on what is missing.
std::string shortened(std::string text, std::size_t bytes);

}  // namespace jet::duktape
