// A journal, in two ways: the input is the file, and the input is one record of changes in a file whose checksums are
// right, which the fuzzer could not find by itself.
#include "fuzz/fuzzing.hpp"
#include "fuzz/temporary_folder.hpp"

#include <jet/journal.hpp>

namespace {

using namespace jet;

std::filesystem::path file() { return fuzz::temporaryFolder() / "fuzz.journal"; }

void readAsFile(std::string_view bytes)
{
    fuzz::put(file(), bytes);
    (void)inspectJournal(file());
    EventsCenter events;
    const auto recovery = recoverProject(file(), events, fuzz::catalog());
    if (!recovery) return;
    for (const Scene* scene : recovery->project->scenes()) fuzz::requireStable(*scene);
}

/// A scene with something of each kind for changes to refer to.
std::unique_ptr<Scene> sample(EventsCenter& events)
{
    auto scene = std::make_unique<Scene>("Sample", events, fuzz::catalog());
    auto edit = scene->items().begin("Sample");
    const Item& layer = edit.add<LayerItem>(scene->root());
    const Item& group = edit.add<GroupItem>(layer);
    const Item& shape = edit.add<ShapeItem>(group, Path::rectangle(Box({0, 0}, {10, 10})));
    edit.addEffect(shape, "tint");
    edit.addEffect(shape, "box-body");
    edit.add("rope", layer, Path::line({0, 0}, {5, 5}));
    edit.commit();
    return scene;
}

void readAsChanges(std::string_view bytes)
{
    EventsCenter events;
    const auto scene = sample(events);
    const std::string_view records[] = {bytes};
    const ReplayedScene replayed = replayChanges(*scene, records);
    fuzz::require(replayed.scene != nullptr, "there is always a scene");
    if (replayed.records == 0) fuzz::require(replayed.scene->hash() == scene->hash(), "a bad record changes nothing");
    (void)writeSceneText(*replayed.scene);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    if (data[0] % 2 == 0) {
        readAsFile(bytes);
    } else {
        readAsChanges(bytes);
    }
    return 0;
}
