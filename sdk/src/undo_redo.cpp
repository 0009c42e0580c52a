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

// What it takes beyond its own size.
std::size_t memoryOf(const Value& value)
{
    if (const auto* text = value.get<std::string>()) return text->capacity();
    if (const auto* raw = value.get<RawText>()) return raw->text.capacity();
    const Path* path = value.get<Path>();
    return path ? path->memory() : 0;
}

std::size_t memoryOf(const Properties& properties)
{
    std::size_t bytes = properties.entries().size() * sizeof(Properties::Entry);
    for (const auto& [id, value] : properties.entries()) bytes += memoryOf(value);
    return bytes;
}

}  // namespace

std::size_t memoryOf(const Item* subtree)
{
    std::size_t bytes = 0;
    if (!subtree) return bytes;
    subtree->walk([&](const Item& item) {
        bytes += sizeof(Item) + item.path().memory() + memoryOf(item.properties());
        for (const EffectInstance& effect : item.effects())
            bytes += sizeof(EffectInstance) + memoryOf(effect.properties);
    });
    return bytes;
}

std::size_t memoryOf(const Change& change)
{
    const auto kept = [](const auto& c) -> std::size_t {
        if constexpr (requires { c.detached; })
            return memoryOf(c.detached.get());
        else if constexpr (requires { c.before.memory(); })
            return c.before.memory();  // `after` is the next one's before
        else if constexpr (requires { memoryOf(c.before); })
            return memoryOf(c.before) + memoryOf(c.after);
        else if constexpr (requires { c.effect; })
            return memoryOf(c.effect.properties);
        else if constexpr (requires { c.before.pairs(); })
            return 2 * sizeof(MaterialPair) * (c.before.pairs().size() + c.after.pairs().size());
        else
            return 0;
    };
    return sizeof(Change) + std::visit(kept, change);
}

// --- steps

std::pair<std::shared_ptr<UndoStep>, std::size_t> UndoRedoCenter::Private::push(UndoStep step)
{
    const bool atTop = done == steps.size();
    if (clean > static_cast<std::ptrdiff_t>(done)) clean = -1;  // the saved state lies in the redo steps that go now
    while (steps.size() > done) {
        bytes -= steps.back()->bytes;
        steps.pop_back();
    }
    std::size_t first = 0;
    const bool mayMerge = atTop && !steps.empty() && !step.mergeKey.empty() &&
                          steps.back()->mergeKey == step.mergeKey && !items->d_->announcing &&
                          clean != static_cast<std::ptrdiff_t>(done);
    if (mayMerge) {
        const std::size_t fresh = step.changes.size();
        merge(step);
        first = steps.back()->changes.size() - std::min(fresh, steps.back()->changes.size());
    } else {
        steps.push_back(std::make_shared<UndoStep>(std::move(step)));
        ++done;
    }
    const auto made = steps.back();
    count(*made);
    forgetOldest();
    return {made, first};
}

void UndoRedoCenter::Private::merge(UndoStep& step)
{
    UndoStep& last = *steps.back();
    last.selectionAfter = std::move(step.selectionAfter);
    if (joinable(last.changes, step.changes)) {
        for (std::size_t i = 0; i < step.changes.size(); ++i) join(last.changes[i], step.changes[i]);
    } else {
        for (Change& change : step.changes) last.changes.push_back(std::move(change));
    }
}

void UndoRedoCenter::Private::count(UndoStep& step)
{
    bytes -= step.bytes;
    step.bytes = sizeof(UndoStep) + step.label.size() + step.mergeKey.size();
    for (const Change& change : step.changes) step.bytes += memoryOf(change);
    bytes += step.bytes;
}

void UndoRedoCenter::Private::forgetOldest()
{
    while (bytes > limit && steps.size() > 1 && done > 0) {
        bytes -= steps.front()->bytes;
        steps.pop_front();
        --done;
        ++forgotten;
        if (clean >= 0) --clean;  // -1: the saved state is older than what is left
    }
}

void UndoRedoCenter::Private::notify() const
{
    const Scene& scene = items->d_->scene;
    items->d_->events.post(&scene, HistoryChanged{&scene});
}

UndoRedoCenter::UndoRedoCenter(ItemsCenter& items) : d_(std::make_unique<Private>()) { d_->items = &items; }
UndoRedoCenter::~UndoRedoCenter() = default;

ItemsCenter& UndoRedoCenter::items() const { return *d_->items; }
bool UndoRedoCenter::canUndo() const { return d_->done > 0; }
bool UndoRedoCenter::canRedo() const { return d_->done < d_->steps.size(); }
std::string UndoRedoCenter::undoLabel() const { return canUndo() ? d_->steps[d_->done - 1]->label : std::string(); }
std::string UndoRedoCenter::redoLabel() const { return canRedo() ? d_->steps[d_->done]->label : std::string(); }

void UndoRedoCenter::undo()
{
    requireThread(d_->items->d_->owner, "UndoRedoCenter::undo", __builtin_return_address(0));
    if (items().inTransaction())
        throw Failure(Error("finish or cancel '" + items().transactionLabel() + "' before undoing"));
    if (canUndo()) take(--d_->done, ItemsChanged::Cause::Undo);
}

void UndoRedoCenter::redo()
{
    requireThread(d_->items->d_->owner, "UndoRedoCenter::redo", __builtin_return_address(0));
    if (items().inTransaction())
        throw Failure(Error("finish or cancel '" + items().transactionLabel() + "' before redoing"));
    if (canRedo()) take(d_->done++, ItemsChanged::Cause::Redo);
}

void UndoRedoCenter::take(std::size_t index, ItemsChanged::Cause cause)
{
    auto& items = *d_->items->d_;
    const std::shared_ptr<UndoStep> step = d_->steps[index];
    const bool back = cause == ItemsChanged::Cause::Undo;
    ++items.undoing;
    if (back) {
        for (auto change = step->changes.rbegin(); change != step->changes.rend(); ++change) items.revert(*change);
    } else {
        for (Change& change : step->changes) items.apply(change);
    }
    items.restoreSelection(back ? step->selectionBefore : step->selectionAfter);
    --items.undoing;
    if (items.indexed) items.index.settle();
    items.touched = true;
    items.announce(step, 0, cause);
}

void UndoRedoCenter::clear()
{
    const bool wasClean = isClean();
    d_->steps.clear();
    d_->done = d_->bytes = d_->forgotten = 0;
    d_->clean = wasClean ? 0 : -1;
    d_->notify();
}

// --- for the History panel

std::size_t UndoRedoCenter::size() const { return d_->steps.size(); }
std::size_t UndoRedoCenter::position() const { return d_->done; }
const std::string& UndoRedoCenter::label(std::size_t step) const { return d_->steps.at(step)->label; }

std::vector<std::string> UndoRedoCenter::labels() const
{
    std::vector<std::string> labels;
    labels.reserve(d_->steps.size());
    for (const auto& step : d_->steps) labels.push_back(step->label);
    return labels;
}

void UndoRedoCenter::goTo(std::size_t position)
{
    while (d_->done > position && canUndo()) undo();
    while (d_->done < position && canRedo()) redo();
}

void UndoRedoCenter::markClean()
{
    if (isClean()) return;
    d_->clean = static_cast<std::ptrdiff_t>(d_->done);
    d_->notify();
}

bool UndoRedoCenter::isClean() const { return d_->clean == static_cast<std::ptrdiff_t>(d_->done); }

std::optional<std::size_t> UndoRedoCenter::cleanPosition() const
{
    return d_->clean < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(d_->clean));
}

void UndoRedoCenter::setMemoryLimit(std::size_t bytes)
{
    d_->limit = bytes;
    const std::size_t before = d_->forgotten;
    d_->forgetOldest();
    if (d_->forgotten != before) d_->notify();
}

std::size_t UndoRedoCenter::memoryLimit() const { return d_->limit; }
std::size_t UndoRedoCenter::memory() const { return d_->bytes; }
std::size_t UndoRedoCenter::forgotten() const { return d_->forgotten; }

}  // namespace jet
