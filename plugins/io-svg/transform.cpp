#include "transform.hpp"

#include "document.hpp"
#include "length.hpp"

#include <jet/value.hpp>

#include <numbers>
#include <vector>

namespace jet::svg {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct AngleUnit {
    std::string_view name;
    double degrees;
};
constexpr AngleUnit kAngleUnits[] = {{"deg", 1}, {"grad", 0.9}, {"rad", 1 / kDegree}, {"turn", 360}, {"px", 1}};

// The numbers between the parentheses; angles in degrees.
std::optional<std::vector<double>> parseArguments(std::string_view text)
{
    std::vector<double> values;
    skipSpace(text);
    while (!text.empty()) {
        double value = 0;
        if (!readNumber(text, value)) return {};
        for (const AngleUnit& unit : kAngleUnits) {
            if (!text.starts_with(unit.name)) continue;
            text.remove_prefix(unit.name.size());
            value *= unit.degrees;
            break;
        }
        values.push_back(value);
        skipCommaSpace(text);
    }
    return values;
}

Affine skew(double x, double y) { return Affine::fromSvg(1, std::tan(y * kDegree), std::tan(x * kDegree), 1, 0, 0); }

std::optional<Affine> single(std::string_view name, const std::vector<double>& v)
{
    const std::size_t n = v.size();
    if (name == "matrix" && n == 6) return Affine::fromSvg(v[0], v[1], v[2], v[3], v[4], v[5]);
    if (name == "translate" && (n == 1 || n == 2)) return Affine::translation({v[0], n == 2 ? v[1] : 0});
    if (name == "translateX" && n == 1) return Affine::translation({v[0], 0});
    if (name == "translateY" && n == 1) return Affine::translation({0, v[0]});
    if (name == "scale" && (n == 1 || n == 2)) return Affine::scaling({v[0], n == 2 ? v[1] : v[0]});
    if (name == "scaleX" && n == 1) return Affine::scaling({v[0], 1});
    if (name == "scaleY" && n == 1) return Affine::scaling({1, v[0]});
    if (name == "rotate" && n == 1) return Affine::rotation(v[0] * kDegree);
    if (name == "rotate" && n == 3) return Affine::rotation(v[0] * kDegree, {v[1], v[2]});
    if (name == "skewX" && n == 1) return skew(v[0], 0);
    if (name == "skewY" && n == 1) return skew(0, v[0]);
    if (name == "skew" && (n == 1 || n == 2)) return skew(v[0], n == 2 ? v[1] : 0);
    return {};
}

// xMin, xMid, xMax: the share of the free room before the picture.
double alignment(std::string_view text, std::string_view axis)
{
    const std::size_t at = text.find(axis);
    const std::string_view word = at == text.npos ? "Mid" : text.substr(at + 1, 3);
    return word == "Min" ? 0 : word == "Max" ? 1 : 0.5;
}

}  // namespace

std::optional<Affine> parseTransform(std::string_view text)
{
    Affine result;
    text = trimmed(text);
    if (text == "none") return result;
    while (!text.empty()) {
        const std::size_t open = text.find('('), close = text.find(')');
        if (open == text.npos || close == text.npos || close < open) return {};
        const auto values = parseArguments(text.substr(open + 1, close - open - 1));
        const auto step = values ? single(trimmed(text.substr(0, open)), *values) : std::nullopt;
        if (!step) return {};
        result = result * *step;
        text.remove_prefix(close + 1);
        skipCommaSpace(text);
    }
    return result;
}

std::optional<Box> parseViewBox(std::string_view text)
{
    bool complete = false;
    const std::vector<double> v = parseNumbers(text, &complete);
    if (!complete || v.size() != 4 || !(v[2] > 0) || !(v[3] > 0)) return {};
    const Box box({v[0], v[1]}, {v[0] + v[2], v[1] + v[3]});
    return box.isEmpty() || !isFinite(box.max) ? std::nullopt : std::optional(box);
}

Affine viewBoxTransform(const Box& viewBox, const Box& viewport, std::string_view preserveAspectRatio)
{
    Vec2 scale = viewport.size().cwiseQuotient(viewBox.size());
    Vec2 align(0.5, 0.5);
    if (!preserveAspectRatio.starts_with("none")) {
        const bool slice = preserveAspectRatio.find("slice") != preserveAspectRatio.npos;
        scale.setConstant(slice ? scale.maxCoeff() : scale.minCoeff());
        align = {alignment(preserveAspectRatio, "x"), alignment(preserveAspectRatio, "Y")};
    }
    const Vec2 room = viewport.size() - viewBox.size().cwiseProduct(scale);
    return Affine::translation(viewport.min + align.cwiseProduct(room)) * Affine::scaling(scale) *
           Affine::translation(-viewBox.min);
}

}  // namespace jet::svg
