// Pictures from files, decoded once and kept while they are in use.
#pragma once

#include <QImage>

#include <string>
#include <string_view>

namespace jet::ui {

/// The picture in the file, or in a "data:" address; a relative name starts from `folder`. Null when it cannot be read
/// or is larger than 128 megapixels. Decoded again when the file has changed. [GUI thread, or the only thread there is]
QImage pictureFile(const std::string& folder, std::string_view file);

}  // namespace jet::ui
