// Zip archives, read with distrust and written with the same bytes for the same content.
#pragma once

#include <jet/result.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jet::host {

/// What an archive may be at most, and what it is called. A zip bomb meets one of the limits before it has filled
/// anything.
struct ArchiveLimits {
    std::size_t packageBytes = 256U << 20;    ///< of the archive itself
    std::size_t unpackedBytes = 1024U << 20;  ///< of all files together
    std::size_t files = 10'000;
    std::size_t ratio = 200;  ///< unpacked to packed, once more than `ratioFrom` came out
    std::size_t ratioFrom = 4U << 20;
    bool unicodeNames = false;               ///< names in UTF-8, as people give them; else ASCII only
    const char* what = "package";            ///< in messages: "this package is refused"
    const char* maker = "jet plugins pack";  ///< the command that makes one
};

struct ArchiveFile {
    std::string name;  ///< relative, '/' between parts
    std::string content;
    bool executable = false;
};

/// A zip with these files in the order of their names, without times, owners or folders: equal files, equal bytes.
Result<std::string> writeZip(std::vector<ArchiveFile> files);

/// Would unpackZip() take it? Reads all of it, writes nothing.
Result<void> checkZip(std::string_view bytes, const std::filesystem::path& package, const ArchiveLimits& limits = {});

/// Unpacks into `folder`, which exists and is empty. Refuses, naming the entry: names that lead elsewhere or meet each
/// other, symbolic and hard links, devices, encrypted entries, and what exceeds the limits. After an error the folder
/// holds a part, for the caller to drop. Files are synced to the disk. `package` is for messages.
Result<void> unpackZip(std::string_view bytes, const std::filesystem::path& folder,
                       const std::filesystem::path& package, const ArchiveLimits& limits = {});

/// One file of the archive, without unpacking the others.
Result<std::string> readFromZip(std::string_view bytes, std::string_view name, const std::filesystem::path& package,
                                const ArchiveLimits& limits = {});

}  // namespace jet::host
