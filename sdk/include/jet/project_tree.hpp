// ProjectTree: changes of a project's tree of filters and scenes, and of its files, that can be undone, by the same
// rules as changes of a scene: a step is whole or not at all, old states come back exactly, and a scene that was
// removed comes back as it was, with its own history. The window's is Editor::projectTree().
//
//   ProjectTree tree(project, events);
//   Scene& level = tree.addScene("Level 2", project.root());
//   tree.remove(level);
//   tree.undo();                       // the same Scene object, in its old place
#pragma once

#include <jet/project.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace jet {

/// Sent by the Project after each change of its tree by a ProjectTree, undo and redo included.
struct ProjectTreeChanged {
    static constexpr EventType type{"org.jet.project-tree-changed"};
    const Project* project;
};

/// Files that ProjectTree::removeFile() put aside, in this session or earlier ones.
struct RemovedFiles {
    std::vector<std::filesystem::path> files;  ///< absolute, sorted
    std::uintmax_t bytes = 0;
};
/// All that lie in the folder .jet-removed of a project's folder. [any thread]
JET_API RemovedFiles removedFiles(const std::filesystem::path& projectFolder);

/// The way to change a project's tree. Methods throw Failure, saying why, for what cannot be done; the tree is then as
/// before. While there is history, nothing else may remove scenes or filters from the project. [owner's thread]
class JET_API ProjectTree {
public:
    ProjectTree(Project& project, EventsCenter& events);
    ~ProjectTree();
    ProjectTree(const ProjectTree&) = delete;
    ProjectTree& operator=(const ProjectTree&) = delete;

    /// At the end of `parent`, or before `index`. Names of scenes are unique in the project and not empty.
    Scene& addScene(std::string name, Filter& parent, std::optional<std::size_t> index = {});
    Filter& addFilter(std::string name, Filter& parent, std::optional<std::size_t> index = {});
    /// The last scene and the root filter stay. A filter goes with all that is in it.
    void remove(Scene& scene);
    void remove(Filter& filter);
    void rename(Scene& scene, std::string name);
    void rename(Filter& filter, std::string name);
    /// Puts it before `index` among the scenes (filters) of `parent`, counted without itself.
    void move(Scene& scene, Filter& parent, std::size_t index);
    void move(Filter& filter, Filter& parent, std::size_t index);
    /// A copy under the next free name, right after it: content, settings, materials and symbols, without history.
    Scene& duplicate(Scene& scene);
    /// Makes it the scene that plays when none is named (jet/start_scene.hpp), whatever place it has in the tree.
    void makeStart(Scene& scene);

    /// Copies a file into the project's assets/ (jet/assets.hpp) and returns its path in the project. No step where a
    /// file of that content is there already.
    std::string addFile(const std::filesystem::path& source);
    /// Takes an asset out of the project; scenes may not refer to it. Undone, it is there again: meanwhile it lies in
    /// the hidden folder .jet-removed, where it stays when the history ends.
    void removeFile(const std::string& path);
    /// Gives an asset another name in its folder, and rewrites what refers to it, as one step of each scene.
    void renameFile(const std::string& path, const std::string& name);
    /// The removed files that neither Undo nor closing without saving will ask for: what may go for good.
    RemovedFiles disposableFiles() const;
    /// Deletes what disposableFiles() tells of. No step, and nothing brings them back: ask before. Returns how many
    /// went; those that cannot be deleted stay.
    std::size_t disposeFiles();
    /// The project was saved: revertFiles() goes back to here.
    void markSaved();
    /// Files change at once, scenes when they are saved. When the project is closed without saving, this puts removed
    /// and renamed files back to where the saved scenes expect them. Added ones stay.
    void revertFiles();

    /// Renames the project itself.
    void renameProject(std::string name);

    bool canUndo() const;
    bool canRedo() const;
    std::string undoLabel() const;
    std::string redoLabel() const;
    void undo();
    void redo();
    /// All labels, oldest first, and how many of them are done.
    std::vector<std::string> labels() const;
    std::size_t position() const;
    void goTo(std::size_t position);
    void clear();

    /// Memory removed scenes may take, an estimate in bytes: when they take more, the oldest steps are forgotten.
    void setMemoryLimit(std::size_t bytes);
    std::size_t memory() const;

private:
    struct Private;
    std::unique_ptr<Private> d_;
};

}  // namespace jet
