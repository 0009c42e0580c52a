#include <jet/body_point.hpp>

#include <algorithm>
#include <optional>

namespace jet {

namespace {

constexpr double kReach = 8, kRing = 5, kDot = 2;  // pixels
constexpr double kInside = 1e-3;  // of the way to the middle: a point of a body's border is taken that far inside

double pixelsPerUnit(const ToolHost& host) { return std::max(host.pixelsPerUnit(), 1e-9); }

const Item* bodyAt(ToolHost& host, const Vec2& at)
{
    const Item* top = nullptr;
    for (const Item* item : host.items().query(Box(at, at)))
        if (item->is<BodyItem>() && item->path().contains(at, FillRule::EvenOdd)) top = item;
    return top;
}

/// A point of a body: one of its border is moved inside, else nobody could tell whom it holds.
std::optional<BodyPoint> pointOf(const Item& body, const Vec2& point)
{
    const Vec2 middle = body.bounds().center();
    for (const double way : {0.0, kInside, 10 * kInside}) {
        const Vec2 inside = point + way * (middle - point);
        if (way == 0 && point != middle) continue;
        if (body.path().contains(inside, FillRule::EvenOdd))
            return BodyPoint{point, inside, body.id(), body.name(), true};
    }
    return std::nullopt;
}

std::optional<BodyPoint> snapped(ToolHost& host, const Vec2& at)
{
    const double reach = kReach / pixelsPerUnit(host);
    std::optional<BodyPoint> best;
    double nearest = reach;
    const auto consider = [&](const Item& body, const Vec2& point) {
        const double distance = (point - at).norm();
        if (distance > nearest || (best && distance == nearest && best->body != body.id())) return;
        if (auto found = pointOf(body, point)) nearest = distance, best = std::move(found);
    };
    const Vec2 around(reach, reach);
    for (const Item* item : host.items().query(Box(at - around, at + around))) {
        if (!item->is<BodyItem>()) continue;
        consider(*item, item->bounds().center());
        for (std::size_t i = 0; i < item->path().segmentCount(); ++i) consider(*item, item->path().segment(i).point);
    }
    return best;
}

}  // namespace

BodyPoint bodyPointAt(ToolHost& host, const Vec2& at, bool snap)
{
    if (snap)
        if (const auto point = snapped(host, at)) return *point;
    BodyPoint point{at, at, {}, {}, false};
    if (const Item* body = bodyAt(host, at)) point.body = body->id(), point.name = body->name();
    return point;
}

void paintBodyPoint(const BodyPoint& point, const ToolHost& host, Painter& painter)
{
    const auto circle = [&](double pixels) {
        const Vec2 half = Vec2(pixels, pixels) / pixelsPerUnit(host);
        painter.stroke(Path::ellipse(Box(point.at - half, point.at + half)), host.layerPen());
    };
    circle(kRing);
    if (!point.isBackground()) circle(kDot);
}

}  // namespace jet
