// Path commands: union, difference, intersection, exclusion, outset, inset, simplify, reverse, join, combine, break
// apart, cut. Each changes the selected shapes and bodies in one undo step; the bottom-most item stays, with its name
// and effects.
#include "clipper.hpp"

#include <jet/arrange.hpp>
#include <jet/editor.hpp>
#include <jet/path_operations.hpp>
#include <jet/plugin.hpp>

#include <algorithm>
#include <functional>

namespace {

using jet::Item;
using jet::ItemList;
using jet::Path;
using jet::Transaction;
using jet::path_operations::Boolean;

constexpr double kOffset = 5;                // scene units a step of Outset and Inset
constexpr double kSimplifyTolerance = 1e-3;  // of the larger side of the path's bounds

struct PathCommand {
    const char* id;
    const char* label;  ///< of the undo step
    std::size_t needs;  ///< selected paths
    std::function<void(Transaction& edit, const ItemList& items)> run;
};

bool hasPath(const Item& item) { return !item.path().isEmpty() && !item.isContainer(); }

/// The selected items with a path, bottom first. A group among them is an error: which of its shapes would be meant?
ItemList operands(const jet::Scene& scene)
{
    ItemList items;
    for (const Item* item : jet::topSelection(scene)) {
        if (item->isContainer())
            throw jet::Failure(
                jet::Error("'" + item->name() + "' is a group: ungroup it first, or select shapes in it"));
        if (hasPath(*item) && item->editable()) items.push_back(item);
    }
    return items;
}

int largestCount(const Path& path)
{
    int most = 0;
    for (std::size_t i = 0; i < path.segmentCount(); ++i) most = std::max(most, path.segment(i).intermediate);
    return most;
}

std::vector<Path> pathsOf(const ItemList& items)
{
    std::vector<Path> paths;
    for (const Item* item : items) paths.push_back(item->path());
    return paths;
}

/// The bottom-most item takes the path, the others go.
void replaceAll(Transaction& edit, const ItemList& items, Path path)
{
    if (path.isEmpty())
        throw jet::Failure(jet::Error("nothing would be left of these shapes, so they stay as they are"));
    edit.setPath(*items.front(), std::move(path));
    for (std::size_t i = 1; i < items.size(); ++i) edit.remove(*items[i]);
    edit.select(*items.front());
}

PathCommand boolean(const char* id, const char* label, Boolean operation)
{
    return {id, label, 2, [operation](Transaction& edit, const ItemList& items) {
                Path result = jet::path_operations::combine(pathsOf(items), operation);
                result.setIntermediate(largestCount(items.front()->path()));
                replaceAll(edit, items, std::move(result));
            }};
}

/// A command that changes each path on its own.
PathCommand each(const char* id, const char* label, std::function<Path(const Path&)> change)
{
    return {id, label, 1, [change = std::move(change)](Transaction& edit, const ItemList& items) {
                for (const Item* item : items) {
                    Path path = change(item->path());
                    if (path.isEmpty())
                        throw jet::Failure(
                            jet::Error("nothing would be left of '" + item->name() + "', so it stays as it is"));
                    edit.setPath(*item, std::move(path));
                }
            }};
}

PathCommand offset(const char* id, const char* label, double distance)
{
    return each(id, label, [distance](const Path& path) {
        Path result = jet::path_operations::offset(path, distance);
        result.setIntermediate(largestCount(path));
        return result;
    });
}

/// Each contour (with the holes in it) becomes an item of its own, a copy of the item it was in.
void split(Transaction& edit, const Item& item, std::vector<Path> parts, std::vector<jet::ItemId>& selection)
{
    selection.push_back(item.id());
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const Item& copy = edit.addCopy(item, *item.parent(), item.index() + i);
        edit.setPath(copy, std::move(parts[i]));
        selection.push_back(copy.id());
    }
    if (parts.size() > 1) edit.setPath(item, std::move(parts.front()));
}

void breakApart(Transaction& edit, const ItemList& items)
{
    std::vector<jet::ItemId> selection;
    for (const Item* item : items) {
        std::vector<Path> parts;
        for (const jet::Contour& contour : item->path().contours()) parts.push_back(Path({contour}));
        split(edit, *item, std::move(parts), selection);
    }
    edit.setSelection(std::move(selection));
}

/// The top-most path is the knife, and stays.
void cut(Transaction& edit, const ItemList& items)
{
    const Path knife = items.back()->path();
    std::vector<jet::ItemId> selection;
    for (const Item* item : ItemList(items.begin(), items.end() - 1)) {
        std::vector<Path> parts = jet::cutPath(item->path(), knife);
        if (parts.size() == item->path().contours().size() && parts.front().contours().front().closed)
            continue;                        // not met
        edit.setPath(*item, parts.front());  // one crossing opens a closed outline
        split(edit, *item, std::move(parts), selection);
    }
    if (selection.empty())
        throw jet::Failure(jet::Error("the top-most path crosses none of the others; draw the cut across them"));
    edit.setSelection(std::move(selection));
}

Path simplify(const Path& path)
{
    return jet::simplifyPath(path, std::max(1e-6, kSimplifyTolerance * path.bounds().size().maxCoeff()));
}

Path combined(const ItemList& items)
{
    std::vector<jet::Contour> contours;
    for (const Item* item : items) {
        contours.insert(contours.end(), item->path().contours().begin(), item->path().contours().end());
    }
    return Path(std::move(contours));
}

std::vector<PathCommand> commands()
{
    return {
        boolean("path-union", "Union", Boolean::Union),
        boolean("path-difference", "Difference", Boolean::Difference),
        boolean("path-intersection", "Intersection", Boolean::Intersection),
        boolean("path-exclusion", "Exclusion", Boolean::Exclusion),
        offset("path-outset", "Outset", kOffset),
        offset("path-inset", "Inset", -kOffset),
        each("path-simplify", "Simplify", simplify),
        each("path-reverse", "Reverse", [](const Path& path) { return path.reversed(); }),
        {"path-join", "Join", 1,
         [](Transaction& edit, const ItemList& items) { replaceAll(edit, items, jet::joinPaths(pathsOf(items))); }},
        {"path-combine", "Combine", 2,
         [](Transaction& edit, const ItemList& items) { replaceAll(edit, items, combined(items)); }},
        {"path-break-apart", "Break apart", 1, breakApart},
        {"path-cut", "Cut path", 2, cut},
    };
}

class RunPathCommand final : public jet::Command {
public:
    explicit RunPathCommand(PathCommand command) : command_(std::move(command)) {}

    bool isEnabled(jet::Editor& editor) const override
    {
        const jet::Scene* scene = jet::editableScene(editor);
        if (!scene) return false;
        const ItemList items = jet::topSelection(*scene);
        return static_cast<std::size_t>(std::count_if(items.begin(), items.end(), [](const Item* i) {
                   return hasPath(*i) && i->editable();
               })) >= command_.needs;
    }
    void run(jet::Editor& editor) override
    {
        jet::Scene* scene = jet::editableScene(editor);
        if (!scene) return;
        try {
            const ItemList items = operands(*scene);
            if (items.size() < command_.needs) return;
            auto edit = scene->items().begin(command_.label);
            command_.run(edit, items);
            edit.commit();
        } catch (const jet::Failure& failure) {  // about these shapes, no fault of the plugin
            editor.showMessage(std::string(command_.label) + ": " + failure.error().message);
        }
    }

private:
    PathCommand command_;
};

}  // namespace

JET_PLUGIN(plugin)
{
    for (const PathCommand& command : commands()) {
        plugin.addCommand(
            command.id, [command] { return std::shared_ptr<jet::Command>(std::make_shared<RunPathCommand>(command)); });
    }
}
