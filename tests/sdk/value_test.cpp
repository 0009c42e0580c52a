#include "geometry_samples.hpp"

#include <jet/value.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <set>

namespace jet {
namespace {

using test::Random;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(NumberTest, IsWrittenWithTheFewestDigitsAPersonWouldUse)
{
    const std::vector<std::pair<double, std::string>> cases{{0, "0"},
                                                            {-0.0, "-0"},
                                                            {1, "1"},
                                                            {-12, "-12"},
                                                            {0.1, "0.1"},
                                                            {100000, "100000"},
                                                            {1e14, "100000000000000"},
                                                            {1e15, "1e+15"},
                                                            {0.00001, "0.00001"},
                                                            {1e-6, "1e-06"},
                                                            {1.0 / 3, "0.3333333333333333"},
                                                            {5e-324, "5e-324"},
                                                            {-2.5, "-2.5"},
                                                            {1.7976931348623157e308, "1.7976931348623157e+308"}};
    for (const auto& [value, text] : cases) EXPECT_EQ(numberText(value), text);
}

TEST(NumberTest, ReadsBackToTheSameBits)
{
    Random random(1);
    for (int i = 0; i < 100'000; ++i) {
        const double value = i % 2 ? std::bit_cast<double>(random.bits()) : random.real(-1e6, 1e6);
        if (!std::isfinite(value)) continue;
        const std::string text = numberText(value);
        std::string_view rest = text;
        double read = 0;
        ASSERT_TRUE(readNumber(rest, read)) << text;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(value)) << text;
        EXPECT_TRUE(rest.empty()) << text;
    }
}

TEST(NumberTest, ReadingStopsWhereTheNumberEnds)
{
    struct Case {
        std::string text;
        double value;
        std::string rest;
    };
    for (const Case& c : std::vector<Case>{{"1.5.5", 1.5, ".5"},
                                           {"1-2", 1, "-2"},
                                           {"+3", 3, ""},
                                           {"-.5e1x", -5, "x"},
                                           {"1em", 1, "em"},
                                           {"1e", 1, "e"},
                                           {"1e+", 1, "e+"},
                                           {"2.", 2, ""},
                                           {"0x10", 0, "x10"},
                                           {"1e-999", 0, ""},
                                           {"-0", -0.0, ""}}) {
        std::string_view rest = c.text;
        double value = 99;
        ASSERT_TRUE(readNumber(rest, value)) << c.text;
        EXPECT_EQ(value, c.value) << c.text;
        EXPECT_EQ(std::signbit(value), std::signbit(c.value)) << c.text;
        EXPECT_EQ(rest, c.rest) << c.text;
    }
}

TEST(NumberTest, WhatIsNoNumberIsNotReadAndChangesNothing)
{
    for (const std::string text :
         {"", "-", "+", ".", "-.", "e5", "inf", "nan", "-inf", "--1", "+-1", " 1", "1e999", "-1e999"}) {
        std::string_view rest = text;
        double value = 7;
        EXPECT_FALSE(readNumber(rest, value)) << text;
        EXPECT_EQ(value, 7) << text;
        EXPECT_EQ(rest, text);
    }
}

TEST(NumberTest, ThousandsOfDigitsAreRead)
{
    const std::string digits = "0." + std::string(5000, '3');
    std::string_view rest = digits;
    double value = 0;
    ASSERT_TRUE(readNumber(rest, value));
    EXPECT_EQ(value, 1.0 / 3);
    const std::string huge(5000, '9');
    rest = huge;
    EXPECT_FALSE(readNumber(rest, value));
}

TEST(NumberTest, DoesNotDependOnTheLocale)
{
    const std::string before = std::setlocale(LC_NUMERIC, nullptr);
    for (const char* name : {"de_DE.UTF-8", "de_AT.UTF-8", "fr_FR.UTF-8"}) std::setlocale(LC_NUMERIC, name);
    EXPECT_EQ(numberText(1.5), "1.5");
    EXPECT_EQ(Value::parse(ValueKind::Real, "1.5").orThrow(), Value(1.5));
    EXPECT_FALSE(Value::parse(ValueKind::Real, "1,5"));
    std::setlocale(LC_NUMERIC, before.c_str());
}

TEST(ColorTest, TextLeavesOutFullOpacity)
{
    EXPECT_EQ((Color{255, 128, 0}.text()), "#ff8000");
    EXPECT_EQ((Color{1, 2, 3, 4}.text()), "#01020304");
}

TEST(ColorTest, EveryWayToWriteAColourIsRead)
{
    const std::vector<std::pair<std::string, Color>> cases{{"#f80", {255, 136, 0}},
                                                           {"#FF8000", {255, 128, 0}},
                                                           {"#ff800040", {255, 128, 0, 64}},
                                                           {"orange", {255, 165, 0}},
                                                           {"DarkSlateGrey", {47, 79, 79}},
                                                           {"aliceblue", {240, 248, 255}},
                                                           {"green", {0, 128, 0}},
                                                           {"yellowgreen", {154, 205, 50}},
                                                           {"gray", {128, 128, 128}},
                                                           {"maroon", {128, 0, 0}},
                                                           {"lightgoldenrodyellow", {250, 250, 210}}};
    for (const auto& [text, color] : cases) EXPECT_EQ(Color::parse(text).orThrow(), color) << text;
}

TEST(ColorTest, TextReadsBack)
{
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const std::uint64_t bits = random.bits();
        const auto channel = [bits](int shift) { return static_cast<std::uint8_t>(bits >> shift); };
        const Color color{channel(0), channel(8), channel(16), channel(24)};
        EXPECT_EQ(Color::parse(color.text()).orThrow(), color);
    }
}

TEST(ColorTest, WhatIsNoColourIsRefusedWithAnExample)
{
    for (const std::string text :
         {"", "#", "#ff", "#ffff", "#fffff", "#ggg", "#ff80000", "#ff80004040", "oran", "orangee", " red", "#+1+1+1"}) {
        const Result<Color> color = Color::parse(text);
        ASSERT_FALSE(color) << text;
        EXPECT_NE(color.error().message.find("#ff8000"), std::string::npos);
    }
}

TEST(ValueTest, KnowsItsKind)
{
    EXPECT_EQ(Value().kind(), ValueKind::None);
    EXPECT_EQ(Value(true).kind(), ValueKind::Bool);
    EXPECT_EQ(Value(1).kind(), ValueKind::Integer);
    EXPECT_EQ(Value(1.0).kind(), ValueKind::Real);
    EXPECT_EQ(Value(Vec2(1, 2)).kind(), ValueKind::Vec2);
    EXPECT_EQ(Value(Color{}).kind(), ValueKind::Color);
    EXPECT_EQ(Value("text").kind(), ValueKind::Text);
    EXPECT_EQ(Value(ItemId{3}).kind(), ValueKind::Item);
    EXPECT_EQ(Value(Path()).kind(), ValueKind::Path);
    EXPECT_EQ(Value(RawText{"x"}).kind(), ValueKind::Raw);
}

TEST(ValueTest, GivesItsContentAsTheRightTypeOnly)
{
    EXPECT_EQ(Value(12).as<int>(), 12);
    EXPECT_EQ(Value(12).as<double>(), 12.0);
    EXPECT_EQ(Value("a").as<std::string>(), "a");
    EXPECT_EQ(Value(Vec2(1, 2)).as<Vec2>(), Vec2(1, 2));
    EXPECT_THROW(Value(1.5).as<int>(), Failure);
    EXPECT_THROW(Value(std::int64_t{1} << 40).as<int>(), Failure);
    EXPECT_THROW(Value().as<Path>(), Failure);
    try {
        Value("abc").as<double>();
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.error().message, "Expected a real number, but the value is a text.");
    }
}

TEST(ValueTest, EqualityIsBitForBit)
{
    EXPECT_EQ(Value(kNaN), Value(kNaN));
    EXPECT_NE(Value(0.0), Value(-0.0));
    EXPECT_NE(Value(1), Value(1.0));
    EXPECT_EQ(Value(Vec2(kNaN, 1)), Value(Vec2(kNaN, 1)));
    EXPECT_NE(Value(Vec2(0, 1)), Value(Vec2(-0.0, 1)));
    EXPECT_EQ(Value(Path::line({kNaN, 0}, {1, 1})), Value(Path::line({kNaN, 0}, {1, 1})));
    EXPECT_NE(Value(Path::line({0, 0}, {1, 1})), Value(Path::line({-0.0, 0}, {1, 1})));
    EXPECT_EQ(Value("a"), Value(std::string("a")));
    EXPECT_NE(Value("a"), Value(RawText{"a"}));
    EXPECT_EQ(Value(), Value());
}

TEST(ValueTest, TextReadsBackAsTheSameValue)
{
    const std::vector<std::pair<ValueKind, Value>> cases{
        {ValueKind::None, Value()},
        {ValueKind::Bool, Value(true)},
        {ValueKind::Bool, Value(false)},
        {ValueKind::Integer, Value(std::numeric_limits<std::int64_t>::min())},
        {ValueKind::Integer, Value(std::numeric_limits<std::int64_t>::max())},
        {ValueKind::Real, Value(-0.0)},
        {ValueKind::Real, Value(0.1)},
        {ValueKind::Real, Value(3.0)},
        {ValueKind::Vec2, Value(Vec2(-1.5, 1e-300))},
        {ValueKind::Color, Value(Color{1, 2, 3, 4})},
        {ValueKind::Text, Value(" any \n text ")},
        {ValueKind::Choice, Value("round")},
        {ValueKind::Item, Value(ItemId{18446744073709551615u})},
        {ValueKind::Path, Value(Path::ellipse(Box({0, 0}, {1, 3})))},
        {ValueKind::Raw, Value(RawText{"<?>"})},
    };
    for (const auto& [kind, value] : cases)
        EXPECT_EQ(Value::parse(kind, value.text()).orThrow(), value) << value.text();
    EXPECT_EQ(Value(Vec2(1, -2.5)).text(), "1 -2.5");
    EXPECT_EQ(Value(true).text(), "true");
}

TEST(ValueTest, MalformedTextIsRefusedWithWhatWasExpected)
{
    struct Case {
        ValueKind kind;
        std::string text, expected;
    };
    for (const Case& c : std::vector<Case>{{ValueKind::None, "x", "no value"},
                                           {ValueKind::Bool, "1", "true or false"},
                                           {ValueKind::Bool, "True", "true or false"},
                                           {ValueKind::Integer, "", "an integer"},
                                           {ValueKind::Integer, "1.5", "an integer"},
                                           {ValueKind::Integer, "12 ", "an integer"},
                                           {ValueKind::Integer, "99999999999999999999", "an integer"},
                                           {ValueKind::Real, "", "a number"},
                                           {ValueKind::Real, "nan", "a number"},
                                           {ValueKind::Real, "inf", "a number"},
                                           {ValueKind::Real, "-infinity", "a number"},
                                           {ValueKind::Real, "1e999", "a number"},
                                           {ValueKind::Real, "1.5x", "a number"},
                                           {ValueKind::Real, " 1", "a number"},
                                           {ValueKind::Vec2, "1", "two numbers"},
                                           {ValueKind::Vec2, "1 2 3", "two numbers"},
                                           {ValueKind::Vec2, "1 nan", "two numbers"},
                                           {ValueKind::Vec2, "1-2", "two numbers"},
                                           {ValueKind::Color, "reddish", "a colour"},
                                           {ValueKind::Item, "-1", "an item"},
                                           {ValueKind::Item, "#3", "an item"},
                                           {ValueKind::Path, "M 0", "a number"}}) {
        const Result<Value> value = Value::parse(c.kind, c.text);
        ASSERT_FALSE(value) << c.text;
        EXPECT_NE(value.error().message.find(c.expected), std::string::npos) << value.error().message;
    }
}

TEST(ValueTest, AMessageDoesNotRepeatPagesOfText)
{
    const Result<Value> value = Value::parse(ValueKind::Real, std::string(100'000, 'x'));
    ASSERT_FALSE(value);
    EXPECT_LT(value.error().message.size(), 300u);
}

TEST(ValueTest, EveryKindHasItsOwnName)
{
    std::set<std::string_view> names;
    for (int kind = 0; kind <= static_cast<int>(ValueKind::Raw); ++kind)
        names.insert(kindName(static_cast<ValueKind>(kind)));
    EXPECT_EQ(names.size(), static_cast<std::size_t>(ValueKind::Raw) + 1);
}

}  // namespace
}  // namespace jet
