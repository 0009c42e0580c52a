// EffectStates: what effects derived from their items, kept from one paint to the next.
#pragma once

#include <jet/effect.hpp>

#include <unordered_map>
#include <vector>

namespace jet {

/// By item and place among its effects; good for one revision of the item. [thread that paints the scene]
class EffectStates {
public:
    /// What effect number `index` of the item returns from update(), computed when it is not known for this revision.
    const EffectState* get(const Effect& effect, const EffectInput& input, std::size_t index)
    {
        Kept& kept = byItem_[input.item.id().value];
        if (kept.revision != input.item.revision()) kept = {input.item.revision(), {}};
        if (kept.states.size() <= index) kept.states.resize(index + 1);
        State& state = kept.states[index];
        if (state.effect != &effect) state = {&effect, effect.update(input)};
        return state.state.get();
    }
    void drop(ItemId item) { byItem_.erase(item.value); }
    void clear() { byItem_.clear(); }

private:
    struct State {
        const Effect* effect = nullptr;
        std::unique_ptr<EffectState> state;
    };
    struct Kept {
        std::uint64_t revision = 0;
        std::vector<State> states;
    };
    std::unordered_map<std::uint64_t, Kept> byItem_;
};

}  // namespace jet
