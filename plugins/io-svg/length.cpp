#include "length.hpp"

#include <jet/value.hpp>

#include <array>
#include <cmath>

namespace jet::svg {

namespace {

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }

struct Unit {
    std::string_view name;
    double factor;  // user units, or of what follows
    double (*base)(const LengthContext&, Axis) = nullptr;
};

double fontSize(const LengthContext& c, Axis) { return c.fontSize; }
double windowWidth(const LengthContext& c, Axis) { return c.window.x(); }
double windowHeight(const LengthContext& c, Axis) { return c.window.y(); }
double windowSmaller(const LengthContext& c, Axis) { return c.window.minCoeff(); }
double windowLarger(const LengthContext& c, Axis) { return c.window.maxCoeff(); }
double viewportSize(const LengthContext& c, Axis axis)
{
    if (axis == Axis::X) return c.viewport.x();
    if (axis == Axis::Y) return c.viewport.y();
    return c.viewport.norm() / std::sqrt(2.0);
}

// Longer names first where one begins another.
constexpr std::array<Unit, 17> kUnits = {{
    {"px", 1},
    {"pt", 96.0 / 72},
    {"pc", 16},
    {"mm", 96 / 25.4},
    {"cm", 96 / 2.54},
    {"in", 96},
    {"q", 96 / 101.6},
    {"%", 0.01, viewportSize},
    {"rem", 16},
    {"em", 1, fontSize},
    {"ex", 0.5, fontSize},
    {"ch", 0.5, fontSize},
    {"vmin", 0.01, windowSmaller},
    {"vmax", 0.01, windowLarger},
    {"vw", 0.01, windowWidth},
    {"vh", 0.01, windowHeight},
    {"", 1},
}};

bool takeUnit(std::string_view& text, std::string_view name)
{
    if (!equalsIgnoringCase(text.substr(0, name.size()), name)) return false;
    text.remove_prefix(name.size());
    return true;
}

}  // namespace

char lower(char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; }

bool equalsIgnoringCase(std::string_view a, std::string_view b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

void skipSpace(std::string_view& text)
{
    while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
}

void skipCommaSpace(std::string_view& text)
{
    skipSpace(text);
    if (!text.empty() && text.front() == ',') {
        text.remove_prefix(1);
        skipSpace(text);
    }
}

std::optional<double> takeLength(std::string_view& text, const LengthContext& context, Axis axis)
{
    double number = 0;
    if (!readNumber(text, number)) return {};
    for (const Unit& unit : kUnits) {
        if (!takeUnit(text, unit.name)) continue;
        const double length = number * unit.factor * (unit.base ? unit.base(context, axis) : 1);
        return std::isfinite(length) ? std::optional(length) : std::nullopt;
    }
    return {};
}

std::optional<double> parseLength(std::string_view text, const LengthContext& context, Axis axis)
{
    skipSpace(text);
    const std::optional<double> length = takeLength(text, context, axis);
    skipSpace(text);
    return text.empty() ? length : std::nullopt;
}

std::optional<double> parseNumber(std::string_view text)
{
    double number = 0;
    skipSpace(text);
    if (!readNumber(text, number)) return {};
    skipSpace(text);
    return text.empty() ? std::optional(number) : std::nullopt;
}

std::optional<double> parseRatio(std::string_view text)
{
    double number = 0;
    skipSpace(text);
    if (!readNumber(text, number)) return {};
    if (takeUnit(text, "%")) number /= 100;
    skipSpace(text);
    return text.empty() ? std::optional(number) : std::nullopt;
}

std::vector<double> parseNumbers(std::string_view text, bool* complete)
{
    std::vector<double> numbers;
    double number = 0;
    skipSpace(text);
    while (readNumber(text, number)) {
        numbers.push_back(number);
        skipCommaSpace(text);
    }
    if (complete) *complete = text.empty();
    return numbers;
}

}  // namespace jet::svg
