#include "bench/summary.hpp"

#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <vector>

namespace jet::bench {

namespace {

class Collector final : public benchmark::ConsoleReporter {
public:
    Times times;
    void ReportRuns(const std::vector<Run>& runs) override
    {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs)
            if (!run.error_occurred && run.run_type == Run::RT_Iteration)
                times[run.run_name.function_name] =
                    run.real_accumulated_time / static_cast<double>(run.iterations) * 1e9;
    }
};

double statusMegabytes(const std::string& key)
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.rfind(key, 0) == 0) return std::stod(line.substr(key.size() + 1)) / 1024;
    return 0;
}

}  // namespace

void Summary::add(const std::string& name, double value, const std::string& unit, double goal, bool met)
{
    std::printf("%-34s %12.2f %-14s goal %10.2f  %s\n", name.c_str(), value, unit.c_str(), goal,
                met ? "met" : "MISSED");
    json_[name] = {{"value", value}, {"unit", unit}, {"goal", goal}, {"met", met}};
}

void Summary::note(const std::string& name, double value, const std::string& unit)
{
    std::printf("%-34s %12.2f %s\n", name.c_str(), value, unit.c_str());
    json_[name] = {{"value", value}, {"unit", unit}};
}

int run(int argc, char** argv, const std::function<void(const Times&, Summary&)>& summarize)
{
    std::string file;
    std::vector<char*> rest;
    for (int i = 0; i < argc; ++i) {
        if (std::strcmp(argv[i], "--summary-json") == 0 && i + 1 < argc) {
            file = argv[++i];
        } else {
            rest.push_back(argv[i]);
        }
    }
    int count = static_cast<int>(rest.size());
    benchmark::Initialize(&count, rest.data());
    if (benchmark::ReportUnrecognizedArguments(count, rest.data())) return 2;
    Collector collector;
    benchmark::RunSpecifiedBenchmarks(&collector);
    std::printf("\n");
    Summary summary;
    summarize(collector.times, summary);
    if (file.empty()) return 0;
    std::ofstream(file) << summary.json().dump(2) << "\n";
    return 0;
}

double processorSeconds()
{
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double residentMegabytes() { return statusMegabytes("VmRSS:"); }
double peakMegabytes() { return statusMegabytes("VmHWM:"); }

}  // namespace jet::bench
