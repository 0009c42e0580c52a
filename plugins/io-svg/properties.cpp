// The properties JET draws, one row each.
#include "color.hpp"
#include "style.hpp"

#include <algorithm>
#include <cmath>

namespace jet::svg {

namespace {

using Value = std::string_view;
using Lengths = const LengthContext&;

template <class T>
bool assign(T& target, const std::optional<T>& value)
{
    if (value) target = *value;
    return value.has_value();
}

template <auto Member>
void copy(Style& style, const Style& from)
{
    style.*Member = from.*Member;
}

bool readFontSize(Style& style, Value value, Lengths lengths)
{
    static constexpr std::pair<Value, double> kNamed[] = {{"xx-small", 6.94}, {"x-small", 8.33}, {"small", 10},
                                                          {"medium", 12},     {"large", 14.4},   {"x-large", 17.28},
                                                          {"xx-large", 20.74}};
    for (const auto& [name, size] : kNamed) {
        if (value == name) return style.fontSize = size, true;
    }
    LengthContext ofFont = lengths;
    ofFont.viewport = Vec2(lengths.fontSize, lengths.fontSize);  // 100 % is the parent's size
    const std::optional<double> size = parseLength(value, ofFont, Axis::X);
    return size && *size >= 0 && assign(style.fontSize, size);
}

// url(#id) or url("#id"), with the quotes and spaces people write; takes it from the front of `value`.
std::optional<Value> takeUrl(Value& value)
{
    if (!value.starts_with("url(")) return {};
    const std::size_t end = value.find(')');
    if (end == value.npos) return {};
    Value inside = trimmed(value.substr(4, end - 4));
    value = trimmed(value.substr(end + 1));
    if (inside.size() >= 2 && (inside.front() == '"' || inside.front() == '\'')) {
        inside = trimmed(inside.substr(1, inside.size() - 2));
    }
    return inside.starts_with('#') ? inside.substr(1) : Value();
}

bool readPlainPaint(Paint& paint, Value value)
{
    if (value == "none") return paint.kind = Paint::Kind::None, true;
    if (equalsIgnoringCase(value, "currentColor")) return paint.kind = Paint::Kind::CurrentColor, true;
    Value rest = value;
    if (!assign(paint.color, takeColor(rest))) return false;
    rest = trimmed(rest);
    if (!rest.empty() && !rest.starts_with("icc-color")) return false;
    return paint.kind = Paint::Kind::Color, true;
}

bool readPaint(Paint& paint, Value value)
{
    const std::optional<Value> server = takeUrl(value);
    Paint result;
    if (!server) {
        if (!readPlainPaint(result, value)) return false;
        return paint = result, true;
    }
    if (!value.empty()) {
        if (!readPlainPaint(result, value)) return false;
        result.fallback = result.kind;
        result.hasFallback = true;
    }
    result.kind = Paint::Kind::Server;
    result.server = *server;
    return paint = result, true;
}

bool readRatio(double& target, Value value)
{
    const std::optional<double> ratio = parseRatio(value);
    return ratio && assign(target, std::optional(std::clamp(*ratio, 0.0, 1.0)));
}

bool readFillRule(Style& style, Value value, Lengths)
{
    if (value != "nonzero" && value != "evenodd") return false;
    style.fillRule = value == "evenodd" ? FillRule::EvenOdd : FillRule::NonZero;
    return true;
}

bool readStrokeWidth(Style& style, Value value, Lengths lengths)
{
    const std::optional<double> width = parseLength(value, lengths, Axis::Diagonal);
    return width && *width >= 0 && assign(style.strokeWidth, width);
}

bool readCap(Style& style, Value value, Lengths)
{
    if (value != "butt" && value != "round" && value != "square") return false;
    return style.cap = value, true;
}

bool readJoin(Style& style, Value value, Lengths)
{
    if (value == "miter-clip" || value == "arcs") value = "miter";
    if (value != "miter" && value != "round" && value != "bevel") return false;
    return style.join = value, true;
}

bool readMiterLimit(Style& style, Value value, Lengths)
{
    const std::optional<double> limit = parseNumber(value);
    return limit && *limit >= 1 && assign(style.miterLimit, limit);
}

bool readDashes(Style& style, Value value, Lengths lengths)
{
    if (value == "none") return style.dashes = nullptr, true;
    std::vector<double> dashes;
    double sum = 0;
    while (!value.empty()) {
        const std::optional<double> dash = takeLength(value, lengths, Axis::Diagonal);
        if (!dash || *dash < 0) return false;
        dashes.push_back(*dash);
        sum += *dash;
        skipCommaSpace(value);
    }
    if (!(sum > 0)) return style.dashes = nullptr, true;
    return style.dashes = std::make_shared<const std::vector<double>>(std::move(dashes)), true;
}

bool readPaintOrder(Style& style, Value value, Lengths)
{
    std::vector<Value> words;
    while (!value.empty()) {
        const std::size_t end = std::min(value.find(' '), value.size());
        const Value word = value.substr(0, end);
        value = trimmed(value.substr(end));
        const bool known = word == "fill" || word == "stroke" || word == "markers" || word == "normal";
        if (!known || std::find(words.begin(), words.end(), word) != words.end()) return style.order = {}, true;
        words.push_back(word);
    }
    const auto place = [&](Value word) { return std::find(words.begin(), words.end(), word) - words.begin(); };
    style.order.strokeFirst = place("stroke") < place("fill");
    style.order.markersFirst = place("markers") == 0;
    return true;
}

template <bool Start, bool Mid, bool End>
bool readMarker(Style& style, Value value, Lengths)
{
    const Value id = takeUrl(value).value_or(Value());
    if (Start) style.markers[0] = id;
    if (Mid) style.markers[1] = id;
    if (End) style.markers[2] = id;
    return true;
}

template <std::size_t Which>
void copyMarker(Style& style, const Style& from)
{
    style.markers[Which] = from.markers[Which];
}

template <bool Style::*Flag>
bool readReference(Style& style, Value value, Lengths)
{
    return style.*Flag = value != "none", true;
}

bool readAnchor(Style& style, Value value, Lengths)
{
    if (value != "start" && value != "middle" && value != "end") return false;
    return style.anchor = value, true;
}

bool readWeight(Style& style, Value value, Lengths)
{
    return style.bold = value == "bold" || value == "bolder" || parseNumber(value).value_or(400) >= 600, true;
}

bool readStopColor(Style& style, Value value, Lengths)
{
    if (equalsIgnoringCase(value, "currentColor")) return style.stopColor = style.color, true;
    return assign(style.stopColor, parseColor(value));
}

const PropertyRule kRules[] = {
    {"font-size", true, readFontSize, copy<&Style::fontSize>},
    {"color", true, [](Style& s, Value v, Lengths) { return assign(s.color, parseColor(v)); }, copy<&Style::color>},
    {"fill", true, [](Style& s, Value v, Lengths) { return readPaint(s.fill, v); }, copy<&Style::fill>},
    {"fill-opacity", true, [](Style& s, Value v, Lengths) { return readRatio(s.fillOpacity, v); },
     copy<&Style::fillOpacity>},
    {"fill-rule", true, readFillRule, copy<&Style::fillRule>},
    {"stroke", true, [](Style& s, Value v, Lengths) { return readPaint(s.stroke, v); }, copy<&Style::stroke>},
    {"stroke-opacity", true, [](Style& s, Value v, Lengths) { return readRatio(s.strokeOpacity, v); },
     copy<&Style::strokeOpacity>},
    {"stroke-width", true, readStrokeWidth, copy<&Style::strokeWidth>},
    {"stroke-linecap", true, readCap, copy<&Style::cap>},
    {"stroke-linejoin", true, readJoin, copy<&Style::join>},
    {"stroke-miterlimit", true, readMiterLimit, copy<&Style::miterLimit>},
    {"stroke-dasharray", true, readDashes, copy<&Style::dashes>},
    {"stroke-dashoffset", true,
     [](Style& s, Value v, Lengths l) { return assign(s.dashOffset, parseLength(v, l, Axis::Diagonal)); },
     copy<&Style::dashOffset>},
    {"visibility", true, [](Style& s, Value v, Lengths) { return s.visible = v == "visible", true; },
     copy<&Style::visible>},
    {"paint-order", true, readPaintOrder, copy<&Style::order>},
    {"marker", true, readMarker<true, true, true>, copy<&Style::markers>, false},
    {"marker-start", true, readMarker<true, false, false>, copyMarker<0>},
    {"marker-mid", true, readMarker<false, true, false>, copyMarker<1>},
    {"marker-end", true, readMarker<false, false, true>, copyMarker<2>},
    {"font-family", true, [](Style& s, Value v, Lengths) { return s.fontFamily = v, true; }, copy<&Style::fontFamily>},
    {"font-weight", true, readWeight, copy<&Style::bold>},
    {"font-style", true, [](Style& s, Value v, Lengths) { return s.italic = v != "normal", true; },
     copy<&Style::italic>},
    {"white-space", true, [](Style& s, Value v, Lengths) { return s.whiteSpace = v, true; }, copy<&Style::whiteSpace>},
    {"text-anchor", true, readAnchor, copy<&Style::anchor>},
    {"dominant-baseline", false, [](Style& s, Value v, Lengths) { return s.baseline = v, true; },
     copy<&Style::baseline>},
    {"display", false, [](Style& s, Value v, Lengths) { return s.display = v != "none", true; }, copy<&Style::display>},
    {"opacity", false, [](Style& s, Value v, Lengths) { return readRatio(s.opacity, v); }, copy<&Style::opacity>},
    {"clip-path", false, readReference<&Style::hasClipPath>, copy<&Style::hasClipPath>},
    {"mask", false, readReference<&Style::hasMask>, copy<&Style::hasMask>},
    {"filter", false, readReference<&Style::hasFilter>, copy<&Style::hasFilter>},
    {"overflow", false,
     [](Style& s, Value v, Lengths) { return s.overflowVisible = v == "visible" || v == "auto", true; },
     copy<&Style::overflowVisible>},
    {"vector-effect", false, [](Style& s, Value v, Lengths) { return s.fixedStroke = v == "non-scaling-stroke", true; },
     copy<&Style::fixedStroke>},
    {"transform", false, [](Style& s, Value v, Lengths) { return s.transform = v, true; }, copy<&Style::transform>,
     false},
    {"stop-color", false, readStopColor, copy<&Style::stopColor>},
    {"stop-opacity", false, [](Style& s, Value v, Lengths) { return readRatio(s.stopOpacity, v); },
     copy<&Style::stopOpacity>},
};

}  // namespace

std::span<const PropertyRule> propertyRules() { return kRules; }

int findProperty(std::string_view name)
{
    static const auto index = [] {
        std::unordered_map<std::string_view, int> map;
        for (int i = 0; i < int(std::size(kRules)); ++i) map.emplace(kRules[i].name, i);
        return map;
    }();
    const auto found = index.find(name);
    return found == index.end() ? -1 : found->second;
}

}  // namespace jet::svg
