// How large the picture in a PNG, JPEG or GIF file is, from its head.
#pragma once

#include <jet/geometry.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace jet::svg {

/// In pixels; none for what is no such picture, or is cut off before it says.
std::optional<Vec2> sizeOfPicture(std::string_view bytes);

/// The content of a "data:" address (RFC 2397); none when it is malformed.
std::optional<std::string> contentOfData(std::string_view address);

}  // namespace jet::svg
