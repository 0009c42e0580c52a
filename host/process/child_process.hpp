// Runs a program as a child with limits on time, memory and output, and tells how it ended. Never through a shell: the
// arguments arrive as they are.
#pragma once

#include <jet/result.hpp>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace jet::host {

struct ChildLimits {
    std::chrono::milliseconds time{
        30'000};                     ///< by the clock on the wall; then the child and what it started are killed
    std::size_t memory = 0;          ///< bytes; 0: no limit
    std::size_t output = 16 << 20;   ///< bytes of stdout kept; a child that writes more is killed
    std::size_t errors = 256 << 10;  ///< bytes of stderr kept; more is read and dropped
};

struct ChildOptions {
    std::vector<std::pair<std::string, std::string>> environment;  ///< set in addition to the program's own
    std::filesystem::path folder;                                  ///< to run in; empty: the present one
    ChildLimits limits;
};

/// How a child ended. At most one of the reasons besides the exit code is given.
struct ChildOutcome {
    int code = -1;   ///< exit code, if it ended by itself
    int signal = 0;  ///< that ended it, if not 0
    bool timedOut = false, tooMuchMemory = false, tooMuchOutput = false;
    std::string out, err;

    bool endedByItself() const { return signal == 0 && !timedOut && !tooMuchMemory && !tooMuchOutput; }
    bool fine() const { return endedByItself() && code == 0; }
    /// "it crashed (signal 11, Segmentation fault)", "it did not end within 5 s", "it ended with exit code 3".
    std::string reason(const ChildLimits& limits) const;
};

/// `arguments[0]` is the program, looked up in PATH where it has no slash. An Error only if it could not be started.
/// [any thread]
Result<ChildOutcome> runChild(const std::vector<std::string>& arguments, const ChildOptions& options);

/// The first executable file of that name in PATH; empty if there is none.
std::filesystem::path findProgram(const std::string& name);
/// This very program, to run it again as a child.
std::filesystem::path ownProgram();

}  // namespace jet::host
