// A project's files as a ProjectTree changes them: moved, and moved back.
#pragma once

#include <jet/project_tree.hpp>

#include <filesystem>
#include <set>
#include <string>

namespace jet {

/// A file that goes from one place to another, with the references that go along.
struct FileMove {
    std::filesystem::path from, to;          ///< absolute
    std::string oldReference, newReference;  ///< in the project, '/' between parts; empty: nobody refers to it

    FileMove inverse() const { return {to, from, newReference, oldReference}; }
};

/// Moves the file and rewrites the references, or throws Failure and leaves all as it is.
void moveFile(const FileMove& move, Project& project);

/// Is it where removed files lie?
bool isShelf(const std::filesystem::path& file);
/// All in there, but those.
RemovedFiles removedFiles(const std::filesystem::path& projectFolder, const std::set<std::filesystem::path>& but);
/// A copy of the file lies in .jet-removed then, from where the move brings it to assets/. Without `from`: a file of
/// that content is in the project already, at newReference.
FileMove prepareNewFile(const Project& project, const std::filesystem::path& source);
FileMove prepareRemoval(const Project& project, const std::string& path);
FileMove prepareRename(const Project& project, const std::string& path, const std::string& name);

/// "Level 2" gives "Level 3", "Menu" gives "Menu 2": the first that is free.
std::string freeCopyName(const Project& project, const std::string& name);

}  // namespace jet
