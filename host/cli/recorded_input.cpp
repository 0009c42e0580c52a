#include "recorded_input.hpp"

#include "host/plugins/json_places.hpp"

#include <jet/format.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace jet::host {

namespace {

using Json = nlohmann::json;
using Kind = RecordedEvent::Kind;

/// Reads one event; what is wrong with it is thrown as a Failure that names the field's place.
class EventReader {
public:
    EventReader(const Json& event, const JsonPlaces& places, std::size_t index)
        : event_(event), places_(places), index_(index), pointer_("/events/" + std::to_string(index))
    {
    }

    RecordedEvent read() const
    {
        RecordedEvent event;
        if (!event_.is_object())
            wrong("", "must be an object, such as { \"step\": 0, \"key\": \"D\", \"down\": true }");
        if (!has("step") || !event_["step"].is_number_unsigned())
            wrong("step", "needs \"step\", a whole number from 0 on");
        event.step = event_["step"];
        event.where = places_.of(pointer_);
        const auto deeds = {std::pair("key", Kind::Key), std::pair("grab", Kind::Grab), std::pair("drag", Kind::Drag),
                            std::pair("letGo", Kind::LetGo)};
        const auto named = std::count_if(deeds.begin(), deeds.end(), [&](const auto& deed) { return has(deed.first); });
        if (named > 1)
            wrong("", "has more than one of \"key\", \"grab\", \"drag\" and \"letGo\"; make it as many events");
        for (const auto& [name, kind] : deeds)
            if (has(name)) event.kind = kind;
        switch (event.kind) {
        case Kind::Key: readKey(event); break;
        case Kind::Grab:
            event.point = place("grab");
            if (has("reach")) event.reach = reach();
            break;
        case Kind::Drag: event.point = place("drag"); break;
        case Kind::LetGo:
            if (event_["letGo"] != true) wrong("letGo", "needs \"letGo\": true");
            break;
        }
        return event;
    }

private:
    bool has(const char* field) const { return event_.contains(field); }
    [[noreturn]] void wrong(const std::string& field, const std::string& what) const
    {
        throw Failure(Error("recorded input: event number " + std::to_string(index_ + 1) + " " + what,
                            places_.of(field.empty() ? pointer_ : pointer_ + "/" + field)));
    }
    void readKey(RecordedEvent& event) const
    {
        if (!has("key") || !event_["key"].is_string())
            wrong("key", "needs \"key\", a name such as \"D\", or \"grab\", \"drag\" or \"letGo\"");
        if (!has("down") || !event_["down"].is_boolean()) wrong("down", "needs \"down\", true or false");
        event.key = event_["key"], event.down = event_["down"];
    }
    Vec2 place(const char* field) const
    {
        const Json& value = event_[field];
        if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number())
            wrong(field, std::string("needs \"") + field + "\": [x, y], a place in the scene");
        return {value[0].get<double>(), value[1].get<double>()};
    }
    double reach() const
    {
        const Json& value = event_["reach"];
        if (!value.is_number() || value.get<double>() < 0)
            wrong("reach", "needs a \"reach\" from 0 on, in units of the scene");
        return value.get<double>();
    }

    const Json& event_;
    const JsonPlaces& places_;
    std::size_t index_;
    std::string pointer_;
};

}  // namespace

Result<RecordedInput> RecordedInput::read(const std::filesystem::path& file)
{
    const auto text = readFile(file);
    if (!text) return text.error();
    Json json;
    try {
        json = Json::parse(*text, nullptr, true, true);
    } catch (const Json::parse_error& e) {
        return Error("the recorded input is not valid JSON",
                     JsonPlaces::at(*text, e.byte > 0 ? e.byte - 1 : 0, file.string()));
    }
    if (!json.is_object() || !json.contains("events") || !json["events"].is_array())
        return Error("recorded input: it must be { \"events\": [ { \"step\": 0, \"key\": \"D\", \"down\": true } ] }",
                     Location{file.string(), 0, 0});
    const JsonPlaces places(*text, file.string());
    RecordedInput input;
    try {
        for (const Json& event : json["events"])
            input.events_.push_back(EventReader(event, places, input.events_.size()).read());
    } catch (const Failure& failure) {
        return failure.error();
    }
    std::stable_sort(input.events_.begin(), input.events_.end(),
                     [](const auto& a, const auto& b) { return a.step < b.step; });
    return input;
}

void RecordedInput::apply(Simulation& simulation, std::uint64_t step, const Warn& warn)
{
    for (; next_ < events_.size() && events_[next_].step <= step; ++next_) {
        const RecordedEvent& event = events_[next_];
        switch (event.kind) {
        case Kind::Key: {
            KeyEvent key;
            key.key = event.key;
            if (key.key.size() == 1) key.text = key.key;
            simulation.key(key, event.down);
            break;
        }
        case Kind::Grab:
            if (!simulation.grab(event.point, event.reach))
                warn("recorded input: nothing that can be dragged is here at step " + std::to_string(step),
                     event.where);
            break;
        case Kind::Drag: simulation.drag(event.point); break;
        case Kind::LetGo: simulation.letGo(); break;
        }
    }
}

std::string RecordedInput::text(const RecordedEvent& event)
{
    nlohmann::ordered_json json{{"step", event.step}};
    const auto place = nlohmann::ordered_json::array({event.point.x(), event.point.y()});
    switch (event.kind) {
    case Kind::Key: json["key"] = event.key, json["down"] = event.down; break;
    case Kind::Grab:
        json["grab"] = place;
        if (event.reach > 0) json["reach"] = event.reach;
        break;
    case Kind::Drag: json["drag"] = place; break;
    case Kind::LetGo: json["letGo"] = true; break;
    }
    return json.dump();
}

}  // namespace jet::host
