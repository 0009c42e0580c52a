// EventLog: what a scene told its listeners while a test ran.
//
//   EventLog log(scene);
//   tool("rectangle").drag({10, 10}, {60, 40});
//   EXPECT_EQ(log.steps(), 1u);                       // one commit
//   EXPECT_EQ(log.count("ItemAdded"), 1u);            // with these changes
//   EXPECT_EQ(log.lines().back(), "SelectionChanged");
//
// Recorded<Event> keeps copies of any other event type, for instance those of your own plugin.
#pragma once

#include <jet/scene.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace jet::test {

/// The events of one type from one sender (null: from anyone), as copies.
template <class E>
class Recorded {
public:
    explicit Recorded(EventsCenter& events, const void* sender = nullptr)
        : subscription_(events.subscribe<E>(sender, [this](const E& event) { events_.push_back(event); }))
    {
    }
    Recorded(const Recorded&) = delete;
    Recorded& operator=(const Recorded&) = delete;

    const std::vector<E>& events() const { return events_; }
    std::size_t size() const { return events_.size(); }
    const E& last() const { return events_.back(); }
    void clear() { events_.clear(); }

private:
    std::vector<E> events_;
    Subscription subscription_;
};

/// The name of the record: "ItemAdded", "PathChanged", ...
std::string_view changeName(const Change& change);

/// ItemsChanged and SelectionChanged of one scene, as lines: "Commit: ItemAdded, EffectAdded", "Undo: ...", "Redo:
/// ...", "SelectionChanged".
class EventLog {
public:
    explicit EventLog(const Scene& scene);
    EventLog(const EventLog&) = delete;
    EventLog& operator=(const EventLog&) = delete;

    const std::vector<std::string>& lines() const { return lines_; }
    /// Commits, undos and redos together.
    std::size_t steps() const { return steps_; }
    /// How many changes of that name these had.
    std::size_t count(std::string_view change) const;
    std::size_t selectionChanges() const { return selectionChanges_; }
    void clear();

private:
    void note(const ItemsChanged& event);

    std::vector<std::string> lines_;
    std::vector<std::string> changes_;
    std::size_t steps_ = 0, selectionChanges_ = 0;
    Subscription itemsChanged_, selectionChanged_;
};

}  // namespace jet::test
