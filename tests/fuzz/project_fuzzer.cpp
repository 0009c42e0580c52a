// project.jet, with one scene beside it.
#include "fuzz/fuzzing.hpp"
#include "fuzz/temporary_folder.hpp"

namespace {

const std::filesystem::path& folder()
{
    static const std::filesystem::path made = [] {
        const std::filesystem::path path = jet::fuzz::temporaryFolder();
        std::filesystem::create_directories(path / "scenes");
        jet::fuzz::put(path / "scenes/Scene 0.scene",
                       "<scene version=\"1\"><item type=\"shape\" id=\"1\" name=\"a\"/></scene>");
        return path;
    }();
    return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace jet;
    fuzz::put(folder() / "project.jet", {reinterpret_cast<const char*>(data), size});
    EventsCenter events;
    const auto project = Project::load(folder() / "project.jet", events, fuzz::catalog());
    if (!project) return 0;
    for (const Scene* scene : (*project)->scenes()) fuzz::requireStable(*scene);
    (void)(*project)->pluginsUsed();
    return 0;
}
