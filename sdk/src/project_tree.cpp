#include "project_files.hpp"
#include "project_tree_files.hpp"
#include "scene_state.hpp"
#include "utf8.hpp"

#include <jet/project_tree.hpp>

namespace jet {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(std::string message) { throw Failure(Error(std::move(message))); }

/// What a filter holds of one kind.
std::vector<std::unique_ptr<Scene>>& listOf(Filter& filter, const Scene*) { return filter.scenes; }
std::vector<std::unique_ptr<Filter>>& listOf(Filter& filter, const Filter*) { return filter.filters; }

struct Place {
    Filter* parent = nullptr;
    std::size_t index = 0;
};

/// A scene or filter put into the tree, or taken out of it. Who is not in the tree is kept here.
template <class T>
struct Presence {
    T* what;
    Place place;
    bool added;  // by redo; else by undo
    std::unique_ptr<T> detached;
    StartChoice start = {};  // as it was before it was taken out
};
template <class T>
struct Movement {
    Place from, to;  // `to` counted without what moves
};
struct Starting {
    StartChoice before, after;
};
struct Renaming {
    Scene* scene;    // else
    Filter* filter;  // else the project
    std::string before, after;
};

using TreeChange =
    std::variant<Presence<Scene>, Presence<Filter>, Movement<Scene>, Movement<Filter>, Starting, Renaming, FileMove>;

struct TreeStep {
    std::string label;
    TreeChange change;
    std::size_t bytes = 0;
};

std::size_t memoryOf(const Filter& filter);
std::size_t memoryOf(const Scene& scene) { return jet::memoryOf(&scene.root()) + scene.undoRedo().memory(); }
std::size_t memoryOf(const Filter& filter)
{
    std::size_t bytes = sizeof(Filter);
    for (const auto& scene : filter.scenes) bytes += memoryOf(*scene);
    for (const auto& child : filter.filters) bytes += memoryOf(*child);
    return bytes;
}

void checkName(const std::string& name, const char* what)
{
    if (name.empty()) fail(std::string("a ") + what + " needs a name");
    if (firstUnstorable(name) != std::string::npos)
        fail(std::string("the name of a ") + what + " must be UTF-8 without a NUL");
}

bool holds(const Filter& filter, const Filter& other)
{
    if (&filter == &other) return true;
    return std::ranges::any_of(filter.filters, [&](const auto& child) { return holds(*child, other); });
}

std::size_t sceneCount(const Filter& filter)
{
    std::size_t count = filter.scenes.size();
    for (const auto& child : filter.filters) count += sceneCount(*child);
    return count;
}

template <class T>
std::optional<Place> find(Filter& filter, const T& what)
{
    auto& all = listOf(filter, &what);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].get() == &what) return Place{&filter, i};
    for (const auto& child : filter.filters)
        if (const auto found = find(*child, what)) return found;
    return std::nullopt;
}

std::size_t depthOf(Filter& root, const Filter& filter)
{
    std::size_t depth = 0;
    for (auto place = find(root, filter); place; place = find(root, *place->parent)) ++depth;
    return depth;
}

std::size_t heightOf(const Filter& filter)
{
    std::size_t height = 0;
    for (const auto& child : filter.filters) height = std::max(height, heightOf(*child) + 1);
    return height;
}

constexpr std::size_t kDeepest = 100;  // as files have it

}  // namespace

struct ProjectTree::Private {
    Project& project;
    EventsCenter& events;
    std::deque<TreeStep> steps;
    std::size_t done = 0, bytes = 0, limit = UndoRedoCenter::kDefaultMemoryLimit;
    std::vector<FileMove> unsavedFiles = {};  // what happened to files since the last save, oldest first

    template <class T>
    Place placeOf(const T& what)
    {
        const auto found = find(project.root(), what);
        if (!found) fail("this is not in the project, or not any more");
        return *found;
    }

    void own(const Filter& filter)
    {
        if (&filter != &project.root()) placeOf(filter);
    }

    void checkFree(const std::string& name, const Scene* but = nullptr)
    {
        checkName(name, "scene");
        const Scene* other = project.scene(name);
        if (other && other != but) fail("there is a scene called '" + name + "' already; choose another name");
    }

    template <class T>
    static std::unique_ptr<T> take(const Place& place)
    {
        auto& all = listOf(*place.parent, static_cast<const T*>(nullptr));
        auto taken = std::move(all[place.index]);
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(place.index));
        return taken;
    }

    template <class T>
    static void put(const Place& place, std::unique_ptr<T> what)
    {
        auto& all = listOf(*place.parent, static_cast<const T*>(nullptr));
        all.insert(all.begin() + static_cast<std::ptrdiff_t>(std::min(place.index, all.size())), std::move(what));
    }

    template <class T>
    void apply(Presence<T>& change, bool forward)
    {
        if (change.added == forward) {
            put(change.place, std::move(change.detached));
            if (change.start.scene) startChoice(project) = change.start;
        } else {
            change.place = placeOf(*change.what);
            change.start = startChoice(project);
            change.detached = take<T>(change.place);
            disown(*change.detached);
        }
    }

    /// Its file goes at the next save. When the scene comes back, it gets one again.
    void disown(const Scene& scene) { project.removeScene(scene); }
    void disown(const Filter& filter)
    {
        for (const auto& scene : filter.scenes) disown(*scene);
        for (const auto& child : filter.filters) disown(*child);
    }

    template <class T>
    void apply(Movement<T>& change, bool forward)
    {
        put(forward ? change.to : change.from, take<T>(forward ? change.from : change.to));
    }
    void apply(const Starting& change, bool forward) { startChoice(project) = forward ? change.after : change.before; }
    void apply(Renaming& change, bool forward)
    {
        const std::string& name = forward ? change.after : change.before;
        if (change.scene) {
            change.scene->setName(name);
        } else if (change.filter) {
            change.filter->name = name;
        } else {
            project.setName(name);
        }
    }

    void apply(const FileMove& change, bool forward)
    {
        const FileMove now = forward ? change : change.inverse();
        moveFile(now, project);
        unsavedFiles.push_back(now);
    }

    void run(TreeStep& step, bool forward)
    {
        std::visit([&](auto& change) { apply(change, forward); }, step.change);  // fails before it did anything
        bytes -= step.bytes;
        step.bytes = sizeof(TreeStep);
        std::visit(
            [&](const auto& change) {
                if constexpr (requires { change.detached; })
                    if (change.detached) step.bytes += memoryOf(*change.detached);
            },
            step.change);
        bytes += step.bytes;
    }

    void make(std::string label, TreeChange change)
    {
        TreeStep step{std::move(label), std::move(change)};
        run(step, true);
        while (steps.size() > done) drop(steps.back()), steps.pop_back();
        steps.push_back(std::move(step));
        ++done;
        forgetOldest();
        tell();
    }

    void drop(const TreeStep& step) { bytes -= step.bytes; }
    void forgetOldest()
    {
        while (bytes > limit && steps.size() > 1 && done > 0) {
            drop(steps.front());
            steps.pop_front();
            --done;
        }
    }
    void tell() { events.post(&project, ProjectTreeChanged{&project}); }
};

ProjectTree::ProjectTree(Project& project, EventsCenter& events)
    : d_(std::make_unique<Private>(Private{project, events, {}}))
{
}
ProjectTree::~ProjectTree() = default;

// --- changes

Scene& ProjectTree::addScene(std::string name, Filter& parent, std::optional<std::size_t> index)
{
    d_->own(parent);
    d_->checkFree(name);
    const std::string label = "Add scene " + name;
    Scene& scene = d_->project.addScene(std::move(name), &parent);
    const Place at{&parent, std::min(index.value_or(parent.scenes.size()), parent.scenes.size() - 1)};
    auto made = Private::take<Scene>({&parent, parent.scenes.size() - 1});
    d_->make(label, Presence<Scene>{&scene, at, true, std::move(made)});
    return scene;
}

Scene& ProjectTree::duplicate(Scene& scene)
{
    const Place at = d_->placeOf(scene);
    if (scene.items().inTransaction())
        fail("finish or cancel '" + scene.items().transactionLabel() + "' before duplicating the scene");
    std::unique_ptr<Scene> made = scene.clone(d_->events);
    made->setName(freeCopyName(d_->project, scene.name()));
    Scene& copy = *made;
    d_->make("Duplicate scene " + scene.name(),
             Presence<Scene>{&copy, {at.parent, at.index + 1}, true, std::move(made)});
    return copy;
}

Filter& ProjectTree::addFilter(std::string name, Filter& parent, std::optional<std::size_t> index)
{
    d_->own(parent);
    checkName(name, "filter");
    if (depthOf(d_->project.root(), parent) + 1 > kDeepest) fail("filters would be nested more than 100 deep");
    auto made = std::make_unique<Filter>();
    made->name = std::move(name);
    Filter& filter = *made;
    const Place at{&parent, std::min(index.value_or(parent.filters.size()), parent.filters.size())};
    d_->make("Add filter " + filter.name, Presence<Filter>{&filter, at, true, std::move(made)});
    return filter;
}

void ProjectTree::remove(Scene& scene)
{
    const Place at = d_->placeOf(scene);
    if (sceneCount(d_->project.root()) == 1) fail("a project has at least one scene; add another one first");
    if (scene.items().inTransaction())
        fail("finish or cancel '" + scene.items().transactionLabel() + "' before removing the scene");
    d_->make("Remove scene " + scene.name(), Presence<Scene>{&scene, at, false, nullptr});
}

void ProjectTree::remove(Filter& filter)
{
    if (&filter == &d_->project.root()) fail("the outermost filter of a project cannot be removed");
    const Place at = d_->placeOf(filter);
    if (sceneCount(filter) == sceneCount(d_->project.root()))
        fail("all scenes of the project are in this filter; add or move one outside first");
    d_->make("Remove filter " + filter.name, Presence<Filter>{&filter, at, false, nullptr});
}

void ProjectTree::rename(Scene& scene, std::string name)
{
    d_->placeOf(scene);
    d_->checkFree(name, &scene);
    if (name == scene.name()) return;
    d_->make("Rename scene " + scene.name(), Renaming{&scene, nullptr, scene.name(), std::move(name)});
}

void ProjectTree::rename(Filter& filter, std::string name)
{
    d_->own(filter);
    checkName(name, "filter");
    if (name == filter.name) return;
    d_->make("Rename filter " + filter.name, Renaming{nullptr, &filter, filter.name, std::move(name)});
}

void ProjectTree::renameProject(std::string name)
{
    checkName(name, "project");
    if (name == d_->project.name()) return;
    d_->make("Rename project", Renaming{nullptr, nullptr, d_->project.name(), std::move(name)});
}

namespace {

template <class T>
Movement<T> movement(const Place& from, Filter& parent, std::size_t index, const T& what)
{
    const std::size_t room = listOf(parent, &what).size() - (from.parent == &parent ? 1 : 0);
    return {from, {&parent, std::min(index, room)}};
}

bool isStill(const Place& a, const Place& b) { return a.parent == b.parent && a.index == b.index; }

}  // namespace

void ProjectTree::move(Scene& scene, Filter& parent, std::size_t index)
{
    d_->own(parent);
    const auto change = movement(d_->placeOf(scene), parent, index, scene);
    if (!isStill(change.from, change.to)) d_->make("Move scene " + scene.name(), change);
}

void ProjectTree::move(Filter& filter, Filter& parent, std::size_t index)
{
    if (&filter == &d_->project.root()) fail("the outermost filter of a project cannot be moved");
    const Place from = d_->placeOf(filter);
    d_->own(parent);
    if (holds(filter, parent)) fail("'" + filter.name + "' cannot be moved into itself");
    if (depthOf(d_->project.root(), parent) + 1 + heightOf(filter) > kDeepest)
        fail("filters would be nested more than 100 deep");
    const auto change = movement(from, parent, index, filter);
    if (!isStill(change.from, change.to)) d_->make("Move filter " + filter.name, change);
}

void ProjectTree::makeStart(Scene& scene)
{
    d_->placeOf(scene);
    const StartChoice now = startChoice(d_->project), then{&scene, {}};
    if (!(now == then)) d_->make("Start with scene " + scene.name(), Starting{now, then});
}

// --- files

std::string ProjectTree::addFile(const fs::path& source)
{
    FileMove added = prepareNewFile(d_->project, source);
    if (added.from.empty()) return added.newReference;  // it is there already
    const std::string path = added.newReference;
    added.newReference.clear();
    d_->make("Add file " + path, std::move(added));
    return path;
}

void ProjectTree::removeFile(const std::string& path)
{
    d_->make("Remove file " + path, prepareRemoval(d_->project, path));
}

void ProjectTree::renameFile(const std::string& path, const std::string& name)
{
    FileMove move = prepareRename(d_->project, path, name);
    if (move.from != move.to) d_->make("Rename file " + path, std::move(move));
}

RemovedFiles ProjectTree::disposableFiles() const
{
    std::set<fs::path> needed;
    const auto note = [&](const FileMove& move) { needed.insert(move.from), needed.insert(move.to); };
    for (const TreeStep& step : d_->steps)
        if (const auto* move = std::get_if<FileMove>(&step.change)) note(*move);
    for (const FileMove& move : d_->unsavedFiles) note(move);
    if (d_->project.file().empty()) return {};
    return removedFiles(d_->project.folder(), needed);
}

std::size_t ProjectTree::disposeFiles()
{
    std::size_t count = 0;
    std::error_code ignored;
    for (const fs::path& file : disposableFiles().files) count += fs::remove(file, ignored) ? 1 : 0;
    return count;
}

void ProjectTree::markSaved() { d_->unsavedFiles.clear(); }

void ProjectTree::revertFiles()
{
    std::error_code ignored;
    for (auto move = d_->unsavedFiles.rbegin(); move != d_->unsavedFiles.rend(); ++move)
        if (!isShelf(move->from) && !fs::exists(move->from, ignored)) fs::rename(move->to, move->from, ignored);
    d_->unsavedFiles.clear();
}

// --- history

bool ProjectTree::canUndo() const { return d_->done > 0; }
bool ProjectTree::canRedo() const { return d_->done < d_->steps.size(); }
std::string ProjectTree::undoLabel() const { return canUndo() ? d_->steps[d_->done - 1].label : std::string(); }
std::string ProjectTree::redoLabel() const { return canRedo() ? d_->steps[d_->done].label : std::string(); }

void ProjectTree::undo()
{
    if (!canUndo()) return;
    d_->run(d_->steps[d_->done - 1], false);
    --d_->done;
    d_->tell();
}

void ProjectTree::redo()
{
    if (!canRedo()) return;
    d_->run(d_->steps[d_->done], true);
    ++d_->done;
    d_->tell();
}

std::vector<std::string> ProjectTree::labels() const
{
    std::vector<std::string> labels;
    labels.reserve(d_->steps.size());
    for (const TreeStep& step : d_->steps) labels.push_back(step.label);
    return labels;
}

std::size_t ProjectTree::position() const { return d_->done; }

void ProjectTree::goTo(std::size_t position)
{
    while (d_->done > position && canUndo()) undo();
    while (d_->done < position && canRedo()) redo();
}

void ProjectTree::clear()
{
    d_->steps.clear();
    d_->done = d_->bytes = 0;
}

void ProjectTree::setMemoryLimit(std::size_t bytes)
{
    d_->limit = bytes;
    d_->forgetOldest();
}

std::size_t ProjectTree::memory() const { return d_->bytes; }

}  // namespace jet
