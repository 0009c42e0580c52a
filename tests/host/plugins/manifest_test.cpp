#include "host/plugins/manifest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(VersionTest, MissingPartsAreZero)
{
    EXPECT_EQ(*Version::parse("1"), (Version{1, 0, 0}));
    EXPECT_EQ(*Version::parse("1.20"), (Version{1, 20, 0}));
    EXPECT_EQ(*Version::parse("1.2.3"), (Version{1, 2, 3}));
    EXPECT_LT(*Version::parse("1.9"), *Version::parse("1.10"));
    EXPECT_EQ(Version::parse("1.2")->text(), "1.2.0");
}

TEST(VersionTest, OtherTextsAreRefused)
{
    for (const char* text : {"", "x", "1.", "1..2", "1.2.3.4", "-1", "1.-2", "1.2 ", "99999999999999", "v1"})
        EXPECT_FALSE(Version::parse(text)) << text;
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
    EXPECT_THAT(refusal("{}"), HasSubstr("\"id\": this field is missing; add it"));
    EXPECT_THAT(refusal(with("\"license\": 3")), HasSubstr("plugin.json:3:1: error: \"license\": must be a text"));
    EXPECT_THAT(refusal("{\"id\": \"Rope\"}"), HasSubstr("'Rope' is not an id; write it as org.example.name"));
    EXPECT_THAT(refusal("{\"id\": \"../x\"}"), HasSubstr("is not an id"));
    EXPECT_THAT(refusal(with("\"requires\": \"x\"")), HasSubstr("\"requires\": must be a list"));
    EXPECT_THAT(refusal(with("\"requires\": [\"a.b x\"]")), HasSubstr("'x' is not a version"));
    EXPECT_THAT(refusal(with("\"contributes\": []")), HasSubstr("must be an object of lists"));
    EXPECT_THAT(refusal(with("\"contributes\": {\"wheels\": []}")),
                HasSubstr("is not a kind of contribution; known are tools, effects"));
    EXPECT_THAT(refusal(with("\"contributes\": {\"tools\": {}}")), HasSubstr("must be a list"));
    EXPECT_THAT(refusal(with("\"contributes\": {\"tools\": [3]}")), HasSubstr("must be an object with \"id\""));
    EXPECT_THAT(refusal(with("\"contributes\": {\"tools\": [{\"label\": \"x\"}]}")),
                HasSubstr("\"id\": this field is missing"));
    EXPECT_THAT(refusal(with("\"contributes\": {\"importers\": [{\"id\": \"x\", \"label\": \"x\"}]}")),
                HasSubstr("needs \"extensions\""));
    EXPECT_THAT(
        refusal(with(
            "\"contributes\": {\"effects\": [{\"id\": \"x\", \"label\": \"x\"}, {\"id\": \"x\", \"label\": \"y\"}]}")),
        HasSubstr("declares 'x' twice"));
    EXPECT_THAT(refusal("{\"id\": \"a.b\", \"name\": \"x\", \"library\": \"../../evil\"}"), HasSubstr("without '/'"));
    EXPECT_THAT(refusal("{\"id\": \"\xff\"}"), HasSubstr("not valid JSON"));
    EXPECT_THAT(refusal(with("\"builtFor\": 3")), HasSubstr("this field is missing"));
}

TEST(ManifestTest, DeepNestingAndTruncationsAreNoCrash)
{
    EXPECT_NE(refusal(std::string(100'000, '[')), "accepted");
    const std::string text = with("\"contributes\": {\"tools\": [{\"id\": \"x\", \"label\": \"y\"}]}");
    for (std::size_t i = 0; i < text.size(); ++i) EXPECT_NE(refusal(text.substr(0, i)), "accepted") << i;
}

}  // namespace
}  // namespace jet::host
