// One engine in one scene, measured in a process of its own, so that an engine that aborts is its own problem and no
// engine's heap is another's. All engines of a scene take turns, a stretch of steps each, so that whatever else the
// machine does meets them alike:
//
//   Contestant (stretch)* result
#pragma once

#include "bench/physics/engines.hpp"

#include <nlohmann/json.hpp>
#include <sys/types.h>

#include <functional>

namespace jet::bench {

struct Measured {
    double median = 0, p95 = 0;        // ms a step, of the processor
    double wall = 0, undisturbed = 0;  // ms a step by the clock: median, tenth part
    std::size_t memory = 0, heap = 0;  // bytes: as the engine counts, as the heap grew
    nlohmann::ordered_json quality;
};

class Contestant {
public:
    using Make = std::function<std::unique_ptr<Engine>()>;

    /// Starts the process, which waits for its turn. The scene must outlive this.
    Contestant(const Scene&, Make);
    ~Contestant();
    Contestant(const Contestant&) = delete;
    Contestant& operator=(const Contestant&) = delete;

    /// Makes the engine at first, then its next steps. False once all are done, or it came to grief.
    bool stretch();
    /// Why there is no result; empty when there is one.
    const std::string& problem() const { return problem_; }
    const Measured& result() const { return result_; }

private:
    [[noreturn]] void serve(const Scene&, const Make&, int commands, int answers);
    bool receive();
    void fail(const std::string& happened);

    pid_t process_ = -1;
    int commands_ = -1, answers_ = -1, noise_ = -1;  // its standard error is kept, the last line tells why it died
    int turns_ = 0;
    std::string problem_;
    Measured result_;
};

}  // namespace jet::bench
