// From a JavaScript error to a message with script and line.
#pragma once

#include "script_files.hpp"

#include <jet/scene.hpp>

#include <duktape.h>

#include <string>
#include <string_view>

namespace jet::duktape {

class Play;

/// A line of a script. Line 0 and no script: not known.
struct Place {
    ItemId script;
    int line = 0;
};

/// What stopped a call.
struct Fault {
    Place place;
    std::string text;  ///< "TypeError: ...", or the limit that was exceeded
};

/// Where the running script is now: the innermost call that is in one of the scripts.
Place currentPlace(duk_context* ctx, const ScriptFiles& files);
/// The fault for the error on top of the stack, after the call has ended; pops it. Takes little time whatever the error
/// is.
Fault takeFault(duk_context* ctx, Play& play);
/// "ControlScript:12: error: text"
std::string prefixed(const Place& place, const Scene& scene, std::string_view severity, std::string_view text);

/// Notes the place where something that is no Error is thrown, which has no traceback. After the kit is set up.
void watchThrows(duk_context* ctx);

}  // namespace jet::duktape
