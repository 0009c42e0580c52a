// The tests of the conformance run: what each is for, which plugins it applies to, and the function that runs in a
// child process of its own.
#pragma once

#include "context.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace jet::host::check {

struct Test {
    std::string_view name;                 ///< "edits"
    std::string_view what;                 ///< a sentence, for --list
    std::optional<ContributionKind> kind;  ///< once for each contribution of this kind; none: once for the plugin
    int seconds;                           ///< the child may take
    int megabytes;                         ///< the child may take
    bool window;                           ///< it needs Qt, on the offscreen platform
    void (*run)(Context&);
};
std::span<const Test> allTests();

// Of the plugin as a whole.
void testManifest(Context&);
void testContributions(Context&);
void testLoading(Context&);
// Of its contributions.
void testToolEdits(Context&);
void testToolSaving(Context&);
void testToolPainting(Context&);
void testToolAlone(Context&);
void testEffectEdits(Context&);
void testEffectSaving(Context&);
void testEffectPainting(Context&);
void testEffectAlone(Context&);
void testEffectBodies(Context&);
void testItemTypeEdits(Context&);
void testItemTypeSaving(Context&);
void testItemTypePainting(Context&);
void testItemTypePlaying(Context&);
void testImporter(Context&);
void testExporter(Context&);
void testPhysicsEngine(Context&);
void testScriptEngine(Context&);
void testPanel(Context&);
void testCommand(Context&);

}  // namespace jet::host::check
