// jet-bench-physics: JET beside Debian's Box2D 2.4.1, Chipmunk 7 and Bullet's soft bodies, the same scenes, the same
// step, one thread, no sleeping; CPU time of a step and the quality of what came out. `--help` tells the options.
#include "bench/physics/bounds.hpp"
#include "bench/physics/contestant.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

namespace jet::bench {

namespace {

struct Options {
    std::vector<std::string> scenes, files, only;
    JetOptions jet;
    std::string check, summary;
};

std::string widestSimd() { return jetSimds().front(); }

std::string processor()
{
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "not known";
}

/// Nanoseconds that a line of memory takes to another thread and back, the least of some tries: by it may be judged
/// what more threads could gain here. Some 100 where processors share a cache, 500 and more where they do not.
double lineRoundTrip()
{
    constexpr std::uint32_t kTrips = 2000, kOver = ~0U;
    constexpr int kTries = 20;
    constexpr auto kMost = std::chrono::milliseconds(20);  // a try, where others have the processors
    using Clock = std::chrono::steady_clock;
    alignas(128) std::atomic<std::uint32_t> line = 0;
    // Odd numbers are answered with the next.
    std::thread other([&line] {
        for (std::uint32_t value = 0; (value = line.load(std::memory_order_acquire)) != kOver;)
            if (value % 2 == 1) line.store(value + 1, std::memory_order_release);
    });
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTries; ++i) {
        const auto start = Clock::now();
        std::uint32_t trips = 0;
        for (; trips < kTrips && Clock::now() - start < kMost; ++trips) {
            line.store(1, std::memory_order_release);
            while (line.load(std::memory_order_acquire) != 2) {
            }
        }
        least = std::min(least, std::chrono::duration<double, std::nano>(Clock::now() - start).count() / trips);
    }
    line = kOver;
    other.join();
    return least;
}

struct Entry {
    std::string key, label;  // in the JSON, in the table
    std::string simd;        // of JET
    Contestant::Make make;
};

/// What JET runs with in a scene: what was asked for, or all that make a difference, the widest first.
std::vector<std::string> simdsOf(const Scene& scene, const Options& options)
{
    const std::vector<std::string> all = jetSimds(scene);
    const std::string& asked = options.jet.simd;
    if (asked.empty()) return all;
    // A scene without code for the widest runs with the next.
    return {std::find(all.begin(), all.end(), asked) != all.end() ? asked : all.front()};
}

/// Is it named by --only? JET's rows by "jet" (the first of the scene) or by their instructions.
bool isChosen(const Entry& entry, const std::vector<std::string>& only)
{
    const auto named = [&](const std::string& name) { return std::find(only.begin(), only.end(), name) != only.end(); };
    return only.empty() || named(entry.key) || (!entry.simd.empty() && named("jet_" + entry.simd));
}

/// JET with the widest instructions first: what the others are compared with.
std::vector<Entry> entries(const Scene& scene, const Options& options)
{
    std::vector<Entry> all;
    for (const std::string& simd : simdsOf(scene, options)) {
        JetOptions chosen = options.jet;
        chosen.simd = simd;
        all.push_back({all.empty() ? "jet" : "jet_" + simd, "jet " + simd, simd,
                       [&scene, chosen] { return makeJet(scene, chosen); }});
    }
    all.push_back({"box2d_241", "box2d 2.4.1", "", [&] { return makeBox2d(scene); }});
    all.push_back({"chipmunk", "chipmunk 7", "", [&] { return makeChipmunk(scene); }});
    if (!scene.soft.empty()) all.push_back({"bullet", "bullet 3.24", "", [&] { return makeBullet(scene); }});
    std::erase_if(all, [&](const Entry& entry) { return !isChosen(entry, options.only); });
    return all;
}

bool isJet(const std::string& key) { return key.rfind("jet", 0) == 0; }

/// What came of a scene, or of all.
struct Outcome {
    bool hasResult = true;  // of JET
    std::size_t rows = 0;
    std::size_t bounds = 0, broken = 0;

    void add(const Outcome& other)
    {
        hasResult = hasResult && other.hasResult;
        rows += other.rows, bounds += other.bounds, broken += other.broken;
    }
};

void report(const Scene& scene, const std::string& label, const std::string& key, const Contestant& one, double jet,
            nlohmann::ordered_json& json)
{
    std::printf("%-22s %-12s ", scene.name.c_str(), label.c_str());
    if (!one.problem().empty()) {
        json[key + "_problem"] = one.problem();
        std::printf("has no result: %s\n", one.problem().c_str());
        return;
    }
    const Measured& result = one.result();
    const std::size_t heap = result.heap / scene.bodies.size();
    json[key + "_ms"] = result.median;
    json[key + "_p95_ms"] = result.p95;
    json[key + "_wall_ms"] = result.wall;
    json[key + "_wall_p10_ms"] = result.undisturbed;
    json[key + "_heap_bytes_a_body"] = heap;
    if (isJet(key) && result.memory > 0) json[key + "_bytes_a_body"] = result.memory / scene.bodies.size();
    json[key == "jet" ? "quality" : "quality_" + key] = result.quality;
    std::printf("%8.3f ms  p95 %8.3f  ", result.median, result.p95);
    if (jet > 0 && key != "jet") {
        if (!isJet(key)) json["ratio_" + key] = result.median / jet;
        std::printf("jet %6.2f x ", result.median / jet);
    } else {
        std::printf("             ");
    }
    std::printf(" %5zu B/body  %s\n", heap, result.quality.dump().c_str());
}

/// JET's row, and what it says to the bounds; the others' quality is theirs.
Outcome judge(const Scene& scene, const Entry& entry, const Contestant& one, nlohmann::ordered_json& json)
{
    Outcome outcome;
    outcome.hasResult = one.problem().empty();
    if (!outcome.hasResult) return outcome;
    const std::vector<std::string> broken = brokenBounds(scene.name, one.result().quality);
    for (const std::string& bound : broken) {
        std::printf("%-22s %-12s BREAKS A BOUND: %s\n", scene.name.c_str(), entry.label.c_str(), bound.c_str());
        json["broken_bounds"].push_back(entry.key + ": " + bound);
    }
    outcome.bounds = boundsOf(scene.name), outcome.broken = broken.size();
    return outcome;
}

Outcome compare(const Scene& scene, const Options& options, nlohmann::ordered_json& scenes)
{
    const std::vector<Entry> all = entries(scene, options);
    if (all.empty()) {
        std::printf("%-22s has no such row\n", scene.name.c_str());
        return {};
    }
    std::vector<std::unique_ptr<Contestant>> contestants;
    for (const Entry& entry : all) contestants.push_back(std::make_unique<Contestant>(scene, entry.make));
    std::vector<bool> runs(all.size(), true);
    for (bool any = true; any;) {
        any = false;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (runs[i]) runs[i] = contestants[i]->stretch();
            any = any || runs[i];
        }
    }
    nlohmann::ordered_json json = {{"scene", scene.name},
                                   {"bodies", scene.bodies.size()},
                                   {"steps", scene.steps},
                                   {"simd", simdsOf(scene, options).front()}};
    Outcome outcome;
    outcome.rows = all.size();
    double jet = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].key == "jet" && contestants[i]->problem().empty()) jet = contestants[i]->result().median;
        report(scene, all[i].label, all[i].key, *contestants[i], jet, json);
        if (isJet(all[i].key)) outcome.add(judge(scene, all[i], *contestants[i], json));
    }
    std::fflush(stdout);
    scenes.push_back(json);
    return outcome;
}

int check(const std::string& folder)
{
    int differing = 0;
    for (const std::string& name : sceneNames()) {
        const std::string file = folder + "/" + name + ".json";
        if (!std::filesystem::exists(file)) continue;
        const std::string found = difference(makeScene(name), loadScene(file));
        std::printf("%-22s %s\n", name.c_str(), found.empty() ? "equal" : ("differs in " + found).c_str());
        differing += !found.empty();
    }
    return differing > 0;
}

void declare(CLI::App& app, Options& options)
{
    app.add_option("--scene", options.scenes, "Only this scene; may repeat")->check(CLI::IsMember(sceneNames()));
    app.add_option("--scene-file", options.files, "A scene from a file; may repeat")->check(CLI::ExistingFile);
    app.add_option("--threads", options.jet.threads, "Of JET")->check(CLI::Range(1, 64))->capture_default_str();
    app.add_option("--simd", options.jet.simd,
                   "JET with these instructions alone, or the next where a scene has no code for them (else: all that\n"
                   "the processor has and that make a difference, the widest first)")
        ->check(CLI::IsMember(jetSimds()));
    app.add_option("--precision", options.jet.precision, "Of JET's rigid solver")
        ->check(CLI::IsMember({"double", "single"}));
    app.add_option("--substeps", options.jet.substeps, "Of JET's rigid solver; 0: its own choice")
        ->check(CLI::Range(0, 4096));
    app.add_option("--only", options.only, "Only this engine, or JET with these instructions; may repeat")
        ->check(CLI::IsMember({"jet", "jet_avx512", "jet_avx2", "jet_sse2", "box2d_241", "chipmunk", "bullet"}));
    app.add_option("--check", options.check, "Compare the scenes with the files of this folder, measure nothing")
        ->check(CLI::ExistingDirectory);
    app.add_option("--summary-json", options.summary, "Write all of it to this file");
    app.footer(
        "The engines of a scene take turns, 30 steps each, every one in a process of its own: one that aborts has\n"
        "no result, and the others go on. Exit code 1: JET has no result; 2: bad usage; 3: JET breaks a bound of\n"
        "quality, whatever the times (the scenes' bounds: tests/bench/physics/bounds.cpp).");
}

int run(Options& options)
{
    if (!options.check.empty()) return check(options.check);
    if (options.scenes.empty() && options.files.empty()) options.scenes = sceneNames();
    nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
    Outcome outcome;
    std::printf("%s, %u threads; JET: %s, %d thread%s\n", processor().c_str(), std::thread::hardware_concurrency(),
                (options.jet.simd.empty() ? widestSimd() : options.jet.simd).c_str(), options.jet.threads,
                options.jet.threads == 1 ? "" : "s");
    // Before the scenes and after them: processors of a virtual machine may be moved meanwhile.
    std::vector<double> trips;
    const auto lookAtLines = [&] {
        if (options.jet.threads == 1 || std::thread::hardware_concurrency() == 1) return;
        trips.push_back(lineRoundTrip());
        std::printf("a line of memory goes to another thread and back in %.0f ns\n", trips.back());
    };
    lookAtLines();
    for (const std::string& name : options.scenes) outcome.add(compare(makeScene(name), options, scenes));
    for (const std::string& file : options.files) outcome.add(compare(loadScene(file), options, scenes));
    lookAtLines();
    if (!options.summary.empty()) {
        const nlohmann::ordered_json all = {
            {"processor", processor()},    {"processor_threads", std::thread::hardware_concurrency()},
            {"widest_simd", widestSimd()}, {"jet_threads", options.jet.threads},
            {"line_round_trip_ns", trips}, {"scenes", scenes}};
        std::ofstream out(options.summary);
        out << all.dump(2) << "\n";
        if (!out) throw std::runtime_error("The summary could not be written to " + options.summary + ".");
    }
    if (outcome.bounds > 0)
        std::printf("JET keeps %zu of %zu bounds of quality\n", outcome.bounds - outcome.broken, outcome.bounds);
    if (outcome.rows == 0) throw std::runtime_error("No scene has a row that --only and --simd leave.");
    if (!outcome.hasResult) return 1;
    return outcome.broken > 0 ? 3 : 0;
}

}  // namespace

}  // namespace jet::bench

int main(int argc, char** argv)
{
    CLI::App app("JET's physics beside Box2D 2.4.1, Chipmunk 7 and Bullet's soft bodies", "jet-bench-physics");
    jet::bench::Options options;
    jet::bench::declare(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& problem) {
        return app.exit(problem) == 0 ? 0 : 2;
    }
    try {
        return jet::bench::run(options);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "jet-bench-physics: error: %s\n", problem.what());
        return 2;
    }
}
