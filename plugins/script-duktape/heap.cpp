#include "heap.hpp"

#include "bindings.hpp"
#include "play.hpp"
#include "text.hpp"

#include <jet/result.hpp>

#include <prelude.hpp>

namespace jet::duktape {

namespace {

void* allocate(void* udata, duk_size_t size) { return Budget::of(udata).allocate(size); }
void* reallocate(void* udata, void* block, duk_size_t size) { return Budget::of(udata).reallocate(block, size); }
void release(void* udata, void* block) { Budget::of(udata).release(block); }

// Every use of the heap is inside a protected call: only a bug of ours leads here.
[[noreturn]] void fatal(void*, const char* message)
{
    throw Failure(Error(std::string("the script engine failed: ") + message));
}

// Functions of the API and prototypes with their accessors, by the names prelude.js finds them under.
void pushKit(duk_context* ctx)
{
    const duk_idx_t kit = duk_push_object(ctx);
    duk_push_global_object(ctx);
    duk_put_prop_literal(ctx, kit, "global");
    for (const char* prototype :
         {"Item", "Body", "Torque", "Spring", "Force", "Joint", "View", "Position", "Velocity", "Gravity", "ctx"}) {
        duk_push_object(ctx);
        duk_put_prop_string(ctx, kit, prototype);
    }
    bindOutput(ctx, kit);
    bindKeyboard(ctx, kit);
    bindView(ctx, kit);
    bindContext(ctx, kit);
    bindColliding(ctx, kit);
    bindQueries(ctx, kit);
    bindEvents(ctx, kit);
    bindItems(ctx, kit);
    bindBodies(ctx, kit);
    bindVectors(ctx, kit);
    bindActuators(ctx, kit);
    bindJoints(ctx, kit);
}

void keepPrototypes(duk_context* ctx, Play& play, duk_idx_t kit)
{
    const auto kept = [&](const char* name) {
        duk_get_prop_string(ctx, kit, name);
        return play.keep(ctx);
    };
    Prototypes& p = play.prototypes;
    p.vector = kept("Vec2d");
    p.position = kept("Position");
    p.velocity = kept("Velocity");
    p.gravity = kept("Gravity");
    p.area = kept("BoundingArea");
    p.item = kept("Item");
    p.body = kept("Body");
    p.torque = kept("Torque");
    p.spring = kept("Spring");
    p.force = kept("Force");
    p.joint = kept("Joint");
}

duk_ret_t setUp(duk_context* ctx, void* udata)
{
    Play& play = *static_cast<Play*>(udata);
    duk_push_heap_stash(ctx);
    duk_push_array(ctx);
    duk_put_prop_literal(ctx, -2, "kept");
    duk_pop(ctx);

    duk_eval_string(ctx, "Object.getOwnPropertyDescriptor(Error.prototype, 'stack').get");
    play.prototypes.tracebackGetter = play.keep(ctx);
    watchThrows(ctx);  // through the global Duktape, which the prelude deletes

    duk_push_string(ctx, "prelude.js");
    duk_compile_lstring_filename(ctx, DUK_COMPILE_EVAL, kPrelude, sizeof kPrelude - 1);
    duk_call(ctx, 0);
    pushKit(ctx);
    const duk_idx_t kit = duk_get_top_index(ctx);
    duk_dup(ctx, -2);
    duk_dup(ctx, kit);
    duk_call(ctx, 1);
    keepPrototypes(ctx, play, kit);
    duk_require_stack(ctx, 64);  // pushing a function and its event must not need memory
    return 0;
}

}  // namespace

Heap::Heap(Play& play) : ctx_(duk_create_heap(allocate, reallocate, release, play.budget.heapData(), fatal))
{
    if (!ctx_) throw Failure(Error("there is not enough memory to start the scripts"));
    if (duk_safe_call(ctx_, setUp, &play, 0, 1) != DUK_EXEC_SUCCESS) {
        const std::string reason = duk_safe_to_string(ctx_, -1);
        duk_destroy_heap(ctx_);
        throw Failure(Error("the script API could not be set up: " + reason));
    }
    duk_pop(ctx_);
}

Heap::~Heap() { duk_destroy_heap(ctx_); }

}  // namespace jet::duktape
