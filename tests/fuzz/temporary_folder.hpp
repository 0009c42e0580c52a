// A folder of this process, in memory where the system has such a place, removed at its end.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

namespace jet::fuzz {

inline const std::filesystem::path& temporaryFolder()
{
    namespace fs = std::filesystem;
    static const fs::path made = [] {
        std::error_code ignored;
        const fs::path base = fs::is_directory("/dev/shm", ignored) ? "/dev/shm" : fs::temp_directory_path();
        std::string name = (base / "jet-fuzz-XXXXXX").string();
        const fs::path folder = ::mkdtemp(name.data());
        std::atexit([] { fs::remove_all(temporaryFolder()); });
        return folder;
    }();
    return made;
}

inline void put(const std::filesystem::path& file, std::string_view bytes)
{
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace jet::fuzz
