// The conformance run: plans the tests of built plugins, runs each in a child process, tells the results.
#pragma once

#include "host/plugins/manifest.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace jet::host::check {

struct RunOptions {
    std::vector<std::filesystem::path> folders;  ///< of built plugins, or folders that hold some
    std::vector<std::string> only;               ///< names of tests, with or without ":ID"; empty: all
    std::uint64_t seed = 1;
    std::filesystem::path samples;  ///< sample files for importers; may be empty
    std::filesystem::path program;  ///< bin/jet; empty: this program
    int jobs = 0;                   ///< children at a time; 0: one a processor
};

/// One test of one plugin.
struct PlannedTest {
    std::size_t plugin = 0;    ///< index into Plan::plugins
    std::size_t test = 0;      ///< index into allTests()
    std::string contribution;  ///< id; empty for a test of the whole plugin
    std::string name;          ///< "tool-edits:rectangle"
};

struct PlannedPlugin {
    std::filesystem::path folder;
    std::string title;  ///< "Rectangle (org.jet.tool.rectangle 1.0.0)", or the folder's name
    Manifest manifest;
};

struct Plan {
    std::vector<PlannedPlugin> plugins;
    std::vector<PlannedTest> tests;
};

/// What will be run. Fails when a folder holds no plugin, or `only` names no test.
Result<Plan> planRun(const RunOptions& options);

struct TestResult {
    enum class Kind { Passed, Failed, Skipped } kind = Kind::Passed;
    std::string reason;   ///< a sentence, unless it passed
    std::string output;   ///< the end of what the child wrote to stderr, if it failed
    std::string command;  ///< that runs this test again
    double seconds = 0;
};

/// Results by PlannedTest. `told` is called as each is there, in the order of the plan. [its own threads; one at a
/// time]
std::vector<TestResult> runPlan(const Plan& plan, const RunOptions& options,
                                const std::function<void(const PlannedTest&, const TestResult&)>& told);

/// The child: one test. Returns the exit code.
int runOne(const std::filesystem::path& folder, const std::string& test, std::uint64_t seed,
           const std::filesystem::path& samples, const std::filesystem::path& board);

}  // namespace jet::host::check
