#include "runtime.hpp"

#include "text.hpp"

#include <jet/simulation.hpp>

#include <optional>

namespace jet::duktape {

namespace {

void setScriptGlobal(duk_context* ctx, Play& play, const Item& script)
{
    play.items.push(ctx, &script);
    duk_put_global_literal(ctx, "script");
}

struct Run {
    Play& play;
    const Item& script;
    const std::string& code;
};

duk_ret_t runProtected(duk_context* ctx, void* udata)
{
    const auto& run = *static_cast<Run*>(udata);
    setScriptGlobal(ctx, run.play, run.script);
    const std::string file = cesu8FromUtf8(run.play.files.add(run.script));
    duk_push_lstring(ctx, file.data(), file.size());
    duk_compile_lstring_filename(ctx, 0, run.code.data(), run.code.size());
    duk_call(ctx, 0);
    return 1;
}

struct Call {
    Play& play;
    void* function;
    const Item* script;  ///< null: the global `script` is right already
};

duk_ret_t callProtected(duk_context* ctx, void* udata)  // [... event]
{
    const auto& call = *static_cast<Call*>(udata);
    if (call.script) setScriptGlobal(ctx, call.play, *call.script);
    duk_push_heapptr(ctx, call.function);
    duk_dup(ctx, -2);
    duk_call(ctx, 1);
    return 1;
}

duk_ret_t pushEventProtected(duk_context* ctx, void* udata)
{
    pushEvent(ctx, *static_cast<const ScriptEvent*>(udata));
    return 1;
}

}  // namespace

Runtime::Runtime(Simulation& simulation, const Limits& limits) : play_(simulation, limits), heap_(play_) {}

Result<void> Runtime::run(const Item& script)
{
    const std::optional<Value> property = script.property("code");
    const std::string* code = property ? property->get<std::string>() : nullptr;
    if (!code) return {};

    duk_context* ctx = heap_.context();
    Run run{play_, script, *code};
    play_.script = script.id();
    play_.budget.begin(play_.budget.limits().call);
    const duk_int_t result = duk_safe_call(ctx, runProtected, &run, 0, 1);
    play_.budget.end();
    if (result == DUK_EXEC_SUCCESS) {
        duk_pop(ctx);
        return {};
    }
    Fault fault = takeFault(ctx, play_);
    if (!fault.place.script) fault.place.script = script.id();
    return Error(prefixed(fault.place, play_.simulation.scene(), "error", fault.text),
                 {script.name(), fault.place.line, 0});
}

void Runtime::dispatch(const ScriptEvent& event)
{
    // A listener cannot cause an event while it runs, except through a host that steps from its output handler.
    if (!play_.listeners.any(event.kind) || play_.budget.isRunning()) return;
    duk_context* ctx = heap_.context();
    ScriptEvent copy = event;
    play_.budget.begin(play_.budget.limits().call);
    const duk_int_t result = duk_safe_call(ctx, pushEventProtected, &copy, 0, 1);
    play_.budget.end();
    if (result != DUK_EXEC_SUCCESS) {
        report(takeFault(ctx, play_), "an event was lost");
        play_.budget.growMemoryLimit();
        return;
    }
    const std::size_t count =
        play_.listeners.of(event.kind).size();  // those added meanwhile hear from the next event on
    for (std::size_t i = 0; i < count; ++i)
        if (!play_.listeners.of(event.kind)[i].removed) callListener(event.kind, i);
    duk_pop(ctx);
    play_.listeners.sweep(ctx);
}

void Runtime::callListener(ScriptEventKind kind, std::size_t index)  // [event] -> [event]
{
    duk_context* ctx = heap_.context();
    Call call{play_, nullptr, nullptr};
    {
        const Listener& listener = play_.listeners.of(kind)[index];
        call.function = listener.function;
        if (listener.script != play_.script) call.script = play_.simulation.scene().items().find(listener.script);
        play_.script = listener.script;
    }
    const auto before = static_cast<std::int64_t>(play_.budget.memoryUsed());
    duk_dup(ctx, -1);
    play_.budget.begin(play_.budget.limits().call);
    const duk_int_t result = duk_safe_call(ctx, callProtected, &call, 1, 1);
    play_.budget.end();
    play_.listeners.of(kind)[index].growth += static_cast<std::int64_t>(play_.budget.memoryUsed()) - before;
    if (result == DUK_EXEC_SUCCESS) {
        duk_pop(ctx);
    } else {
        stopListener(kind, index);
    }
}

// [event error] -> [event]
void Runtime::stopListener(ScriptEventKind kind, std::size_t index)
{
    duk_context* ctx = heap_.context();
    const bool outOfMemory = play_.budget.outOfMemory();
    Fault fault = takeFault(ctx, play_);
    Listener* culprit = &play_.listeners.of(kind)[index];
    if (outOfMemory) {
        // The one that asked for the last byte may not be the one that took them all.
        Listener* greediest = play_.listeners.greediest();
        if (greediest && greediest->growth > 4 * std::max<std::int64_t>(culprit->growth, 0)) {
            culprit = greediest;
            fault.place = {greediest->script, 0};
        }
    }
    if (!fault.place.script) fault.place.script = culprit->script;
    const std::string name = eventName(play_.listeners.kindOf(*culprit));
    play_.listeners.remove(*culprit);
    report(fault, "its " + name + " listener was removed");
    if (outOfMemory) {
        collectGarbage();
        play_.budget.growMemoryLimit();
    }
}

void Runtime::report(const Fault& fault, std::string_view consequence)
{
    std::string text = prefixed(fault.place, play_.simulation.scene(), "error", fault.text);
    text.append("; ").append(consequence);
    play_.simulation.print({OutputLine::Kind::Error, std::move(text), fault.place.script, fault.place.line});
}

void Runtime::collectGarbage() { duk_gc(heap_.context(), 0); }

}  // namespace jet::duktape
