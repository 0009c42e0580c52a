// ProjectTree: changes of a project's tree of filters and scenes that can be undone, by the same rules as changes of a
// scene: a step is whole or not at all, old states come back exactly, and a scene that was removed comes back as it
// was, with its own history.
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
