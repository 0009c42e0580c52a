// What scripts print.
#include "bindings.hpp"
#include "native.hpp"
#include "text.hpp"

#include <jet/simulation.hpp>

namespace jet::duktape {

namespace {

constexpr std::size_t kLongestLine = 10'000;

// All arguments as text, with a space between.
std::string joined(Native& call)
{
    std::string text;
    for (duk_idx_t i = 0; i < duk_get_top(call.ctx); ++i) {
        if (i > 0) text += ' ';
        text += call.text(i);
        if (text.size() > kLongestLine) break;
    }
    return shortened(std::move(text), kLongestLine);
}

duk_ret_t print(Native& call) { return call.play.simulation.print(joined(call)), 0; }

duk_ret_t printAs(Native& call, OutputLine::Kind kind, std::string_view severity)
{
    const Place place = currentPlace(call.ctx, call.play.files);
    std::string text = prefixed(place, call.play.simulation.scene(), severity, joined(call));
    call.play.simulation.print({kind, std::move(text), place.script, place.line});
    return 0;
}

duk_ret_t printWarning(Native& call) { return printAs(call, OutputLine::Kind::Warning, "warning"); }
duk_ret_t printError(Native& call) { return printAs(call, OutputLine::Kind::Error, "error"); }

}  // namespace

void bindOutput(duk_context* ctx, duk_idx_t kit)
{
    duk_dup(ctx, kit);
    method<print>(ctx, "print", DUK_VARARGS);
    method<printWarning>(ctx, "printWarning", DUK_VARARGS);
    method<printError>(ctx, "printError", DUK_VARARGS);
    duk_pop(ctx);
}

}  // namespace jet::duktape
