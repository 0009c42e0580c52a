#include "recorded_input.hpp"

#include <jet/format.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace jet::host {

Result<RecordedInput> RecordedInput::read(const std::filesystem::path& file)
{
    const auto text = readFile(file);
    if (!text) return text.error();
    nlohmann::json json;
    try {
        json = nlohmann::json::parse(*text, nullptr, true, true);
    } catch (const nlohmann::json::parse_error& e) {
        const auto end = text->begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, text->size()));
        return Error("the recorded input is not valid JSON",
                     Location{file.string(), 1 + static_cast<int>(std::count(text->begin(), end, '\n')), 0});
    }
    const auto wrong = [&](const std::string& what) {
        return Error("recorded input: " + what, Location{file.string(), 0, 0});
    };
    if (!json.is_object() || !json.contains("events") || !json["events"].is_array())
        return wrong("it must be { \"events\": [ { \"step\": 0, \"key\": \"D\", \"down\": true } ] }");
    RecordedInput input;
    for (const auto& event : json["events"]) {
        const std::string place = "event number " + std::to_string(input.events_.size() + 1);
        if (!event.is_object() || !event.contains("step") || !event["step"].is_number_unsigned())
            return wrong(place + " needs \"step\", a whole number from 0 on");
        if (!event.contains("key") || !event["key"].is_string())
            return wrong(place + " needs \"key\", a name such as \"D\"");
        if (!event.contains("down") || !event["down"].is_boolean())
            return wrong(place + " needs \"down\", true or false");
        input.events_.push_back({event["step"], event["key"], event["down"]});
    }
    std::stable_sort(input.events_.begin(), input.events_.end(),
                     [](const auto& a, const auto& b) { return a.step < b.step; });
    return input;
}

void RecordedInput::apply(Simulation& simulation, std::uint64_t step)
{
    for (; next_ < events_.size() && events_[next_].step <= step; ++next_) {
        KeyEvent event;
        event.key = events_[next_].key;
        if (event.key.size() == 1) event.text = event.key;
        simulation.key(event, events_[next_].down);
    }
}

}  // namespace jet::host
