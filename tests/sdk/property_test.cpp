#include <jet/property.hpp>

#include <gtest/gtest.h>

namespace jet {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const PropertyTable& table()
{
    static const PropertyTable table{
        real("mass", "Mass", 1).in("kg").range(0.001, 1e6),
        flag("fixed", "Fixed", false),
        integer("count", "Count", 3).range(0, 10),
        vector("velocity", "Velocity", {1, 2}).in("units/s").range(-100, 100),
        color("fill", "Fill", {255, 0, 0}),
        text("script", "Script", "", true),
        choice("join", "Join", {"miter", "round", "bevel"}).says("How edges meet."),
        real("stiffness", "Stiffness", 10).range(0, kInfinity),
    };
    return table;
}

std::string refusal(std::string_view id, const Value& value)
{
    const Result<void> result = table().find(id)->check(value);
    return result ? "accepted" : result.error().message;
}

TEST(PropertyTableTest, KeepsTheOrderPeopleSeeAndFindsById)
{
    EXPECT_EQ(table().specs().front().id, "mass");
    EXPECT_EQ(table().specs().back().id, "stiffness");
    ASSERT_NE(table().find("join"), nullptr);
    EXPECT_EQ(table().find("join")->help, "How edges meet.");
    EXPECT_EQ(table().find("nothing"), nullptr);
}

TEST(PropertyTableTest, DeclarationsCarryKindDefaultAndUnit)
{
    EXPECT_EQ(table().find("mass")->kind, ValueKind::Real);
    EXPECT_EQ(table().find("mass")->unit, "kg");
    EXPECT_EQ(table().find("mass")->fallback, Value(1.0));
    EXPECT_EQ(table().find("join")->fallback, Value("miter"));
    EXPECT_TRUE(table().find("script")->multiline);
}

TEST(PropertySpecTest, EveryDefaultPassesItsOwnCheck)
{
    for (const PropertySpec& spec : table().specs()) EXPECT_TRUE(spec.check(spec.fallback)) << spec.id;
}

TEST(PropertySpecTest, TheEndsOfARangeBelongToIt)
{
    EXPECT_EQ(refusal("mass", 0.001), "accepted");
    EXPECT_EQ(refusal("mass", 1e6), "accepted");
    EXPECT_EQ(refusal("mass", 5), "accepted");  // an integer reads as a real
    EXPECT_EQ(refusal("count", 10), "accepted");
}

TEST(PropertySpecTest, ARefusalNamesPropertyValueAndRange)
{
    EXPECT_EQ(refusal("mass", -1.0), "Property \"mass\" must be from 0.001 to 1000000 kg, but is -1 kg.");
    EXPECT_EQ(refusal("mass", "heavy"), "Property \"mass\" must be a real number, but has a text, \"heavy\".");
    EXPECT_EQ(refusal("mass", Value()), "Property \"mass\" must be a real number, but has no value.");
    EXPECT_EQ(refusal("mass", kNaN), "Property \"mass\" must be finite, but is nan kg.");
    EXPECT_EQ(refusal("stiffness", -2.0), "Property \"stiffness\" must be at least 0, but is -2.");
    EXPECT_EQ(refusal("count", 11), "Property \"count\" must be from 0 to 10, but is 11.");
    EXPECT_EQ(refusal("count", 1.0), "Property \"count\" must be an integer, but has a real number, 1.");
    EXPECT_EQ(refusal("velocity", Vec2(0, 101)),
              "Property \"velocity\" must be from -100 to 100 units/s, but is 0 101 units/s.");
    EXPECT_EQ(refusal("join", "sharp"), "Property \"join\" must be one of miter, round, bevel, but is \"sharp\".");
    EXPECT_EQ(refusal("fixed", RawText{"yes"}),
              "Property \"fixed\" must be true or false, but has a text of unknown kind, \"yes\".");
}

TEST(PropertySpecTest, InfinityIsOutOfAnOpenRangeToo)
{
    EXPECT_NE(refusal("stiffness", kInfinity), "accepted");
    EXPECT_NE(refusal("velocity", Vec2(kInfinity, 0)), "accepted");
    PropertySpec outline;
    outline.id = "outline";
    outline.kind = ValueKind::Path;
    EXPECT_TRUE(outline.check(Path::line({0, 0}, {1, 1})));
    EXPECT_FALSE(outline.check(Path::line({0, kNaN}, {1, 1})));
}

TEST(PropertiesTest, StaySortedByIdWhateverTheOrderOfSetting)
{
    Properties a{{"b", 1}, {"c", 2}, {"a", 3}}, b;
    b.set("c", 2);
    b.set("a", 0);
    b.set("b", 1);
    b.set("a", 3);
    EXPECT_EQ(a, b);
    ASSERT_EQ(a.entries().size(), 3u);
    EXPECT_EQ(a.entries()[0].first, "a");
    EXPECT_EQ(a.entries()[1].first, "b");
    EXPECT_EQ(a.entries()[2].first, "c");
}

TEST(PropertiesTest, ALaterEntryOfTheSameIdWins)
{
    const Properties properties{{"a", 1}, {"a", 2}};
    ASSERT_EQ(properties.entries().size(), 1u);
    EXPECT_EQ(*properties.find("a"), Value(2));
}

TEST(PropertiesTest, FallBackToTheDeclaredDefault)
{
    const Properties properties{{"mass", 5.0}, {"unknown", RawText{"kept"}}};
    EXPECT_EQ(properties.get("mass", table()), Value(5.0));
    EXPECT_EQ(properties.get("fixed", table()), Value(false));
    EXPECT_EQ(properties.get("unknown", table()), Value(RawText{"kept"}));
    EXPECT_THROW(properties.get("nothing", table()), Failure);
}

TEST(PropertiesTest, ErasingTellsWhetherThereWasOne)
{
    Properties properties{{"a", 1}, {"b", 2}};
    EXPECT_TRUE(properties.erase("a"));
    EXPECT_FALSE(properties.erase("a"));
    EXPECT_EQ(properties.find("a"), nullptr);
    EXPECT_NE(properties.find("b"), nullptr);
    EXPECT_FALSE(properties.isEmpty());
}

}  // namespace
}  // namespace jet
