#include "host/plugins/suggest.hpp"
#include "host/plugins/versions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace jet::host {
namespace {

using testing::HasSubstr;

Version v(const char* text) { return *Version::parse(text); }

TEST(VersionTest, MissingPartsAreZero)
{
    EXPECT_EQ(v("1"), (Version{1, 0, 0}));
    EXPECT_EQ(v("1.20"), (Version{1, 20, 0}));
    EXPECT_EQ(v("1.2.3"), (Version{1, 2, 3}));
    EXPECT_LT(v("1.9"), v("1.10"));
    EXPECT_EQ(v("1.2").text(), "1.2.0");
}

TEST(VersionTest, OtherTextsAreRefused)
{
    for (const char* text : {"", "x", "1.", "1..2", "1.2.3.4", "-1", "1.-2", "1.2 ", "99999999999999", "v1", "+1"})
        EXPECT_FALSE(Version::parse(text)) << text;
}

struct RangeCase {
    const char* range;
    std::vector<const char*> inside, outside;
};

TEST(VersionRangeTest, EachComparatorAdmitsWhatItSays)
{
    const RangeCase cases[] = {
        {"*", {"0", "9.9.9"}, {}},
        {"1.2", {"1.2", "1.2.1", "1.9.9"}, {"1.1.9", "2", "0.9"}},
        {">=1.2", {"1.2", "7"}, {"1.1.9"}},
        {">1.2", {"1.2.1", "7"}, {"1.2"}},
        {"<3", {"0", "2.9.9"}, {"3", "3.0.1"}},
        {"<=3", {"3"}, {"3.0.1"}},
        {"=1.2.3", {"1.2.3"}, {"1.2.2", "1.2.4"}},
        {"^1.2", {"1.2", "1.99"}, {"1.1", "2"}},
        {"^0.2", {"0.2", "0.2.9"}, {"0.3", "1"}},
        {"^0.0.3", {"0.0.3"}, {"0.0.4", "0.0.2"}},
        {"^0", {"0", "0.9"}, {"1"}},
        {"~1.2", {"1.2", "1.2.9"}, {"1.3", "1.1.9"}},
        {"~1.2.3", {"1.2.3", "1.2.9"}, {"1.2.2", "1.3"}},
        {"~1", {"1", "1.9"}, {"2"}},
        {">=1.2 <3", {"1.2", "2.9"}, {"1.1", "3"}},
        {">=1 <2.5 <=2", {"1", "2"}, {"2.0.1"}},
    };
    for (const RangeCase& one : cases) {
        const auto range = VersionRange::parse(one.range);
        ASSERT_TRUE(range) << one.range;
        for (const char* version : one.inside) EXPECT_TRUE(range->admits(v(version))) << one.range << " " << version;
        for (const char* version : one.outside) EXPECT_FALSE(range->admits(v(version))) << one.range << " " << version;
    }
}

TEST(VersionRangeTest, MistakesAreTold)
{
    EXPECT_THAT(VersionRange::parse("").error().message, HasSubstr("a range of versions is missing"));
    EXPECT_THAT(VersionRange::parse(">= 1").error().message, HasSubstr("'>=' is not a version or a range"));
    EXPECT_THAT(VersionRange::parse("=>1").error().message,
                HasSubstr("'=>' is not a comparison of versions; known are"));
    EXPECT_THAT(VersionRange::parse(">=3 <2").error().message, HasSubstr("no version is in the range '>=3 <2'"));
}

TEST(VersionRangeTest, PeopleReadItInWords)
{
    EXPECT_EQ(VersionRange().inWords(), "any version");
    EXPECT_EQ(VersionRange::parse(">=1.2 <3")->inWords(), "version 1.2.0 or a later one before 3.0.0");
    EXPECT_EQ(VersionRange::parse("<3")->inWords(), "a version before 3.0.0");
    EXPECT_EQ(VersionRange::exactly({1, 2, 3}).inWords(), "version 1.2.3");
}

TEST(SuggestTest, OnlySlipsAreMended)
{
    const std::vector<std::string> known{"tools", "effects", "panels"};
    EXPECT_EQ(nearestWord("tool", known), "tools");
    EXPECT_EQ(nearestWord("efects", known), "effects");
    EXPECT_EQ(nearestWord("panles", known), "panels") << "two letters swapped";
    EXPECT_EQ(nearestWord("PANELS", known), "panels");
    EXPECT_EQ(nearestWord("wheels", known), "") << "another word";
    EXPECT_EQ(nearestWord("tools", known), "") << "the word itself is no slip";
}

}  // namespace
}  // namespace jet::host
