#include "color.hpp"

#include "document.hpp"
#include "length.hpp"

#include <array>
#include <cmath>
#include <string>

namespace jet::svg {

namespace {

std::uint8_t channel(double unit) { return std::uint8_t(std::lround(255 * std::clamp(unit, 0.0, 1.0))); }

std::optional<int> hexDigit(char c)
{
    c = lower(c);
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return {};
}

std::optional<Color> parseHex(std::string_view digits)
{
    const bool isShort = digits.size() == 3 || digits.size() == 4;
    if (!isShort && digits.size() != 6 && digits.size() != 8) return {};
    std::array<int, 8> value = {15, 15, 15, 15, 15, 15, 15, 15};
    for (std::size_t i = 0; i < digits.size(); ++i) {
        const std::optional<int> digit = hexDigit(digits[i]);
        if (!digit) return {};
        if (isShort) {
            value[2 * i] = value[2 * i + 1] = *digit;
        } else {
            value[i] = *digit;
        }
    }
    const auto byte = [&](std::size_t i) { return std::uint8_t(16 * value[2 * i] + value[2 * i + 1]); };
    return Color{byte(0), byte(1), byte(2), byte(3)};
}

// One argument of rgb() or hsl(): a number, which may be a percentage or an angle.
struct Argument {
    double value = 0;
    bool percent = false;
};

std::optional<Argument> takeArgument(std::string_view& text)
{
    Argument a;
    skipCommaSpace(text);
    if (!text.empty() && text.front() == '/') text.remove_prefix(1), skipSpace(text);
    if (!readNumber(text, a.value)) return {};
    if (text.starts_with('%')) {
        a.percent = true;
        text.remove_prefix(1);
    } else if (text.starts_with("deg")) {
        text.remove_prefix(3);
    }
    skipSpace(text);
    return a;
}

double alphaOf(const Argument& a) { return a.percent ? a.value / 100 : a.value; }

// Numbers or percentages, not both.
std::optional<Color> fromRgb(const std::array<Argument, 4>& a)
{
    if (a[0].percent != a[1].percent || a[1].percent != a[2].percent) return {};
    const auto unit = [](const Argument& v) { return v.percent ? v.value / 100 : v.value / 255; };
    return Color{channel(unit(a[0])), channel(unit(a[1])), channel(unit(a[2])), channel(alphaOf(a[3]))};
}

// CSS Color 4, section 7.1.
Color fromHsl(const std::array<Argument, 4>& a)
{
    const double hue = a[0].value - 360 * std::floor(a[0].value / 360);
    const double saturation = std::clamp(a[1].value / 100, 0.0, 1.0), light = std::clamp(a[2].value / 100, 0.0, 1.0);
    const auto component = [&](double n) {
        const double k = std::fmod(n + hue / 30, 12);
        return light - saturation * std::min(light, 1 - light) * std::max(-1.0, std::min({k - 3, 9 - k, 1.0}));
    };
    return {channel(component(0)), channel(component(8)), channel(component(4)), channel(alphaOf(a[3]))};
}

std::optional<Color> parseFunction(std::string_view name, std::string_view arguments)
{
    std::array<Argument, 4> values = {};
    values[3].value = 1;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i == 3 && arguments.empty()) break;
        const std::optional<Argument> argument = takeArgument(arguments);
        if (!argument) return {};
        values[i] = *argument;
    }
    if (!arguments.empty()) return {};
    if (equalsIgnoringCase(name, "rgb") || equalsIgnoringCase(name, "rgba")) return fromRgb(values);
    if (equalsIgnoringCase(name, "hsl") || equalsIgnoringCase(name, "hsla")) return fromHsl(values);
    return {};
}

}  // namespace

std::optional<Color> parseColor(std::string_view text)
{
    text = trimmed(text);
    if (text.empty()) return {};
    if (text.front() == '#') return parseHex(text.substr(1));
    if (const std::size_t open = text.find('('); open != text.npos) {
        if (text.back() != ')') return {};
        return parseFunction(trimmed(text.substr(0, open)), text.substr(open + 1, text.size() - open - 2));
    }
    std::string name(text);
    for (char& c : name) c = lower(c);
    if (name == "transparent") return Color{0, 0, 0, 0};
    const Result<Color> named = Color::parse(name);
    return named ? std::optional(*named) : std::nullopt;
}

std::optional<Color> takeColor(std::string_view& text)
{
    std::size_t end = 0;
    for (int depth = 0; end < text.size(); ++end) {
        if (text[end] == '(') ++depth;
        if (text[end] == ')') --depth;
        if (text[end] == ' ' && depth == 0) break;
    }
    const std::optional<Color> color = parseColor(text.substr(0, end));
    if (color) text.remove_prefix(end);
    return color;
}

}  // namespace jet::svg
