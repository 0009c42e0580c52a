// ctx.colTab[a.body.cti][b.body.cti] (SPEC PH12): true while the two touch. A body's index in the table is its handle.
//
// The rows are Proxies that ask the physics engine (see prelude.js). A table filled after each step would be read a
// little faster, but cost every step as much as it has contacts.
#include "bindings.hpp"
#include "native.hpp"
#include "text.hpp"

#include <jet/simulation.hpp>

#include <charconv>
#include <optional>

namespace jet::duktape {

namespace {

// A body's handle from a number or its text; kNoHandle for a number that is no body's. None for what is no number at
// all.
std::optional<BodyHandle> handleAt(const Native& call, duk_idx_t index)
{
    double value = 0;
    if (duk_is_number(call.ctx, index)) {
        value = duk_get_number(call.ctx, index);
    } else {
        const std::string text = stringAt(call.ctx, index);
        const char* end = text.data() + text.size();
        if (text.empty() || std::from_chars(text.data(), end, value).ptr != end) return {};
    }
    const bool exists = value >= 0 && value < static_cast<double>(call.play.simulation.world().bodyCount());
    return exists ? static_cast<BodyHandle>(value) : kNoHandle;
}

// The trap "get" of a row: (target { cti }, key, receiver). A body that does not exist touches nothing.
duk_ret_t touching(Native& call)
{
    const std::optional<BodyHandle> b = handleAt(call, 1);
    if (!b) {  // toString and the like; undefined for the cti of an item without a body
        duk_dup(call.ctx, 1);
        return duk_get_prop(call.ctx, 0), 1;
    }
    duk_get_prop_literal(call.ctx, 0, "cti");
    const BodyHandle a = handleAt(call, -1).value_or(kNoHandle);
    return call.give(a != kNoHandle && *b != kNoHandle && a != *b && call.play.simulation.world().touching(a, *b));
}

}  // namespace

void bindColliding(duk_context* ctx, duk_idx_t kit)
{
    duk_dup(ctx, kit);
    method<touching>(ctx, "touching", 3);
    duk_pop(ctx);
}

}  // namespace jet::duktape
