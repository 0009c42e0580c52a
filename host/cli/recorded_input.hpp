// Recorded input: which keys go down and up at which step (docs/command-line.md, "Recorded input").
#pragma once

#include <jet/result.hpp>
#include <jet/simulation.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace jet::host {

struct RecordedEvent {
    std::uint64_t step = 0;
    std::string key;
    bool down = false;
};

/// { "events": [ { "step": 0, "key": "D", "down": true }, ... ] }, in any order.
class RecordedInput {
public:
    static Result<RecordedInput> read(const std::filesystem::path& file);
    /// Applies what happens before the given step.
    void apply(Simulation& simulation, std::uint64_t step);
    const std::vector<RecordedEvent>& events() const { return events_; }

private:
    std::vector<RecordedEvent> events_;
    std::size_t next_ = 0;
};

}  // namespace jet::host
