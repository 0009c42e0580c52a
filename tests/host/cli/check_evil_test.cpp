// Each evil plugin fails the conformance run, for its own reason.
#include "check_fixture.hpp"

namespace jet::test {
namespace {

using testing::AllOf;
using testing::AnyOf;

class CheckEvilTest : public CheckCommandTest {
protected:
    /// The reason one test of the plugin fails for, in one of its evil ways.
    std::string reasonFor(const std::string& id, const std::string& test, const std::string& way = "")
    {
        return reason(check("evil-" + id, "--only " + test, way.empty() ? "" : "JET_TEST_EVIL=" + way), test);
    }
};

TEST_F(CheckEvilTest, ACrashIsNamedWithItsCallback)
{
    const std::string test = "tool-edits:evil-crashes";
    EXPECT_THAT(reasonFor("crashes", test),
                AllOf(HasSubstr("it crashed (signal 11"), HasSubstr("in Tool::press (edit")));
    EXPECT_THAT(reasonFor("crashes", test, "abort"), AllOf(HasSubstr("signal 6"), HasSubstr("in Tool::press")));
    EXPECT_THAT(reasonFor("crashes", test, "overflow"), AllOf(HasSubstr("signal 11"), HasSubstr("in Tool::press")));
    EXPECT_THAT(reasonFor("crashes", test, "kill"), AllOf(HasSubstr("signal 9"), HasSubstr("in Tool::press")));
    EXPECT_THAT(reasonFor("crashes", test, "exit"),
                HasSubstr("it ended the whole program (exit code 0) in Tool::press"));
    EXPECT_THAT(reasonFor("crashes", "contributions", "load"),
                AllOf(HasSubstr("signal 11"), HasSubstr("in registering")));
}

TEST_F(CheckEvilTest, ATransactionThatStaysOpenIsFound)
{
    EXPECT_THAT(reasonFor("leaks", "tool-edits:evil-leaks"), HasSubstr("leaves a transaction open"));
    EXPECT_THAT(reasonFor("leaks", "command-run:evil-leaks"), HasSubstr("Command::run leaves a transaction open"));
}

TEST_F(CheckEvilTest, ACallbackThatTakesForeverIsFound)
{
    EXPECT_THAT(reasonFor("sleeps", "tool-painting:evil-sleeps", "3"), HasSubstr("Tool::paint took 3."));
}

TEST_F(CheckEvilTest, CallsFromAnotherThreadAreFound)
{
    for (const char* way : {"begin", "edit", "undo", "throw"})
        EXPECT_THAT(reasonFor("threads", "tool-edits:evil-threads", way), HasSubstr("in Tool::press")) << way;
}

TEST_F(CheckEvilTest, WhatStaysBehindAfterUnloadingIsFound)
{
    EXPECT_THAT(reasonFor("unloads", "tool-edits:evil-unloads", "thread"), HasSubstr("it leaves 1 thread running"));
    EXPECT_THAT(reasonFor("unloads", "load", "listener"), HasSubstr("leaves a listener of events behind"));
    EXPECT_THAT(reasonFor("unloads", "tool-edits:evil-unloads", "listener"),
                HasSubstr("leaves a listener of events behind"));
    EXPECT_THAT(reasonFor("unloads", "load", "nodelete"), HasSubstr("its library stays in memory"));
    EXPECT_THAT(reasonFor("unloads", "load", "exit"),
                AllOf(HasSubstr("signal 11"), AnyOf(HasSubstr("dlclose"), HasSubstr("ended"))));
}

TEST_F(CheckEvilTest, ACorruptManifestIsTold)
{
    EXPECT_THAT(reasonFor("manifest", "manifest"), HasSubstr("is not valid JSON"));
}

}  // namespace
}  // namespace jet::test
