// jet-physics-check: what the engine promises of the benchmark's scenes beside speed.
//
//   jet-physics-check hash [--plain] [--steps N] [SCENE...]
//       the state's hash after N (240) steps, over threads and instruction sets; --plain: of one run alone
//   jet-physics-check snapshot [--steps N] [SCENE...]
//       saved at step N / 4: the same future in the same world and in a new one
//   jet-physics-check soak MINUTES [SCENE...]
//       simulated time; nothing may become NaN, escape or take more memory
//   jet-physics-check growth
//       what a step costs with 1,000 to 100,000 particles; it may grow as n log n does
//   jet-physics-check memory
//       bytes of the heap a body, a contact, a particle and a spring take, and their limits
//   jet-physics-check stiffness
//       the hanging sheet with springs of 30 to 480 Hz; no NaN, and motion and height never hold more energy than at
//       first
//
// A scene is a name of jet-bench-physics or a file. Exit code: 1 when a promise is broken, 2 for bad usage.
#include "bench/physics/engines.hpp"
#include "bench/physics/memory_check.hpp"
#include "bench/physics/scene_soft.hpp"
#include "bench/physics/stiffness_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <stdexcept>

namespace jet::bench {

namespace {

constexpr int kSteps = 240;

Scene sceneOf(const std::string& name) { return std::filesystem::exists(name) ? loadScene(name) : makeScene(name); }

void advance(Engine& engine, const Scene& scene, int steps)
{
    for (int i = 0; i < steps; ++i) engine.step(scene.dt);
}

int hashes(const Scene& scene, int steps, bool plainly)
{
    JetOptions plain;
    std::vector<JetOptions> variants(5, plain);
    variants[1].threads = 2, variants[2].threads = 4, variants[3].simd = "sse2", variants[4].simd = "avx2";
    variants[4].threads = 3;
    if (plainly) variants.resize(1);
    std::uint64_t first = 0;
    int differing = 0;
    for (const JetOptions& options : variants) {
        const auto engine = makeJet(scene, options);
        advance(*engine, scene, steps);
        if (first == 0) first = engine->hash();
        if (engine->hash() == first) continue;
        std::fprintf(stderr, "%s: other bits with %d threads, simd \"%s\"\n", scene.name.c_str(), options.threads,
                     options.simd.c_str());
        ++differing;
    }
    std::printf("%-22s %016llx\n", scene.name.c_str(), static_cast<unsigned long long>(first));
    return differing;
}

int snapshots(const Scene& scene, int steps)
{
    const auto engine = makeJet(scene, {}), fresh = makeJet(scene, {});
    advance(*engine, scene, steps / 4);
    const std::vector<std::byte> saved = engine->save();
    std::vector<std::uint64_t> future;
    for (int i = 0; i < steps; ++i) {
        engine->step(scene.dt);
        future.push_back(engine->hash());
    }
    engine->restore(saved);
    fresh->restore(saved);
    for (int i = 0; i < steps; ++i) {
        engine->step(scene.dt);
        fresh->step(scene.dt);
        const bool same = engine->hash() == future[static_cast<std::size_t>(i)],
                   equal = fresh->hash() == future[static_cast<std::size_t>(i)];
        if (same && equal) continue;
        std::printf("%-22s differs %d steps after restoring into %s\n", scene.name.c_str(), i + 1,
                    same ? "a new world" : "the same world");
        return 1;
    }
    std::printf("%-22s same future, in the same world and in a new one; %zu bytes\n", scene.name.c_str(), saved.size());
    return 0;
}

/// Steps, at least a tenth of a soak: the last of what falls has met the heap.
constexpr int kWarmUp = 300;

int soak(const Scene& scene, double minutes)
{
    const auto engine = makeJet(scene, {});
    const int steps = static_cast<int>(std::lround(60 * minutes / scene.dt)), tenth = std::max(steps / 10, 1);
    const int warmUp = std::max(tenth, kWarmUp);
    std::size_t early = 0, late = 0;
    for (int i = 1; i <= steps; ++i) {
        engine->step(scene.dt);
        if (i % tenth != 0) continue;
        std::size_t bad = 0, out = 0;
        for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
            const Pose pose = engine->pose(body);
            bad += !std::isfinite(pose.position.x + pose.position.y + pose.angle);
            out += scene.bodies[body].type == SceneBody::Type::Dynamic &&
                   (pose.position.x < scene.bounds[0] || pose.position.y < scene.bounds[1] ||
                    pose.position.x > scene.bounds[2]);
        }
        late = heapInUse();
        if (early == 0 && i >= warmUp) early = late;
        std::printf("%-22s %6.1f min  not finite %zu  escaped %zu  heap %.2f MB\n", scene.name.c_str(),
                    i * scene.dt / 60, bad, out, 1e-6 * static_cast<double>(late));
        std::fflush(stdout);
        if (bad + out > 0) return 1;
    }
    return early > 0 && static_cast<double>(late) > 1.02 * static_cast<double>(early) + 65536 ? 1 : 0;
}

double processorMs()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Median of the steps in the second second: balls have met, and rest has not set in.
double costOfStep(const Scene& scene)
{
    const auto engine = makeJet(scene, {});
    advance(*engine, scene, 60);
    std::vector<double> times;
    for (int i = 0; i < 60; ++i) {
        const double start = processorMs();
        engine->step(scene.dt);
        times.push_back(processorMs() - start);
    }
    std::nth_element(times.begin(), times.begin() + 30, times.end());
    return times[30];
}

/// Caches end somewhere between the sizes: up to so many times what n log n says is taken for that.
constexpr double kCacheFactor = 2.5;

int growth(const char* name, const std::vector<Scene>& scenes)
{
    double first = 0, last = 0;
    for (const Scene& scene : scenes) {
        const auto particles = static_cast<double>(scene.bodies.size());
        const double cost = costOfStep(scene);
        last = cost / (particles * std::log2(particles));
        if (first == 0) first = last;
        std::printf("%-12s %7.0f particles  %9.3f ms a step  %6.1f ns a particle  %5.2f of n log n\n", name, particles,
                    cost, 1e6 * cost / particles, last / first);
        std::fflush(stdout);
    }
    return last > kCacheFactor * first;
}

int growths()
{
    return growth("balls", {softPile(6, 6), softPile(18, 18), softPile(57, 57)}) +
           growth("sheet", {hangingSheet(32), hangingSheet(100), hangingSheet(316)});
}

int run(int argc, char** argv)
{
    const std::string mode = argc > 1 ? argv[1] : "";
    if (mode == "growth") return growths() > 0;
    if (mode == "memory") return !memoryIsInLimits();
    if (mode == "stiffness") return !everyStiffnessIsStable();
    if (mode != "hash" && mode != "snapshot" && mode != "soak")
        throw std::runtime_error(
            "usage: jet-physics-check hash [--plain] [--steps N] | snapshot [--steps N] | soak MINUTES   [SCENE...] | "
            "growth | memory | stiffness");
    int next = 2;
    const double minutes = mode == "soak" ? std::stod(next < argc ? argv[next++] : "10") : 0;
    int steps = kSteps;
    bool plainly = false;
    for (; next < argc && std::string(argv[next]).rfind("--", 0) == 0; ++next) {
        const std::string option = argv[next];
        if (option == "--plain")
            plainly = true;
        else if (option == "--steps" && next + 1 < argc)
            steps = std::stoi(argv[++next]);
        else
            throw std::runtime_error("The option " + option + " is not known, or lacks its value.");
    }
    std::vector<std::string> names(argv + next, argv + argc);
    if (names.empty()) names = sceneNames();
    int failed = 0;
    for (const std::string& name : names) {
        const Scene scene = sceneOf(name);
        failed += mode == "hash"       ? hashes(scene, steps, plainly)
                  : mode == "snapshot" ? snapshots(scene, steps)
                                       : soak(scene, minutes);
    }
    return failed > 0;
}

}  // namespace

}  // namespace jet::bench

int main(int argc, char** argv)
{
    try {
        return jet::bench::run(argc, argv);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "jet-physics-check: error: %s\n", problem.what());
        return 2;
    }
}
