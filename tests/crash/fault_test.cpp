// Full disks, failing disks, vanishing folders and power cuts at every single call that writes: no file is broken,
// nothing saved or recorded is lost, and the failure is told in a sentence.
#include "sdk/scene_fakes.hpp"
#include "support/random_edits.hpp"

#include <jet/journal.hpp>

#include <cstdio>
#include <set>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace jet {
namespace {

namespace fs = std::filesystem;

struct Fault {
    fs::path folder;
    long at = 0;
    int code = 0;
    bool sticky = false;
    std::string power;
};

/// What the editing program told.
struct Told {
    int code = -1;
    std::vector<std::string> hashes;  // before each save
    std::size_t saved = 0;            // of the saves, how many succeeded
    std::string text;
};

class FaultTest : public testing::Test {
protected:
    FaultTest()
    {
        test::registerFakes(catalog);
        std::string name = (fs::temp_directory_path() / "jet-fault-XXXXXX").string();
        folder = ::mkdtemp(name.data());
        start = name + "-start";
        auto project = Project::create("Game", events, catalog);
        test::RandomEdits edits(*project, events, 5);
        for (int i = 0; i < 20; ++i) edits.step();
        project->addScene("Last");
        project->saveAs(start).orThrow();
        first = hashText(project->hash());
    }
    ~FaultTest() override
    {
        fs::remove_all(folder);
        fs::remove_all(start);
    }

    void reset()
    {
        for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
        fs::copy(start, folder / "game", fs::copy_options::recursive);
    }

    Told run(const Fault& fault)
    {
        const std::string command =
            "LD_PRELOAD='" JET_FAULT_INJECTOR "' JET_FAULT_FOLDER='" + fault.folder.string() +
            "' JET_FAULT_AT=" + std::to_string(fault.at) + " JET_FAULT_ERRNO=" + std::to_string(fault.code) +
            " JET_FAULT_STICKY=" + (fault.sticky ? "1" : "0") + " JET_FAULT_POWER=" + fault.power +
            " JET_FAULT_COUNT='" + (folder / "count").string() + "' '" JET_EDITING_PROGRAM "' '" +
            (folder / "game").string() + "' '" + (folder / "state").string() + "' 77 2>&1";
        Told told;
        FILE* pipe = ::popen(command.c_str(), "r");
        char line[4096];
        while (std::fgets(line, sizeof line, pipe)) {
            const std::string text = line;
            told.text += text;
            if (text.starts_with("hash ")) told.hashes.push_back(text.substr(5, 16));
            if (text.starts_with("saved")) ++told.saved;
        }
        const int status = ::pclose(pipe);
        told.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
        return told;
    }

    long countCalls(const fs::path& where)
    {
        reset();
        const Told told = run({where, 0, 0, false, ""});
        EXPECT_EQ(told.code, 0) << told.text;
        return std::stol(readFile(folder / "count").orThrow());
    }

    /// The project opens, and with its journal, if there is one, is what it was before the last save or after.
    void check(const Told& told, const std::string& what)
    {
        ASSERT_TRUE(told.code == 0 || told.code == 1 || told.code == 99) << what << ": " << told.text;
        auto project = Project::load(folder / "game", events, catalog);
        ASSERT_TRUE(project) << what << ": " << project.error().text();
        std::set<std::string> fine{first};
        for (const std::string& hash : told.hashes) fine.insert(hash);
        const auto journals = findJournals(folder / "state");
        // A power cut may bring back one that a save had ended: then there is nothing in it that is not saved.
        ASSERT_LE(journals.size(), told.code == 99 ? 2u : 1u) << what;
        if (journals.empty()) {
            EXPECT_TRUE(fine.contains(hashText((*project)->hash()))) << what << ": neither the old nor the new state";
            return;
        }
        auto recovery = recoverProject(journals.front().file, events, catalog);
        ASSERT_TRUE(recovery) << what << ": " << recovery.error().text();
        hash = hashText(recovery->project->hash());
        ASSERT_TRUE(recovery->project->save(Overwrite::Allow)) << what;
        EXPECT_EQ(hashText(Project::load(folder / "game", events, catalog).orThrow()->hash()), hash) << what;
    }

    static std::string hashText(std::uint64_t hash)
    {
        char text[17];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
        return text;
    }

    /// Each call in turn fails once, or from then on.
    void failEachCall(const fs::path& where, int code)
    {
        const long calls = countCalls(where);
        ASSERT_GT(calls, 10);
        for (const bool sticky : {false, true})
            for (long at = 1; at <= calls; ++at) {
                reset();
                hash.clear();
                const Told told = run({where, at, code, sticky, ""});
                const std::string what = "call " + std::to_string(at) + (sticky ? " and later" : "") + ", error " +
                                         std::to_string(code) + "\n" + told.text;
                ASSERT_NO_FATAL_FAILURE(check(told, what));
                ASSERT_EQ(told.hashes.size(), 2u) << what;
                // All that was done is there: saved, or in the journal.
                const bool ofProject = where.filename() == "game";
                EXPECT_TRUE(!ofProject || hash.empty() || hash == told.hashes.back()) << what;
                EXPECT_TRUE(ofProject || told.saved == 2) << "a journal must not stop a save; " << what;
                EXPECT_TRUE(told.code != 1 || told.text.find("; ") != std::string::npos) << "says what to do; " << what;
            }
    }

    test::TestCatalog catalog;
    EventsCenter events;
    fs::path folder, start;   // start: the project each run begins with
    std::string first, hash;  // of the project at the start, and as it was recovered
};

TEST_F(FaultTest, AFullDiskAtEachCallBreaksNothing) { failEachCall(folder / "game", ENOSPC); }
TEST_F(FaultTest, AFailingDiskAtEachCallBreaksNothing) { failEachCall(folder / "game", EIO); }
TEST_F(FaultTest, AVanishingNetworkFolderAtEachCallBreaksNothing) { failEachCall(folder / "game", ESTALE); }
TEST_F(FaultTest, AFullDiskOfJournalsStopsNoSave) { failEachCall(folder / "state", ENOSPC); }

TEST_F(FaultTest, APowerCutAtEachCallLeavesTheOldProjectOrTheNewOne)
{
    const long calls = countCalls(folder);
    for (const char* power : {"undo", "empty"})
        for (long at = 1; at <= calls; ++at) {
            reset();
            const Told told = run({folder, at, 0, false, power});
            const std::string what =
                std::string("power cut, ") + power + ", call " + std::to_string(at) + "\n" + told.text;
            // A save that was told to be done stays done.
            if (told.saved == told.hashes.size() && told.saved > 0) {
                const auto project = Project::load(folder / "game", events, catalog);
                ASSERT_TRUE(project) << what;
                EXPECT_EQ(hashText((*project)->hash()), told.hashes.back()) << what;
            }
            ASSERT_NO_FATAL_FAILURE(check(told, what));
        }
}

TEST_F(FaultTest, AReadOnlyFolderIsToldAndTheChangesStayInTheJournal)
{
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    reset();
    ::chmod((folder / "game/scenes").c_str(), 0555);
    const Told told = run({});
    ::chmod((folder / "game/scenes").c_str(), 0755);
    EXPECT_EQ(told.code, 1);
    EXPECT_NE(told.text.find("check the permissions"), std::string::npos) << told.text;
    ASSERT_NO_FATAL_FAILURE(check(told, told.text));
    EXPECT_EQ(hash, told.hashes.back());
}

TEST_F(FaultTest, AFolderThatVanishesIsMadeAgainWithTheWholeProject)
{
    reset();
    auto project = Project::load(folder / "game", events, catalog).orThrow();
    fs::remove_all(folder / "game");
    auto edit = project->scenes()[0]->items().begin("Draw");
    edit.add<ShapeItem>(project->scenes()[0]->root());
    edit.commit();
    project->save().orThrow();
    EXPECT_EQ(Project::load(folder / "game", events, catalog).orThrow()->hash(), project->hash());
}

}  // namespace
}  // namespace jet
