#include "scene_state.hpp"

namespace jet {

namespace {

// Two changes of the same thing become one from the first's "before" to the second's "after". Returns false where that
// cannot be said of them.
bool joins(Change& first, Change& second)
{
    if (first.index() != second.index()) return false;
    if (auto* a = std::get_if<PathChanged>(&first)) {
        auto& b = std::get<PathChanged>(second);
        if (a->item != b.item) return false;
        a->after = std::move(b.after);
        return true;
    }
    if (auto* a = std::get_if<PropertyChanged>(&first)) {
        auto& b = std::get<PropertyChanged>(second);
        if (a->item != b.item || a->property != b.property) return false;
        a->after = std::move(b.after);
        return true;
    }
    if (auto* a = std::get_if<EffectPropertyChanged>(&first)) {
        auto& b = std::get<EffectPropertyChanged>(second);
        if (a->item != b.item || a->index != b.index || a->property != b.property) return false;
        a->after = std::move(b.after);
        return true;
    }
    if (auto* a = std::get_if<ScenePropertyChanged>(&first)) {
        auto& b = std::get<ScenePropertyChanged>(second);
        if (a->property != b.property) return false;
        a->after = std::move(b.after);
        return true;
    }
    return false;
}

bool sameTargets(const std::vector<Change>& a, const std::vector<Change>& b)
{
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].index() != b[i].index() || changedItem(a[i]) != changedItem(b[i])) return false;
    return true;
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
    if (sameTargets(last.changes, step.changes)) {
        std::vector<Change> apart;
        for (std::size_t i = 0; i < step.changes.size(); ++i)
            if (!joins(last.changes[i], step.changes[i])) apart.push_back(std::move(step.changes[i]));
        step.changes = std::move(apart);
    }
    for (Change& change : step.changes) last.changes.push_back(std::move(change));
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
