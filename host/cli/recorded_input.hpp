// Recorded input: which keys go down and up, and what the hand drags, at which step (docs/command-line.md, "Recorded
// input").
#pragma once

#include <jet/result.hpp>
#include <jet/simulation.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace jet::host {

struct RecordedEvent {
    enum class Kind { Key, Grab, Drag, LetGo };
    std::uint64_t step = 0;
    Kind kind = Kind::Key;
    std::string key;
    bool down = false;
    Vec2 point{0, 0};  ///< Grab, Drag: scene units
    double reach = 0;  ///< Grab: scene units
    Location where;    ///< in its file
};

/// { "events": [ { "step": 0, "key": "D", "down": true }, { "step": 9, "grab": [80, 20] }, ... ] }, in any order.
class RecordedInput {
public:
    using Warn = std::function<void(const std::string& what, const Location& where)>;

    static Result<RecordedInput> read(const std::filesystem::path& file);
    /// Applies what happens before the given step.
    void apply(Simulation& simulation, std::uint64_t step, const Warn& warn);
    const std::vector<RecordedEvent>& events() const { return events_; }
    /// As JSON that read() takes.
    static std::string text(const RecordedEvent&);

private:
    std::vector<RecordedEvent> events_;
    std::size_t next_ = 0;
};

}  // namespace jet::host
