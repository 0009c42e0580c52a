// Icons: small line drawings in the colour of the text around them, sharp at every size, without a picture file or an
// SVG plugin.
#pragma once

#include <jet/version.hpp>

#include <QIcon>

#include <filesystem>
#include <string_view>
#include <vector>

namespace jet::ui {

/// A built-in icon by name ("play", "eye", "layer", "trash", ...; see iconNames()); a null icon for an unknown name.
/// [GUI thread]
JET_API QIcon icon(std::string_view name);
JET_API std::vector<std::string_view> iconNames();

/// An icon from a small SVG file as plugins ship them: path, rect, circle, ellipse, line, polyline and polygon with
/// `fill`, `stroke`, `stroke-width` and `opacity`; `currentColor` is the text colour of the window. A null icon when
/// the file cannot be read. [GUI thread]
JET_API QIcon iconFromFile(const std::filesystem::path& file);

}  // namespace jet::ui
