#include <jet/line_tool.hpp>

#include <cmath>
#include <numbers>

namespace jet {

namespace {

constexpr double kStill = 3;  // pixels: a press that moves less is a click

/// The nearest to it in a direction of eighths of a turn.
Vec2 inEighths(const Vec2& way)
{
    const double eighth = std::numbers::pi / 4;
    const double angle = eighth * std::round(std::atan2(way.y(), way.x()) / eighth);
    const Vec2 along(std::cos(angle), std::sin(angle));
    return way.dot(along) * along;
}

}  // namespace

LineTool::LineTool(ToolHost& host, std::string help, Second second)
    : Tool(host), help_(std::move(help)), second_(second)
{
}

void LineTool::activate()
{
    host().setCursor("cross");
    host().showStatus(help_);
}

void LineTool::deactivate()
{
    cancel();
    hover_.reset();
}

void LineTool::press(const PointerEvent& event)
{
    if (event.button != PointerButton::Left) return;
    pressedAt_ = event.pixels;
    pressed_ = true;
    last_ = from_.has_value();
    if (!last_) from_ = pointAt(event, true);
    follow(event);
}

void LineTool::drag(const PointerEvent& event) { follow(event); }
void LineTool::move(const PointerEvent& event) { follow(event); }

void LineTool::release(const PointerEvent& event)
{
    if (!pressed_ || !from_) return;
    pressed_ = false;
    follow(event);
    if (!last_ && (event.pixels - pressedAt_).norm() < kStill) return;  // the second point is to be clicked
    const Line drawn = line();
    cancel();
    finish(drawn);
}

bool LineTool::keyPress(const KeyEvent& event) { return constrain(event.key, true); }
bool LineTool::keyRelease(const KeyEvent& event) { return constrain(event.key, false); }

bool LineTool::cancel()
{
    if (!from_) return false;
    from_.reset();
    pressed_ = false;
    host().showStatus("");
    host().requestRepaint();
    return true;
}

void LineTool::paint(Painter& painter) const
{
    if (from_) {
        paintLine(line(), painter);
        paintBodyPoint(*from_, host(), painter);
    }
    if (hover_ && (from_ ? second_ == Second::Snaps : hover_->snapped)) paintBodyPoint(*hover_, host(), painter);
}

const PropertyTable& LineTool::options() const
{
    static const PropertyTable table{
        flag("snap", "Snap to bodies", true).says("Points go to the middles and points of bodies.")};
    return table;
}

BodyPoint LineTool::pointAt(const PointerEvent& event, bool maySnap) const
{
    const bool snap =
        maySnap && !event.modifiers.alt && options().find("snap") && host().options().get("snap", options()).as<bool>();
    return bodyPointAt(host(), event.scene, snap);
}

LineTool::Line LineTool::line() const
{
    Line line{*from_, *hover_, hover_->at - from_->at};
    if (second_ == Second::Snaps || !eighths_) return line;
    line.way = inEighths(line.way);
    line.to = bodyPointAt(host(), from_->at + line.way, false);
    return line;
}

/// Before there is a first point, this is where it would be.
void LineTool::follow(const PointerEvent& event)
{
    hover_ = pointAt(event, !from_ || second_ == Second::Snaps);
    eighths_ = event.modifiers.shift;
    show();
}

void LineTool::show()
{
    if (from_) host().showStatus(describe(line()));
    host().requestRepaint();
}

// Shift also counts when it is pressed or let go while the pointer rests.
bool LineTool::constrain(const std::string& key, bool down)
{
    if (!from_ || second_ == Second::Snaps || key != "Shift") return false;
    eighths_ = down;
    show();
    return true;
}

}  // namespace jet
