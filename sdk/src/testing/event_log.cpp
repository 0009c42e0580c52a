#include <jet/testing/event_log.hpp>

#include <algorithm>

namespace jet::test {

namespace {

struct Namer {
    std::string_view operator()(const ItemAdded&) const { return "ItemAdded"; }
    std::string_view operator()(const ItemRemoved&) const { return "ItemRemoved"; }
    std::string_view operator()(const ItemMoved&) const { return "ItemMoved"; }
    std::string_view operator()(const PathChanged&) const { return "PathChanged"; }
    std::string_view operator()(const PropertyChanged&) const { return "PropertyChanged"; }
    std::string_view operator()(const TypeChanged&) const { return "TypeChanged"; }
    std::string_view operator()(const EffectAdded&) const { return "EffectAdded"; }
    std::string_view operator()(const EffectRemoved&) const { return "EffectRemoved"; }
    std::string_view operator()(const EffectMoved&) const { return "EffectMoved"; }
    std::string_view operator()(const EffectPropertyChanged&) const { return "EffectPropertyChanged"; }
    std::string_view operator()(const ScenePropertyChanged&) const { return "ScenePropertyChanged"; }
    std::string_view operator()(const MaterialsChanged&) const { return "MaterialsChanged"; }
    /// A record added to the SDK later than this list.
    template <class Other>
    std::string_view operator()(const Other&) const
    {
        return "Change";
    }
};

}  // namespace

std::string_view changeName(const Change& change) { return std::visit(Namer(), change); }

EventLog::EventLog(const Scene& scene)
    : itemsChanged_(scene.events().subscribe<ItemsChanged>(&scene, [this](const ItemsChanged& e) { note(e); })),
      selectionChanged_(scene.events().subscribe<SelectionChanged>(&scene, [this](const SelectionChanged&) {
          ++selectionChanges_;
          lines_.emplace_back("SelectionChanged");
      }))
{
}

void EventLog::note(const ItemsChanged& event)
{
    ++steps_;
    std::string line = event.cause == ItemsChanged::Cause::Commit ? "Commit:"
                       : event.cause == ItemsChanged::Cause::Undo ? "Undo:"
                                                                  : "Redo:";
    for (const Change& change : event.changes) {
        changes_.emplace_back(changeName(change));
        line += (line.back() == ':' ? " " : ", ") + changes_.back();
    }
    lines_.push_back(std::move(line));
}

std::size_t EventLog::count(std::string_view change) const
{
    return static_cast<std::size_t>(std::count(changes_.begin(), changes_.end(), change));
}

void EventLog::clear()
{
    lines_.clear();
    changes_.clear();
    steps_ = selectionChanges_ = 0;
}

}  // namespace jet::test
