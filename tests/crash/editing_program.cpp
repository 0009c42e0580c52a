// A program that edits and saves a project, for tests that break its disk: crash-editing-program PROJECT JOURNALS SEED
//
// Loads the project (or makes one if there is none), edits with a journal, saves, edits on, saves again. Prints the
// hash before each save and what failed. Exit code 0: both saves succeeded, 1: one failed and said why.
#include "sdk/scene_fakes.hpp"
#include "support/random_edits.hpp"

#include <jet/journal.hpp>

#include <cstdio>

namespace {

int run(const std::filesystem::path& folder, const std::filesystem::path& journals, std::uint64_t seed)
{
    using namespace jet;
    test::TestCatalog catalog;
    test::registerFakes(catalog);
    EventsCenter events;
    auto project = Project::load(folder, events, catalog).orThrow();
    Journal journal(*project, journals);
    test::RandomEdits edits(*project, events, seed);
    int failures = 0;
    for (int round = 0; round < 2; ++round) {
        for (int i = 0; i < 15; ++i) edits.step();
        std::printf("hash %016llx\n", static_cast<unsigned long long>(project->hash()));
        std::fflush(stdout);
        if (const auto saved = project->save(); !saved) {
            std::printf("failed %s\n", saved.error().text().c_str());
            ++failures;
        } else {
            std::printf("saved\n");
        }
        std::fflush(stdout);
    }
    return failures == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc != 4) return 2;
    try {
        return run(argv[1], argv[2], std::strtoull(argv[3], nullptr, 10));
    } catch (const std::exception& e) {
        std::printf("exception %s\n", e.what());
        return 3;
    }
}
