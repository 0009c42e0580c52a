#include "native.hpp"

#include "text.hpp"

#include <jet/result.hpp>

#include <cmath>
#include <exception>

namespace jet::duktape {

double Native::number(duk_idx_t index) const
{
    if (!duk_is_number(ctx, index) || !std::isfinite(duk_get_number(ctx, index)))
        throw Complaint{"expected a finite number, got " + describe(index)};
    return duk_get_number(ctx, index);
}

bool Native::boolean(duk_idx_t index) const
{
    if (!duk_is_boolean(ctx, index)) throw Complaint{"expected true or false, got " + describe(index)};
    return duk_get_boolean(ctx, index) != 0;
}

std::string Native::text(duk_idx_t index) const { return textAt(ctx, index); }

Vec2 Native::vector(duk_idx_t index) const
{
    if (!duk_is_object(ctx, index)) return {number(index), number(index + 1)};
    duk_get_prop_string(ctx, index, "x");
    duk_get_prop_string(ctx, index, "y");
    const Vec2 v(number(-2), number(-1));
    duk_pop_2(ctx);
    return v;
}

const Item& Native::item(duk_idx_t index) const
{
    const ItemSlot* slot = play.items.slotOf(ctx, index, DUK_HIDDEN_SYMBOL("item"));
    if (!slot) throw Complaint{"expected an item, got " + describe(index)};
    return *slot->item;
}

const ItemSlot& Native::self(const char* hiddenKey, const char* what) const
{
    duk_push_this(ctx);
    const ItemSlot* slot = play.items.slotOf(ctx, -1, hiddenKey);
    duk_pop(ctx);
    if (!slot) throw Complaint{std::string("must be called on ") + what};
    return *slot;
}

std::string Native::describe(duk_idx_t index) const
{
    switch (duk_get_type(ctx, index)) {
    case DUK_TYPE_NONE: return "nothing";
    case DUK_TYPE_UNDEFINED: return "undefined";
    case DUK_TYPE_NULL: return "null";
    case DUK_TYPE_BOOLEAN: return duk_get_boolean(ctx, index) ? "true" : "false";
    case DUK_TYPE_NUMBER: return textAt(ctx, index);
    case DUK_TYPE_STRING: return '"' + shortened(stringAt(ctx, index), 40) + '"';
    default: return duk_is_function(ctx, index) ? "a function" : "an object";
    }
}

namespace detail {

duk_ret_t guard(duk_context* ctx, NativeFunction function)
{
    duk_errcode_t kind = DUK_ERR_TYPE_ERROR;
    std::string message;
    try {
        Native call(ctx);
        return function(call);
    } catch (const Complaint& complaint) {
        kind = complaint.kind, message = complaint.text;
    } catch (const Failure& failure) {
        message = failure.error().message;
    } catch (const std::exception& exception) {  // duk_internal_exception is none: an error of a script passes through
        kind = DUK_ERR_ERROR, message = exception.what();
    }
    duk_push_current_function(ctx);
    duk_get_prop_string(ctx, -1, "name");
    message = stringAt(ctx, -1) + ": " + message;
    return duk_error(ctx, kind, "%s", cesu8FromUtf8(message).c_str());
}

namespace {

void pushFunction(duk_context* ctx, const char* name, duk_c_function function, duk_idx_t arguments)
{
    duk_push_c_function(ctx, function, arguments);
    duk_push_string(ctx, "name");
    duk_push_string(ctx, name);
    duk_def_prop(ctx, -3, DUK_DEFPROP_HAVE_VALUE | DUK_DEFPROP_SET_CONFIGURABLE);
}

}  // namespace

void defineMethod(duk_context* ctx, const char* name, duk_c_function function, duk_idx_t arguments)
{
    duk_push_string(ctx, name);
    pushFunction(ctx, name, function, arguments);
    duk_def_prop(ctx, -3,
                 DUK_DEFPROP_HAVE_VALUE | DUK_DEFPROP_SET_WRITABLE | DUK_DEFPROP_SET_CONFIGURABLE |
                     DUK_DEFPROP_CLEAR_ENUMERABLE);
}

void defineAccessor(duk_context* ctx, const char* name, duk_c_function get, duk_c_function set, int magic)
{
    const duk_idx_t object = duk_get_top_index(ctx);
    duk_uint_t flags = DUK_DEFPROP_HAVE_GETTER | DUK_DEFPROP_SET_ENUMERABLE | DUK_DEFPROP_SET_CONFIGURABLE;
    duk_push_string(ctx, name);
    pushFunction(ctx, name, get, 0);
    duk_set_magic(ctx, -1, magic);
    if (set) {
        pushFunction(ctx, name, set, 1);
        duk_set_magic(ctx, -1, magic);
        flags |= DUK_DEFPROP_HAVE_SETTER;
    }
    duk_def_prop(ctx, object, flags);
}

}  // namespace detail

}  // namespace jet::duktape
