// What all benchmark programs share: Google Benchmark's main with --summary-json FILE, and goals that are printed
// beside the figures.
#pragma once

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace jet::bench {

/// Figures to be written, in the order they were found.
class Summary {
public:
    /// A figure with its goal; `met` tells whether it is reached.
    void add(const std::string& name, double value, const std::string& unit, double goal, bool met);
    /// A figure without a goal.
    void note(const std::string& name, double value, const std::string& unit);
    nlohmann::ordered_json& json() { return json_; }

private:
    nlohmann::ordered_json json_ = nlohmann::ordered_json::object();
};

/// The mean time of an iteration of each benchmark that ran, in nanoseconds, by name.
using Times = std::map<std::string, double>;

/// Runs the registered benchmarks, then `summarize`, which turns their times into figures. Returns the exit code.
int run(int argc, char** argv, const std::function<void(const Times&, Summary&)>& summarize);

/// Processor time this thread has taken: other programs on the machine do not count.
double processorSeconds();

/// Resident memory of this process, now and at most, in MB.
double residentMegabytes();
double peakMegabytes();

}  // namespace jet::bench
