#include <jet/testing/catalog.hpp>

#include <jet/effect.hpp>
#include <test_paths.hpp>

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>

namespace jet::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::filesystem::path fixtures() { return std::filesystem::path(JET_BINARY_DIR) / "tests/plugins"; }

std::string failureOf(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Failure& failure) {
        return failure.what();
    }
    return {};
}

TEST(TestCatalog, FindsTheShippedPluginsBesideTheSdk)
{
    TestCatalog catalog{"org.jet.effect.polygon-face"};
    EXPECT_THAT(catalog.plugins(), ElementsAre("org.jet.effect.polygon-face"));
    EXPECT_NE(catalog.effect("polygon-face"), nullptr);
    EXPECT_EQ(catalog.provider(ContributionKind::Effect, "polygon-face").substr(0, 28), "org.jet.effect.polygon-face ");
}

TEST(TestCatalog, APluginIsLoadedOnce)
{
    TestCatalog catalog{"org.jet.effect.polygon-face", "org.jet.effect.polygon-face"};
    EXPECT_EQ(catalog.contributions(ContributionKind::Effect).size(), 1u);
}

TEST(TestCatalog, LooksIntoTheFoldersOfTheEnvironmentFirst)
{
    ::setenv("JET_TEST_PLUGIN_PATH", ("/nowhere:" + fixtures().string()).c_str(), 1);
    const auto path = pluginPath();
    ::unsetenv("JET_TEST_PLUGIN_PATH");
    ASSERT_GE(path.size(), 3u);
    EXPECT_EQ(path[0], "/nowhere");
    EXPECT_EQ(path[1], fixtures());
    EXPECT_EQ(path.back(), std::filesystem::path(JET_BINARY_DIR) / "lib/jet/plugins");
}

TEST(TestCatalog, NamesTheFoldersItSearchedForAPluginThatIsNotThere)
{
    const std::string why = failureOf([] { TestCatalog catalog{"org.acme.nothing"}; });
    EXPECT_THAT(why, HasSubstr("org.acme.nothing"));
    EXPECT_THAT(why, HasSubstr("lib/jet/plugins"));
}

TEST(TestCatalog, RefusesAPluginThatRegistersWhatItDoesNotDeclare)
{
    TestCatalog catalog;
    const std::string why = failureOf([&] { catalog.loadFolder(fixtures() / "org.jet.test.undeclared"); });
    EXPECT_THAT(why, HasSubstr("org.jet.test.undeclared"));
    EXPECT_THAT(why, HasSubstr("declare"));
}

TEST(TestCatalog, RefusesAFolderWithoutAManifest)
{
    TestCatalog catalog;
    EXPECT_THAT(failureOf([&] { catalog.loadFolder(fixtures()); }), HasSubstr("plugin.json"));
}

}  // namespace
}  // namespace jet::test
