// Functions in C++ that scripts call. One is written as `duk_ret_t fn(Native& call)` and may throw: Complaint and
// jet::Failure become JavaScript errors that start with the function's name; what it holds is unwound.
#pragma once

#include "play.hpp"

#include <jet/geometry.hpp>
#include <jet/item.hpp>

#include <duktape.h>

#include <string>

namespace jet::duktape {

/// Thrown by a native function about its arguments.
struct Complaint {
    std::string text;
    duk_errcode_t kind = DUK_ERR_TYPE_ERROR;
};

/// One call: its arguments, checked, and what leads from it to the game.
class Native {
public:
    explicit Native(duk_context* context) : ctx(context), play(Play::of(context)) {}

    /// The argument as a finite number.
    double number(duk_idx_t index) const;
    bool boolean(duk_idx_t index) const;
    /// The argument as text, as String(value) gives it.
    std::string text(duk_idx_t index) const;
    /// The argument as { x, y }, or it and the next as two numbers; finite.
    Vec2 vector(duk_idx_t index) const;
    const Item& item(duk_idx_t index) const;
    /// The slot kept in `this` under a hidden key: of an item ("item"), of a body ("body"), ...
    const ItemSlot& self(const char* hiddenKey, const char* what) const;

    /// What an argument is, for messages: `undefined`, `"abc"`, `an object`.
    std::string describe(duk_idx_t index) const;

    duk_ret_t give(double value) const { return duk_push_number(ctx, value), 1; }
    duk_ret_t give(bool value) const { return duk_push_boolean(ctx, value), 1; }
    duk_ret_t give(const Item* item) const { return play.items.push(ctx, item), 1; }
    duk_ret_t give(const Vec2& vector) const { return play.pushVector(ctx, vector), 1; }

    duk_context* const ctx;
    Play& play;
};

using NativeFunction = duk_ret_t (*)(Native&);

namespace detail {
duk_ret_t guard(duk_context* ctx, NativeFunction function);
template <NativeFunction F>
duk_ret_t entry(duk_context* ctx)
{
    return guard(ctx, F);
}
void defineMethod(duk_context* ctx, const char* name, duk_c_function function, duk_idx_t arguments);
void defineAccessor(duk_context* ctx, const char* name, duk_c_function get, duk_c_function set, int magic);
}  // namespace detail

// Add to the object on top of the stack. Not enumerable, as methods of built-in classes are not; accessors are.
template <NativeFunction F>
void method(duk_context* ctx, const char* name, duk_idx_t arguments)
{
    detail::defineMethod(ctx, name, &detail::entry<F>, arguments);
}
template <NativeFunction Get>
void accessor(duk_context* ctx, const char* name)
{
    detail::defineAccessor(ctx, name, &detail::entry<Get>, nullptr, 0);
}
/// `magic` tells apart accessors that share functions: duk_get_current_magic().
template <NativeFunction Get, NativeFunction Set>
void accessor(duk_context* ctx, const char* name, int magic = 0)
{
    detail::defineAccessor(ctx, name, &detail::entry<Get>, &detail::entry<Set>, magic);
}

}  // namespace jet::duktape
