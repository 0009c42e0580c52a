// What another program put on the clipboard: read as a scene, and its items pasted into one that is there.
#include "fuzz/fuzzing.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace jet;
    EventsCenter events;
    std::vector<FormatNote> notes;
    const auto clips = readSceneText(std::string(reinterpret_cast<const char*>(data), size), "clipboard", events,
                                     fuzz::catalog(), notes);
    if (!clips) return 0;
    Scene scene("Target", events, fuzz::catalog());
    const std::uint64_t before = scene.hash();
    {
        auto edit = scene.items().begin("Paste");
        for (const auto& item : (*clips)->root().children()) edit.addCopy(*item, scene.root());
        edit.commit();
    }
    fuzz::requireStable(scene);
    scene.undoRedo().undo();
    fuzz::require(scene.hash() == before, "pasting can be undone");
    return 0;
}
