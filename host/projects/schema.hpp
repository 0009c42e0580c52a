// Files checked against the RELAX NG schemas that JET ships, by libxml2: a second opinion besides the reader's own.
#pragma once

#include "findings.hpp"

#include <filesystem>
#include <string_view>

namespace jet::host {

/// What the schema says of the text; a few findings at most. `file` is for messages.
Result<Findings> checkAgainstSchema(std::string_view text, const std::string& file,
                                    const std::filesystem::path& schema);

}  // namespace jet::host
