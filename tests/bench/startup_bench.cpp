// How soon JET is there: bin/jet as a process, from fork to exit; the ball game headless; the window's first painted
// frame.
#include "bench/summary.hpp"

#include <jet/version.hpp>
#include <test_paths.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

const std::string kJet = JET_BINARY_DIR "/bin/jet";
const std::string kGame = JET_SOURCE_DIR "/examples/games/ball";

/// A data folder with that many installed manifests, so that only they are added to what ships.
fs::path dataFolder(int count)
{
    static std::map<int, fs::path> made;
    if (const auto known = made.find(count); known != made.end()) return known->second;
    return made[count] = [count] {
        std::string name = (fs::temp_directory_path() / "jet-bench-XXXXXX").string();
        const fs::path folder = ::mkdtemp(name.data());
        for (int i = 0; i < count; ++i) {
            const std::string id = "org.bench.p" + std::to_string(i);
            fs::create_directories(folder / "jet/plugins" / id);
            std::ofstream(folder / "jet/plugins" / id / "plugin.json")
                << "{ \"id\": \"" << id
                << "\", \"name\": \"P\", \"version\": \"1.0.0\", \"jet\": \"" JET_SDK_VERSION
                   "\", \"library\": \"p\",\n"
                << "  \"description\": \"One of many.\", \"license\": \"MIT\", \"requires\": [],\n"
                << "  \"builtFor\": { \"sdk\": \"" JET_SDK_VERSION "\", \"abi\": \"" JET_ABI_TAG "\" },\n"
                << "  \"contributes\": { \"tools\": [ { \"id\": \"t" << i
                << "\", \"label\": \"T\", \"icon\": \"t.svg\", \"shortcut\": \"M\" } ],\n"
                << "    \"effects\": [ { \"id\": \"e" << i << "\", \"label\": \"E\" } ] } }\n";
        }
        return folder;
    }();
}

/// Runs bin/jet silently; returns its exit code.
int jet(const std::vector<std::string>& arguments)
{
    const pid_t child = ::fork();
    if (child == 0) {
        (void)!std::freopen("/dev/null", "w", stdout);
        std::vector<char*> argv{const_cast<char*>(kJet.c_str())};
        for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        ::execv(kJet.c_str(), argv.data());
        ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void version(benchmark::State& state)
{
    for (auto _ : state)
        if (jet({"--version"}) != 0) state.SkipWithError("jet --version failed");
}
BENCHMARK(version)->Unit(benchmark::kMillisecond)->UseRealTime();

void pluginsList(benchmark::State& state)
{
    for (auto _ : state)
        if (jet({"plugins", "list"}) != 0) state.SkipWithError("jet plugins list failed");
}
BENCHMARK(pluginsList)->Unit(benchmark::kMillisecond)->UseRealTime();

/// CPU milliseconds of the fastest of several starts with that many manifests, so that other programs do not count.
double startWith(int manifests)
{
    ::setenv("XDG_DATA_HOME", dataFolder(manifests).c_str(), 1);
    double best = -1;
    for (int i = 0; i < 15; ++i) {
        rusage before{}, after{};
        ::getrusage(RUSAGE_CHILDREN, &before);
        if (jet({"plugins", "list"}) != 0) return -1;
        ::getrusage(RUSAGE_CHILDREN, &after);
        const auto ms = [](const timeval& time) {
            return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) / 1e3;
        };
        const double used = ms(after.ru_utime) + ms(after.ru_stime) - ms(before.ru_utime) - ms(before.ru_stime);
        if (best < 0 || used < best) best = used;
    }
    return best;
}

void ballGame(benchmark::State& state)
{
    if (!fs::exists(kGame)) return state.SkipWithError("there is no ball game");
    for (auto _ : state)
        if (jet({"play", kGame, "--steps", "3000"}) != 0) state.SkipWithError("the ball game did not play");
}
BENCHMARK(ballGame)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Milliseconds from the start of the process to the first painted frame, as the window tells with
/// JET_TRACE_FIRST_FRAME; below 0 where it does not.
double firstFrame()
{
    const std::string command =
        "QT_QPA_PLATFORM=offscreen JET_TRACE_FIRST_FRAME=1 timeout 20 '" + kJet + "' '" + kGame + "' 2>&1";
    std::FILE* output = ::popen(command.c_str(), "r");
    double ms = -1;
    char line[1000];
    while (std::fgets(line, sizeof line, output))
        if (std::sscanf(line, "first frame after %lf ms", &ms) == 1) break;
    ::pclose(output);
    return ms;
}

}  // namespace

int main(int argc, char** argv)
{
    ::setenv("XDG_DATA_HOME", dataFolder(200).c_str(), 1);
    ::setenv("XDG_CONFIG_HOME", dataFolder(200).c_str(), 1);
    const int code = jet::bench::run(argc, argv, [](const jet::bench::Times& times, jet::bench::Summary& summary) {
        const auto ms = [&](const char* name) { return times.contains(name) ? times.at(name) / 1e6 : 0.0; };
        const auto add = [&](const char* key, const char* name, double goal) {
            if (ms(name) > 0) summary.add(key, ms(name), "ms", goal, ms(name) < goal);
        };
        add("version", "version", 30);
        add("plugins_list_200", "pluginsList", 60);
        if (ms("ballGame") > 0) {
            const double pace = 3000.0 / 60 / (ms("ballGame") / 1000);
            summary.add("ball_game", pace, "x real time", 50, pace >= 50);
        }
        const double few = startWith(10), many = startWith(500);
        if (few >= 0 && many >= 0) {
            summary.add("start_10_manifests", few, "ms CPU", 60, few < 60);
            summary.add("start_500_manifests", many, "ms CPU", few + 20, many < few + 20);
            summary.add("manifests_500_over_10", many - few, "ms CPU", 20, many - few < 20);
        }
        ::setenv("XDG_DATA_HOME", dataFolder(200).c_str(), 1);
        double best = -1;
        for (int i = 0; i < 3; ++i)
            if (const double frame = firstFrame(); frame >= 0 && (best < 0 || frame < best)) best = frame;
        if (best >= 0) summary.add("first_frame", best, "ms", 400, best < 400);
    });
    std::error_code ignored;
    for (const int count : {10, 200, 500}) fs::remove_all(dataFolder(count), ignored);
    return code;
}
