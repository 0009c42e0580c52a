// What the guard costs: a call of a plugin's effect and of its tool through the guard, beside the plain virtual call,
// a storm of 10,000 events to 50 listeners whose code is in plugins, and loading a plugin beside dlopen alone.
#include "bench/summary.hpp"

#include "host/plugins/plugin_manager.hpp"
#include "support/recording_painter.hpp"
#include <jet/testing/tool_driver.hpp>

#include <jet/events.hpp>
#include <jet/tool.hpp>

#include <test_paths.hpp>

#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using namespace jet;

constexpr int kListeners = 50, kEvents = 10'000;

/// The fixture plugin under as many ids as are wanted.
class Plugins {
public:
    explicit Plugins(int count, bool ownFiles = false)
    {
        folder_ = fs::temp_directory_path() /
                  ("jet-guard-bench-" + std::to_string(getpid()) + (ownFiles ? "-own-" + std::to_string(++made_) : ""));
        const fs::path source = fs::path(JET_BINARY_DIR) / "tests/plugins/org.jet.test.bench";
        std::ifstream in(source / "plugin.json");
        std::stringstream text;
        text << in.rdbuf();
        host::PluginOptions options;
        options.copyLibraries = !ownFiles;  // one library under one path would be loaded once
        for (int i = 0; i < count; ++i) {
            const std::string number = std::to_string(i);
            const fs::path folder = folder_ / number;
            fs::create_directories(folder);
            if (ownFiles)
                fs::copy_file(source / "fixture-bench.so", folder / "fixture-bench.so");
            else
                fs::create_symlink(source / "fixture-bench.so", folder / "fixture-bench.so");
            std::string manifest = text.str();
            const auto replaceAll = [&](const std::string& from, const std::string& to) {
                for (auto at = manifest.find(from); at != std::string::npos; at = manifest.find(from, at + to.size()))
                    manifest.replace(at, from.size(), to);
            };
            replaceAll("org.jet.test.bench", "org.jet.test.bench" + number);
            std::ofstream(folder / "plugin.json") << manifest;
            options.searchPath = {folder};
            managers.push_back(std::make_unique<host::PluginManager>(options));
            managers.back()->scan();
        }
    }
    ~Plugins()
    {
        managers.clear();
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    fs::path folder(int i) const { return folder_ / std::to_string(i); }
    std::vector<std::unique_ptr<host::PluginManager>> managers;

private:
    fs::path folder_;
    static inline int made_ = 0;
};

/// Milliseconds of the fastest of several loads, each of a file that was not loaded before: by the plugin manager, and
/// by dlopen.
std::pair<double, double> loadTimes()
{
    constexpr int kLoads = 20;
    const auto fastest = [](const auto& load) {
        double best = -1;
        for (int i = 0; i < kLoads; ++i) {
            const double before = bench::processorSeconds();
            load(i);
            const double took = 1e3 * (bench::processorSeconds() - before);
            if (best < 0 || took < best) best = took;
        }
        return best;
    };
    Plugins managed(kLoads, true);
    const double whole = fastest([&](int i) {
        const std::string id = "org.jet.test.bench" + std::to_string(i);
        if (const auto loaded = managed.managers[static_cast<std::size_t>(i)]->load(id); !loaded)
            throw std::runtime_error(loaded.error().message);
    });
    Plugins plain(kLoads, true);
    const double alone = fastest([&](int i) {
        if (!::dlopen((plain.folder(i) / "fixture-bench.so").c_str(), RTLD_NOW | RTLD_LOCAL))
            throw std::runtime_error(::dlerror());
    });
    return {whole, alone};
}

/// The same work as the plugin's, called as plainly as C++ can.
class PlainTool final : public Tool {
public:
    using Tool::Tool;
    void move(const PointerEvent&) override { benchmark::DoNotOptimize(++moves_); }

private:
    int moves_ = 0;
};

void plainCall(benchmark::State& state)
{
    Plugins plugins(1);
    EventsCenter events;
    Scene scene("Scene", events, *plugins.managers[0]);
    test::TestToolHost host(scene);
    const std::unique_ptr<Tool> tool = std::make_unique<PlainTool>(host);
    Tool* called = tool.get();
    benchmark::DoNotOptimize(called);
    for (auto _ : state) called->move({});
}
BENCHMARK(plainCall);

void guardedCall(benchmark::State& state)
{
    Plugins plugins(1);
    EventsCenter events;
    Scene scene("Scene", events, *plugins.managers[0]);
    test::TestToolHost host(scene);
    const auto tool = plugins.managers[0]->createTool("bench", host);
    if (!tool) return state.SkipWithError("the fixture does not load");
    Tool* called = tool.get();
    benchmark::DoNotOptimize(called);
    for (auto _ : state) called->move({});
}
BENCHMARK(guardedCall);

/// Each plugin's tool listens when it is made; see the fixture.
void storm(benchmark::State& state, int pluginCount)
{
    Plugins plugins(pluginCount);
    EventsCenter events;
    Scene scene("Scene", events, *plugins.managers[0]);
    test::TestToolHost host(scene);
    std::vector<std::unique_ptr<Tool>> tools;
    for (int i = 0; i < kListeners; ++i)
        tools.push_back(
            plugins.managers[static_cast<std::size_t>(i * pluginCount / kListeners)]->createTool("bench", host));
    if (events.listenerCount() != kListeners) return state.SkipWithError("not all listen");
    for (auto _ : state)
        for (int i = 0; i < kEvents; ++i) events.post(&scene, SelectionChanged{&scene});
}
void stormToOnePlugin(benchmark::State& state) { storm(state, 1); }
void stormToFivePlugins(benchmark::State& state) { storm(state, 5); }
void stormToFiftyPlugins(benchmark::State& state) { storm(state, 50); }
BENCHMARK(stormToOnePlugin)->Unit(benchmark::kMillisecond);
BENCHMARK(stormToFivePlugins)->Unit(benchmark::kMillisecond);
BENCHMARK(stormToFiftyPlugins)->Unit(benchmark::kMillisecond);

/// The same number of listeners without any plugin.
void stormToTheHost(benchmark::State& state)
{
    Plugins plugins(1);
    EventsCenter events;
    Scene scene("Scene", events, *plugins.managers[0]);
    std::vector<Subscription> subscriptions;
    std::int64_t heard = 0;
    for (int i = 0; i < kListeners; ++i)
        subscriptions.push_back(
            events.subscribe<SelectionChanged>(&scene, [&heard](const SelectionChanged&) { ++heard; }));
    for (auto _ : state)
        for (int i = 0; i < kEvents; ++i) events.post(&scene, SelectionChanged{&scene});
    benchmark::DoNotOptimize(heard);
}
BENCHMARK(stormToTheHost)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv)
{
    return jet::bench::run(argc, argv, [](const jet::bench::Times& times, jet::bench::Summary& summary) {
        const double plain = times.at("plainCall"), guarded = times.at("guardedCall");
        summary.add("guard_ns", guarded - plain, "ns over a plain virtual call", 50, guarded - plain < 50);
        summary.note("plain_call_ns", plain, "ns");
        summary.note("guarded_call_ns", guarded, "ns");
        const double one = times.at("stormToOnePlugin") / 1e6;
        summary.add("storm_ms", one, "ms for 10,000 events to 50 listeners of a plugin", 5, one < 5);
        const double five = times.at("stormToFivePlugins") / 1e6;
        summary.add("storm_5_plugins_ms", five, "ms, ten listeners each of five plugins", 5, five < 5);
        summary.note("storm_50_plugins_ms", times.at("stormToFiftyPlugins") / 1e6,
                     "ms, one listener each of 50 plugins");
        const auto [load, dlopenAlone] = loadTimes();
        summary.add("load_over_dlopen", load - dlopenAlone, "ms CPU", 1, load - dlopenAlone < 1);
        summary.note("load_dlopen", dlopenAlone, "ms CPU, dlopen alone");
        summary.note("storm_host_ms", times.at("stormToTheHost") / 1e6, "ms, the same listeners in JET itself");
    });
}
