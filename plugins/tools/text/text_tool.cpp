// Text tool: click and type. Clicking text edits it where it is; Enter begins a line, Esc and a click elsewhere end.
// Letters are selected by dragging, by a double click (a word), with Shift and the keys of the caret, and by Ctrl+A;
// cut, copied and pasted as text. What was typed between is one undo step; each letter of it is in the scene at once,
// so that no crash loses it.
#include "text_lines.hpp"

#include <jet/plugin.hpp>
#include <jet/tool_view.hpp>
#include <jet/ui/text_frame.hpp>
#include <jet/ui/text_metrics.hpp>

#include <QClipboard>
#include <QGuiApplication>
#include <QMimeData>

#include <cmath>

namespace {

using jet::writing::TextLines;

constexpr double kAscent = jet::ui::kTextAscent, kLineHeight = jet::ui::kTextLineHeight;
constexpr std::uint8_t kSelectionAlpha = 90;
constexpr double kLineBreak = 0.3;  // of the size: so wide is a selected end of a line

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
        const bool same = hit && isEditing() && hit->id() == item_;
        if (!same) {
            finish();
            hit ? edit(*hit) : start(event.scene);
        }
        selecting_ = hit != nullptr;
        if (hit) placeCaret(*hit, event.scene, same && event.modifiers.shift);
    }
    void drag(const jet::PointerEvent& event) override
    {
        if (selecting_ && isEditing() && item()) placeCaret(*item(), event.scene, true);
    }
    void release(const jet::PointerEvent&) override { selecting_ = false; }
    void doubleClick(const jet::PointerEvent& event) override
    {
        press(event);
        selecting_ = false;
        if (isEditing()) lines_.selectWord();
        host().requestRepaint();
    }

    bool keyPress(const jet::KeyEvent& event) override
    {
        if (!isEditing() || !follow()) return false;
        const bool isUsed = move(event) || exchange(event) || change(event);
        if (isUsed) host().requestRepaint();
        return isUsed || event.key == "Delete" || event.key == "Backspace";
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
        paintSelection(painter, frame, style);
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
        if (jet::ToolView* view = jet::toolView(host())) view->setTextEditing(true);
        changed_ = host().scene().events().subscribe<jet::ItemsChanged>(&host().scene(), [this](const auto&) {
            if (isEditing() && follow()) host().requestRepaint();
        });
        host().showStatus("Type. Enter: a new line, Esc: done.");
        host().requestRepaint();
    }

    void end()
    {
        editing_ = selecting_ = false;
        if (jet::ToolView* view = jet::toolView(host())) view->setTextEditing(false);
        host().requestRepaint();
    }

    void start(const jet::Vec2& at)
    {
        item_ = {};
        at_ = at;
        lines_ = TextLines();
        begin();
    }

    void edit(const jet::Item& item)
    {
        item_ = item.id();
        host().items().setSelection({item_});
        shown_ = item.property("text")->as<std::string>();
        lines_ = TextLines(shown_);
        begin();
    }

    /// Is what is edited still there? What Undo or the Inspector made of it is taken over.
    bool follow()
    {
        if (item_ == jet::ItemId{}) return true;
        const jet::Item* present = item();
        if (!present || !present->is<jet::TextItem>()) return end(), false;
        if (const auto now = present->property("text")->as<std::string>(); now != shown_) {
            const auto caret = lines_.caret(), anchor = lines_.anchor();
            lines_ = TextLines(shown_ = now);
            lines_.setCaret(caret);
            lines_.setAnchor(anchor);
            newSession();  // what is typed from here on is a step of its own
        }
        return true;
    }

    void finish()
    {
        if (!editing_) return;
        end();
        const jet::Item* present = item();
        if (present && lines_.isBlank() && !host().items().inTransaction()) {
            auto edit = host().items().begin("Delete empty text");
            edit.remove(*present);
            edit.commit(key());
        }
        host().showStatus("");
    }

    // --- keys

    /// Keys of the caret. With Shift they select.
    bool move(const jet::KeyEvent& event)
    {
        const bool isWord = event.modifiers.control, isSelecting = event.modifiers.shift;
        const bool collapses = lines_.hasSelection() && !isSelecting && !isWord;
        const std::string& key = event.key;
        if (key == "Left") {
            if (collapses) return lines_.toSelectionStart(), true;
            isWord ? lines_.toPreviousWord() : lines_.toPrevious();
        } else if (key == "Right") {
            if (collapses) return lines_.toSelectionEnd(), true;
            isWord ? lines_.toNextWord() : lines_.toNext();
        } else if (key == "Up" || key == "Down") {
            lines_.toLine(key == "Up" ? -1 : 1);
        } else if (key == "Home") {
            isWord ? lines_.toStart() : lines_.toLineStart();
        } else if (key == "End") {
            isWord ? lines_.toEnd() : lines_.toLineEnd();
        } else {
            return false;
        }
        if (!isSelecting) lines_.dropSelection();
        return true;
    }

    /// Ctrl with A, C, X and V.
    bool exchange(const jet::KeyEvent& event)
    {
        if (!event.modifiers.control || event.modifiers.shift || event.modifiers.alt) return false;
        if (event.key == "A") return lines_.selectAll(), true;
        const bool cuts = event.key == "X";
        if (event.key == "C" || cuts) {
            if (lines_.hasSelection()) QGuiApplication::clipboard()->setText(QString::fromStdString(lines_.selected()));
            if (cuts && lines_.removeSelection()) write();
            return true;  // also without a selection: an item would be copied, which nobody meant
        }
        if (event.key != "V") return false;
        const std::string pasted = textOnClipboard();
        if (pasted.empty()) return host().showStatus("The clipboard holds no text."), true;
        lines_.insert(pasted);
        write();
        return true;
    }

    /// What a clipboard's text is in a text item: lines end with a line feed, other control characters go.
    static std::string textOnClipboard()
    {
        const QMimeData* data = QGuiApplication::clipboard()->mimeData();
        const bool isItems = data && data->hasFormat(QStringLiteral("application/x-jet-scene+xml"));
        if (!data || isItems) return {};
        QString text = data->text();
        text.replace(QLatin1String("\r\n"), QLatin1String("\n")).replace(QLatin1Char('\r'), QLatin1Char('\n'));
        text.replace(QLatin1Char('\t'), QLatin1Char(' '));
        text.removeIf([](QChar c) { return c.category() == QChar::Other_Control && c != QLatin1Char('\n'); });
        return text.toStdString();
    }

    bool change(const jet::KeyEvent& event)
    {
        const bool isWord = event.modifiers.control;
        const std::string before = lines_.utf8();
        if (event.key == "Backspace") {
            lines_.removeBefore(isWord);
        } else if (event.key == "Delete") {
            lines_.removeAfter(isWord);
        } else if (event.modifiers.control) {
            return false;
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
        edit.setPath(target, jet::ui::fittedTextFrame(target));
        item_ = target.id();
        edit.commit(key());
    }

    const jet::Item& create(jet::Transaction& edit)
    {
        const jet::TextStyle style = styleNow();
        const double width = jet::ui::kNarrowestText * style.size;
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

    // --- measures

    /// Of a text that is still to be made.
    jet::TextStyle styleOfOptions() const
    {
        const jet::Properties& values = host().options();
        jet::TextStyle style;
        style.family = values.get("font", options()).as<std::string>();
        style.size = values.get("size", options()).as<double>();
        const auto align = values.get("align", options()).as<std::string>();
        if (align == "center") style.align = jet::TextAlign::Center;
        if (align == "right") style.align = jet::TextAlign::Right;
        return style;
    }
    jet::TextStyle styleNow() const { return item() ? jet::ui::textStyleOf(*item()) : styleOfOptions(); }

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

    void paintSelection(jet::Painter& painter, const jet::Affine& frame, const jet::TextStyle& style) const
    {
        if (!lines_.hasSelection()) return;
        jet::Color color = host().layerPen().color;
        color.a = kSelectionAlpha;
        for (int line = 0; line < lines_.lineCount(); ++line) {
            const TextLines::Part part = lines_.selectedIn(line);
            if (part.selected.empty() && !part.isToTheEnd) continue;
            const double start = lineStart(style, jet::ui::textWidth(lines_.line(line), style));
            const double left = start + jet::ui::textWidth(part.before, style);
            double right = start + jet::ui::textWidth(part.before + part.selected, style);
            if (part.isToTheEnd) right += kLineBreak * style.size;
            const double top = line * kLineHeight * style.size;
            const jet::Box box({left, top}, {right, top + kLineHeight * style.size});
            painter.fill(jet::Path::rectangle(box).transformed(frame), color);
        }
    }

    /// The place between two letters that is nearest.
    void placeCaret(const jet::Item& target, const jet::Vec2& at, bool selects)
    {
        const jet::TextStyle style = jet::ui::textStyleOf(target);
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
        if (!selects) lines_.dropSelection();
        host().requestRepaint();
    }

    bool editing_ = false, selecting_ = false;
    jet::ItemId item_;  // none: nothing was typed yet
    jet::Vec2 at_;      // where a new text's baseline starts
    TextLines lines_;
    std::string shown_;  // what the item has, as far as this tool knows
    int session_ = 0;
    jet::Subscription changed_;  // while editing: what the Inspector, a script or Undo makes of the text is shown
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<TextTool>("text-tool"); }
