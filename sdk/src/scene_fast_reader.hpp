// The fast way to read a scene: for text that is exactly what the writer makes of it.
#pragma once

#include "symbol_text.hpp"

#include <jet/scene.hpp>

#include <string_view>

namespace jet {

/// Where the items begin in such a text: what stands before, and `</scene>`, is a scene without items. npos where there
/// are none, or the text is another.
std::size_t itemsOf(std::string_view text);

/// Reads the items (the text from itemsOf() on) straight into the scene: without a document tree, and with one pass
/// over the text. False where anything is not as the writer writes it, is of a plugin that is absent, or wrong in any
/// way: then the scene holds some part, is to be thrown away, and the thorough reader to be asked, which also tells
/// what is wrong. What both read, they read as the same (tests/sdk/scene_fast_reader_test.cpp).
/// Adds to `instances` what is to be expanded.
bool readItems(std::string_view text, Scene& scene, std::vector<InstanceRecord>& instances);

}  // namespace jet
