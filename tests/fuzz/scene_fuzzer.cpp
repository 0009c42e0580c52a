// The text of a scene file: read, written and read again.
#include "fuzz/fuzzing.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace jet;
    EventsCenter events;
    std::vector<FormatNote> notes;
    const auto scene = readSceneText(std::string(reinterpret_cast<const char*>(data), size), "fuzz.scene", events,
                                     fuzz::catalog(), notes);
    if (scene) {
        fuzz::requireStable(**scene);
    } else {
        fuzz::require(!scene.error().message.empty(), "an error says what is wrong");
    }
    return 0;
}
