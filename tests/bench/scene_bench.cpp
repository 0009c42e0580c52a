// A scene of 100,000 shapes: what it takes to load, save, keep, hash, pick and change it.
#include "bench/summary.hpp"
#include "fixtures/fakes.hpp"
#include "support/test_catalog.hpp"

#include <jet/project.hpp>

#include <cstdlib>
#include <filesystem>
#include <malloc.h>
#include <unistd.h>

namespace {

using namespace jet;
namespace fs = std::filesystem;

constexpr int kShapes = 100'000;
constexpr int kColumns = 400;

struct World {
    test::TestCatalog catalog;
    EventsCenter events;
    World() { catalog.inCode().effect<test::TintEffect>("tint"); }

    /// 100 layers of 1,000 ellipses and rectangles with one effect each.
    std::unique_ptr<Project> make()
    {
        auto project = Project::create("Large", events, catalog);
        Scene& scene = *project->scenes().front();
        auto edit = scene.items().begin("Fill");
        for (int i = 0; i < kShapes; ++i) {
            if (i % 1000 == 0) edit.add<LayerItem>(scene.root());
            const Vec2 at(i % kColumns * 12.25, i / kColumns * 12.25);
            const Box box(at, at + Vec2(10, 8));
            const Item& shape =
                edit.add<ShapeItem>(*scene.root().children().back(), i % 2 ? Path::ellipse(box) : Path::rectangle(box));
            edit.addEffect(shape, "tint", {{"color", Color{static_cast<std::uint8_t>(i), 90, 200, 255}}});
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

Project& project()
{
    static const std::unique_ptr<Project> one = Project::load(folder(), world().events, world().catalog).orThrow();
    return *one;
}
Scene& scene() { return *project().scenes().front(); }

void load(benchmark::State& state)
{
    for (auto _ : state) benchmark::DoNotOptimize(Project::load(folder(), world().events, world().catalog).orThrow());
}
BENCHMARK(load)->Unit(benchmark::kMillisecond);

void save(benchmark::State& state)
{
    auto loaded = Project::load(folder(), world().events, world().catalog).orThrow();
    const fs::path target = folder() / "saved";
    for (auto _ : state) loaded->saveAs(target).orThrow();
}
BENCHMARK(save)->Unit(benchmark::kMillisecond);

void hash(benchmark::State& state)
{
    for (auto _ : state) benchmark::DoNotOptimize(scene().hash());
}
BENCHMARK(hash)->Unit(benchmark::kMillisecond);

void clone(benchmark::State& state)
{
    for (auto _ : state) benchmark::DoNotOptimize(scene().clone(world().events));
}
BENCHMARK(clone)->Unit(benchmark::kMillisecond);

void pick(benchmark::State& state)
{
    benchmark::DoNotOptimize(scene().items().itemAt({0, 0}, 1));  // bounds are known from now on
    int i = 0;
    for (auto _ : state) {
        const int k = i++ * 7919 % kShapes;
        benchmark::DoNotOptimize(scene().items().itemAt({k % kColumns * 12.25 + 5, k / kColumns * 12.25 + 4}, 1));
    }
}
BENCHMARK(pick)->Unit(benchmark::kMicrosecond);

void rubberBand(benchmark::State& state)
{
    for (auto _ : state) benchmark::DoNotOptimize(scene().items().itemsIn(Box({1000, 1000}, {2000, 2000})));
}
BENCHMARK(rubberBand)->Unit(benchmark::kMicrosecond);

void dragOne(benchmark::State& state)
{
    const Item& shape = *scene().root().children()[50]->children()[500];
    auto edit = scene().items().begin("Drag");
    double x = 0;
    for (auto _ : state) {
        edit.restart();
        edit.transform(shape, Affine::translation({x += 0.1, 0}));
    }
}
BENCHMARK(dragOne)->Unit(benchmark::kMicrosecond);

void selectAllAndDelete(benchmark::State& state)
{
    for (auto _ : state) {
        std::vector<ItemId> all;
        scene().root().walk([&](const Item& item) {
            if (item.is<ShapeItem>()) all.push_back(item.id());
        });
        auto edit = scene().items().begin("Delete");
        edit.setSelection(all);
        for (const ItemId id : all) edit.remove(*scene().items().find(id));
        edit.rollback();
    }
}
BENCHMARK(selectAllAndDelete)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv)
{
    world().make()->saveAs(folder()).orThrow();
    ::malloc_trim(0);
    const double before = bench::residentMegabytes();
    project();  // the one that stays
    const double after = bench::residentMegabytes(), peak = bench::peakMegabytes();
    ::malloc_trim(0);
    const double trimmed = bench::residentMegabytes();
    const double fileMegabytes = static_cast<double>(fs::file_size(folder() / "scenes/Scene 0.scene")) / 1e6;
    const int code = bench::run(argc, argv, [&](const bench::Times& times, bench::Summary& summary) {
        const auto ms = [&](const char* name) { return times.contains(name) ? times.at(name) / 1e6 : 0.0; };
        summary.add("load_100000_shapes", ms("load"), "ms", 1000, ms("load") < 1000);
        summary.add("save_100000_shapes", ms("save"), "ms", 1000, ms("save") < 1000);
        summary.add("memory_of_the_scene", trimmed - before, "MB", 200, trimmed - before < 200);
        summary.note("resident_after_load", after, "MB");
        summary.note("peak_including_making", peak, "MB");
        summary.note("file", fileMegabytes, "MB");
        for (const char* name : {"hash", "clone", "selectAllAndDelete"}) summary.note(name, ms(name), "ms");
        for (const char* name : {"pick", "rubberBand", "dragOne"}) summary.note(name, ms(name) * 1000, "µs");
    });
    std::error_code ignored;
    fs::remove_all(folder(), ignored);
    return code;
}
