#include "paint_server.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace jet::svg {

namespace {

constexpr int kMostReferences = 32;  // gradients that take their stops from another that takes them from another ...

struct Stop {
    double offset;
    Eigen::Array4d color;  // premultiplied, so that a clear stop adds no tint
};

Eigen::Array4d premultiplied(const Color& c, double opacity)
{
    const double a = c.a / 255.0 * opacity;
    return {c.r * a, c.g * a, c.b * a, a};
}

Color fromPremultiplied(const Eigen::Array4d& p)
{
    const auto byte = [](double v) { return std::uint8_t(std::lround(std::clamp(v, 0.0, 255.0))); };
    if (!(p[3] > 0)) return {0, 0, 0, 0};
    return {byte(p[0] / p[3]), byte(p[1] / p[3]), byte(p[2] / p[3]), byte(255 * p[3])};
}

// The integral of the gradient over 0..1: linear pieces between the stops, constant before the first and after the
// last.
Color meanOf(const std::vector<Stop>& stops)
{
    Eigen::Array4d sum = stops.front().offset * stops.front().color + (1 - stops.back().offset) * stops.back().color;
    for (std::size_t i = 1; i < stops.size(); ++i) {
        sum += 0.5 * (stops[i].offset - stops[i - 1].offset) * (stops[i - 1].color + stops[i].color);
    }
    return fromPremultiplied(sum);
}

bool isGradient(Tag tag) { return tag == Tag::LinearGradient || tag == Tag::RadialGradient; }

}  // namespace

std::optional<Color> PaintServers::colorOf(const Paint& paint, const Style& style, ElementIndex user)
{
    const auto plain = [&](Paint::Kind kind) -> std::optional<Color> {
        if (kind == Paint::Kind::None) return {};
        return kind == Paint::Kind::CurrentColor ? style.color : paint.color;
    };
    if (paint.kind != Paint::Kind::Server) return plain(paint.kind);
    const ElementIndex server = document_.find(paint.server);
    const Tag tag = server == kNoElement ? Tag::Unknown : document_[server].tag;
    if (isGradient(tag)) {
        const std::optional<Color> color = serverColor(server, user);
        return color ? color : plain(paint.fallback);
    }
    if (tag == Tag::Pattern) {
        report_.count("patterns are not drawn; the fallback colour is taken where there is one",
                      document_.offsetOf(user));
    } else if (!paint.hasFallback) {
        report_.count("a paint refers to something that is no gradient and no pattern here; nothing is painted",
                      document_.offsetOf(user));
    }
    return plain(paint.fallback);
}

std::optional<Color> PaintServers::serverColor(ElementIndex server, ElementIndex user)
{
    const auto known = means_.find(server);
    const std::optional<Color> color = known != means_.end() ? known->second : means_[server] = mean(server);
    if (color) report_.count("gradients are drawn as one colour, their mean", document_.offsetOf(user));
    return color;
}

ElementIndex PaintServers::ownerOfStops(ElementIndex gradient) const
{
    for (int i = 0; i < kMostReferences && gradient != kNoElement && isGradient(document_[gradient].tag); ++i) {
        for (ElementIndex e = gradient + 1; e < document_[gradient].next; e = document_[e].next) {
            if (document_[e].tag == Tag::Stop) return gradient;
        }
        gradient = document_.findReference(document_[gradient].href());
    }
    return kNoElement;
}

std::optional<Color> PaintServers::mean(ElementIndex gradient)
{
    const ElementIndex owner = ownerOfStops(gradient);
    if (owner == kNoElement) return {};
    std::vector<Stop> stops;
    for (ElementIndex e = owner + 1; e < document_[owner].next; e = document_[e].next) {
        if (document_[e].tag != Tag::Stop) continue;
        const double before = stops.empty() ? 0 : stops.back().offset;
        const double offset = parseRatio(document_[e].attribute("offset")).value_or(0);
        const Style style = styles_.computeFromRoot(e);
        stops.push_back({std::clamp(offset, before, 1.0), premultiplied(style.stopColor, style.stopOpacity)});
    }
    return meanOf(stops);
}

}  // namespace jet::svg
