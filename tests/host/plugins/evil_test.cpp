// Plugins that do the worst they can, each in a process of its own. Where the process can live on it does, with the
// plugin named and the scene whole; where it cannot, the next start names plugin and callback.
#include "plugin_folder.hpp"

#include "host/plugins/crash_ledger.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <csignal>

namespace jet::host {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

struct Ended {
    int code = 0;  // negative: the signal
    std::string out;
};

class EvilTest : public testing::Test {
protected:
    EvilTest()
    {
        for (const char* name : {"leaks", "crashes", "sleeps", "threads", "unloads"})
            plugins_.link(std::string("org.jet.test.evil-") + name);
    }

    /// Runs the tool evil-NAME in a process of its own.
    Ended run(const std::string& name, const std::string& actions, const std::string& how = "")
    {
        const std::string command = "ASAN_OPTIONS=detect_leaks=0 " + (how.empty() ? "" : "JET_TEST_EVIL=" + how + " ") +
                                    "exec " JET_BINARY_DIR "/bin/evil-runner '" + plugins_.path().string() + "' '" +
                                    state().string() + "' evil-" + name + " " + actions + " 2>&1";
        Ended ended;
        FILE* pipe = popen(("bash -c \"" + command + "\"").c_str(), "r");
        std::array<char, 256> part{};
        while (std::fgets(part.data(), part.size(), pipe)) ended.out += part.data();
        const int status = pclose(pipe);
        ended.code = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
        if (ended.code > 128) ended.code = 128 - ended.code;  // as the shell tells it
        return ended;
    }
    std::filesystem::path state() const { return state_.path(); }
    std::vector<CrashReport> reports() const { return CrashLedger::reports(state()); }
    std::size_t ledgers() const
    {
        const std::filesystem::directory_iterator files(state());
        return static_cast<std::size_t>(std::distance(begin(files), end(files)));
    }
    static void expectCode(const Ended& ended, int code)
    {
#ifdef __SANITIZE_ADDRESS__
        if (code == -SIGSEGV) code = ended.code != 0 ? ended.code : code;  // it reports, and ends as it likes
#endif
        EXPECT_EQ(ended.code, code) << ended.out;
    }
    void expectFault(const Ended& ended, const std::string& message)
    {
        EXPECT_EQ(ended.code, 0) << ended.out;
        EXPECT_THAT(ended.out, HasSubstr("was switched off: " + message));
        EXPECT_THAT(ended.out, HasSubstr("scene unchanged, at rest\nsurvived"));
        EXPECT_EQ(ledgers(), 0u) << "a run that ends well leaves no ledger";
    }

private:
    test::PluginFolder plugins_, state_;
};

TEST_F(EvilTest, AGestureThatIsGivenUpButLeavesItsTransactionOpenIsRolledBack)
{
    expectFault(run("leaks", "press release cancel"), "Tool::cancel left the change 'Lost' of its gesture open");
}

TEST_F(EvilTest, AToolThatIsPutAwayWithAnOpenTransactionIsRolledBack)
{
    expectFault(run("leaks", "press release deactivate"), "Tool::deactivate left the change 'Lost' of its gesture");
}

// --- threads

struct ThreadCase {
    const char* what;
    const char* rule;
};
class WrongThreadTest : public EvilTest, public testing::WithParamInterface<ThreadCase> {};

TEST_P(WrongThreadTest, IsRefusedAndItsPluginNamed)
{
    expectFault(run("threads", "press", GetParam().what), GetParam().rule);
}

INSTANTIATE_TEST_SUITE_P(
    Evil, WrongThreadTest,
    testing::Values(ThreadCase{"begin", "its own code broke a rule: ItemsCenter::begin was called on another thread"},
                    ThreadCase{"edit", "its own code broke a rule: Transaction was called on another thread"},
                    ThreadCase{"undo", "its own code broke a rule: UndoRedoCenter::undo was called on another thread"},
                    ThreadCase{"throw", "a thread of its own failed: nobody catches this"}),
    [](const auto& info) { return std::string(info.param.what); });

TEST_F(EvilTest, ListeningFromAnotherThreadIsAllowed)
{
    for (const char* what : {"subscribe", "unsubscribe"}) {
        const Ended ended = run("threads", "press", what);
        EXPECT_EQ(ended.code, 0) << what;
        EXPECT_THAT(ended.out, Not(HasSubstr("problem:"))) << what;
        EXPECT_THAT(ended.out, HasSubstr("scene unchanged, at rest\nsurvived")) << what;
    }
}

// --- time

TEST_F(EvilTest, ACallThatDoesNotReturnIsNamedWhileItGoesOn)
{
    const Ended ended = run("sleeps", "paint", "1");
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.out, HasSubstr("hang: JET waits for the plugin Evil: sleeps (org.jet.test.evil-sleeps 1.0.0): "
                                     "Tool::paint has not returned for"));
    EXPECT_THAT(ended.out, HasSubstr("survived"));
}

// --- crashes

struct CrashCase {
    const char* how;
    int code;
    const char* message;
};
class CrashTest : public EvilTest, public testing::WithParamInterface<CrashCase> {};

TEST_P(CrashTest, IsNamedWithPluginAndCallbackAtTheNextStart)
{
    const Ended ended = run("crashes", "press", GetParam().how);
    expectCode(ended, GetParam().code);
    EXPECT_THAT(ended.out, Not(HasSubstr("survived")));
    const auto found = reports();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].plugin, "org.jet.test.evil-crashes");
    EXPECT_THAT(found[0].message, HasSubstr(GetParam().message));
    EXPECT_FALSE(found[0].toldBefore);

    CrashLedger::told(found[0]);
    ASSERT_EQ(reports().size(), 1u);
    EXPECT_TRUE(reports()[0].toldBefore);
    CrashLedger::settled(reports()[0]);
    EXPECT_TRUE(reports().empty());
    EXPECT_EQ(ledgers(), 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Evil, CrashTest,
    testing::Values(
        CrashCase{"segfault", -SIGSEGV,
                  "crashed (segmentation fault) while the plugin org.jet.test.evil-crashes 1.0.0 was in "
                  "Tool::press"},
        CrashCase{"abort", -SIGABRT, "was aborted while the plugin org.jet.test.evil-crashes 1.0.0 was in Tool::press"},
        CrashCase{"kill", -SIGKILL, "was killed while the plugin org.jet.test.evil-crashes 1.0.0 was in Tool::press"},
        CrashCase{"exit", 0, "was ended by a call of exit() while the plugin org.jet.test.evil-crashes"},
        CrashCase{"overflow", -SIGSEGV,
                  "crashed (segmentation fault) while the plugin org.jet.test.evil-crashes 1.0.0 was in "
                  "Tool::press"},
        CrashCase{"load", -SIGSEGV,
                  "crashed (segmentation fault) while the plugin org.jet.test.evil-crashes 1.0.0 was in "
                  "load"}),
    [](const auto& info) { return std::string(info.param.how); });

TEST_F(EvilTest, AStaticDestructorThatCrashesIsNamed)
{
    const Ended ended = run("unloads", "press", "exit");
    expectCode(ended, -SIGSEGV);
    EXPECT_THAT(ended.out, HasSubstr("survived")) << "the work was done by then";
    ASSERT_EQ(reports().size(), 1u);
    EXPECT_THAT(reports()[0].message,
                HasSubstr("while the plugin org.jet.test.evil-unloads 1.0.0 cleaned up at the end of the program"));
}

TEST_F(EvilTest, ARunThatSomebodyEndedOnPurposeAccusesNobody)
{
    const Ended ended = run("sleeps", "paint & sleep 0.3; kill -TERM \\$!; wait \\$!", "20");
    EXPECT_EQ(ended.code, -SIGTERM) << ended.out;
    EXPECT_TRUE(reports().empty());
    EXPECT_EQ(ledgers(), 0u);
}

TEST_F(EvilTest, ABrokenLedgerIsNoReport)
{
    std::ofstream(state() / "1-2.ledger") << "not a ledger";
    EXPECT_TRUE(reports().empty());
    EXPECT_EQ(ledgers(), 0u) << "it is of no use to anybody";
    EXPECT_TRUE(CrashLedger::reports("/no/such/folder").empty());
}

}  // namespace
}  // namespace jet::host
