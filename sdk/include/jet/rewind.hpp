// Rewind: the last seconds of a run, kept as states of the simulation, so that one can go back and play on from there.
//
//   SimulationCenter& simulation = editor.simulation();
//   simulation.pause();
//   simulation.rewindTo(simulation.rewindState().oldest);  // a SimulationFrameReady follows
//   simulation.resume();                                   // what came after is forgotten
//
// Bodies, actuators, camera and random numbers go back; playing on gives the same bits. What scripts keep in variables
// of their own does not: a script language's heap has no copy.
#pragma once

#include <jet/version.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace jet {

struct RewindLimits {
    double seconds = 10;                         ///< simulated; 0: nothing is kept
    std::size_t bytes = std::size_t{256} << 20;  ///< of kept states; where they need more, some steps are left out
};

/// What can be gone back to.
struct RewindState {
    std::uint64_t oldest = 0, newest = 0;  ///< steps
    std::uint64_t present = 0;             ///< step that is shown
    std::size_t bytes = 0;                 ///< memory of the kept states
    std::uint32_t interval = 1;            ///< steps from one kept state to the next; those between are computed again
    bool any = false;                      ///< is there anything?
};

/// States by step, packed: each is kept as the difference to what its two predecessors let expect, in as many bytes as
/// that has. Positions of moving bodies take about half their size then, those of resting ones next to nothing.
class JET_API RewindHistory {
public:
    explicit RewindHistory(RewindLimits limits = {}, double timeStep = 1.0 / 60);
    ~RewindHistory();
    RewindHistory(const RewindHistory&) = delete;
    RewindHistory& operator=(const RewindHistory&) = delete;

    /// Shall the state after this step be recorded? Not where the memory does not suffice for every step.
    bool wants(std::uint64_t step) const;
    /// Keeps the state after `step`. States of this and later steps are forgotten first: another future begins.
    void record(std::uint64_t step, std::span<const std::byte> state);
    void clear();

    struct State {
        std::uint64_t step = 0;
        std::vector<std::byte> bytes;
    };
    /// The last kept state at or before `step`, else the oldest; none when nothing is kept.
    std::optional<State> find(std::uint64_t step) const;
    /// `present` is left 0: the history does not know it.
    RewindState state() const;

private:
    struct Private;
    std::unique_ptr<Private> d_;
};

}  // namespace jet
