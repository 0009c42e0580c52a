#include "host/packages/repository.hpp"

#include "../plugins/plugin_folder.hpp"
#include "host/packages/settings.hpp"
#include "host/packages/sha256.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace jet::host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Sha256, IsTheOneOfTheStandard)
{
    // FIPS 180-4, the examples of NIST.
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

class RepositoryTest : public testing::Test {
protected:
    /// An entry of the index; its package is not there.
    void add(const std::string& id, const std::string& version, std::vector<std::string> needs = {},
             const std::string& jet = JET_SDK_VERSION)
    {
        IndexEntry entry;
        entry.id = id;
        entry.name = "The " + id;
        entry.version = *Version::parse(version);
        entry.jet = *Version::parse(jet);
        entry.sdk = jet;
        entry.abi = JET_ABI_TAG;
        for (const std::string& need : needs) {
            const std::size_t space = need.find(' ');
            Dependency dependency{need.substr(0, space), {}};
            if (space != std::string::npos) dependency.range = *VersionRange::parse(need.substr(space + 1));
            entry.needs.push_back(dependency);
        }
        entry.file = id + "-" + version + ".jetplugin";
        entry.sha256 = std::string(64, '0');
        index_.entries.push_back(entry);
    }
    Repository open()
    {
        std::ofstream(folder_.path() / "index.json") << index_.text();
        return Repository::open(*Source::parse(folder_.path().string())).orThrow();
    }
    std::vector<std::string> resolve(const std::string& id, const std::vector<InstalledPlugin>& installed = {})
    {
        const Repository repository = open();
        const auto chosen = repository.resolve(id, installed);
        if (!chosen) return {chosen.error().message};
        std::vector<std::string> names;
        for (const IndexEntry* entry : *chosen) names.push_back(entry->id + " " + entry->version.text());
        return names;
    }
    std::string problemWith(const std::string& index) const
    {
        const auto parsed = Index::parse(index, "index.json");
        return parsed ? "it was taken" : parsed.error().text();
    }

    test::PluginFolder folder_;
    Index index_;
};

TEST_F(RepositoryTest, DependenciesComeFirstEachOnce)
{
    add("a.top", "1.0.0", {"a.left", "a.right"});
    add("a.left", "1.0.0", {"a.base 1.1"});
    add("a.right", "1.0.0", {"a.base"});
    add("a.base", "1.2.0");
    add("a.base", "1.0.0");
    EXPECT_THAT(resolve("a.top"), ElementsAre("a.base 1.2.0", "a.left 1.0.0", "a.right 1.0.0", "a.top 1.0.0"));
}

TEST_F(RepositoryTest, WhatIsInstalledIsNotTakenAgain)
{
    add("a.top", "1.0.0", {"a.base 1.1"});
    add("a.base", "1.2.0");
    EXPECT_THAT(resolve("a.top", {{"a.base", {1, 1, 0}, {}, {}, true}}), ElementsAre("a.top 1.0.0"));
    EXPECT_THAT(resolve("a.top", {{"a.base", {1, 0, 0}, {}, {}, true}}), ElementsAre("a.base 1.2.0", "a.top 1.0.0"));
}

TEST_F(RepositoryTest, TheNewestVersionThatFitsThisSdkIsTaken)
{
    add("a.tool", "1.0.0");
    add("a.tool", "1.5.0");
    add("a.tool", "2.0.0", {}, "99.0");
    EXPECT_THAT(resolve("a.tool"), ElementsAre("a.tool 1.5.0"));
    const Repository repository = open();
    const auto found = repository.search("TOOL");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0]->version.text(), "1.5.0");
}

TEST_F(RepositoryTest, WhatCannotBeHadIsNamedWithItsChain)
{
    add("a.top", "1.0.0", {"a.middle"});
    add("a.middle", "1.0.0", {"a.gone"});
    add("a.old", "1.0.0", {"a.middle 2.0"});
    add("a.future", "1.0.0", {}, "99.0");
    add("a.one", "1.0.0", {"a.two"});
    add("a.two", "1.0.0", {"a.one"});
    EXPECT_THAT(
        resolve("a.top"),
        ElementsAre(HasSubstr("a.top → a.middle → a.gone cannot be installed: the repository does not have it")));
    EXPECT_THAT(
        resolve("a.old"),
        ElementsAre(HasSubstr("the repository has version 1.0.0 and not version 2.0.0 or a later one before 3.0.0")));
    EXPECT_THAT(resolve("a.future"), ElementsAre(HasSubstr("does not fit this JET: it was written for SDK 99.0.0")));
    EXPECT_THAT(resolve("a.one"), ElementsAre(HasSubstr("in a circle: a.one → a.two → a.one")));
    EXPECT_THAT(resolve("a.nothing"), ElementsAre(HasSubstr("the repository does not have it; 'jet plugins search")));
}

TEST_F(RepositoryTest, AnIndexReadsBackAsItWasWritten)
{
    add("a.top", "1.0.0", {"a.base 1.1"});
    const std::string text = index_.text();
    const auto again = Index::parse(text, "index.json");
    ASSERT_TRUE(again);
    EXPECT_EQ(again->text(), text);
}

TEST_F(RepositoryTest, ADamagedIndexIsToldWithItsPlace)
{
    add("a.top", "1.0.0");
    const std::string text = index_.text();
    const auto with = [&](const std::string& what, const std::string& instead) {
        std::string changed = text;
        changed.replace(changed.find(what), what.size(), instead);
        return problemWith(changed);
    };
    EXPECT_THAT(problemWith(text.substr(0, text.size() / 2)), HasSubstr("is not valid JSON"));
    EXPECT_THAT(problemWith("[]"), HasSubstr("no index of a repository"));
    EXPECT_THAT(with("\"jetRepository\": 1", "\"jetRepository\": 2"), HasSubstr("of a later kind"));
    EXPECT_THAT(with("\"1.0.0\"", "\"one\""), HasSubstr("entry 1 (a.top), \"version\": 'one' is not a version"));
    EXPECT_THAT(with(std::string(64, '0'), "abc"), HasSubstr("\"sha256\": must be 64"));
    EXPECT_THAT(with("a.top-1.0.0.jetplugin", "../../etc/passwd"),
                HasSubstr("\"file\": '../../etc/passwd': its name leads out"));
    EXPECT_THAT(with("a.top-1.0.0.jetplugin", "/etc/passwd"), HasSubstr("absolute path"));
    EXPECT_THAT(with("\"size\": 0", "\"size\": -1"), HasSubstr("\"size\": must be a number of bytes"));
}

// A flip of every byte of an index: it parses or is refused with a message.
TEST_F(RepositoryTest, FlippedBytesInAnIndexDoNoHarm)
{
    add("a.top", "1.0.0", {"a.base 1.1"});
    const std::string text = index_.text();
    std::size_t refused = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string flipped = text;
        flipped[i] = static_cast<char>(flipped[i] ^ 0x11);
        const auto parsed = Index::parse(flipped, "index.json");
        refused += !parsed;
        if (!parsed) {
            EXPECT_THAT(parsed.error().text(), testing::StartsWith("index.json"));
        }
    }
    EXPECT_GT(refused, 0u);
}

TEST(Source, TellsWhatIsNoRepository)
{
    EXPECT_THAT(Source::parse("ftp://host/x").error().message, HasSubstr("is no repository"));
    EXPECT_THAT(Source::parse("file://host/x").error().message, HasSubstr("file:///FOLDER"));
    EXPECT_THAT(Source::parse("/no/such/folder").error().message, HasSubstr("no such folder"));
    EXPECT_THAT(Source::parse("http://host/a b").error().message, HasSubstr("is not an address"));
}

TEST(Source, AddressesAreEncodedAndDecoded)
{
    test::PluginFolder folder;
    std::filesystem::create_directories(folder.path() / "with space");
    std::ofstream(folder.path() / "with space" / "f") << "content";
    const auto local = Source::parse("file://" + folder.path().string() + "/with%20space/");
    ASSERT_TRUE(local);
    EXPECT_EQ(*local->read("f", 100), "content");
    EXPECT_THAT(local->read("f", 3).error().message, HasSubstr("larger than"));
    EXPECT_THAT(local->read("../f", 100).error().message, HasSubstr("leads out"));
    EXPECT_EQ(Source::parse("https://host/jet/")->address("a b#1.jetplugin"), "https://host/jet/a%20b%231.jetplugin");
}

TEST(Settings, DroppingThemLeavesThoseOfOthers)
{
    test::PluginFolder folder;
    Manifest manifest;
    manifest.id = "a.rope";
    Contribution rope{};
    rope.kind = ContributionKind::Tool;
    rope.id = "rope", rope.label = "Rope", rope.plugin = "a.rope";
    manifest.contributions.push_back(std::move(rope));
    std::ofstream(folder.path() / "disabled-plugins") << "a.other\na.rope\n";
    std::ofstream(folder.path() / "window.ini") << "[layout]\nrope\\x=1\n[tools]\nrope\\size=3, 5\nropes\\size=3, 6\n";
    std::filesystem::create_directories(folder.path() / "settings");
    std::ofstream(folder.path() / "settings/a.rope.json") << "{}";
    std::ofstream(folder.path() / "settings/a.ropes.json") << "{}";
    ASSERT_TRUE(dropSettings(manifest, folder.path()));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "settings/a.rope.json"));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "settings/a.ropes.json"));
    EXPECT_EQ(*readFile(folder.path() / "disabled-plugins"), "a.other\n");
    EXPECT_EQ(*readFile(folder.path() / "window.ini"), "[layout]\nrope\\x=1\n[tools]\nropes\\size=3, 6\n");
}

}  // namespace
}  // namespace jet::host
