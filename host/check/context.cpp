#include "context.hpp"

#include "checked_painter.hpp"

#include "host/plugins/plugin_manager.hpp"

#include <jet/project.hpp>
#include <jet/scene_painter.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace jet::host::check {

namespace {

std::string secondsText(double seconds)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1f s", seconds);
    return text;
}

}  // namespace

Context::Clock::time_point Context::Clock::now()
{
    // schedstat: nanoseconds on a processor, nanoseconds ready without one, turns (Linux, Documentation/scheduler).
    std::ifstream schedule("/proc/thread-self/schedstat");
    std::int64_t worked = 0, waited = 0;
    if (!(schedule >> worked >> waited)) waited = 0;
    return std::chrono::steady_clock::now() - duration(waited);
}

std::string Context::where(const std::string& problem) const
{
    const std::string doing = board.activity();
    return problem + (doing.empty() ? "" : " (" + doing + ")");
}

Context::Watch::~Watch() noexcept(false)
{
    const std::chrono::duration<double> took = Clock::now() - begin;
    // While another failure is on its way, that one is told.
    if (took > callLimit && std::uncaught_exceptions() == exceptions)
        context.fail(context.where(std::string(callback) + " took " + secondsText(took.count()) + "; a call may take " +
                                   secondsText(std::chrono::duration<double>(callLimit).count()) + " at most"));
}

Stage::Stage(Context& c, With with) : context(c), scene("Scene", events, catalog), host(scene)
{
    context.board.callback("loading");
    try {
        catalog.loadFolder(context.folder);
    } catch (const std::exception& e) {
        context.fail(std::string("it does not load: ") + e.what());
    }
    if (with == With::Optional)
        for (const Dependency& use : context.manifest.optional) try {
                catalog.load(use.id);
            } catch (const std::exception&) {
                continue;  // it is optional
            }
    events.setExceptionHandler([this](std::exception_ptr problem) {
        try {
            std::rethrow_exception(problem);
        } catch (const std::exception& e) {
            listenerProblem_ = e.what();
        } catch (...) {
            listenerProblem_ = "an unknown exception";
        }
    });
}

Stage::~Stage() = default;

void Stage::fill()
{
    Random& random = context.random;
    auto edit = items().begin("Fill");
    const Item& layer = edit.add<LayerItem>(items().root());
    const Item& group = edit.add<GroupItem>(layer);
    for (int i = 0; i < 8; ++i) edit.add<ShapeItem>(i < 5 ? layer : group, random.path());
    edit.add<BodyItem>(layer, random.path());
    edit.add<SpringItem>(layer, Path::line(random.point(), random.point()));
    edit.set(edit.add<ScriptItem>(layer), "code", random.text());
    edit.set(edit.add<ShapeItem>(layer, random.path()), "locked", true);
    edit.set(edit.add<ShapeItem>(layer, random.path()), "visible", false);
    edit.commit();
    for (const Contribution& one : context.manifest.contributions) {
        if (one.kind != ContributionKind::Effect) continue;
        const Item* item = random.item(scene, [](const Item& i) { return !i.isContainer() && !i.path().isEmpty(); });
        if (!item) continue;
        context.call("Effect::rejects or Effect::applied", [&] {
            try {
                auto adding = items().begin("Fill");
                adding.addEffect(*item, one.id);
                adding.commit();
            } catch (const Failure&) {
                return;  // not on this item; the tests of effects look into it
            }
        });
    }
}

void Stage::editElsewhere()
{
    Random& random = context.random;
    if (items().inTransaction()) return;
    const Item* item = random.item(scene);
    if (random.chance(0.5)) {
        std::vector<ItemId> chosen;
        for (std::size_t n = random.below(4); n > 0; --n)
            if (const Item* one = random.item(scene)) chosen.push_back(one->id());
        return items().setSelection(chosen);
    }
    auto edit = items().begin("Elsewhere");
    switch (item ? random.below(5) : 4) {
    case 0: edit.remove(*item); break;
    case 1: edit.transform(*item, random.map()); break;
    case 2: edit.set(*item, random.chance(0.5) ? "visible" : "locked", random.chance(0.5)); break;
    case 3:
        if (!item->isContainer()) edit.setPath(*item, random.path());
        break;
    default: edit.add<ShapeItem>(items().root(), random.path());
    }
    edit.commit();
}

bool Stage::loadPhysicsEngine()
{
    if (catalog.physicsEngine("")) return true;
    PluginOptions options;
    options.searchPath = {context.folder.parent_path(), userPluginFolder(), builtInPluginFolder()};
    PluginManager manager(std::move(options));
    manager.scan();
    for (const Contribution& engine : manager.contributions(ContributionKind::PhysicsEngine)) try {
            catalog.loadFolder(manager.plugin(engine.plugin)->folder);
            return true;
        } catch (const Failure&) {
            continue;
        }
    return false;
}

void Stage::checkClosed(const std::string& who)
{
    if (!listenerProblem_.empty())
        context.fail(context.where("a listener of an event failed: " + std::exchange(listenerProblem_, {})));
    if (items().inTransaction()) context.fail(context.where(who + " leaves a transaction open"));
}

void Stage::checkSaving()
{
    const std::string first = context.call("saving the scene", [&] { return writeSceneText(scene); });
    std::vector<FormatNote> notes;
    const auto again =
        context.call("reading the scene", [&] { return readSceneText(first, "scene", events, catalog, notes); });
    if (!again) context.fail(context.where("the saved scene does not open: " + again.error().text()));
    if (writeSceneText(**again) != first)
        context.fail(context.where("the scene, saved, opened and saved again, has other bytes"));
    if ((*again)->hash() != scene.hash()) context.fail(context.where("the scene, saved and opened, has another hash"));
}

void Stage::checkPainting()
{
    // Item by item: each has the time of a call.
    for (const PaintPurpose purpose : {PaintPurpose::Edit, PaintPurpose::Play, PaintPurpose::Export}) {
        scene.root().walk([&](const Item& item) {
            CheckedPainter painter(host.scale);
            context.call("painting an item", [&] { paintItem(scene, item, item.path(), purpose, painter); });
            if (const std::string problem = painter.problem(); !problem.empty())
                context.fail(context.where("painting an item " + problem));
        });
    }
}

void Stage::thin(std::size_t most)
{
    while (items().itemCount() > most) {
        const Item* item = context.random.item(scene);
        if (!item) return;
        auto edit = items().begin("Thin out");
        edit.remove(*item);
        edit.commit();
    }
}

void UndoModel::record()
{
    const std::size_t position = stage_.scene.undoRedo().position();
    hashes_.resize(position + 1);
    hashes_[position] = stage_.scene.hash();
}

void UndoModel::goTo(std::size_t position)
{
    UndoRedoCenter& history = stage_.scene.undoRedo();
    while (history.position() != position) {
        const bool back = history.position() > position;
        const std::string label = back ? history.undoLabel() : history.redoLabel();
        const std::size_t before = history.position();
        stage_.context.call(back ? "undo" : "redo", [&] { back ? history.undo() : history.redo(); });
        if (history.position() == before) return;
        std::uint64_t& expected = hashes_[history.position()];
        const std::uint64_t found = stage_.scene.hash();
        if (expected == 0) expected = found;  // a state in between, which was never seen
        if (expected != found)
            stage_.context.fail(stage_.context.where("after the " + std::string(back ? "undo" : "redo") + " of '" +
                                                     label + "' the scene is not as it was there before"));
    }
}

void UndoModel::wander()
{
    const std::size_t last = hashes_.size() - 1;
    const std::size_t reach = std::min<std::size_t>(last + 1, 12);
    goTo(last + 1 - 1 - stage_.context.random.below(reach));
    if (stage_.context.random.chance(0.7)) goTo(last);
}

void UndoModel::sweep()
{
    const std::size_t last = stage_.scene.undoRedo().labels().size();
    hashes_.resize(last + 1);
    goTo(0);
    goTo(last);
}

}  // namespace jet::host::check
