#include "host/plugins/manifest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <test_paths.hpp>

#include <fstream>

namespace jet::host {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& text)
{
    const auto manifest = Manifest::parse(text, "plugin.json");
    return manifest ? "accepted" : manifest.error().text();
}

std::string with(const std::string& more)
{
    return "{\n\"id\": \"org.acme.rope\", \"name\": \"Rope\", \"version\": \"1.2\", \"jet\": \"1.0\", \"library\": "
           "\"rope\"" +
           (more.empty() ? "" : ",\n" + more) + "\n}";
}

TEST(ManifestTest, TheSmallestOneIsEnough)
{
    const auto manifest = Manifest::parse(with(""), "plugin.json");
    ASSERT_TRUE(manifest) << manifest.error().text();
    EXPECT_EQ(manifest->id, "org.acme.rope");
    EXPECT_EQ(manifest->version, (Version{1, 2, 0}));
    EXPECT_TRUE(manifest->contributions.empty());
}

TEST(ManifestTest, ContributionsCarryWhatTheyDeclare)
{
    const auto manifest = Manifest::parse(with(R"(// comments are fine
        "requires": ["org.acme.knot 1.4"], "optional": ["org.acme.glue"],
        "contributes": { "tools": [ { "id": "rope", "label": "Rope", "shortcut": "R", "icon": "rope.svg", "order": 5 } ],
                         "importers": [ { "id": "rope-file", "label": "Rope file", "extensions": ["rope", "rp"] } ] })"),
                                          "plugin.json");
    ASSERT_TRUE(manifest) << manifest.error().text();
    ASSERT_EQ(manifest->contributions.size(), 2u);
    const Contribution& importer = manifest->contributions[0];
    const Contribution& tool = manifest->contributions[1];
    EXPECT_EQ(importer.extensions, (std::vector<std::string>{"rope", "rp"}));
    EXPECT_EQ(tool.kind, ContributionKind::Tool);
    EXPECT_EQ(tool.plugin, "org.acme.rope");
    EXPECT_EQ(tool.order, 5);
    EXPECT_TRUE(manifest->requires_[0].admits({1, 5, 0}));
    EXPECT_FALSE(manifest->requires_[0].admits({1, 3, 9}));
    EXPECT_FALSE(manifest->requires_[0].admits({2, 0, 0}));
}

TEST(ManifestTest, MistakesAreToldWithTheirPlace)
{
    EXPECT_THAT(refusal("{\n  \"id\": ,\n}"),
                HasSubstr("plugin.json:2:9: error: this manifest is not valid JSON: syntax error"));
    EXPECT_THAT(refusal(""), HasSubstr("plugin.json:1:1: error: this manifest is not valid JSON"));
    EXPECT_THAT(refusal("[]"), HasSubstr("a manifest is a JSON object"));
    EXPECT_THAT(refusal(with("\"license\": 3")), HasSubstr("plugin.json:3:1: error: \"license\": must be a text"));
    EXPECT_THAT(refusal("{\"id\": \"\xff\"}"), HasSubstr("not valid JSON"));
    EXPECT_THAT(
        refusal(with(
            "\"contributes\": {\"effects\": [{\"id\": \"x\", \"label\": \"x\"}, {\"id\": \"x\", \"label\": \"y\"}]}")),
        HasSubstr("\"contributes.effects[1].id\": declares 'x' twice"));
}

// The same word may stand in several places: the one that is wrong is named, not the first.
TEST(ManifestTest, TheRightOneOfManyEqualFieldsIsNamed)
{
    EXPECT_THAT(refusal(with("// \"label\": in a comment\n\"description\": \"a \\\"label\\\": 3\",\n"
                             "\"contributes\": { \"tools\": [\n  { \"id\": \"a\", \"label\": \"A\" },\n"
                             "  { \"id\": \"b\", /* here */ \"label\": 3 } ] }")),
                HasSubstr("plugin.json:7:27: error: \"contributes.tools[1].label\": must be a text"));
}

// The schema goes by the same table (tests/sdk/json_schema_test.py).
TEST(ManifestTest, TheTableOfManifestsIsJudgedAsTheSchemaDoes)
{
    std::ifstream in(JET_SOURCE_DIR "/tests/fixtures/manifests.json");
    const auto table = nlohmann::json::parse(in);
    ASSERT_GT(table["cases"].size(), 50u);
    for (const auto& entry : table["cases"]) {
        SCOPED_TRACE(entry["name"]);
        auto json = table["base"];
        json.update(entry.value("with", nlohmann::json::object()));
        for (const std::string& key : entry.value("without", std::vector<std::string>())) json.erase(key);
        const auto manifest = Manifest::parse(json.dump(1), "plugin.json");
        const std::string verdict = !manifest ? "refused" : manifest->warnings.empty() ? "good" : "warned";
        std::string said = manifest ? "" : manifest.error().text();
        if (verdict == "warned") said = manifest->warnings[0].text();
        EXPECT_EQ(verdict, entry["verdict"]) << said;
        EXPECT_THAT(said, HasSubstr(entry.value("says", "")));
    }
}

TEST(ManifestTest, AllShippedManifestsAreGood)
{
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(JET_SOURCE_DIR "/plugins")) {
        if (entry.path().filename() != "plugin.json") continue;
        const auto manifest = Manifest::read(entry.path());
        ASSERT_TRUE(manifest) << manifest.error().text();
        EXPECT_TRUE(manifest->warnings.empty()) << manifest->warnings[0].text();
        ++count;
    }
    EXPECT_GT(count, 10);
}

TEST(ManifestTest, AWarningHasItsPlace)
{
    const auto manifest = Manifest::parse(with("\"optinal\": []"), "plugin.json");
    ASSERT_TRUE(manifest);
    ASSERT_EQ(manifest->warnings.size(), 1u);
    EXPECT_EQ(manifest->warnings[0].text(),
              "plugin.json:3:1: error: \"optinal\": this field is not known here and means "
              "nothing; did you mean 'optional'?");
}

/// What follows a null byte is no part of the JSON, and may be anything; the place of an error is sought in all of it.
TEST(ManifestTest, WhatIsNoJsonAfterANullByteIsNoHang)
{
    using namespace std::string_literals;
    for (const std::string& rest : {"[}"s, "{\"a\"]"s, "[,,}"s, "{\"a\" \"b\" {]"s, "[[}{]"s, "[\0}"s})
        EXPECT_THAT(refusal("// a\0"
                            "0\0"s +
                            rest),
                    HasSubstr("a manifest is a JSON object"))
            << rest;
    EXPECT_THAT(refusal("// a\r[ 1,\n {\"id\": 5} ]"),
                HasSubstr("plugin.json:1:6: error: a manifest is a JSON object"));
}

TEST(ManifestTest, DeepNestingAndTruncationsAreNoCrash)
{
    EXPECT_NE(refusal(std::string(100'000, '[')), "accepted");
    const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
    EXPECT_NE(refusal(deep), "accepted");
    EXPECT_NE(refusal(with("\"id\": " + deep)), "accepted");
    const std::string text = with("\"contributes\": {\"tools\": [{\"id\": \"x\", \"label\": \"y\"}]}");
    for (std::size_t i = 0; i < text.size(); ++i) EXPECT_NE(refusal(text.substr(0, i)), "accepted") << i;
}

}  // namespace
}  // namespace jet::host
