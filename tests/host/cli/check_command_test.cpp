#include "check_fixture.hpp"

#include <filesystem>

namespace jet::test {
namespace {

using testing::Not;

TEST_F(CheckCommandTest, APluginThatWorksPasses)
{
    const auto report = check("good");
    EXPECT_GE(report.size(), 15u);
    for (const auto& [name, finding] : report) EXPECT_EQ(finding.result, "ok") << name << ": " << finding.reason;
}

TEST_F(CheckCommandTest, WhatDoesNotLoadOrAgreeIsToldAndTheRestIsNotRun)
{
    const std::pair<const char*, const char*> fixtures[] = {
        {"throws-on-load", "it fails while registering: no licence found"},
        {"undeclared", "effect 'surprise' is registered but not declared"},
        {"no-symbol", "has no symbol jet_plugin_entry"},
        {"wrong-entry", "was built for SDK 99.7"}};
    for (const auto& [id, why] : fixtures) {
        const auto report = check(id);
        EXPECT_THAT(reason(report, "contributions"), HasSubstr(why));
        EXPECT_EQ(report.at("manifest").result, "ok") << id;
        EXPECT_EQ(report.at("load").result, "skip") << id;
    }
}

// One callback each throws; the test that drives it fails and names it.
TEST_F(CheckCommandTest, AnExceptionInAnyCallbackIsFoundAndNamed)
{
    const std::tuple<const char*, const char*, const char*> callbacks[] = {
        {"factory", "contributions", "factory"},
        {"Tool::options", "contributions", "Tool::options"},
        {"Tool::activate", "tool-edits:fragile", "Tool::activate"},
        {"Tool::press", "tool-edits:fragile", "Tool::press"},
        {"Tool::drag", "tool-edits:fragile", "Tool::drag"},
        {"Tool::release", "tool-edits:fragile", "Tool::release"},
        {"Tool::move", "tool-edits:fragile", "Tool::move"},
        {"Tool::doubleClick", "tool-edits:fragile", "Tool::doubleClick"},
        {"Tool::wheel", "tool-edits:fragile", "Tool::wheel"},
        {"Tool::keyPress", "tool-edits:fragile", "Tool::keyPress"},
        {"Tool::keyRelease", "tool-edits:fragile", "Tool::keyRelease"},
        {"Tool::cancel", "tool-edits:fragile", "Tool::cancel"},
        {"Tool::deactivate", "tool-edits:fragile", "Tool::deactivate"},
        {"Tool::paint", "tool-painting:fragile", "Tool::paint"},
        {"Effect::properties", "contributions", "Effect::properties"},
        {"Effect::rejects", "effect-edits:fragile", "Effect::rejects"},
        {"Effect::applied", "effect-edits:fragile", "Effect::applied"},
        {"Effect::update", "effect-painting:fragile", "painting an item"},
        {"Effect::paint", "effect-painting:fragile", "painting an item"},
        {"Effect::buildBody", "effect-bodies:fragile", "Effect::buildBody"},
        {"ItemType::properties", "contributions", "ItemType::properties"},
        {"ItemType::label", "contributions", "ItemType::label"},
        {"ItemType::paint", "item-type-painting:fragile", "painting an item"},
        {"Importer::read", "importer-hostile:fragile", "Importer::read"},
        {"Exporter::write", "exporter-scenes:fragile", "Exporter::write"},
        {"PhysicsEngine::createWorld", "physics-engine-determinism:fragile", "PhysicsEngine::createWorld"},
        {"PhysicsWorld::step", "physics-engine-determinism:fragile", "PhysicsWorld::step"},
        {"Command::run", "command-run:fragile", "Command::run"},
        {"Command::isEnabled", "command-run:fragile", "Command::isEnabled"},
    };
    for (const auto& [callback, test, named] : callbacks) {
        const auto report =
            check("throws-inside", "--only " + std::string(test), "JET_TEST_THROW=" + std::string(callback));
        EXPECT_THAT(reason(report, test), HasSubstr(named)) << callback;
        EXPECT_THAT(reason(report, test), HasSubstr("oops")) << callback;
    }
}

TEST_F(CheckCommandTest, ABrokenManifestIsToldWithItsPlace)
{
    write("broken/plugin.json", "{ \"id\": \"org.acme.rope\",\n  \"name\": 7 }");
    const Outcome run = plain("plugins check broken");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.out, HasSubstr("FAIL  manifest"));
    EXPECT_THAT(run.out, HasSubstr("plugin.json:2:"));
    EXPECT_THAT(run.out, HasSubstr("1 plugins, 0 tests passed, 1 failed, 0 not run"));
}

TEST_F(CheckCommandTest, EqualSeedsGiveEqualFindingsAndTheCommandRepeatsThem)
{
    const auto first = check("throws-inside", "--only tool-edits --seed 7", "JET_TEST_THROW=Tool::press");
    const auto second = check("throws-inside", "--only tool-edits --seed 7", "JET_TEST_THROW=Tool::press");
    ASSERT_EQ(first.size(), 1u);
    const Finding& finding = first.begin()->second;
    EXPECT_EQ(finding.reason, second.begin()->second.reason);
    EXPECT_THAT(finding.reason, HasSubstr("seed 7"));
    ASSERT_TRUE(finding.command.starts_with("jet plugins check ")) << finding.command;
    const Outcome again = plain(finding.command.substr(4), "JET_TEST_THROW=Tool::press");
    EXPECT_EQ(again.code, 1);
    EXPECT_THAT(again.out, HasSubstr(finding.reason));
}

TEST_F(CheckCommandTest, WrongCallsAreTold)
{
    EXPECT_EQ(plain("plugins check").code, 2);
    EXPECT_EQ(plain("plugins check nowhere").code, 2);
    write("empty/file", "");
    EXPECT_THAT(plain("plugins check empty").err, HasSubstr("holds no built plugin"));
    const Outcome unknown = plain("plugins check " + folder("org.jet.test.good") + " --only tool-flies");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.err, HasSubstr("--list shows all"));
    EXPECT_THAT(plain("plugins check --list").out, HasSubstr("importer-hostile"));
}

// A folder with several plugins: each is checked, and its own failure is its own.
TEST_F(CheckCommandTest, AllPluginsOfAFolderAreChecked)
{
    std::filesystem::create_directories(home() / "all");
    for (const char* id : {"org.jet.test.good", "org.jet.test.undeclared"})
        std::filesystem::create_directory_symlink(fixtureFolder() / id, home() / "all" / id);
    const auto report = json(plain("plugins check all --only contributions --json").out);
    ASSERT_EQ(report["plugins"].size(), 2u);
    EXPECT_EQ(report["passed"], 1);
    EXPECT_EQ(report["failed"], 1);
}

}  // namespace
}  // namespace jet::test
