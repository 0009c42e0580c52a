// Joint tool: drag, or click twice, from one body to another or to the background; a Joint item holds the two at play.
// Ends snap to the middles and points of bodies (Alt: freely), Esc gives up.
#include <jet/catalog.hpp>
#include <jet/plugin.hpp>
#include <jet/tool.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace {

constexpr double kReach = 8, kStill = 3;  // pixels: of snapping; a press that moves less is a click
constexpr double kInside = 1e-3;  // of the way to the middle: an end on a body's border is taken that far inside

/// Where an end of the joint is, and what it holds.
struct End {
    jet::Vec2 at{0, 0};      // scene units; as shown
    jet::Vec2 inside{0, 0};  // in the body, for certain
    jet::ItemId body;        // none: the background
    std::string name;        // of the body
    bool snapped = false;

    bool isBackground() const { return body == jet::ItemId{}; }
};

class JointTool final : public jet::Tool {
public:
    using Tool::Tool;

    void activate() override
    {
        host().setCursor("cross");
        host().showStatus("Drag from one body to another, or to the background; or click both. Alt: without snapping.");
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
        if (!second_) start_ = endAt(event);
        follow(event);
    }
    void drag(const jet::PointerEvent& event) override { follow(event); }
    void move(const jet::PointerEvent& event) override { follow(event); }

    void release(const jet::PointerEvent& event) override
    {
        if (!pressed_ || !start_) return;
        pressed_ = false;
        follow(event);
        if (!second_ && (event.pixels - pressedAt_).norm() < kStill) return;  // the other end is to be clicked
        const End from = *start_, to = *hover_;
        cancel();
        create(from, to);
    }

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
        if (start_ && hover_) painter.stroke(pathOf(*start_, *hover_), host().layerPen());
        if (start_) mark(painter, *start_);
        if (hover_ && (hover_->snapped || start_)) mark(painter, *hover_);
    }

    const jet::PropertyTable& options() const override
    {
        static const jet::PropertyTable table{
            jet::choice("kind", "Kind",
                        {"revolute", "prismatic", "weld", "distance", "rope", "wheel", "motor", "mouse", "pulley"}),
            jet::choice("pivot", "Turns about", {"automatic", "start", "end", "middle"})
                .says("Where revolute, prismatic, weld and wheel joints hold; automatic: at the end in the background, "
                      "else at the start."),
            jet::flag("snap", "Snap to bodies", true).says("Ends go to the middles and points of bodies."),
        };
        return table;
    }

private:
    std::string option(const char* id) const { return host().options().get(id, options()).as<std::string>(); }

    // --- what lies under the pointer

    const jet::Item* bodyAt(const jet::Vec2& at) const
    {
        const jet::Item* top = nullptr;
        for (const jet::Item* item : host().items().query(jet::Box(at, at)))
            if (item->is<jet::BodyItem>() && item->path().contains(at, jet::FillRule::EvenOdd)) top = item;
        return top;
    }

    /// The end at a point of a body: a point of its border is moved inside, else nobody could tell whom it holds.
    static std::optional<End> endOf(const jet::Item& body, const jet::Vec2& point)
    {
        const jet::Vec2 middle = body.bounds().center();
        for (const double way : {0.0, kInside, 10 * kInside}) {
            const jet::Vec2 inside = point + way * (middle - point);
            if (way == 0 && point != middle) continue;
            if (body.path().contains(inside, jet::FillRule::EvenOdd))
                return End{point, inside, body.id(), body.name(), true};
        }
        return std::nullopt;
    }

    std::optional<End> snapped(const jet::Vec2& at) const
    {
        const double reach = kReach / std::max(host().pixelsPerUnit(), 1e-9);
        std::optional<End> best;
        double nearest = reach;
        const auto consider = [&](const jet::Item& body, const jet::Vec2& point) {
            const double distance = (point - at).norm();
            if (distance > nearest || (best && distance == nearest && best->body != body.id())) return;
            if (auto end = endOf(body, point)) nearest = distance, best = std::move(end);
        };
        const jet::Vec2 around(reach, reach);
        for (const jet::Item* item : host().items().query(jet::Box(at - around, at + around))) {
            if (!item->is<jet::BodyItem>()) continue;
            consider(*item, item->bounds().center());
            for (std::size_t i = 0; i < item->path().segmentCount(); ++i)
                consider(*item, item->path().segment(i).point);
        }
        return best;
    }

    End endAt(const jet::PointerEvent& event) const
    {
        const bool snap = host().options().get("snap", options()).as<bool>() && !event.modifiers.alt;
        if (snap)
            if (const auto end = snapped(event.scene)) return *end;
        End end{event.scene, event.scene, {}, {}, false};
        if (const jet::Item* body = bodyAt(event.scene)) end.body = body->id(), end.name = body->name();
        return end;
    }

    void follow(const jet::PointerEvent& event)
    {
        hover_ = endAt(event);
        if (start_) host().showStatus(option("kind") + ": " + words(*start_) + " – " + words(*hover_));
        host().requestRepaint();
    }

    static std::string words(const End& end) { return end.isBackground() ? "background" : end.name; }

    // --- the joint

    bool hasPivot() const
    {
        const std::string kind = option("kind");
        return kind == "revolute" || kind == "prismatic" || kind == "weld" || kind == "wheel";
    }

    jet::Vec2 pivot(const End& from, const End& to) const
    {
        const std::string where = option("pivot");
        if (where == "middle") return 0.5 * (from.at + to.at);
        if (where == "end" || (where == "automatic" && to.isBackground())) return to.at;
        return from.at;
    }

    static jet::Path line(const std::vector<jet::Vec2>& points) { return jet::Path::polygon(points, false); }

    /// As joint items want it: body A, (pivot | the wheels of a pulley), body B.
    jet::Path pathOf(const End& from, const End& to) const
    {
        if (hasPivot()) return line({from.inside, pivot(from, to), to.inside});
        if (option("kind") != "pulley") return line({from.inside, to.inside});
        const double above = std::min(from.at.y(), to.at.y()) - std::max((to.at - from.at).norm(), 1.0);
        return line({from.inside, {from.inside.x(), above}, {to.inside.x(), above}, to.inside});
    }

    /// Why these two cannot be joined; empty: they can.
    std::string refusal(const End& from, const End& to) const
    {
        if (from.isBackground() && to.isBackground())
            return "There is no body at either end: drag from a body to another one, or to the background.";
        if (from.body == to.body) return "Both ends lie in " + from.name + ": a joint holds two different bodies.";
        if (!host().scene().catalog().itemType("joint"))
            return "Joints need the plugin org.jet.items.physics, which is not there: " +
                   host().scene().catalog().explain(jet::ContributionKind::ItemType, "joint");
        return {};
    }

    void create(const End& from, const End& to)
    {
        if (const std::string why = refusal(from, to); !why.empty()) return host().showStatus(why);
        const std::string kind = option("kind");
        auto edit = host().items().begin("Create joint");
        const jet::Item& joint = edit.add("joint", host().insertionPoint(edit), pathOf(from, to));
        edit.set(joint, "kind", kind);
        // Without strength or spring these would do nothing.
        if (kind == "wheel") edit.set(joint, "hertz", 4.0), edit.set(joint, "damping-ratio", 0.7), setAxis(edit, joint);
        if (kind == "mouse") edit.set(joint, "hertz", 4.0), edit.set(joint, "max-force", 1e5);
        if (kind == "motor") edit.set(joint, "max-force", 1e5), edit.set(joint, "max-torque", 1e6);
        if (kind == "prismatic" && from.at != to.at) edit.set(joint, "axis", jet::Vec2((to.at - from.at).normalized()));
        edit.select(joint);
        edit.commit();
        host().showStatus("Joined " + words(from) + " and " + words(to) + ".");
    }

    /// Wheels hang below what they carry.
    static void setAxis(jet::Transaction& edit, const jet::Item& joint) { edit.set(joint, "axis", jet::Vec2(0, 1)); }

    void mark(jet::Painter& painter, const End& end) const
    {
        const jet::Vec2 half = jet::Vec2(5, 5) / std::max(host().pixelsPerUnit(), 1e-9);
        painter.stroke(jet::Path::ellipse(jet::Box(end.at - half, end.at + half)), host().layerPen());
        if (!end.isBackground())
            painter.stroke(jet::Path::ellipse(jet::Box(end.at - 0.4 * half, end.at + 0.4 * half)), host().layerPen());
    }

    std::optional<End> start_, hover_;
    jet::Vec2 pressedAt_{0, 0};  // pixels
    bool pressed_ = false;
    bool second_ = false;  // is this the press that ends it?
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<JointTool>("joint-tool"); }
