#include "listeners.hpp"

#include "native.hpp"
#include "text.hpp"

#include <jet/simulation.hpp>

#include <algorithm>

namespace jet::duktape {

namespace {

// The object in the stash that keeps the functions alive, by key.
void pushKept(duk_context* ctx)
{
    duk_push_heap_stash(ctx);
    duk_get_prop_literal(ctx, -1, "listeners");
    duk_remove(ctx, -2);
}

}  // namespace

const char* eventName(ScriptEventKind kind)
{
    for (const EventName& event : kEventNames)
        if (event.kind == kind) return event.name;
    return "";
}

std::optional<ScriptEventKind> eventKind(std::string_view name)
{
    for (const EventName& event : kEventNames)
        if (event.name == name) return event.kind;
    return {};
}

void ListenerTable::add(duk_context* ctx, ScriptEventKind kind, duk_idx_t index, ItemId script)
{
    void* function = duk_get_heapptr(ctx, index);
    for (const Listener& listener : of(kind))
        if (!listener.removed && listener.function == function) return;
    Listener listener;
    listener.key = nextKey_++;
    listener.function = function;
    listener.script = script;
    index = duk_require_normalize_index(ctx, index);
    pushKept(ctx);
    duk_dup(ctx, index);
    duk_put_prop_index(ctx, -2, listener.key);
    duk_pop(ctx);
    of(kind).push_back(listener);
    ++alive_[static_cast<std::size_t>(kind)];
}

void ListenerTable::remove(duk_context*, ScriptEventKind kind, void* function)
{
    for (Listener& listener : of(kind))
        if (!listener.removed && listener.function == function) return remove(listener);
}

void ListenerTable::remove(Listener& listener)
{
    if (listener.removed) return;
    listener.removed = true;
    dirty_ = true;
    --alive_[static_cast<std::size_t>(kindOf(listener))];
}

void ListenerTable::sweep(duk_context* ctx)
{
    if (!dirty_) return;
    dirty_ = false;
    pushKept(ctx);
    for (auto& list : lists_) {
        for (const Listener& listener : list)
            if (listener.removed) duk_del_prop_index(ctx, -1, listener.key);
        std::erase_if(list, [](const Listener& listener) { return listener.removed; });
    }
    duk_pop(ctx);
}

Listener* ListenerTable::greediest()
{
    Listener* most = nullptr;
    for (auto& list : lists_)
        for (Listener& listener : list)
            if (!listener.removed && (!most || listener.growth > most->growth)) most = &listener;
    return most;
}

ScriptEventKind ListenerTable::kindOf(const Listener& listener) const
{
    for (const EventName& event : kEventNames) {
        const auto& list = lists_[static_cast<std::size_t>(event.kind)];
        if (!list.empty() && &listener >= list.data() && &listener < list.data() + list.size()) return event.kind;
    }
    return ScriptEventKind::Step;
}

namespace {

ScriptEventKind kindArgument(const Native& call)
{
    if (const auto kind = eventKind(stringAt(call.ctx, 0))) return *kind;
    std::string known;
    for (const EventName& event : kEventNames) known += (known.empty() ? "" : ", ") + std::string(event.name);
    throw Complaint{"no event is called " + call.describe(0) + "; there are " + known};
}

duk_ret_t addEventListener(Native& call)
{
    const ScriptEventKind kind = kindArgument(call);
    if (!duk_is_function(call.ctx, 1)) throw Complaint{"expected a function, got " + call.describe(1)};
    const std::size_t most = call.play.budget.limits().listenersPerEvent;
    if (call.play.listeners.count(kind) >= most)
        throw Complaint{"there are " + std::to_string(most) + ' ' + eventName(kind) + " listeners already",
                        DUK_ERR_RANGE_ERROR};
    call.play.listeners.add(call.ctx, kind, 1, call.play.script);
    return 0;
}

duk_ret_t removeEventListener(Native& call)
{
    const ScriptEventKind kind = kindArgument(call);
    if (duk_is_function(call.ctx, 1)) call.play.listeners.remove(call.ctx, kind, duk_get_heapptr(call.ctx, 1));
    return 0;
}

duk_ret_t playScene(Native& call) { return call.play.simulation.requestScene(call.text(0)), 0; }

}  // namespace

void bindEvents(duk_context* ctx, duk_idx_t kit)
{
    duk_push_heap_stash(ctx);
    duk_push_bare_object(ctx);
    duk_put_prop_literal(ctx, -2, "listeners");
    duk_pop(ctx);

    duk_dup(ctx, kit);
    method<addEventListener>(ctx, "addEventListener", 2);
    method<removeEventListener>(ctx, "removeEventListener", 2);
    method<playScene>(ctx, "playScene", 1);
    duk_pop(ctx);
}

}  // namespace jet::duktape
