// What a project knows of its files: limits shared by reader and writer, what was read and written last, who watches.
#pragma once

#include <jet/project.hpp>

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>

namespace jet {

inline constexpr int kMaximumFilterDepth = 100;

/// A file as it was read or written last.
struct FileState {
    std::uint64_t hash = 0;  ///< of the content
    std::uint64_t size = 0;
    std::int64_t modified = 0;  ///< nanoseconds since 1970
};

std::uint64_t contentHash(std::string_view content);
/// Size and time of the file now, hash left 0; nothing when there is no such file.
std::optional<FileState> statFile(const std::filesystem::path& file);
/// Is the file on disk another one than `known`? Reads it only where its size is the same and its time is not.
bool differsOnDisk(const std::filesystem::path& file, const FileState& known);

/// A file that is about to be written; `path` is relative to the project's folder.
struct FileToWrite {
    std::string path;
    const Scene* scene = nullptr;  ///< null for project.jet
    std::string content;
    std::uint64_t hash = 0;
};

/// Hears of what happens to a project besides the events of its scenes: its journal.
class ProjectWatcher {
public:
    virtual ~ProjectWatcher() = default;
    virtual void sceneAdded(Scene& scene) = 0;
    /// Before the first byte is written. `elsewhere`: to another place than the project had.
    virtual void aboutToSave(std::span<const FileToWrite> files, bool elsewhere) = 0;
    /// All of it was written and synced.
    virtual void saved() = 0;
};

/// Which scene was chosen to start with. None: the first one, whichever that is.
struct StartChoice {
    const Scene* scene = nullptr;  ///< in the project
    std::string missing;           ///< else, the name the file gives, which no scene has: kept as it is
    bool operator==(const StartChoice&) const = default;
    /// The attribute of project.jet; empty: none.
    std::string name() const { return scene ? scene->name() : missing; }
};
StartChoice& startChoice(const Project& project);
/// By the name of an attribute or a journal; empty: none.
StartChoice startCalled(const Project& project, const std::string& name);

struct Project::Files {
    StartChoice start;
    std::map<std::string, FileState> known;  ///< by path relative to the project's folder
    std::set<const Scene*> unsaved;  ///< differ from their files although their history says nothing: recovered ones
    bool structureUnsaved = false;   ///< the same of project.jet
    ProjectWatcher* watcher = nullptr;
    std::size_t backups = kDefaultBackups;
    std::vector<std::string> notes;  ///< of the last save
    std::set<std::string> migrated;  ///< files read from an older format, not written since; paths as in `known`
    int oldestVersion = 0;           ///< of theirs
};

/// Copies what the project's files are now into a new folder of .jet-backups, and removes the oldest beyond `count`.
/// Files are paths relative to `folder`; those that do not exist are left out. Unchanged files share their space. With
/// a `formatVersion` it is the original of a project of that version: it stays, and does not count.
Result<void> backUp(const std::filesystem::path& folder, const std::string& project, const std::set<std::string>& files,
                    std::size_t count, std::optional<int> formatVersion = {});

}  // namespace jet
