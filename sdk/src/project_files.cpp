#include "project_files.hpp"

#include "hasher.hpp"

#include <sys/stat.h>

namespace jet {

namespace fs = std::filesystem;

std::uint64_t contentHash(std::string_view content)
{
    Hasher h;
    h.add(content);
    return h.value();
}

std::optional<FileState> statFile(const fs::path& file)
{
    struct stat info {};
    if (::stat(file.c_str(), &info) != 0) return std::nullopt;
    FileState state;
    state.size = static_cast<std::uint64_t>(info.st_size);
    state.modified = static_cast<std::int64_t>(info.st_mtim.tv_sec) * 1'000'000'000 + info.st_mtim.tv_nsec;
    return state;
}

bool differsOnDisk(const fs::path& file, const FileState& known)
{
    const auto now = statFile(file);
    if (!now) return false;  // gone: there is nothing to lose
    if (now->size == known.size && now->modified == known.modified) return false;
    const auto content = readFile(file);
    return !content || contentHash(*content) != known.hash;
}

}  // namespace jet
