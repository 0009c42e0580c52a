// kill -9 at random moments of random editing and saving: nothing committed is lost, no file is broken.
//
// A child process edits, saves and records; it is killed after some milliseconds. Since the edits of a seed are the
// same in every process, the parent does them again without a disk, up to the last one the child finished, and one
// more: the recovered project must be one of the two, bit for bit. JET_KILL_ROUNDS sets how often (1000 if not set).
#include "sdk/scene_fakes.hpp"
#include "support/random_edits.hpp"

#include <jet/journal.hpp>

#include <atomic>
#include <csignal>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace jet {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostEdits = 60;
constexpr unsigned kMostPause = 500;  // microseconds; an edit takes some 200, with a save 1,000

/// What the child tells, in memory shared with the parent.
struct Progress {
    std::atomic<std::uint64_t> done;
    std::atomic<std::uint64_t> saves;
    std::atomic<int> failed;
};

class KillTest : public testing::Test {
protected:
    KillTest()
    {
        test::registerFakes(catalog);
        std::string name = (fs::temp_directory_path() / "jet-kill-XXXXXX").string();
        folder = ::mkdtemp(name.data());
        void* memory = ::mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        progress = new (memory) Progress();
    }
    ~KillTest() override
    {
        ::munmap(progress, sizeof(Progress));
        fs::remove_all(folder);
    }

    /// One edit, and now and then a save: the child writes, the parent, who does it again, only notes that it was done.
    void step(Project& project, test::RandomEdits& edits, bool writes)
    {
        if (edits.below(12) != 0) return edits.step();
        if (writes) {
            if (!project.file().empty() && !project.save()) progress->failed = 1;
            ++progress->saves;
        }
        if (project.file().empty()) return;
        for (Scene* scene : project.scenes()) scene->undoRedo().markClean();
    }

    [[noreturn]] void child(Project& project, std::uint64_t seed)
    {
        Journal journal(project, folder / "state");
        project.setBackupCount(2);
        test::RandomEdits edits(project, events, seed);
        for (;;) {
            step(project, edits, true);
            ++progress->done;
        }
    }

    /// After so many edits, and some time.
    void runAndKill(Project& project, std::uint64_t seed, std::uint64_t edits, unsigned microseconds)
    {
        progress->done = 0;
        const pid_t pid = ::fork();
        ASSERT_GE(pid, 0);
        if (pid == 0) child(project, seed);
        int status = 0;
        while (progress->done < edits && progress->failed == 0) {
            ASSERT_EQ(::waitpid(pid, &status, WNOHANG), 0) << "the child ended by itself";
            ::usleep(1000);
        }
        ::usleep(microseconds);
        ::kill(pid, SIGKILL);
        ASSERT_EQ(::waitpid(pid, &status, 0), pid);
        ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "the child ended by itself";
    }

    /// The project after the kill: from the journal where there is one with changes, else from its files.
    std::unique_ptr<Project> after(const fs::path& file, std::string& how)
    {
        const auto found = findJournals(folder / "state");
        EXPECT_LE(found.size(), 1u);
        if (found.empty()) {
            how = "files";
            return file.empty() ? nullptr : Project::load(file, events, catalog).orThrow();
        }
        how = "journal " + std::to_string(found.front().changes);
        Recovery recovery = recoverProject(found.front().file, events, catalog).orThrow();
        for (const std::string& note : recovery.notes) how += "; " + note;
        return std::move(recovery.project);
    }

    test::TestCatalog catalog;
    EventsCenter events;
    fs::path folder;
    Progress* progress;
};

TEST_F(KillTest, NothingCommittedIsLostAndNoFileIsBroken)
{
    const char* wanted = std::getenv("JET_KILL_ROUNDS");
    const int rounds = wanted ? std::atoi(wanted) : 1000;
    std::mt19937_64 random(20311);
    std::uint64_t edits = 0, recovered = 0;
    for (int round = 0; round < rounds; ++round) {
        // Every fourth project was never saved; the others go on from where they were, for some rounds.
        const bool untitled = round % 4 == 3;
        if (round % 16 == 0) fs::remove_all(folder / "game");
        fs::remove_all(folder / "state");
        auto project = untitled || !fs::exists(folder / "game")
                           ? Project::create("Game", events, catalog)
                           : Project::load(folder / "game", events, catalog).orThrow();
        if (!untitled && project->file().empty()) project->saveAs(folder / "game").orThrow();
        const fs::path file = project->file();
        const std::uint64_t initial = project->hash(), seed = random();
        // In the midst of some edit, on a busy machine, too.
        const std::uint64_t when = random();
        runAndKill(*project, seed, when % kMostEdits, static_cast<unsigned>(when / kMostEdits % kMostPause));
        ASSERT_EQ(progress->failed, 0) << "a save failed in round " << round;

        ASSERT_TRUE(file.empty() || Project::load(file, events, catalog)) << "round " << round;
        std::string how;
        const auto found = after(file, how);
        test::RandomEdits again(*project, events, seed);
        for (std::uint64_t n = progress->done; n > 0; --n) step(*project, again, false);
        const std::uint64_t finished = project->hash();
        step(*project, again, false);
        const std::uint64_t underWay = project->hash();
        edits += progress->done, recovered += how.starts_with("journal") ? 1 : 0;
        if (!found) {
            ASSERT_EQ(finished, initial) << "an untitled project left no journal in round " << round;
            continue;
        }
        ASSERT_TRUE(found->hash() == finished || found->hash() == underWay)
            << "round " << round << ", seed " << seed << ", " << progress->done << " edits, " << how;
        if (file.empty()) continue;
        const auto saved = found->save();  // nobody else wrote these files: no question
        ASSERT_TRUE(saved) << "round " << round << ", seed " << seed << ", " << how << ": "
                           << (saved ? "" : saved.error().text());
        ASSERT_EQ(Project::load(file, events, catalog).orThrow()->hash(), found->hash()) << "round " << round;
    }
    std::printf("%d kills, %llu edits, %llu saves, %llu recoveries from a journal\n", rounds,
                static_cast<unsigned long long>(edits), static_cast<unsigned long long>(progress->saves),
                static_cast<unsigned long long>(recovered));
    if (rounds >= 100) {
        EXPECT_GT(progress->saves, static_cast<std::uint64_t>(rounds)) << "the kills should fall among saves";
        EXPECT_GT(recovered, static_cast<std::uint64_t>(rounds) / 3) << "and leave something to recover";
    }
}

}  // namespace
}  // namespace jet
