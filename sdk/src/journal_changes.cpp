// Changes as bytes, and back.
//
// A record is written after its transaction: an item that was added and then changed stands in the scene as it is at
// the end. So an added subtree is written with its final data, and later changes of that data are left out; the tree's
// structure, which later changes refer to by index, is written as it was when the item was added, found by taking back
// the changes of the tree, the last first, on lists of ids.
#include "journal_bytes.hpp"

#include <jet/journal.hpp>

#include <algorithm>

namespace jet {

namespace {

// Journals on disk know these numbers: add, never change.
enum class Op : std::uint8_t {
    Add = 1,
    Remove,
    Move,
    SetPath,
    SetProperty,
    SetType,
    AddEffect,
    RemoveEffect,
    MoveEffect,
    SetEffect,
    SetScene,
    SetMaterials
};

template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

/// A change of the tree in the direction it was made.
struct TreeStep {
    Op op;  // Add, Remove or Move
    ItemId item;
    ItemId fromParent, toParent;
    std::size_t from = 0, to = 0;
    const Item* detached = nullptr;  // Remove: the subtree that was taken out
};

std::optional<TreeStep> treeStep(const Change& change, bool undone)
{
    const auto added = [](ItemId item, ItemId parent, std::size_t index) {
        return TreeStep{Op::Add, item, {}, parent, 0, index, nullptr};
    };
    const auto removed = [](ItemId item, ItemId parent, std::size_t index, const Item* subtree) {
        return TreeStep{Op::Remove, item, parent, {}, index, 0, subtree};
    };
    if (const auto* c = std::get_if<ItemAdded>(&change))
        return undone ? removed(c->item, c->parent, c->index, c->detached.get()) : added(c->item, c->parent, c->index);
    if (const auto* c = std::get_if<ItemRemoved>(&change))
        return undone ? added(c->item, c->parent, c->index) : removed(c->item, c->parent, c->index, c->detached.get());
    if (const auto* c = std::get_if<ItemMoved>(&change))
        return undone ? TreeStep{Op::Move, c->item, c->newParent, c->oldParent, c->newIndex, c->oldIndex, nullptr}
                      : TreeStep{Op::Move, c->item, c->oldParent, c->newParent, c->oldIndex, c->newIndex, nullptr};
    return std::nullopt;
}

/// What each added subtree looked like when it was added: its items in pre-order with their counts of children.
class AddedSubtrees {
public:
    using Subtree = std::vector<std::pair<const Item*, std::size_t>>;

    AddedSubtrees(const Scene& scene, const std::vector<TreeStep>& steps)
    {
        if (std::ranges::none_of(steps, [](const TreeStep& s) { return s.op == Op::Add; })) return;
        for (const TreeStep& step : steps) {
            const Item* subtree = step.detached ? step.detached : scene.items().find(step.item);
            if (!subtree || known_.contains(step.item.value)) continue;
            subtree->walk([this](const Item& item) { known_.emplace(item.id().value, &item); });
        }
        for (std::size_t i = steps.size(); i-- > 0;) takeBack(steps[i]);
    }

    /// Of the n-th Add.
    const Subtree& of(std::size_t n) const { return subtrees_[subtrees_.size() - 1 - n]; }

private:
    void takeBack(const TreeStep& step)
    {
        if (step.op == Op::Add) {
            subtrees_.emplace_back();
            collect(step.item, subtrees_.back());
        }
        if (step.op != Op::Remove) erase(step.toParent, step.item, step.to);
        if (step.op != Op::Add) insert(step.fromParent, step.item, step.from);
    }

    // The children of an item that may be new; null for one that was there before: its lists do not matter.
    std::vector<ItemId>* list(ItemId parent)
    {
        const auto item = known_.find(parent.value);
        if (item == known_.end()) return nullptr;
        const auto [found, isNew] = lists_.try_emplace(parent.value);
        if (isNew)
            for (const auto& child : item->second->children()) found->second.push_back(child->id());
        return &found->second;
    }
    void erase(ItemId parent, ItemId item, std::size_t index)
    {
        auto* children = list(parent);
        if (!children) return;
        if (index < children->size() && (*children)[index] == item) {
            children->erase(children->begin() + static_cast<std::ptrdiff_t>(index));
        } else {
            std::erase(*children, item);
        }
    }
    void insert(ItemId parent, ItemId item, std::size_t index)
    {
        if (auto* children = list(parent))
            children->insert(children->begin() + static_cast<std::ptrdiff_t>(std::min(index, children->size())), item);
    }
    void collect(ItemId id, Subtree& subtree)
    {
        const auto item = known_.find(id.value);
        if (item == known_.end()) return;
        if (const auto changed = lists_.find(id.value); changed != lists_.end()) {
            subtree.emplace_back(item->second, changed->second.size());
            for (const ItemId child : std::vector(changed->second)) collect(child, subtree);
        } else {
            collect(*item->second, subtree);
        }
    }
    void collect(const Item& item, Subtree& subtree)
    {
        subtree.emplace_back(&item, item.children().size());
        for (const auto& child : item.children()) collect(child->id(), subtree);
    }

    std::unordered_map<std::uint64_t, const Item*> known_;
    std::unordered_map<std::uint64_t, std::vector<ItemId>> lists_;
    std::vector<Subtree> subtrees_;  // the last Add first
};

class ChangeEncoder {
public:
    ChangeEncoder(const Scene& scene, std::span<const Change> changes, bool undone)
        : changes_(changes), undone_(undone), subtrees_(scene, treeSteps(changes, undone))
    {
    }

    std::string encode()
    {
        for (std::size_t i = 0; i < changes_.size(); ++i) encode(changes_[undone_ ? changes_.size() - 1 - i : i]);
        return out_.take();
    }

private:
    static std::vector<TreeStep> treeSteps(std::span<const Change> changes, bool undone)
    {
        std::vector<TreeStep> steps;
        for (const Change& change : changes)
            if (const auto step = treeStep(change, undone)) steps.push_back(*step);
        if (undone) std::ranges::reverse(steps);
        return steps;
    }

    void op(Op o) { out_.byte(static_cast<std::uint8_t>(o)); }
    const Value& pick(const Value& before, const Value& after) const { return undone_ ? before : after; }

    void encode(const Change& change)
    {
        if (const auto step = treeStep(change, undone_)) return encode(*step);
        const ItemId item = changedItem(change);
        if (item && added_.contains(item.value)) return;  // written with its final data when it was added
        std::visit(
            Overloaded{
                [](const ItemAdded&) {},
                [](const ItemRemoved&) {},
                [](const ItemMoved&) {},
                [&](const PathChanged& c) {
                    op(Op::SetPath), out_.number(c.item.value), out_.path(undone_ ? c.before : c.after);
                },
                [&](const PropertyChanged& c) {
                    op(Op::SetProperty), out_.number(c.item.value), out_.text(c.property);
                    out_.value(pick(c.before, c.after));
                },
                [&](const TypeChanged& c) {
                    op(Op::SetType), out_.number(c.item.value), out_.text(undone_ ? c.before : c.after);
                },
                [&](const EffectAdded& c) { effect(c.item, c.index, undone_ ? nullptr : &c.effect); },
                [&](const EffectRemoved& c) { effect(c.item, c.index, undone_ ? &c.effect : nullptr); },
                [&](const EffectMoved& c) {
                    op(Op::MoveEffect), out_.number(c.item.value);
                    out_.number(undone_ ? c.to : c.from), out_.number(undone_ ? c.from : c.to);
                },
                [&](const EffectPropertyChanged& c) {
                    op(Op::SetEffect), out_.number(c.item.value), out_.number(c.index), out_.text(c.property);
                    out_.value(pick(c.before, c.after));
                },
                [&](const ScenePropertyChanged& c) {
                    op(Op::SetScene), out_.text(c.property), out_.value(pick(c.before, c.after));
                },
                [&](const MaterialsChanged& c) { op(Op::SetMaterials), out_.materials(undone_ ? c.before : c.after); },
            },
            change);
    }

    void encode(const TreeStep& step)
    {
        op(step.op);
        out_.number(step.item.value);
        if (step.op == Op::Remove) return;
        out_.number(step.toParent.value), out_.number(step.to);
        if (step.op == Op::Move) return;
        const auto& subtree = subtrees_.of(addCount_++);
        out_.number(subtree.size());
        for (const auto& [item, children] : subtree) {
            added_.insert(item->id().value);
            out_.item(*item), out_.number(children);
        }
    }

    // Adds the effect; with null, removes the one at the index.
    void effect(ItemId item, std::size_t index, const EffectInstance* added)
    {
        op(added ? Op::AddEffect : Op::RemoveEffect);
        out_.number(item.value), out_.number(index);
        if (added) out_.effect(*added);
    }

    std::span<const Change> changes_;
    bool undone_;
    AddedSubtrees subtrees_;
    std::size_t addCount_ = 0;
    std::unordered_set<std::uint64_t> added_;
    ByteWriter out_;
};

}  // namespace

std::string encodeChanges(const Scene& scene, std::span<const Change> changes, ItemsChanged::Cause cause)
{
    return ChangeEncoder(scene, changes, cause == ItemsChanged::Cause::Undo).encode();
}

/// Makes encoded changes in a copy of a scene's content, without the scene's own machinery: no plugin is asked for
/// anything but whether it knows a type. Checks everything: the bytes may be of another state, or hostile.
class ChangeReplay {
public:
    explicit ChangeReplay(const Scene& scene)
        : catalog_(scene.catalog()), root_(kRootId, GroupItem::type), symbols_(kSymbolsId, GroupItem::type),
          settings_(scene.settings()), materials_(scene.materials())
    {
        byId_.emplace(kRootId.value, &root_);
        byId_.emplace(kSymbolsId.value, &symbols_);
        copyChildren(scene.root(), root_);
        copyChildren(*scene.items().find(kSymbolsId), symbols_);
    }

    void run(std::string_view bytes)
    {
        in_ = ByteReader(bytes);
        holders_.clear();
        while (!in_.atEnd()) step();
        checkHolders();
    }

    std::unique_ptr<Scene> scene(const Scene& like) const
    {
        auto made = std::make_unique<Scene>(like.name(), like.events(), like.catalog());
        SceneBuilder builder(*made);
        for (const auto& [id, value] : settings_.entries()) builder.setSetting(id, value);
        builder.setMaterials(materials_);
        build(symbols_, const_cast<Item&>(*made->items().find(kSymbolsId)), builder);
        build(root_, builder.root(), builder);
        return made;
    }

private:
    void copyChildren(const Item& from, Item& to)
    {
        for (const auto& child : from.children()) {
            auto copy = Item::Mutator::copyAlone(*child, child->id());
            byId_.emplace(copy->id().value, copy.get());
            copyChildren(*child, *copy);
            Item::Mutator::insert(to, to.children().size(), std::move(copy));
        }
    }
    static void build(const Item& from, Item& to, SceneBuilder& builder)
    {
        for (const auto& child : from.children()) {
            Item& item = builder.add(to, child->id(), child->type());
            builder.setName(item, child->name());
            builder.setFlags(item, child->visible(), child->locked());
            builder.setPath(item, child->path());
            builder.setProperties(item, child->properties());
            for (const EffectInstance& effect : child->effects()) builder.addEffect(item, effect);
            build(*child, item, builder);
        }
    }

    [[noreturn]] static void fail(const char* what) { ByteReader::fail(what); }

    void step()
    {
        switch (static_cast<Op>(in_.byte())) {
        case Op::Add: return add();
        case Op::Remove: return remove();
        case Op::Move: return move();
        case Op::SetPath: return setPath();
        case Op::SetProperty: return setProperty();
        case Op::SetType: return setType();
        case Op::AddEffect: return addEffect();
        case Op::RemoveEffect: return removeEffect();
        case Op::MoveEffect: return moveEffect();
        case Op::SetEffect: return setEffect();
        case Op::SetScene: return setScene();
        case Op::SetMaterials: materials_ = in_.materials(); return;
        }
        fail("it holds a kind of change this JET does not know; open it with a newer JET");
    }

    Item& item()
    {
        const auto found = byId_.find(in_.number());
        if (found == byId_.end()) fail("it changes an item that is not there");
        return *found->second;
    }
    Item& changeable()
    {
        Item& found = item();
        if (!found.parent()) fail("it changes the top group");
        return found;
    }
    // Whether an item may hold others is looked at in the end: one that was added stands here with its final type.
    Item& container()
    {
        Item& found = item();
        holders_.insert(found.id().value);
        return found;
    }
    void checkHolders()
    {
        for (const std::uint64_t id : holders_) {
            const auto found = byId_.find(id);
            if (found == byId_.end() || found->second->children().empty() || found->second->isContainer()) continue;
            if (itemTypeOf(catalog_, found->second->type())) fail("it puts an item into one that holds none");
        }
    }
    static std::size_t depthOf(const Item& item)
    {
        std::size_t depth = 0;
        for (const Item* up = item.parent(); up; up = up->parent()) ++depth;
        return depth;
    }
    static std::size_t heightOf(const Item& item)
    {
        std::size_t height = 0;
        for (const auto& child : item.children()) height = std::max(height, heightOf(*child) + 1);
        return height;
    }
    std::size_t index(std::size_t size)
    {
        const std::uint64_t n = in_.number();
        if (n > size) fail("it counts past the end of a list");
        return static_cast<std::size_t>(n);
    }

    void add()
    {
        const std::uint64_t id = in_.number();
        Item& parent = container();
        const std::size_t at = index(parent.children().size());
        std::size_t left = in_.count(4);
        std::unordered_set<std::uint64_t> ids;
        auto subtree = readSubtree(left, depthOf(parent) + 1, ids);
        if (left != 0 || subtree->id().value != id) fail("an added item is not what it says");
        subtree->walk([this](const Item& item) { byId_.emplace(item.id().value, const_cast<Item*>(&item)); });
        Item::Mutator::insert(parent, at, std::move(subtree));
    }

    std::unique_ptr<Item> readSubtree(std::size_t& left, std::size_t depth, std::unordered_set<std::uint64_t>& ids)
    {
        if (left == 0) fail("an added item is incomplete");
        if (depth > kMaximumDepth) fail("items are nested too deep in it");
        --left;
        auto item = in_.item();
        const std::uint64_t id = item->id().value;
        if (byId_.contains(id) || !ids.insert(id).second) fail("an item's number is taken");
        std::size_t children = in_.count();
        if (children > 0) holders_.insert(id);
        for (; children > 0; --children)
            Item::Mutator::insert(*item, item->children().size(), readSubtree(left, depth + 1, ids));
        return item;
    }

    std::unique_ptr<Item> take(const Item& item)
    {
        return Item::Mutator::take(*byId_.at(item.parent()->id().value), item.index());
    }

    void remove()
    {
        const auto gone = take(changeable());
        gone->walk([this](const Item& item) { byId_.erase(item.id().value); });
    }

    void move()
    {
        const Item& moved = changeable();
        Item& parent = container();
        if (&moved == &parent || moved.isAncestorOf(parent)) fail("it moves an item into itself");
        if (depthOf(parent) + 1 + heightOf(moved) > kMaximumDepth) fail("items are nested too deep in it");
        const std::size_t room = parent.children().size() - (moved.parent() == &parent ? 1 : 0);
        const std::size_t at = index(room);
        Item::Mutator::insert(parent, at, take(moved));
    }

    void setPath()
    {
        Item& changed = changeable();
        Item::Mutator::setPath(changed, in_.path());
    }

    void setProperty()
    {
        Item& changed = changeable();
        const std::string id = in_.storable();
        const Value value = in_.value();
        const bool flag = id == "visible" || id == "locked";
        if ((id == "name" && !value.get<std::string>()) || (flag && !value.get<bool>()))
            fail("a property has a value of another kind");
        Item::Mutator::setProperty(changed, id, value);
    }

    void setType()
    {
        Item& changed = changeable();
        holders_.insert(changed.id().value);
        Item::Mutator::setType(changed, in_.storable());
    }

    void addEffect()
    {
        Item& changed = changeable();
        const auto at = static_cast<std::ptrdiff_t>(index(changed.effects().size()));
        auto& effects = Item::Mutator::effects(changed);
        effects.insert(effects.begin() + at, in_.effect());
    }

    std::size_t effectIndex(const Item& item)
    {
        if (item.effects().empty()) fail("it changes an effect that is not there");
        return index(item.effects().size() - 1);
    }

    void removeEffect()
    {
        Item& changed = changeable();
        const auto at = static_cast<std::ptrdiff_t>(effectIndex(changed));
        auto& effects = Item::Mutator::effects(changed);
        effects.erase(effects.begin() + at);
    }

    void moveEffect()
    {
        Item& changed = changeable();
        const std::size_t from = effectIndex(changed), to = effectIndex(changed);
        auto& effects = Item::Mutator::effects(changed);
        EffectInstance moved = std::move(effects[from]);
        effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(from));
        effects.insert(effects.begin() + static_cast<std::ptrdiff_t>(to), std::move(moved));
    }

    void setEffect()
    {
        Item& changed = changeable();
        EffectInstance& effect = Item::Mutator::effects(changed)[effectIndex(changed)];
        const std::string id = in_.storable();
        const Value value = in_.value();
        if (id == "visible") {
            if (!value.get<bool>()) fail("a property has a value of another kind");
            effect.visible = *value.get<bool>();
        } else {
            set(effect.properties, id, value);
        }
    }

    static void set(Properties& properties, const std::string& id, const Value& value)
    {
        if (value.isNone()) {
            properties.erase(id);
        } else {
            properties.set(id, value);
        }
    }

    void setScene()
    {
        const std::string id = in_.storable();
        const Value value = in_.value();
        const PropertySpec* spec = Scene::settingsTable().find(id);
        if (spec && !value.isNone() && !spec->check(value)) fail("a setting of the scene has a value it cannot have");
        set(settings_, id, value);
    }

    Catalog& catalog_;
    Item root_, symbols_;
    Properties settings_;
    MaterialTable materials_;
    std::unordered_map<std::uint64_t, Item*> byId_;
    ByteReader in_{{}};
    std::unordered_set<std::uint64_t> holders_;  // items that were given children, or another type
};

namespace {

/// Makes the first `count` records; false, and the reason, where one cannot be made.
bool replay(ChangeReplay& replay, std::span<const std::string_view> records, ReplayedScene& result)
{
    for (result.records = 0; result.records < records.size(); ++result.records) {
        try {
            replay.run(records[result.records]);
        } catch (const Failure& failure) {
            result.problem = failure.error();
            return false;
        }
    }
    return true;
}

}  // namespace

ReplayedScene replayChanges(const Scene& scene, std::span<const std::string_view> records)
{
    ReplayedScene result;
    ChangeReplay first(scene);
    if (replay(first, records, result)) {
        result.scene = first.scene(scene);
        return result;
    }
    // Half a record was made: once more, without it.
    ChangeReplay second(scene);
    replay(second, records.first(result.records), result);
    result.scene = second.scene(scene);
    return result;
}

}  // namespace jet
