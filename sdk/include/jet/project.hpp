// Project: a tree of filters and scenes, kept in a folder of text files (docs/file-format.md).
#pragma once

#include <jet/format.hpp>
#include <jet/scene.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace jet {

/// A folder of the Scenes panel: filters and scenes in order (thesis §3, SPEC EN1).
struct Filter {
    std::string name;
    std::vector<std::unique_ptr<Filter>> filters;
    std::vector<std::unique_ptr<Scene>> scenes;
};

/// A plugin the project's scenes use.
struct PluginUse {
    std::string id, version;
    int count = 0;  ///< items, effects and engines that come from it
    std::vector<std::pair<ContributionKind, std::string>> provides = {};  ///< which ones, by kind and id
};

/// What saving does with a file that another program changed since it was read or written last.
enum class Overwrite {
    Refuse,  ///< fails before anything is written, naming the file
    Allow,   ///< replaces it; the file as it was goes to the backups
};

/// A former state of a project, kept beside it (docs/file-format.md, "Backups").
struct Backup {
    std::string name;              ///< its time, UTC: "2031-05-01T12-30-05.250"
    std::filesystem::path folder;  ///< with project.jet and the scenes as they were
};

class JET_API Project {
public:
    /// Former states kept when a save replaces them.
    static constexpr std::size_t kDefaultBackups = 10;

    /// A new project with one filter "Filter0" and one empty scene "Scene 0" with a layer.
    static std::unique_ptr<Project> create(std::string name, EventsCenter& events, Catalog& catalog);
    /// Reads `project.jet` (or the folder that holds it) and its scenes. The error names file, line and column.
    /// What a missing plugin wrote is kept as it is and listed in notes().
    static Result<std::unique_ptr<Project>> load(const std::filesystem::path& path, EventsCenter& events,
                                                 Catalog& catalog, const Progress& progress = {});
    ~Project();

    const std::string& name() const { return name_; }
    void setName(std::string name) { name_ = std::move(name); }
    /// The project.jet file; empty for a project that was never saved.
    const std::filesystem::path& file() const { return file_; }
    Filter& root() { return root_; }
    const Filter& root() const { return root_; }
    std::vector<Scene*> scenes() const;
    /// By name; null if none.
    Scene* scene(std::string_view name) const;
    Scene& addScene(std::string name, Filter* filter = nullptr);
    /// Removes from the project (its file goes at the next save); events are the caller's business.
    void removeScene(const Scene& scene);
    /// "Scene 0", "Scene 1", ...: the first that is free.
    std::string freeSceneName() const;

    /// Writes what changed; each file atomically, project.jet last, so that a crash leaves a project that opens. The
    /// files it replaces go to the backups first.
    Result<void> save(Overwrite overwrite = Overwrite::Refuse);
    /// Writes everything to another folder or .jet file, which is the project's from then on. Replaces the project that
    /// is there: ask before.
    Result<void> saveAs(const std::filesystem::path& folderOrFile);
    /// Anything not saved?
    bool isModified() const;
    /// Files that other programs changed since they were read or written last, as paths to show.
    std::vector<std::filesystem::path> changedOnDisk() const;
    /// What the last save could not do besides its work, e.g. keep a backup. Sentences.
    const std::vector<std::string>& saveNotes() const;
    /// How many former states a save keeps; 0: none.
    void setBackupCount(std::size_t count);
    /// The newest first.
    std::vector<Backup> backups() const;
    /// Where the project's files lie: the folder of file().
    std::filesystem::path folder() const;

    /// Loaded with these remarks (missing plugins, placeholders).
    const std::vector<FormatNote>& notes() const { return notes_; }
    std::vector<PluginUse> pluginsUsed() const;
    /// The same as its file says: of when it was saved last, by whatever versions.
    const std::vector<PluginUse>& recordedPlugins() const { return recordedUses_; }
    /// Hash over all scenes' content and the tree's structure.
    std::uint64_t hash() const;

private:
    Project(EventsCenter& events, Catalog& catalog);
    /// Names, filters and scene files: what project.jet says besides the plugins used.
    std::string structure() const;
    EventsCenter& events_;
    Catalog& catalog_;
    std::string name_;
    std::filesystem::path file_;
    Filter root_;
    std::vector<FormatNote> notes_;
    std::vector<std::filesystem::path> obsoleteFiles_;
    std::map<const Scene*, std::string> sceneFiles_;  ///< relative to the project's folder, '/' between parts
    std::vector<PluginUse> recordedUses_;             ///< as read: kept for plugins that are not installed
    std::string savedStructure_;
    struct Files;
    std::unique_ptr<Files> files_;
    friend class ProjectReader;
    friend class ProjectWriter;
    friend class ProjectRecovery;
    friend class Journal;
};

/// Puts a backup's files back in place. The state they replace becomes the newest backup.
JET_API Result<void> restoreBackup(const std::filesystem::path& projectFile, const std::string& name);
/// Keeps the project's files as they are now as the newest backup: for programs that change them by themselves.
JET_API Result<void> backUpProject(const std::filesystem::path& projectFile);
/// The same as Project::backups(), for a project that cannot be opened.
JET_API std::vector<Backup> findBackups(const std::filesystem::path& projectFile);
/// The .jet file meant by a folder, or the file itself; an Error where there is none or several.
JET_API Result<std::filesystem::path> findProjectFile(const std::filesystem::path& path);

/// A scene as the text of its file, and back. `file` is for messages.
JET_API std::string writeSceneText(const Scene& scene);
JET_API Result<std::unique_ptr<Scene>> readSceneText(std::string text, const std::string& file, EventsCenter& events,
                                                     Catalog& catalog, std::vector<FormatNote>& notes);

}  // namespace jet
