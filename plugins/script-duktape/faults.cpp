#include "faults.hpp"

#include "play.hpp"
#include "text.hpp"

#include <charconv>

namespace jet::duktape {

namespace {

constexpr auto kTimeToDescribe = std::chrono::milliseconds(10);
constexpr std::size_t kLongestText = 2000;

// One line of a traceback: `at name (file:line) flags`. Files have neither parentheses nor colons (see ScriptFiles).
Place placeInLine(std::string_view line, const ScriptFiles& files)
{
    const std::size_t open = line.rfind('(');
    const std::size_t close = line.find(')', open == std::string_view::npos ? line.size() : open);
    const std::size_t colon = line.rfind(':', close);
    if (open == std::string_view::npos || close == std::string_view::npos || colon == std::string_view::npos ||
        colon < open)
        return {};
    Place place;
    place.script = files.find(utf8FromCesu8(line.substr(open + 1, colon - open - 1)));
    std::from_chars(line.data() + colon + 1, line.data() + close, place.line);
    return place;
}

// The innermost place in one of the scripts.
Place placeInTraceback(std::string_view traceback, const ScriptFiles& files)
{
    while (!traceback.empty()) {
        const std::size_t end = std::min(traceback.find('\n'), traceback.size());
        const Place place = placeInLine(traceback.substr(0, end), files);
        if (place.script) return place;
        traceback.remove_prefix(std::min(end + 1, traceback.size()));
    }
    return {};
}

// What happened on the way: filled piece by piece, so that an evil toString() cannot take the place away.
struct Description {
    Play& play;
    Fault fault;
};

duk_ret_t describe(duk_context* ctx, void* udata)
{
    auto& description = *static_cast<Description*>(udata);
    Play& play = description.play;
    if (duk_is_error(ctx, -1)) {
        duk_push_heapptr(ctx, play.prototypes.tracebackGetter);  // not the property: a script may have replaced it
        duk_dup(ctx, -2);
        duk_call_method(ctx, 0);
        duk_size_t size = 0;
        const char* traceback = duk_get_lstring(ctx, -1, &size);
        if (traceback) description.fault.place = placeInTraceback({traceback, size}, play.files);
        duk_pop(ctx);
        std::string text = textAt(ctx, -1);
        // The compiler appends the line, which the place already tells.
        if (const std::size_t at = text.rfind(" (line "); at != std::string::npos && text.starts_with("SyntaxError"))
            text.erase(at);
        description.fault.text = std::move(text);
    } else {
        description.fault.place = play.lastThrow;
        const std::string text = textAt(ctx, -1);
        description.fault.text = "uncaught " + (duk_is_string(ctx, -1) ? '"' + text + '"' : text);
    }
    return 0;
}

std::string milliseconds(std::chrono::nanoseconds time)
{
    return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(time).count()) + " ms";
}

std::string limitExceeded(const Budget& budget)
{
    if (budget.timedOut()) return "stopped: it ran for more than " + milliseconds(budget.limits().call);
    if (budget.outOfMemory())
        return "stopped: the scripts of the scene need more than " + std::to_string(budget.limits().memory >> 20) +
               " MB of memory";
    return {};
}

// A hook of Duktape: (value thrown) -> value to throw.
duk_ret_t noteThrow(duk_context* ctx)
{
    if (!duk_is_error(ctx, 0)) {
        Play& play = Play::of(ctx);
        play.lastThrow = currentPlace(ctx, play.files);
    }
    duk_dup(ctx, 0);
    return 1;
}

}  // namespace

Place currentPlace(duk_context* ctx, const ScriptFiles& files)
{
    constexpr int kDeepest = 100;
    for (int level = -1; level >= -kDeepest; --level) {
        duk_inspect_callstack_entry(ctx, level);
        if (!duk_is_object(ctx, -1)) {
            duk_pop(ctx);
            break;
        }
        Place place;
        duk_get_prop_literal(ctx, -1, "lineNumber");
        place.line = duk_get_int(ctx, -1);
        duk_get_prop_literal(ctx, -2, "function");
        duk_get_prop_literal(ctx, -1, "fileName");
        place.script = files.find(stringAt(ctx, -1));
        duk_pop_n(ctx, 4);
        if (place.script) return place;
    }
    return {};
}

Fault takeFault(duk_context* ctx, Play& play)
{
    const std::string limit = limitExceeded(play.budget);
    Description description{play, {}};
    play.budget.begin(kTimeToDescribe);
    duk_safe_call(ctx, describe, &description, 1, 1);
    play.budget.end();
    duk_pop(ctx);
    Fault fault = std::move(description.fault);
    if (!limit.empty()) fault.text = limit;
    if (fault.text.empty()) fault.text = "an error that cannot be shown as text";
    fault.text = shortened(std::move(fault.text), kLongestText);
    return fault;
}

std::string prefixed(const Place& place, const Scene& scene, std::string_view severity, std::string_view text)
{
    std::string out;
    if (const Item* script = scene.items().find(place.script)) {
        out = script->name();
        if (place.line > 0) out += ':' + std::to_string(place.line);
        out += ": ";
    }
    return out.append(severity).append(": ").append(text);
}

void watchThrows(duk_context* ctx)
{
    duk_get_global_literal(ctx, "Duktape");
    duk_push_c_function(ctx, noteThrow, 1);
    duk_put_prop_literal(ctx, -2, "errThrow");
    duk_pop(ctx);
}

}  // namespace jet::duktape
