// Camera: which part of a scene a view shows. Zooming keeps the point under the pointer where it is.
#pragma once

#include <jet/format.hpp>

namespace jet::host {

class Camera {
public:
    const View& view() const { return view_; }
    void setView(const View& view);

    Vec2 toScene(const Vec2& pixels) const { return view_.anchor + pixels / view_.scale; }
    Vec2 toPixels(const Vec2& scene) const { return (scene - view_.anchor) * view_.scale; }

    void panBy(const Vec2& pixels) { view_.anchor -= pixels / view_.scale; }
    void zoomAbout(const Vec2& pixels, double factor);
    /// Fits the box, with a margin, into a view of `size` pixels. An empty box is centred at the present zoom.
    void frame(const Box& box, const Vec2& size);
    /// The scene area seen.
    Box visibleArea(const Vec2& size) const { return {toScene(Vec2::Zero()), toScene(size)}; }

private:
    View view_;
};

}  // namespace jet::host
