// jet-bench-physics: JET beside Debian's Box2D 2.4.1 and Chipmunk 7, the same scenes, the same step, one thread, no
// sleeping; CPU time of a step and the quality of what came out.
//
//   jet-bench-physics [--scene NAME]... [--scene-file FILE]... [--threads N] [--simd sse2|avx2]
//                     [--precision double|single] [--substeps N] [--only ENGINE] [--check FOLDER] [--summary-json FILE]
#include "bench/physics/quality.hpp"
#include "bench/physics/quality_soft.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>

namespace jet::bench {

namespace {

struct Options {
    std::vector<std::string> scenes, files;
    JetOptions jet;
    std::string only, check, summary;
};

double milliseconds(clockid_t clock)
{
    timespec now{};
    clock_gettime(clock, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Measured {
    double median = 0, p95 = 0, wall = 0;  // ms a step
    std::size_t memory = 0, heap = 0;      // bytes: as the engine counts, as the heap grew
    nlohmann::ordered_json quality;
};

std::size_t heapInUse()
{
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

Measured measure(const Scene& scene, Engine& engine)
{
    std::vector<double> times, walls;
    times.reserve(static_cast<std::size_t>(scene.steps)), walls.reserve(static_cast<std::size_t>(scene.steps));
    for (int i = 0; i < scene.warmUpSteps; ++i) engine.step(scene.dt);
    std::vector<Pose> before = posesOf(engine, scene.bodies.size());
    SoftWatch watch(scene);
    for (int i = 0; i < scene.steps; ++i) {
        if (i == scene.steps - 1) before = posesOf(engine, scene.bodies.size());
        const double start = milliseconds(CLOCK_THREAD_CPUTIME_ID), wall = milliseconds(CLOCK_MONOTONIC);
        engine.step(scene.dt);
        times.push_back(milliseconds(CLOCK_THREAD_CPUTIME_ID) - start);
        walls.push_back(milliseconds(CLOCK_MONOTONIC) - wall);
        watch.see(engine);
    }
    Measured result;
    result.heap = heapInUse();
    const std::vector<Pose> now = posesOf(engine, scene.bodies.size());
    result.quality = qualityOf(scene, before, now);
    if (!scene.soft.empty()) result.quality.update(watch.quality(now));
    result.memory = engine.memory();
    std::sort(times.begin(), times.end());
    std::sort(walls.begin(), walls.end());
    result.median = times[times.size() / 2];
    result.p95 = times[times.size() * 95 / 100];
    result.wall = walls[walls.size() / 2];
    return result;
}

nlohmann::ordered_json compare(const Scene& scene, const Options& options)
{
    const std::vector<std::pair<std::string, std::function<std::unique_ptr<Engine>()>>> engines = {
        {"jet", [&] { return makeJet(scene, options.jet); }},
        {"box2d_241", [&] { return makeBox2d(scene); }},
        {"chipmunk", [&] { return makeChipmunk(scene); }},
    };
    nlohmann::ordered_json json = {{"scene", scene.name}, {"bodies", scene.bodies.size()}, {"steps", scene.steps}};
    double jet = 0;
    for (const auto& [name, make] : engines) {
        if (!options.only.empty() && options.only != name) continue;
        const std::size_t heap = heapInUse();
        std::unique_ptr<Engine> engine;
        try {
            engine = make();
        } catch (const std::exception& problem) {
            json[name + "_problem"] = problem.what();
            std::printf("%-22s %-10s %s\n", scene.name.c_str(), name.c_str(), problem.what());
            continue;
        }
        Measured result = measure(scene, *engine);
        result.heap -= std::min(result.heap, heap);
        json[name + "_ms"] = result.median;
        json[name + "_p95_ms"] = result.p95;
        json[name + "_wall_ms"] = result.wall;
        json[name + "_heap_bytes_a_body"] = result.heap / scene.bodies.size();
        if (name == "jet") {
            jet = result.median;
            if (result.memory > 0) json["jet_bytes_a_body"] = result.memory / scene.bodies.size();
        } else if (jet > 0) {
            json["ratio_" + name] = result.median / jet;
        }
        json[name == "jet" ? "quality" : "quality_" + name] = result.quality;
        std::printf("%-22s %-10s %8.3f ms  p95 %8.3f", scene.name.c_str(), name.c_str(), result.median, result.p95);
        if (name == "jet") {
            std::printf("              ");
        } else {
            std::printf("  jet %5.2f x ", jet > 0 ? result.median / jet : 0);
        }
        std::printf(" %5zu B/body  %s\n", result.heap / scene.bodies.size(), result.quality.dump().c_str());
        std::fflush(stdout);
    }
    return json;
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

Options parse(int argc, char** argv)
{
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string key = argv[i];
        if (i + 1 >= argc) throw std::runtime_error(key + " needs a value, or is not known.");
        const std::string value = argv[++i];
        if (key == "--scene")
            options.scenes.push_back(value);
        else if (key == "--scene-file")
            options.files.push_back(value);
        else if (key == "--threads")
            options.jet.threads = std::stoi(value);
        else if (key == "--simd")
            options.jet.simd = value;
        else if (key == "--precision")
            options.jet.precision = value;
        else if (key == "--substeps")
            options.jet.substeps = std::stoi(value);
        else if (key == "--only")
            options.only = value;
        else if (key == "--check")
            options.check = value;
        else if (key == "--summary-json")
            options.summary = value;
        else
            throw std::runtime_error("The option " + key + " is not known.");
    }
    if (options.scenes.empty() && options.files.empty()) options.scenes = sceneNames();
    return options;
}

int run(int argc, char** argv)
{
    const Options options = parse(argc, argv);
    if (!options.check.empty()) return check(options.check);
    nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
    for (const std::string& name : options.scenes) scenes.push_back(compare(makeScene(name), options));
    for (const std::string& file : options.files) scenes.push_back(compare(loadScene(file), options));
    if (!options.summary.empty()) {
        std::ofstream out(options.summary);
        out << nlohmann::ordered_json{{"scenes", scenes}}.dump(2) << "\n";
        if (!out) throw std::runtime_error("The summary could not be written to " + options.summary + ".");
    }
    return 0;
}

}  // namespace

}  // namespace jet::bench

int main(int argc, char** argv)
{
    try {
        return jet::bench::run(argc, argv);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "jet-bench-physics: error: %s\n", problem.what());
        return 2;
    }
}
