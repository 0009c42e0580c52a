#include "handles.hpp"

#include <array>
#include <numbers>

namespace jet::selection {

namespace {

constexpr double kMargin = 4;          // pixels between the selection and its frame
constexpr double kSmallestFrame = 28;  // pixels: room for three handles a side, and for taking hold of the middle
constexpr double kHandle = 7;          // pixels, side of a handle's square
constexpr double kReach = 6;           // pixels, how near the pointer must come to a handle
constexpr double kRotateZone = 20;     // pixels, how far outside a corner dragging rotates
constexpr double kKnob = 22;           // pixels above the frame

constexpr std::array kScaleHandles{Handle::TopLeft, Handle::TopRight, Handle::BottomRight, Handle::BottomLeft,
                                   Handle::Top,     Handle::Right,    Handle::Bottom,      Handle::Left};

/// Which way the handle lies from the centre: each component -1, 0 or 1.
Vec2 direction(Handle handle)
{
    switch (handle) {
    case Handle::TopLeft: return {-1, -1};
    case Handle::Top: return {0, -1};
    case Handle::TopRight: return {1, -1};
    case Handle::Right: return {1, 0};
    case Handle::BottomRight: return {1, 1};
    case Handle::Bottom: return {0, 1};
    case Handle::BottomLeft: return {-1, 1};
    case Handle::Left: return {-1, 0};
    default: return {0, 0};
    }
}

bool isCorner(Handle handle) { return direction(handle).cwiseAbs().sum() == 2; }

}  // namespace

Frame::Frame(const Box& box, double pixelsPerUnit) : frame_(box), pixel_(1 / pixelsPerUnit)
{
    const Vec2 smallest = Vec2::Constant(kSmallestFrame * pixel_);
    const Vec2 size = (box.size() + Vec2::Constant(2 * kMargin * pixel_)).cwiseMax(smallest);
    frame_ = Box(box.center() - 0.5 * size, box.center() + 0.5 * size);
}

Vec2 Frame::position(Handle handle) const
{
    if (handle == Handle::Rotate) return {frame_.center().x(), frame_.min.y() - kKnob * pixel_};
    return frame_.center() + 0.5 * direction(handle).cwiseProduct(frame_.size());
}

Handle Frame::handleAt(const Vec2& p) const
{
    for (const Handle handle : kScaleHandles)
        if ((p - position(handle)).cwiseAbs().maxCoeff() <= kReach * pixel_) return handle;
    if ((p - position(Handle::Rotate)).norm() <= kReach * pixel_) return Handle::Rotate;
    if (frame_.contains(p)) return Handle::None;
    for (const Handle handle : kScaleHandles)
        if (isCorner(handle) && (p - position(handle)).norm() <= kRotateZone * pixel_) return Handle::Rotate;
    return Handle::None;
}

void Frame::paint(Painter& painter, const Pen& pen) const
{
    constexpr Color kInside{255, 255, 255, 255};
    painter.stroke(Path::rectangle(frame_), pen);
    painter.stroke(Path::line({frame_.center().x(), frame_.min.y()}, position(Handle::Rotate)), pen);
    const Vec2 half = Vec2::Constant(0.5 * kHandle * pixel_);
    Path squares;
    for (const Handle handle : kScaleHandles) {
        Path square = Path::rectangle(Box(position(handle) - half, position(handle) + half));
        squares.contours().push_back(std::move(square.contours().front()));
    }
    const Path knob = Path::ellipse(Box(position(Handle::Rotate) - half, position(Handle::Rotate) + half));
    for (const Path* path : {&std::as_const(squares), &knob}) {
        painter.fill(*path, kInside);
        painter.stroke(*path, pen);
    }
}

std::string_view cursorOf(Handle handle)
{
    switch (handle) {
    case Handle::TopLeft:
    case Handle::BottomRight: return "size-fdiag";
    case Handle::TopRight:
    case Handle::BottomLeft: return "size-bdiag";
    case Handle::Left:
    case Handle::Right: return "size-hor";
    case Handle::Top:
    case Handle::Bottom: return "size-ver";
    case Handle::Rotate: return "rotate";
    case Handle::None: break;
    }
    return "arrow";
}

Affine scaled(const Box& box, Handle handle, const Vec2& delta, const Modifiers& modifiers)
{
    constexpr double kFlattest = 1e-3;
    const Vec2 way = direction(handle), half = 0.5 * way.cwiseProduct(box.size());
    const Vec2 pivot = modifiers.alt ? box.center() : Vec2(box.center() - half);
    const Vec2 arm = box.center() + half - pivot;
    Vec2 factor(1, 1);
    for (int axis = 0; axis < 2; ++axis)
        if (arm[axis] != 0) factor[axis] = (arm[axis] + delta[axis]) / arm[axis];
    if (modifiers.shift) {
        // of a corner the larger factor, of a side its own
        double both = 0;
        for (int axis = 0; axis < 2; ++axis)
            if (arm[axis] != 0) both = std::max(both, std::abs(factor[axis]));
        for (int axis = 0; axis < 2 && both > 0; ++axis) factor[axis] = std::copysign(both, factor[axis]);
    }
    for (int axis = 0; axis < 2; ++axis)
        factor[axis] = std::copysign(std::max(std::abs(factor[axis]), kFlattest), factor[axis]);
    return Affine::scaling(factor, pivot);
}

double dragAngle(const Vec2& centre, const Vec2& from, const Vec2& to, const Modifiers& modifiers)
{
    const Vec2 a = from - centre, b = to - centre;
    const double angle = std::atan2(cross(a, b), a.dot(b));
    if (!modifiers.shift) return angle;
    constexpr double kStep = std::numbers::pi / 12;
    return std::round(angle / kStep) * kStep;
}

Affine rotated(double angle, const Vec2& centre)
{
    const double quarters = angle / (std::numbers::pi / 2);
    if (std::abs(quarters - std::round(quarters)) > 1e-12) return Affine::rotation(angle, centre);
    static constexpr int kCos[] = {1, 0, -1, 0}, kSin[] = {0, 1, 0, -1};
    const int turn = (static_cast<int>(std::round(quarters)) % 4 + 4) % 4;
    const double c = kCos[turn], s = kSin[turn];
    return Affine::fromSvg(c, s, -s, c, centre.x() - c * centre.x() + s * centre.y(),
                           centre.y() - s * centre.x() - c * centre.y());
}

}  // namespace jet::selection
