// A project as a single file, *.jetz, for sending: the zip of its folder. It is not edited in place: who wants to work
// on it unpacks it (docs/file-format.md, "The single-file form").
#pragma once

#include <jet/project.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace jet::host {

inline constexpr std::string_view kPackedProjectExtension = "jetz";

struct PackedProject {
    std::string bytes;
    std::size_t files = 0;
    std::vector<std::filesystem::path> outside;  ///< assets that lie elsewhere, so they are not in it
    std::vector<std::filesystem::path> missing;  ///< assets that are nowhere
};

/// Is this a file *.jetz (whatever is in it)?
bool isPackedProject(const std::filesystem::path& path);

/// The project as it is saved: all files of its folder but hidden ones, other projects (*.jet) and *.jetz files beside
/// the project file. Equal folders give equal bytes. Refuses, naming the file, what unpackProject() would refuse.
Result<PackedProject> packProject(const Project& project);

/// Unpacks into `folder`, which does not exist or is empty, all of it or nothing. Gives the project file in it.
Result<std::filesystem::path> unpackProject(const std::filesystem::path& packed, const std::filesystem::path& folder);

/// A copy in a temporary folder that goes with this object: for commands that only read.
class UnpackedProject {
public:
    static Result<UnpackedProject> make(const std::filesystem::path& packed);
    UnpackedProject(UnpackedProject&& other) noexcept;
    UnpackedProject& operator=(UnpackedProject&& other) = delete;
    ~UnpackedProject();

    const std::filesystem::path& folder() const { return folder_; }

private:
    explicit UnpackedProject(std::filesystem::path folder) : folder_(std::move(folder)) {}
    std::filesystem::path folder_;
};

}  // namespace jet::host
