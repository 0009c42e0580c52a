#include <jet/ui/number_expression.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace jet::ui {
namespace {

double value(std::string_view text, const NumberContext& context = {})
{
    const auto result = evaluateNumber(text, context);
    EXPECT_TRUE(result) << text << ": " << result.error().message;
    return result ? *result : NAN;
}

std::string refusal(std::string_view text, const NumberContext& context = {})
{
    const auto result = evaluateNumber(text, context);
    return result ? "accepted" : std::to_string(result.error().where.column) + ": " + result.error().message;
}

TEST(NumberExpression, ReadsNumbersAsPeopleTypeThem)
{
    const std::pair<const char*, double> cases[] = {
        {"12", 12}, {" -0.5 ", -0.5}, {"1e-3", 1e-3},   {".25", 0.25}, {"0,5", 0.5},
        {"+7", 7},  {"−3", -3},       {"1e300", 1e300}, {"0.1", 0.1},
    };
    for (const auto& [text, expected] : cases) EXPECT_EQ(value(text), expected) << text;
}

TEST(NumberExpression, CalculatesWithTheUsualPrecedence)
{
    const std::pair<const char*, double> cases[] = {
        {"2*45", 90},
        {"1+2*3", 7},
        {"(1+2)*3", 9},
        {"10/4", 2.5},
        {"2-3-4", -5},
        {"16/4/2", 2},
        {"-2^2", 4},
        {"2^3^2", 512},
        {"2×3÷4", 1.5},
        {"--2", 2},
        {"sqrt(2)*3", std::sqrt(2) * 3},
        {"abs(-4)", 4},
        {"round(2.5+0,1)", 3},
        {"2*pi", 2 * std::numbers::pi},
        {"sin(pi/6)*2", 2 * std::sin(std::numbers::pi / 6)},
    };
    for (const auto& [text, expected] : cases) EXPECT_EQ(value(text), expected) << text;
}

TEST(NumberExpression, ConvertsUnitsOfTheFieldsKind)
{
    EXPECT_DOUBLE_EQ(value("25.4 mm", {"units", {}}), 96);
    EXPECT_DOUBLE_EQ(value("1in + 2.54cm", {"units", {}}), 192);
    EXPECT_DOUBLE_EQ(value("72pt", {"units", {}}), 96);
    EXPECT_DOUBLE_EQ(value("180 deg", {"rad", {}}), std::numbers::pi);
    EXPECT_DOUBLE_EQ(value("(90+90)°", {"rad", {}}), std::numbers::pi);
    EXPECT_DOUBLE_EQ(value("16 ms", {"s", {}}), 0.016);
    EXPECT_DOUBLE_EQ(value("1.5 t", {"kg", {}}), 1500);
}

TEST(NumberExpression, TheFieldsOwnUnitMayStandBehindTheNumber)
{
    for (const char* unit : {"units", "units/s²", "force·s/unit", "× rest length", "kg", "1/s"})
        EXPECT_EQ(value(std::string("5 ") + unit, {unit, {}}), 5) << unit;
    EXPECT_EQ(value("10 units * 2", {"units", {}}), 20);
}

TEST(NumberExpression, PercentAndXAreOfThePresentValue)
{
    EXPECT_EQ(value("50%", {"", 30.0}), 15);
    EXPECT_EQ(value("x*2+1", {"", 30.0}), 61);
    EXPECT_EQ(value("100% + 10%", {"", 30.0}), 33);
    EXPECT_EQ(refusal("50%"), "4: The present values differ, so they cannot be used here.");
}

TEST(NumberExpression, SaysWhatIsWrongAndWhere)
{
    const std::pair<const char*, const char*> cases[] = {
        {"", "1: The expression ends too early."},
        {"2*", "3: The expression ends too early."},
        {"(2+3", "5: A closing bracket is missing."},
        {"2+3)", "4: \")\" has no meaning here."},
        {"2 3", "3: \"3\" has no meaning here."},
        {"1/0", "4: A division by zero has no result."},
        {"sqrt(-1)", "9: The result is not a number that can be used."},
        {"1e300*1e300", "12: The result is not a number that can be used."},
        {"foo", "1: \"foo\" is not known here."},
        {"sqrt 4", "6: After \"sqrt\" there should be a value in brackets."},
        {"nan", "1: \"nan\" is not known here."},
        {"10 mm", "4: \"mm\" is no unit of this field, which is a plain number."},
    };
    for (const auto& [text, message] : cases) EXPECT_EQ(refusal(text), message) << text;
    EXPECT_EQ(refusal("10 mm", {"kg", {}}), "4: \"mm\" is no unit of this field; it takes kg, g, t.");
}

TEST(NumberExpression, HostileInputIsRefusedOrRead)
{
    EXPECT_EQ(refusal(std::string(2000, '1')), "0: The expression is longer than 1000 characters.");
    EXPECT_EQ(refusal(std::string(999, '(')), "51: The expression is nested too deep.");
    EXPECT_EQ(refusal(std::string(999, '-')), "100: The expression is nested too deep.");
    EXPECT_EQ(refusal("2" + std::string(499, '^') + "2"), "3: A number should be here.");
    std::mt19937 random(5);
    const std::string pieces[] = {"1",  "2.5",   "e",  "x",  "(",    ")", "+", "-", "*",    "/",
                                  "^",  "%",     " ",  "mm", "sqrt", ",", ".", "°", "\xff", std::string(1, '\0'),
                                  "pi", "1e308", "inf"};
    for (int i = 0; i < 20000; ++i) {
        std::string text;
        for (std::size_t n = random() % 12; n > 0; --n) text += pieces[random() % std::size(pieces)];
        const auto result = evaluateNumber(text, {"units", 3.0});
        if (result) {
            EXPECT_TRUE(std::isfinite(*result)) << text;
        } else {
            EXPECT_FALSE(result.error().message.empty()) << text;
        }
    }
}

}  // namespace
}  // namespace jet::ui
