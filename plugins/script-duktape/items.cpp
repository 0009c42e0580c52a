#include "items.hpp"

#include "item_values.hpp"
#include "native.hpp"
#include "text.hpp"

#include <jet/simulation.hpp>

#include <cmath>

namespace jet::duktape {

ItemSlot& ItemTable::slot(duk_context* ctx, const Item& item)
{
    const auto [found, isNew] = byId_.try_emplace(item.id().value, slots_.size());
    if (isNew) {
        slots_.push_back({});
        slots_.back().item = &item;
        slots_.back().body = simulation_.bodyOf(item.id());
        slots_.back().joint = simulation_.jointOf(item.id());
    }
    ItemSlot& slot = slots_[found->second];
    if (slot.object) return slot;

    // The object of the item, with body, torque, spring, force and joint as fixed properties where it has them.
    Play& play = Play::of(ctx);
    const auto begin = [&](void* prototype, const char* hiddenKey) {
        duk_push_object(ctx);
        duk_push_heapptr(ctx, prototype);
        duk_set_prototype(ctx, -2);
        duk_push_uint(ctx, static_cast<duk_uint_t>(found->second));
        duk_put_prop_string(ctx, -2, hiddenKey);
    };
    const auto define = [&](const char* name) {  // [... object value] -> [... object]
        duk_push_string(ctx, name);
        duk_insert(ctx, -2);
        duk_def_prop(ctx, -3, DUK_DEFPROP_HAVE_VALUE | DUK_DEFPROP_SET_ENUMERABLE);
    };
    const auto part = [&](const char* name, void* prototype, const char* hiddenKey) {
        begin(prototype, hiddenKey);
        duk_dup(ctx, -2);
        define("item");
        duk_dup(ctx, -1);
        void* object = play.keep(ctx);
        define(name);
        return object;
    };
    begin(play.prototypes.item, DUK_HIDDEN_SYMBOL("item"));
    if (slot.body != kNoHandle) {
        slot.bodyObject = part("body", play.prototypes.body, DUK_HIDDEN_SYMBOL("body"));
        duk_push_heapptr(ctx, slot.bodyObject);
        duk_push_uint(ctx, slot.body);
        define("cti");
        duk_pop(ctx);
    }
    if (item.is<TorqueItem>()) part("torque", play.prototypes.torque, DUK_HIDDEN_SYMBOL("torque"));
    if (item.is<SpringItem>() || item.is<RSpringItem>())
        part("spring", play.prototypes.spring, DUK_HIDDEN_SYMBOL("spring"));
    if (simulation_.forceOf(item.id()) != kNoHandle) part("force", play.prototypes.force, DUK_HIDDEN_SYMBOL("force"));
    if (slot.joint != kNoHandle) part("joint", play.prototypes.joint, DUK_HIDDEN_SYMBOL("joint"));
    slot.object = play.keep(ctx);
    return slot;
}

void ItemTable::push(duk_context* ctx, const Item* item)
{
    if (item) {
        duk_push_heapptr(ctx, slot(ctx, *item).object);
    } else {
        duk_push_null(ctx);
    }
}

void ItemTable::pushBody(duk_context* ctx, const Item* item)
{
    void* body = item ? slot(ctx, *item).bodyObject : nullptr;
    if (body) {
        duk_push_heapptr(ctx, body);
    } else {
        duk_push_null(ctx);
    }
}

const ItemSlot* ItemTable::slotOf(duk_context* ctx, duk_idx_t index, const char* hiddenKey) const
{
    if (!duk_is_object(ctx, index)) return nullptr;
    duk_get_prop_string(ctx, index, hiddenKey);
    const std::size_t slot = duk_get_uint_default(ctx, -1, UINT32_MAX);
    duk_pop(ctx);
    return slot < slots_.size() ? &slots_[slot] : nullptr;
}

void ItemTable::pushLive(duk_context* ctx, const ItemSlot& slot, bool velocity)
{
    const std::size_t index = static_cast<std::size_t>(&slot - slots_.data());
    void*& object = velocity ? slots_[index].velocity : slots_[index].position;
    if (!object) {
        Play& play = Play::of(ctx);
        duk_push_object(ctx);
        duk_push_heapptr(ctx, velocity ? play.prototypes.velocity : play.prototypes.position);
        duk_set_prototype(ctx, -2);
        duk_push_uint(ctx, static_cast<duk_uint_t>(index));
        duk_put_prop_literal(ctx, -2, DUK_HIDDEN_SYMBOL("vector"));
        object = play.keep(ctx);
    }
    duk_push_heapptr(ctx, object);
}

namespace {

const Item& self(Native& call) { return *call.self(DUK_HIDDEN_SYMBOL("item"), "an item").item; }

duk_ret_t name(Native& call) { return pushText(call.ctx, self(call).name()), 1; }
duk_ret_t id(Native& call) { return call.give(static_cast<double>(self(call).id().value)); }
duk_ret_t type(Native& call) { return pushText(call.ctx, self(call).type()), 1; }
duk_ret_t visible(Native& call) { return call.give(self(call).visible()); }
duk_ret_t locked(Native& call) { return call.give(self(call).locked()); }
duk_ret_t parent(Native& call) { return call.give(self(call).parent()); }
duk_ret_t sibling(Native& call) { return call.give(self(call).sibling()); }
duk_ret_t priorSibling(Native& call) { return call.give(self(call).priorSibling()); }

duk_ret_t setName(Native& call)
{
    const Item& item = self(call);
    call.play.simulation.setItemProperty(item.id(), "name", Value(call.text(0)));
    return 0;
}

duk_ret_t setVisible(Native& call)
{
    const Item& item = self(call);
    call.play.simulation.setItemProperty(item.id(), "visible", Value(call.boolean(0)));
    return 0;
}

duk_ret_t setParent(Native&) { throw Complaint{"the tree of items cannot change while playing"}; }
duk_ret_t setFixed(Native&) { throw Complaint{"this cannot change while playing"}; }

duk_ret_t childList(Native& call)
{
    const Item& item = self(call);
    const duk_idx_t list = duk_push_array(call.ctx);
    duk_uarridx_t index = 0;
    for (const auto& child : item.children()) {
        call.play.items.push(call.ctx, child.get());
        duk_put_prop_index(call.ctx, list, index++);
    }
    return 1;
}

// Of a body where it is now, else of the drawn path and all below it.
duk_ret_t boundingArea(Native& call)
{
    const ItemSlot& slot = call.self(DUK_HIDDEN_SYMBOL("item"), "an item");
    Play& play = call.play;
    play.pushArea(call.ctx,
                  slot.body != kNoHandle ? play.simulation.world().bodies().bounds[slot.body] : slot.item->bounds());
    return 1;
}

duk_ret_t has(Native& call) { return call.give(hasProperty(call, self(call), call.text(0))); }

duk_ret_t get(Native& call)
{
    pushProperty(call, self(call), call.text(0));
    return 1;
}

duk_ret_t set(Native& call)
{
    const Item& item = self(call);
    const std::string property = call.text(0);
    call.play.simulation.setItemProperty(item.id(), property, propertyFrom(call, item, property, 1));
    return 0;
}

// --- ItemUtils

duk_ret_t getTopGroup(Native& call) { return call.give(&topGroup(call.item(0))); }
duk_ret_t getItemByName(Native& call) { return call.give(findByName(call.item(1), call.text(0))); }
duk_ret_t getClosestItemByName(Native& call) { return call.give(findClosestByName(call.item(1), call.text(0))); }

}  // namespace

void bindItems(duk_context* ctx, duk_idx_t kit)
{
    duk_get_prop_string(ctx, kit, "Item");
    accessor<name, setName>(ctx, "name");
    accessor<id, setFixed>(ctx, "id");
    accessor<type, setFixed>(ctx, "type");
    accessor<visible, setVisible>(ctx, "visible");
    accessor<locked, setFixed>(ctx, "locked");
    accessor<parent, setParent>(ctx, "parent");
    method<sibling>(ctx, "getSibling", 0);
    method<priorSibling>(ctx, "getPriorSibling", 0);
    method<childList>(ctx, "getChildList", 0);
    method<boundingArea>(ctx, "getBoundingArea", 0);
    method<has>(ctx, "has", 1);
    method<get>(ctx, "get", 1);
    method<set>(ctx, "set", 2);
    duk_pop(ctx);

    duk_dup(ctx, kit);
    method<getTopGroup>(ctx, "getTopGroup", 1);
    method<getItemByName>(ctx, "getItemByName", 2);
    method<getClosestItemByName>(ctx, "getClosestItemByName", 2);
    duk_pop(ctx);
}

}  // namespace jet::duktape
