// What a plugin may leave behind when it should be gone.
#pragma once

#include <cstdint>
#include <filesystem>

namespace jet::host {

/// Threads of this process that have code of the plugin at this place of the CallBoard on their stacks, but the calling
/// one.
int threadsIn(std::uint16_t place);
/// Is a library of that path still loaded?
bool isMapped(const std::filesystem::path& library);

}  // namespace jet::host
