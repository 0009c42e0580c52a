#include "framing.hpp"

#include <cmath>

namespace jet::png {

namespace {

// Around a scene without a page, in scene units: room for the strokes at its rim, which its bounds do not count.
constexpr double kMargin = 8;

Box pageOf(const Scene& scene)
{
    const double width = scene.setting("page-width").as<double>();
    const double height = scene.setting("page-height").as<double>();
    return width > 0 && height > 0 ? Box({0, 0}, {width, height}) : Box();
}

Box shownBounds(const Scene& scene, const PoseSource* poses)
{
    Box bounds;
    scene.root().walk([&](const Item& item) {
        if (!item.visible()) return false;
        const Path* pose = poses ? poses->pose(item) : nullptr;
        const Box box = pose ? pose->bounds() : item.path().bounds();
        if (!box.isNull()) bounds.extend(box);
        return true;
    });
    return bounds;
}

// What is to be seen when nobody said which part.
Box areaOf(const ExportRequest& request)
{
    const Box page = pageOf(request.scene);
    if (!page.isNull()) return page;
    const Box bounds = shownBounds(request.scene, request.poses);
    if (bounds.isNull()) return Box({0, 0}, {1, 1});
    const bool sized = request.width > 0 || request.height > 0;
    return sized && !bounds.isEmpty() ? bounds : bounds.inflated(kMargin);
}

// A side of the picture: rounded up, but not for the dust that scaling leaves.
double pixels(double length) { return std::max(1.0, std::ceil(length - 1e-6)); }

Result<Frame> sized(double width, double height)
{
    if (!(width <= kMaxSide && height <= kMaxSide && width * height <= kMaxPixels)) {
        return Error("The picture would be " + numberText(width) + " x " + numberText(height) +
                     " pixels; at most 32768 a side and 268435456 in all can be written. Give a smaller width or "
                     "height.");
    }
    Frame frame;
    frame.width = int(width);
    frame.height = int(height);
    return frame;
}

// With a view the picture begins at its anchor and ends where it was told to, or with the scene.
Result<Frame> viewed(const ExportRequest& request)
{
    const Affine toPixels = request.view->toPixels();
    if (!(request.view->scale > 0) || !isFinite(request.view->anchor)) {
        return Error("The view to export has no size: its scale must be above 0 and its anchor finite.");
    }
    const Vec2 corner = toPixels * areaOf(request).max;
    Result<Frame> frame = sized(request.width > 0 ? request.width : pixels(corner.x()),
                                request.height > 0 ? request.height : pixels(corner.y()));
    if (frame) frame->toPixels = toPixels;
    return frame;
}

// The whole area, as large as fits, in the middle.
Result<Frame> fitted(const ExportRequest& request)
{
    const Box area = areaOf(request);
    const Vec2 size = area.size();
    double scale = 1;
    if (request.width > 0 && request.height > 0) {
        scale = std::min(request.width / size.x(), request.height / size.y());
    } else if (request.width > 0) {
        scale = request.width / size.x();
    } else if (request.height > 0) {
        scale = request.height / size.y();
    }
    const double width = request.width > 0 ? request.width : pixels(scale * size.x());
    const double height = request.height > 0 ? request.height : pixels(scale * size.y());
    Result<Frame> frame = sized(width, height);
    if (frame) {
        const Vec2 middle(0.5 * width, 0.5 * height);
        const bool given = request.width > 0 && request.height > 0;
        const Vec2 corner = given ? Vec2(middle - 0.5 * scale * size) : Vec2(0, 0);
        frame->toPixels =
            Affine::translation(corner) * Affine::scaling({scale, scale}) * Affine::translation(-area.min);
    }
    return frame;
}

}  // namespace

Box Frame::visible() const
{
    const Affine back = toPixels.inverse();
    return Box(back * Vec2(0, 0), back * Vec2(width, height));
}

Result<Frame> frameOf(const ExportRequest& request)
{
    if (request.width < 0 || request.height < 0) {
        return Error("A picture cannot be " + std::to_string(request.width) + " x " + std::to_string(request.height) +
                     " pixels. Give a width and height above 0, or leave them out.");
    }
    return request.view ? viewed(request) : fitted(request);
}

}  // namespace jet::png
