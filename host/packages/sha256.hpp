// SHA-256, by which an index names the very bytes of a package.
#pragma once

#include <string>
#include <string_view>

namespace jet::host {

/// As 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace jet::host
