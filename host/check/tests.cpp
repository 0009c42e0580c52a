#include "tests.hpp"

#include <array>

namespace jet::host::check {

namespace {

using K = ContributionKind;

constexpr std::array kTests = {
    Test{"manifest",
         "the manifest is valid, names what is there, fits this SDK, and its requirements are installed",
         {},
         10,
         512,
         false,
         testManifest},
    Test{"contributions",
         "what is declared is registered; every contribution can be made; its properties are sound",
         {},
         10,
         1024,
         false,
         testContributions},
    Test{"load",
         "loads, makes everything and unloads, 20 times, leaving nothing behind",
         {},
         30,
         1024,
         false,
         testLoading},
    Test{"edits", "1,000 random gestures, undone and redone to equal hashes; no transaction stays open", K::Tool, 30,
         1024, false, testToolEdits},
    Test{"saving", "scenes it made are saved, opened and saved again to equal bytes", K::Tool, 30, 1024, false,
         testToolSaving},
    Test{"painting", "what it paints is finite and balanced, at all zooms, in the middle of gestures", K::Tool, 30,
         1024, false, testToolPainting},
    Test{"alone", "without optional plugins, engines, layers, selection, items", K::Tool, 30, 1024, false,
         testToolAlone},
    Test{"edits", "1,000 random edits of items with it, undone and redone to equal hashes", K::Effect, 30, 1024, false,
         testEffectEdits},
    Test{"saving", "scenes with it are saved, opened and saved again to equal bytes", K::Effect, 30, 1024, false,
         testEffectSaving},
    Test{"painting", "what it paints is finite and balanced, for any path and any values in range", K::Effect, 90, 1024,
         false, testEffectPainting},
    Test{"alone", "without optional plugins and engines", K::Effect, 30, 1024, false, testEffectAlone},
    Test{"bodies", "the bodies it builds are sound, and play", K::Effect, 90, 1024, false, testEffectBodies},
    Test{"edits", "1,000 random edits of its items, undone and redone to equal hashes", K::ItemType, 30, 1024, false,
         testItemTypeEdits},
    Test{"saving", "scenes with its items are saved, opened and saved again to equal bytes", K::ItemType, 30, 1024,
         false, testItemTypeSaving},
    Test{"painting", "what its items paint is finite and balanced", K::ItemType, 30, 1024, false, testItemTypePainting},
    Test{"playing", "its items play, with and without a physics engine", K::ItemType, 30, 1024, false,
         testItemTypePlaying},
    Test{"hostile", "broken and hostile files are refused or read, within bounds, without half an import", K::Importer,
         60, 1024, false, testImporter},
    Test{"scenes", "empty and odd scenes and sizes are written or refused", K::Exporter, 60, 1024, false, testExporter},
    Test{"determinism", "equal runs give equal hashes, also from a restored state; no NaN", K::PhysicsEngine, 60, 1024,
         false, testPhysicsEngine},
    Test{"limits", "a syntax error is reported, a runaway script is stopped", K::ScriptEngine, 60, 1536, false,
         testScriptEngine},
    Test{"window", "is made, shown on an empty and on a changing project, and destroyed", K::Panel, 30, 2048, true,
         testPanel},
    Test{"run", "runs on an empty and on a filled project, undone to equal hashes", K::Command, 30, 2048, true,
         testCommand},
};

}  // namespace

std::span<const Test> allTests() { return kTests; }

}  // namespace jet::host::check
