// Force tool: drag, or click twice, from a point of a body in the direction it is to be pushed; a Force item pushes it
// at play, the harder the longer the arrow. The point snaps to the middles and points of bodies (Alt: freely), Shift
// keeps to eighths of a turn, Esc gives up.
#include <jet/body_point.hpp>
#include <jet/catalog.hpp>
#include <jet/item_type.hpp>
#include <jet/plugin.hpp>
#include <jet/tool.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace {

constexpr double kStill = 3;  // pixels: a press that moves less is a click
constexpr double kDot = 4;    // scene units: the item's path about the point where the force acts
constexpr double kHead = 9;   // pixels

class ForceTool final : public jet::Tool {
public:
    using Tool::Tool;

    void activate() override
    {
        host().setCursor("cross");
        host().showStatus("Drag from a point of a body the way it is to be pushed; or click both. Alt: without "
                          "snapping, Shift: eighths of a turn.");
    }
    void deactivate() override
    {
        cancel();
        hover_.reset();
    }

    void press(const jet::PointerEvent& event) override
    {
        if (event.button != jet::PointerButton::Left) return;
        pressedAt_ = event.pixels;
        pressed_ = true;
        second_ = start_.has_value();
        if (!second_) start_ = pointAt(event);
        follow(event);
    }
    void drag(const jet::PointerEvent& event) override { follow(event); }
    void move(const jet::PointerEvent& event) override { follow(event); }

    void release(const jet::PointerEvent& event) override
    {
        if (!pressed_ || !start_) return;
        pressed_ = false;
        follow(event);
        if (!second_ && (event.pixels - pressedAt_).norm() < kStill) return;  // the arrow's tip is to be clicked
        const jet::BodyPoint from = *start_;
        const jet::Vec2 arrow = drawn();
        cancel();
        create(from, arrow);
    }

    bool keyPress(const jet::KeyEvent& event) override { return constrain(event.key, true); }
    bool keyRelease(const jet::KeyEvent& event) override { return constrain(event.key, false); }

    bool cancel() override
    {
        if (!start_) return false;
        start_.reset();
        pressed_ = false;
        host().showStatus("");
        host().requestRepaint();
        return true;
    }

    void paint(jet::Painter& painter) const override
    {
        if (start_) {
            jet::paintBodyPoint(*start_, host(), painter);
            paintArrow(painter);
        } else if (hover_ && hover_->snapped) {
            jet::paintBodyPoint(*hover_, host(), painter);
        }
    }

    const jet::PropertyTable& options() const override
    {
        static const jet::PropertyTable table{
            jet::real("scale", "Force a unit", 10)
                .in("mass/s²")
                .range(1e-6, 1e9)
                .says(
                    "Of the arrow: with 10, one of 100 units pushes with 1,000, about ten times the weight of mass 1."),
            jet::flag("snap", "Snap to bodies", true).says("The point goes to the middles and points of bodies."),
        };
        return table;
    }

private:
    jet::BodyPoint pointAt(const jet::PointerEvent& event) const
    {
        const bool snap = host().options().get("snap", options()).as<bool>() && !event.modifiers.alt;
        return jet::bodyPointAt(host(), event.scene, snap);
    }

    /// From the point to the pointer, in scene units.
    jet::Vec2 drawn() const
    {
        const jet::Vec2 free = tip_ - start_->at;
        if (!eighths_) return free;
        const double eighth = std::numbers::pi / 4;
        const double angle = eighth * std::round(std::atan2(free.y(), free.x()) / eighth);
        const jet::Vec2 along(std::cos(angle), std::sin(angle));
        return free.dot(along) * along;
    }

    jet::Vec2 force(const jet::Vec2& arrow) const
    {
        const jet::Vec2 exact = host().options().get("scale", options()).as<double>() * arrow;
        // A force straight up has no part to the side, whatever is left of a cosine.
        const double least = 1e-12 * exact.norm();
        return {std::abs(exact.x()) < least ? 0 : exact.x(), std::abs(exact.y()) < least ? 0 : exact.y()};
    }

    void follow(const jet::PointerEvent& event)
    {
        hover_ = pointAt(event);
        tip_ = event.scene;
        eighths_ = event.modifiers.shift;
        show();
    }

    void show()
    {
        if (start_) {
            const auto rounded = [](double value) { return jet::numberText(std::round(value * 100) / 100); };
            const jet::Vec2 value = force(drawn());
            host().showStatus((start_->isBackground() ? "background" : start_->name) + ": force " +
                              rounded(value.norm()) + " (" + rounded(value.x()) + ", " + rounded(value.y()) + ")");
        }
        host().requestRepaint();
    }

    // Shift also counts while the pointer rests.
    bool constrain(const std::string& key, bool down)
    {
        if (!start_ || key != "Shift") return false;
        eighths_ = down;
        show();
        return true;
    }

    /// Why no force can be made; empty: it can.
    std::string refusal(const jet::BodyPoint& from, const jet::Vec2& arrow) const
    {
        if (from.isBackground()) return "There is no body at the start: drag from the point of a body that is pushed.";
        if (!(arrow.norm() > 0)) return "The arrow has no length: drag it the way the body is to be pushed.";
        const jet::ItemType* type = host().scene().catalog().itemType("force");
        if (!type)
            return "Forces need the plugin org.jet.items.physics, which is not there: " +
                   host().scene().catalog().explain(jet::ContributionKind::ItemType, "force");
        const auto fits = type->properties().find("value")->check(force(arrow));
        return fits ? std::string() : "No force is as strong as this arrow is long: " + fits.error().message;
    }

    void create(const jet::BodyPoint& from, const jet::Vec2& arrow)
    {
        if (const std::string why = refusal(from, arrow); !why.empty()) return host().showStatus(why);
        const jet::Vec2 half(kDot, kDot);
        auto edit = host().items().begin("Create force");
        const jet::Item& item = edit.add("force", host().insertionPoint(edit),
                                         jet::Path::ellipse(jet::Box(from.inside - half, from.inside + half)));
        edit.set(item, "value", force(arrow));
        edit.select(item);
        edit.commit();
        host().showStatus("A force pushes " + from.name + ".");
    }

    void paintArrow(jet::Painter& painter) const
    {
        const jet::Vec2 arrow = drawn();
        if (!(arrow.norm() > 0)) return;
        const double head = kHead / std::max(host().pixelsPerUnit(), 1e-9);
        const jet::Vec2 tip = start_->at + arrow, along = arrow.normalized(), across = jet::perpendicular(along);
        painter.stroke(jet::Path::line(start_->at, tip), host().layerPen());
        painter.stroke(jet::Path::polygon(std::array{jet::Vec2(tip - head * along + 0.5 * head * across), tip,
                                                     jet::Vec2(tip - head * along - 0.5 * head * across)},
                                          false),
                       host().layerPen());
    }

    std::optional<jet::BodyPoint> start_, hover_;
    jet::Vec2 tip_{0, 0};        // scene units
    jet::Vec2 pressedAt_{0, 0};  // pixels
    bool pressed_ = false;
    bool second_ = false;   // is this the press that ends it?
    bool eighths_ = false;  // Shift is held
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<ForceTool>("force-tool"); }
