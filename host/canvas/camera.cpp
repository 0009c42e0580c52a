#include "canvas/camera.hpp"

namespace jet::host {

namespace {

// Beyond these, scene coordinates lose whole pixels to rounding.
constexpr double kSmallestScale = 1e-4, kLargestScale = 1e4;
constexpr double kFrameMargin = 0.08;  // part of the view left free on each side

}  // namespace

void Camera::setView(const View& view)
{
    view_ = view;
    view_.scale = std::clamp(view.scale, kSmallestScale, kLargestScale);
}

void Camera::zoomAbout(const Vec2& pixels, double factor)
{
    const Vec2 fixed = toScene(pixels);
    view_.scale = std::clamp(view_.scale * factor, kSmallestScale, kLargestScale);
    view_.anchor = fixed - pixels / view_.scale;
}

void Camera::frame(const Box& box, const Vec2& size)
{
    if (box.isNull()) return;
    const Vec2 room = size * (1 - 2 * kFrameMargin);
    const double fit = std::min(room.x() / box.width(), room.y() / box.height());
    if (std::isfinite(fit) && fit > 0) view_.scale = std::clamp(fit, kSmallestScale, kLargestScale);
    view_.anchor = box.center() - 0.5 * size / view_.scale;
}

}  // namespace jet::host
