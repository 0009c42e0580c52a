// What the operating system said, as a sentence with a remedy; and making a new name in a folder outlive a power cut.
#pragma once

#include <jet/result.hpp>

#include <filesystem>
#include <string>

namespace jet {

Error systemError(const std::filesystem::path& file, const std::string& what, int code);
/// An Error where the folder says it could not (EIO); file systems that know no such thing are fine.
Result<void> syncFolder(const std::filesystem::path& folder);

}  // namespace jet
