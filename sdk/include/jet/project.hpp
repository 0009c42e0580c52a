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

class JET_API Project {
public:
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

    /// Writes what changed; each file atomically, project.jet last, so that a crash leaves a project that opens.
    Result<void> save();
    Result<void> saveAs(const std::filesystem::path& folderOrFile);
    /// Anything not saved?
    bool isModified() const;

    /// Loaded with these remarks (missing plugins, placeholders).
    const std::vector<FormatNote>& notes() const { return notes_; }
    std::vector<PluginUse> pluginsUsed() const;
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
    friend class ProjectReader;
    friend class ProjectWriter;
};

/// A scene as the text of its file, and back. `file` is for messages.
JET_API std::string writeSceneText(const Scene& scene);
JET_API Result<std::unique_ptr<Scene>> readSceneText(std::string text, const std::string& file, EventsCenter& events,
                                                     Catalog& catalog, std::vector<FormatNote>& notes);

}  // namespace jet
