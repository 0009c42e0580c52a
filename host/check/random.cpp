#include "random.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace jet::host::check {

namespace {
constexpr double kFarthest = 1000;  // where a property has no bound of its own
}

Color Random::color()
{
    const std::uint64_t b = bits();
    return {static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(b >> 8), static_cast<std::uint8_t>(b >> 16),
            static_cast<std::uint8_t>(chance(0.5) ? 255 : b >> 24)};
}

std::string Random::text()
{
    static constexpr std::array pieces = {"a",  "Ball", " ", "<",  "&", "\"", "'",   "]]>",
                                          "\n", "\t",   "é", "漢", "😀", "0",  "-->", "\\"};
    std::string text;
    for (std::size_t n = below(6); n > 0; --n) text += pieces[below(pieces.size())];
    return text;
}

Path Random::path()
{
    const Vec2 a = point(), b = a + Vec2(between(1, 120), between(1, 120));
    switch (below(12)) {
    case 0: return {};
    case 1: return Path::line(a, b);
    case 2: return Path::polygon(std::array{a}, false);
    case 3: return Path::rectangle(Box(a, a));  // without extent
    case 4: {
        std::vector<Vec2> star;
        const std::size_t corners = 3 + below(9);
        for (std::size_t i = 0; i < corners; ++i) star.push_back(point());
        return Path::polygon(star);
    }
    case 5: {
        Path path;
        path.moveTo(a);
        for (std::size_t n = 1 + below(5); n > 0; --n) path.cubicTo(point(), point(), point());
        if (chance(0.7)) path.close();
        return path;
    }
    case 6: {
        Path path = Path::rectangle(Box(a, b));
        const Path hole = Path::ellipse(Box(a + Vec2(1, 1), 0.5 * (a + b)));
        path.contours().push_back(hole.contours().front());
        return path;
    }
    case 7:
    case 8:
    case 9: return Path::ellipse(Box(a, b));
    default: return Path::rectangle(Box(a, b));
    }
}

Affine Random::map()
{
    switch (below(4)) {
    case 0: return Affine::translation(Vec2(between(-50, 50), between(-50, 50)));
    case 1: return Affine::rotation(between(-4, 4), point());
    case 2: return Affine::scaling(Vec2(between(-2, 2), between(0.1, 2)), point());
    default: return Affine::scaling(Vec2(between(0.5, 1.5), between(0.5, 1.5)), point());
    }
}

double Random::real(const PropertySpec& spec)
{
    const double lo = std::isfinite(spec.minimum) ? spec.minimum : std::min(-kFarthest, spec.maximum - kFarthest);
    const double hi = std::isfinite(spec.maximum) ? spec.maximum : std::max(kFarthest, spec.minimum + kFarthest);
    const double pick = unit();
    if (pick < 0.05) return lo;
    if (pick < 0.10) return hi;
    if (pick < 0.15) return std::clamp(0.0, lo, hi);
    // Ranges of many powers of ten are mostly used near their lower end.
    if (pick < 0.5 && hi - lo > kFarthest) return lo + (hi - lo) * std::pow(10, between(-6, 0));
    return std::clamp(between(lo, hi), lo, hi);
}

Value Random::value(const PropertySpec& spec, const Scene& scene)
{
    if (chance(0.1)) return spec.fallback;
    switch (spec.kind) {
    case ValueKind::Bool: return Value(chance(0.5));
    case ValueKind::Integer: return Value(static_cast<std::int64_t>(std::llround(real(spec))));
    case ValueKind::Real: return Value(real(spec));
    case ValueKind::Vec2: return Value(Vec2(real(spec), real(spec)));
    case ValueKind::Color: return Value(color());
    case ValueKind::Text: return Value(text());
    case ValueKind::Choice:
        return spec.choices.empty() ? spec.fallback : Value(spec.choices[below(spec.choices.size())]);
    case ValueKind::Item: {
        const Item* target = item(scene);
        return Value(target && chance(0.8) ? target->id() : ItemId{});
    }
    case ValueKind::Path: return Value(path());
    default: return spec.fallback;
    }
}

Properties Random::properties(const PropertyTable& table, const Scene& scene)
{
    Properties properties;
    for (const PropertySpec& spec : table.specs())
        if (chance(0.6)) properties.set(spec.id, value(spec, scene));
    return properties;
}

const Item* Random::item(const Scene& scene, const std::function<bool(const Item&)>& suits)
{
    std::vector<const Item*> all;
    scene.root().walk([&](const Item& one) {
        if (one.parent() && (!suits || suits(one))) all.push_back(&one);
    });
    return all.empty() ? nullptr : all[below(all.size())];
}

}  // namespace jet::host::check
