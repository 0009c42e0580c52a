// Text tool: click and type. Clicking text edits it where it is; Enter begins a line, Esc and a click elsewhere end.
// What was typed between is one undo step; each letter of it is in the scene at once, so that no crash loses it.
#include "text_lines.hpp"

#include <jet/plugin.hpp>
#include <jet/tool.hpp>
#include <jet/ui/text_metrics.hpp>

#include <cmath>

namespace {

using jet::writing::TextLines;

constexpr double kAscent = 0.93, kLineHeight = 1.2;  // of the size, as text items are drawn
constexpr double kNarrowest = 0.5;                   // of the size: an empty text can still be seen and clicked

class TextTool final : public jet::Tool {
public:
    using Tool::Tool;

    void activate() override
    {
        host().setCursor("text");
        host().showStatus("Click where the text goes, or text to edit it.");
    }
    void deactivate() override { finish(); }

    void press(const jet::PointerEvent& event) override
    {
        const jet::Item* hit = textAt(event.scene);
        if (hit && isEditing() && hit->id() == item_) return placeCaret(*hit, event.scene);
        finish();
        hit ? edit(*hit, event.scene) : start(event.scene);
    }

    bool keyPress(const jet::KeyEvent& event) override
    {
        if (!isEditing() || !follow()) return false;
        if (event.modifiers.control && event.key != "Left" && event.key != "Right") return false;
        if (!move(event) && !change(event)) return event.key == "Delete" || event.key == "Backspace";
        host().requestRepaint();
        return true;
    }

    // Ends, and keeps what was typed: Undo is there to take it back.
    bool cancel() override
    {
        if (!isEditing()) return false;
        finish();
        return true;
    }

    void paint(jet::Painter& painter) const override
    {
        if (!isEditing()) return;
        jet::Path caret;
        const jet::Affine frame = uprightFrame();
        const jet::TextStyle style = styleNow();
        const double x = caretX(style), y = lines_.caretLine() * kLineHeight * style.size;
        caret.moveTo(frame * jet::Vec2(x, y + 0.1 * style.size));
        caret.lineTo(frame * jet::Vec2(x, y + 1.15 * style.size));
        painter.stroke(caret, host().layerPen());
    }

    const jet::PropertyTable& options() const override
    {
        static const jet::PropertyTable table{
            jet::text("font", "Font", "").says("Family, such as DejaVu Sans; empty: the usual one."),
            jet::real("size", "Size", 24).in("units").range(1e-3, 1e6),
            jet::color("color", "Color", jet::Color{0, 0, 0, 255}),
            jet::choice("align", "Alignment", {"left", "center", "right"}),
        };
        return table;
    }

private:
    bool isEditing() const { return editing_; }
    void newSession()
    {
        static int sessions = 0;  // of all scenes: a key that was used before would join that step
        session_ = ++sessions;
    }
    const jet::Item* item() const { return host().items().find(item_); }

    // --- what is edited

    const jet::Item* textAt(const jet::Vec2& at) const
    {
        const jet::Item* found = nullptr;  // the last one is on top
        host().scene().root().walk([&](const jet::Item& one) {
            if (!one.visible() || one.locked()) return false;
            if (!one.is<jet::TextItem>()) return true;
            const jet::Affine frame = jet::frameOf(one.path());
            if (!frame.isInvertible()) return true;
            const jet::Vec2 inside = frame.inverse() * at;
            if (jet::Box({0, 0}, {1, 1}).contains(inside)) found = &one;
            return true;
        });
        return found;
    }

    void begin()
    {
        editing_ = true;
        newSession();
        host().showStatus("Type. Enter: a new line, Esc: done.");
        host().requestRepaint();
    }

    void start(const jet::Vec2& at)
    {
        item_ = {};
        at_ = at;
        lines_ = TextLines();
        begin();
    }

    void edit(const jet::Item& item, const jet::Vec2& at)
    {
        item_ = item.id();
        host().items().setSelection({item_});
        shown_ = item.property("text")->as<std::string>();
        lines_ = TextLines(shown_);
        begin();
        placeCaret(item, at);
    }

    /// Is what is edited still there? What Undo or the Inspector made of it is taken over.
    bool follow()
    {
        if (item_ == jet::ItemId{}) return true;
        const jet::Item* present = item();
        if (!present || !present->is<jet::TextItem>()) {
            editing_ = false;
            return false;
        }
        if (const auto now = present->property("text")->as<std::string>(); now != shown_) {
            const auto caret = lines_.caret();
            lines_ = TextLines(shown_ = now);
            lines_.setCaret(caret);
            newSession();  // what is typed from here on is a step of its own
        }
        return true;
    }

    void finish()
    {
        if (!editing_) return;
        editing_ = false;
        const jet::Item* present = item();
        if (present && lines_.isBlank() && !host().items().inTransaction()) {
            auto edit = host().items().begin("Delete empty text");
            edit.remove(*present);
            edit.commit(key());
        }
        host().showStatus("");
        host().requestRepaint();
    }

    // --- keys

    bool move(const jet::KeyEvent& event)
    {
        const std::string& key = event.key;
        if (key == "Left") return event.modifiers.control ? lines_.toPreviousWord() : lines_.toPrevious(), true;
        if (key == "Right") return event.modifiers.control ? lines_.toNextWord() : lines_.toNext(), true;
        if (key == "Up") return lines_.toLine(-1), true;
        if (key == "Down") return lines_.toLine(1), true;
        if (key == "Home") return lines_.toLineStart(), true;
        if (key == "End") return lines_.toLineEnd(), true;
        return false;
    }

    bool change(const jet::KeyEvent& event)
    {
        const std::string before = lines_.utf8();
        if (event.key == "Backspace") {
            lines_.removeBefore();
        } else if (event.key == "Delete") {
            lines_.removeAfter();
        } else if (event.key == "Enter") {
            lines_.insert("\n");
        } else if (!event.text.empty() && static_cast<unsigned char>(event.text[0]) >= 0x20 && event.text[0] != 0x7f) {
            lines_.insert(event.text);
        } else {
            return false;
        }
        if (lines_.utf8() != before) write();
        return true;
    }

    // --- the scene

    std::string key() const { return "text-" + std::to_string(session_); }

    void write()
    {
        if (host().items().inTransaction()) return;
        shown_ = lines_.utf8();
        auto edit = host().items().begin(item() ? "Edit text" : "Create text");
        const jet::Item& target = item() ? *item() : create(edit);
        edit.set(target, "text", shown_);
        edit.setPath(target, framed(target));
        item_ = target.id();
        edit.commit(key());
    }

    const jet::Item& create(jet::Transaction& edit)
    {
        const jet::TextStyle style = styleNow();
        const double width = kNarrowest * style.size;
        jet::Vec2 corner = at_ - jet::Vec2(0, kAscent * style.size);
        if (style.align == jet::TextAlign::Center) corner.x() -= 0.5 * width;
        if (style.align == jet::TextAlign::Right) corner.x() -= width;
        const jet::Box frame(corner, corner + jet::Vec2(width, kLineHeight * style.size));
        const jet::Item& made = edit.add<jet::TextItem>(host().insertionPoint(edit), jet::Path::rectangle(frame));
        for (const char* property : {"font", "size", "color", "align"})
            edit.set(made, property, host().options().get(property, options()));
        edit.select(made);
        return made;
    }

    /// The item's frame as wide and high as the text, growing to the side that its alignment leaves open.
    jet::Path framed(const jet::Item& target) const
    {
        const jet::Affine frame = jet::frameOf(target.path());
        const jet::Vec2 right = frame.linear().col(0), down = frame.linear().col(1);
        const double oldWidth = right.norm(), height = down.norm();
        if (!(oldWidth > 0) || !(height > 0)) return target.path();
        const jet::TextStyle style = styleOf(target);
        double width = kNarrowest * style.size;
        for (int i = 0; i < lines_.lineCount(); ++i) width = std::max(width, jet::ui::textWidth(lines_.line(i), style));
        const double high = std::max(1, lines_.lineCount()) * kLineHeight * style.size;
        double shift = 0;
        if (style.align == jet::TextAlign::Center) shift = 0.5 * (oldWidth - width);
        if (style.align == jet::TextAlign::Right) shift = oldWidth - width;
        jet::Affine now = frame;
        now.linear().col(0) = right / oldWidth * width;
        now.linear().col(1) = down / height * high;
        now = jet::Affine::translation(right / oldWidth * shift) * now;
        return jet::Path::rectangle(jet::Box({0, 0}, {1, 1})).transformed(now);
    }

    // --- measures

    jet::TextStyle styleFrom(const jet::Properties& values, const jet::PropertyTable& table) const
    {
        jet::TextStyle style;
        style.family = values.get("font", table).as<std::string>();
        style.size = values.get("size", table).as<double>();
        const auto align = values.get("align", table).as<std::string>();
        if (align == "center") style.align = jet::TextAlign::Center;
        if (align == "right") style.align = jet::TextAlign::Right;
        return style;
    }
    jet::TextStyle styleOf(const jet::Item& target) const { return styleFrom(target.properties(), options()); }
    jet::TextStyle styleNow() const { return item() ? styleOf(*item()) : styleFrom(host().options(), options()); }

    /// The frame's corner and directions, at the letters' own size.
    jet::Affine uprightFrame() const
    {
        if (!item()) return jet::Affine::translation(at_ - jet::Vec2(0, kAscent * styleNow().size));
        jet::Affine frame = jet::frameOf(item()->path());
        for (int side = 0; side < 2; ++side)
            if (const double length = frame.linear().col(side).norm(); length > 0) frame.linear().col(side) /= length;
        return frame;
    }

    double frameWidth() const { return item() ? jet::frameOf(item()->path()).linear().col(0).norm() : 0; }

    /// Where a line of that width starts.
    double lineStart(const jet::TextStyle& style, double width) const
    {
        if (style.align == jet::TextAlign::Center) return 0.5 * (frameWidth() - width);
        return style.align == jet::TextAlign::Right ? frameWidth() - width : 0;
    }

    double caretX(const jet::TextStyle& style) const
    {
        const double whole = jet::ui::textWidth(lines_.line(lines_.caretLine()), style);
        return lineStart(style, whole) + jet::ui::textWidth(lines_.beforeCaret(), style);
    }

    /// The place between two letters that is nearest.
    void placeCaret(const jet::Item& target, const jet::Vec2& at)
    {
        const jet::TextStyle style = styleOf(target);
        const jet::Vec2 inside = uprightFrame().inverse() * at;
        lines_.setCaret(static_cast<int>(std::floor(inside.y() / (kLineHeight * style.size))), 0);
        const int line = lines_.caretLine();
        auto best = lines_.caret();
        double distance = std::abs(inside.x() - caretX(style));
        for (auto last = best - 1; lines_.caret() != last && lines_.caretLine() == line; lines_.toNext()) {
            last = lines_.caret();
            if (const double d = std::abs(inside.x() - caretX(style)); d < distance) distance = d, best = last;
        }
        lines_.setCaret(best);
        host().requestRepaint();
    }

    bool editing_ = false;
    jet::ItemId item_;  // none: nothing was typed yet
    jet::Vec2 at_;      // where a new text's baseline starts
    TextLines lines_;
    std::string shown_;  // what the item has, as far as this tool knows
    int session_ = 0;
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<TextTool>("text-tool"); }
