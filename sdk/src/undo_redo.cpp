#include "scene_state.hpp"

#include <algorithm>

namespace jet {

namespace {

// The same value set again: two such changes are one, from the first's "before" to the second's "after".
bool joinable(const Change& first, const Change& second)
{
    if (first.index() != second.index() || changedItem(first) != changedItem(second)) return false;
    if (std::holds_alternative<PathChanged>(first)) return true;
    if (const auto* a = std::get_if<PropertyChanged>(&first))
        return a->property == std::get<PropertyChanged>(second).property;
    if (const auto* a = std::get_if<ScenePropertyChanged>(&first))
        return a->property == std::get<ScenePropertyChanged>(second).property;
    if (const auto* a = std::get_if<EffectPropertyChanged>(&first)) {
        const auto& b = std::get<EffectPropertyChanged>(second);
        return a->index == b.index && a->property == b.property;
    }
    return false;
}

void join(Change& first, Change& second)
{
    std::visit(
        [&]<class C>(C& a) {
            if constexpr (requires { a.before = std::move(a.after); }) a.after = std::move(std::get<C>(second).after);
        },
        first);
}

// All or nothing: a change of the tree in between could give a place in it another meaning.
bool joinable(const std::vector<Change>& first, const std::vector<Change>& second)
{
    return std::ranges::equal(first, second, [](const Change& a, const Change& b) { return joinable(a, b); });
}

}  // namespace

void UndoRedoCenter::Private::push(UndoStep step)
{
    const bool atTop = done == steps.size();
    if (clean > static_cast<std::ptrdiff_t>(done)) clean = -1;  // the saved state lies in the redo steps that go now
    steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(done), steps.end());
    const bool merge = atTop && !steps.empty() && !step.mergeKey.empty() && steps.back().mergeKey == step.mergeKey &&
                       clean != static_cast<std::ptrdiff_t>(done);
    if (!merge) {
        steps.push_back(std::move(step));
        ++done;
        return;
    }
    UndoStep& last = steps.back();
    last.selectionAfter = std::move(step.selectionAfter);
    if (joinable(last.changes, step.changes)) {
        for (std::size_t i = 0; i < step.changes.size(); ++i) join(last.changes[i], step.changes[i]);
    } else {
        for (Change& change : step.changes) last.changes.push_back(std::move(change));
    }
}

UndoRedoCenter::UndoRedoCenter(ItemsCenter& items) : d_(std::make_unique<Private>()) { d_->items = &items; }
UndoRedoCenter::~UndoRedoCenter() = default;

bool UndoRedoCenter::canUndo() const { return d_->done > 0; }
bool UndoRedoCenter::canRedo() const { return d_->done < d_->steps.size(); }
std::string UndoRedoCenter::undoLabel() const { return canUndo() ? d_->steps[d_->done - 1].label : std::string(); }
std::string UndoRedoCenter::redoLabel() const { return canRedo() ? d_->steps[d_->done].label : std::string(); }

void UndoRedoCenter::undo()
{
    auto& items = *d_->items->d_;
    if (items.open) throw Failure(Error("finish or cancel '" + items.open->label + "' before undoing"));
    if (!canUndo()) return;
    UndoStep& step = d_->steps[--d_->done];
    for (auto change = step.changes.rbegin(); change != step.changes.rend(); ++change) items.revert(*change);
    items.setSelection(step.selectionBefore);
    items.notifyTouched();
    items.notifyChanged(step.changes, ItemsChanged::Cause::Undo);
}

void UndoRedoCenter::redo()
{
    auto& items = *d_->items->d_;
    if (items.open) throw Failure(Error("finish or cancel '" + items.open->label + "' before redoing"));
    if (!canRedo()) return;
    UndoStep& step = d_->steps[d_->done++];
    for (Change& change : step.changes) items.apply(change);
    items.setSelection(step.selectionAfter);
    items.notifyTouched();
    items.notifyChanged(step.changes, ItemsChanged::Cause::Redo);
}

void UndoRedoCenter::clear()
{
    const bool wasClean = isClean();
    d_->steps.clear();
    d_->done = 0;
    d_->clean = wasClean ? 0 : -1;
}

std::vector<std::string> UndoRedoCenter::labels() const
{
    std::vector<std::string> labels;
    for (const UndoStep& step : d_->steps) labels.push_back(step.label);
    return labels;
}

std::size_t UndoRedoCenter::position() const { return d_->done; }

void UndoRedoCenter::goTo(std::size_t position)
{
    while (d_->done > position && canUndo()) undo();
    while (d_->done < position && canRedo()) redo();
}

void UndoRedoCenter::markClean() { d_->clean = static_cast<std::ptrdiff_t>(d_->done); }
bool UndoRedoCenter::isClean() const { return d_->clean == static_cast<std::ptrdiff_t>(d_->done); }

}  // namespace jet
