// The parts of the script API that have no class of their own in C++; see also items.hpp and listeners.hpp. Each adds
// its functions to the kit that prelude.js is called with, or to a prototype in it.
#pragma once

#include <duktape.h>

namespace jet::duktape {

void bindOutput(duk_context* ctx, duk_idx_t kit);  ///< print, console, CC.GUIC
void bindKeyboard(duk_context* ctx, duk_idx_t kit);
void bindView(duk_context* ctx, duk_idx_t kit);       ///< scene.GC.swingSimulationGP, CC.getScene
void bindContext(duk_context* ctx, duk_idx_t kit);    ///< ctx
void bindColliding(duk_context* ctx, duk_idx_t kit);  ///< ctx.colTab
void bindQueries(duk_context* ctx, duk_idx_t kit);    ///< ctx.rayCast, ...

}  // namespace jet::duktape
