// A scene of 100,000 shapes, beside what Qt and pugixml do with as many: what it takes to load, save, keep, hash, pick,
// drag and undo; and 1,000,000 opened. Times are processor time of the thread, the median of the runs, so that other
// programs on the machine count little.
#include "bench/scene_peers.hpp"
#include "bench/summary.hpp"
#include "fixtures/fakes.hpp"
#include "support/test_catalog.hpp"

#include <jet/find.hpp>
#include <jet/project.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <malloc.h>
#include <sstream>
#include <unistd.h>

namespace {

using namespace jet;
namespace fs = std::filesystem;

constexpr int kShapes = 100'000, kMany = 1'000'000, kMoved = 10'000;
constexpr int kColumns = 400;
constexpr double kPitch = 12.25;  // units from one shape to the next

/// With the properties of the polygon-face effect.
class FaceEffect final : public Effect {
public:
    const PropertyTable& properties() const override
    {
        static const PropertyTable table{color("color", "Color", {50, 205, 50, 255}), flag("curved", "Curved", true),
                                         choice("fill-rule", "Fill rule", {"nonzero", "evenodd"})};
        return table;
    }
};

struct World {
    test::TestCatalog catalog;
    EventsCenter events;
    World() { catalog.inCode().effect<FaceEffect>("face"); }

    /// Layers of 1,000 ellipses and rectangles with one effect each.
    std::unique_ptr<Project> make(int shapes)
    {
        auto project = Project::create("Large", events, catalog);
        Scene& scene = *project->scenes().front();
        auto edit = scene.items().begin("Fill");
        for (int i = 0; i < shapes; ++i) {
            if (i % 1000 == 0) edit.add<LayerItem>(scene.root());
            const Vec2 at(i % kColumns * kPitch, i / kColumns * kPitch);
            const Box box(at, at + Vec2(10, 8));
            const Item& shape =
                edit.add<ShapeItem>(*scene.root().children().back(), i % 2 ? Path::ellipse(box) : Path::rectangle(box));
            edit.addEffect(shape, "face", {{"color", Color{static_cast<std::uint8_t>(i), 90, 200, 255}}});
        }
        edit.commit();
        scene.undoRedo().clear();
        return project;
    }
};

World& world()
{
    static World one;
    return one;
}

fs::path folder()
{
    static const fs::path one = [] {
        std::string name = (fs::temp_directory_path() / "jet-bench-XXXXXX").string();
        return fs::path(::mkdtemp(name.data()));
    }();
    return one;
}

fs::path sceneFile() { return folder() / "scenes/Scene 0.scene"; }

const std::string& text()
{
    static const std::string one = [] {
        std::ostringstream all;
        all << std::ifstream(sceneFile(), std::ios::binary).rdbuf();
        return all.str();
    }();
    return one;
}

Project& project()
{
    static const std::unique_ptr<Project> one = Project::load(folder(), world().events, world().catalog).orThrow();
    return *one;
}
Scene& scene() { return *project().scenes().front(); }

// --- measuring

std::map<std::string, std::vector<double>> samples;  // milliseconds, by name

/// `action` once an iteration, by the clock of the thread's processor time.
template <class Action>
void timed(benchmark::State& state, const char* name, Action&& action)
{
    for (auto _ : state) {
        const double begin = bench::processorSeconds();
        action();
        const double seconds = bench::processorSeconds() - begin;
        state.SetIterationTime(seconds);
        samples[name].push_back(1000 * seconds);
    }
}

double median(const std::string& name)
{
    std::vector<double>& all = samples[name];
    if (all.empty()) return 0;
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
    return all[all.size() / 2];
}

#define JET_BENCH(name, iterations)                                                                                    \
    BENCHMARK(name)->UseManualTime()->Iterations(iterations)->Unit(benchmark::kMillisecond)

// --- files

void load(benchmark::State& state)
{
    timed(state, "load", [] {
        std::vector<FormatNote> notes;
        benchmark::DoNotOptimize(readSceneText(text(), "a.scene", world().events, world().catalog, notes).orThrow());
    });
}
JET_BENCH(load, 5);

/// The same scene with a comment in it, as somebody may have edited it: read through a document tree.
void loadEdited(benchmark::State& state)
{
    const std::string edited = text() + "<!-- edited -->\n";
    timed(state, "loadEdited", [&] {
        std::vector<FormatNote> notes;
        benchmark::DoNotOptimize(readSceneText(edited, "a.scene", world().events, world().catalog, notes).orThrow());
    });
}
JET_BENCH(loadEdited, 3);

void pugixmlParse(benchmark::State& state)
{
    timed(state, "pugixmlParse", [] { bench::parseWithPugixml(text()); });
}
JET_BENCH(pugixmlParse, 5);

void save(benchmark::State& state)
{
    timed(state, "save", [] { benchmark::DoNotOptimize(writeSceneText(scene())); });
}
JET_BENCH(save, 5);

void saveToDisk(benchmark::State& state)
{
    auto loaded = Project::load(folder(), world().events, world().catalog).orThrow();
    timed(state, "saveToDisk", [&] { loaded->saveAs(folder() / "saved").orThrow(); });
}
JET_BENCH(saveToDisk, 2);

void hash(benchmark::State& state)
{
    timed(state, "hash", [] { benchmark::DoNotOptimize(scene().hash()); });
}
JET_BENCH(hash, 5);

void clone(benchmark::State& state)
{
    timed(state, "clone", [] { benchmark::DoNotOptimize(scene().clone(world().events)); });
}
JET_BENCH(clone, 5);

// --- where things are

Vec2 somewhere(int i)
{
    const int k = i * 7919 % kShapes;
    return {k % kColumns * kPitch + 5, k / kColumns * kPitch + 4};
}

void hitTest(benchmark::State& state)
{
    int i = 0;
    timed(state, "hitTest", [&] { benchmark::DoNotOptimize(scene().items().itemAt(somewhere(i++), 1)); });
}
JET_BENCH(hitTest, 1000);

void rubberBand(benchmark::State& state)
{
    timed(state, "rubberBand", [] {
        benchmark::DoNotOptimize(scene().items().itemsIn(Box({1000, 1000}, {2000, 2000})));
    });
}
JET_BENCH(rubberBand, 100);

void viewQuery(benchmark::State& state)
{
    timed(state, "viewQuery", [] { benchmark::DoNotOptimize(scene().items().query(Box({900, 900}, {2180, 1620}))); });
}
JET_BENCH(viewQuery, 100);

void find(benchmark::State& state)
{
    const FindQuery query = FindQuery::parse("name:*7 type:shape -effect:stroke is:visible").orThrow();
    timed(state, "find", [&] { benchmark::DoNotOptimize(findItems(scene(), query)); });
}
JET_BENCH(find, 20);

// --- changes

std::vector<ItemId> selectMany()
{
    std::vector<ItemId> chosen;
    scene().root().walk([&](const Item& item) {
        if (item.is<ShapeItem>() && chosen.size() < kMoved) chosen.push_back(item.id());
    });
    scene().items().setSelection(chosen);
    return chosen;
}

void dragStep(benchmark::State& state)
{
    const std::vector<ItemId> chosen = selectMany();
    const auto view = world().events.subscribeCoalesced<SceneTouched>(&scene(), [](const SceneTouched&) {
        scene().items().query(Box({900, 900}, {2180, 1620}));
    });
    auto edit = scene().items().begin("Drag");
    double x = 0;
    timed(state, "dragStep", [&] {
        edit.restart();
        const Affine by = Affine::translation({x += 0.1, 0.3});
        jet::Box bounds;
        for (const ItemId id : chosen) edit.transform(*scene().items().find(id), by);
        for (const ItemId id : chosen) bounds.extend(scene().items().find(id)->bounds());
        benchmark::DoNotOptimize(bounds);
        world().events.dispatchQueued();
        benchmark::DoNotOptimize(scene().items().itemAt({100, 100}, 1));
    });
}
JET_BENCH(dragStep, 40);

void undoOfAMove(benchmark::State& state)
{
    auto edit = scene().items().begin("Move");
    for (const ItemId id : selectMany()) edit.transform(*scene().items().find(id), Affine::rotation(0.3, {2000, 1500}));
    edit.commit();
    auto& history = scene().undoRedo();
    timed(state, "undo", [&] { history.canUndo() ? history.undo() : history.redo(); });
    history.goTo(0);
}
JET_BENCH(undoOfAMove, 40);

void removeAll(benchmark::State& state)
{
    timed(state, "removeAll", [] {
        std::vector<ItemId> all;
        scene().root().walk([&](const Item& item) {
            if (item.is<ShapeItem>()) all.push_back(item.id());
        });
        auto edit = scene().items().begin("Delete");
        edit.setSelection(all);
        for (const ItemId id : all) edit.remove(*scene().items().find(id));
        edit.rollback();
    });
}
JET_BENCH(removeAll, 3);

// --- Qt's equals

void qtHitTest(benchmark::State& state)
{
    bench::QtPeer& qt = bench::QtPeer::get(kShapes, kColumns, kPitch);
    int i = 0;
    timed(state, "qtHitTest", [&] { qt.hit(somewhere(i).x(), somewhere(i).y()), ++i; });
}
JET_BENCH(qtHitTest, 1000);

void qtRubberBand(benchmark::State& state)
{
    bench::QtPeer& qt = bench::QtPeer::get(kShapes, kColumns, kPitch);
    timed(state, "qtRubberBand", [&] { qt.inside(1000, 1000, 1000, 1000); });
}
JET_BENCH(qtRubberBand, 20);

void qtDragStep(benchmark::State& state)
{
    bench::QtPeer& qt = bench::QtPeer::get(kShapes, kColumns, kPitch);
    timed(state, "qtDragStep", [&] {
        qt.moveFirst(kMoved, 0.1, 0.3);
        qt.hit(100, 100);
    });
}
JET_BENCH(qtDragStep, 10);

void qtUndo(benchmark::State& state)
{
    bench::QtPeer& qt = bench::QtPeer::get(kShapes, kColumns, kPitch);
    qt.pushMove(kMoved, 5, 7);
    timed(state, "qtUndo", [&] { qt.undoOrRedo(); });
}
JET_BENCH(qtUndo, 20);

// --- a million, in a process of its own

/// "seconds of processor time, peak in MB".
int openAndTell(const char* path)
{
    const double begin = bench::processorSeconds();
    const auto opened = Project::load(path, world().events, world().catalog).orThrow();
    const double seconds = bench::processorSeconds() - begin;
    std::printf("%f %f\n", seconds, bench::peakMegabytes());
    return opened->scenes().front()->items().itemCount() > kMany ? 0 : 1;
}

std::pair<double, double> openMany()
{
    const fs::path where = folder() / "many";
    world().make(kMany)->saveAs(where).orThrow();
    const std::string command = fs::read_symlink("/proc/self/exe").string() + " --open " + where.string();
    double seconds = 0, megabytes = 0;
    if (FILE* told = ::popen(command.c_str(), "r")) {
        if (std::fscanf(told, "%lf %lf", &seconds, &megabytes) != 2) seconds = megabytes = 0;
        ::pclose(told);
    }
    fs::remove_all(where);
    return {seconds, megabytes};
}

void report(bench::Summary& summary)
{
    const double megabytes = static_cast<double>(text().size()) / 1e6;
    const auto rate = [&](const char* name) { return median(name) > 0 ? megabytes / median(name) * 1000 : 0; };
    const auto goal = [&](const char* name, const char* figure, double most) {
        summary.add(figure, median(name), "ms", most, median(name) < most);
    };
    const auto ratio = [&](const char* figure, const char* jet, const char* peer) {
        if (median(jet) > 0) summary.note(figure, median(peer) / median(jet), "x (above 1: JET is faster)");
    };
    summary.note("file", megabytes, "MB");
    summary.add("load", rate("load"), "MB/s", 60, rate("load") >= 60);
    summary.add("save", rate("save"), "MB/s", 60, rate("save") >= 60);
    summary.add("load_edited_by_hand", rate("loadEdited"), "MB/s", 60, rate("loadEdited") >= 60);
    summary.note("pugixml_parse_only", rate("pugixmlParse"), "MB/s");
    ratio("load_to_pugixml_parse_only", "load", "pugixmlParse");
    summary.note("save_with_disk", median("saveToDisk"), "ms");
    goal("hitTest", "hit_test", 1);
    ratio("hit_test_to_qgraphicsscene", "hitTest", "qtHitTest");
    goal("rubberBand", "rubber_band", 1);
    ratio("rubber_band_to_qgraphicsscene", "rubberBand", "qtRubberBand");
    goal("viewQuery", "view_query", 1);
    goal("dragStep", "drag_step_of_10000", 8);
    ratio("drag_step_to_qgraphicsscene", "dragStep", "qtDragStep");
    goal("undo", "undo_of_10000_moves", 10);
    ratio("undo_to_qundostack", "undo", "qtUndo");
    for (const char* name : {"find", "hash", "clone", "removeAll"}) summary.note(name, median(name), "ms");
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc == 3 && std::strcmp(argv[1], "--open") == 0) return openAndTell(argv[2]);
    bool many = true;
    std::vector<char*> rest;
    for (int i = 0; i < argc; ++i) {
        if (std::strcmp(argv[i], "--no-million") == 0) {
            many = false;
        } else {
            rest.push_back(argv[i]);
        }
    }
    world().make(kShapes)->saveAs(folder()).orThrow();
    ::malloc_trim(0);
    const double before = bench::residentMegabytes();
    project();  // the one that stays
    ::malloc_trim(0);
    const double kept = bench::residentMegabytes() - before;
    const int code = bench::run(static_cast<int>(rest.size()), rest.data(), [&](const auto&, bench::Summary& summary) {
        report(summary);
        summary.add("memory_of_100000", kept, "MB", 200, kept < 200);
        if (!many) return;
        const auto [seconds, peak] = openMany();
        summary.add("open_1000000", seconds, "s", 8, seconds > 0 && seconds < 8);
        summary.add("open_1000000_peak", peak, "MB", 2500, peak > 0 && peak < 2500);
    });
    std::error_code ignored;
    fs::remove_all(folder(), ignored);
    return code;
}
