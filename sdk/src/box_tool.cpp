#include <jet/box_tool.hpp>
#include <jet/catalog.hpp>

#include <cmath>

namespace jet {

namespace {

constexpr Color kGreen{50, 205, 50, 255};  // the thesis's face of new shapes (§4.2)

std::string shortText(double length) { return numberText(std::round(length * 100) / 100); }

std::string capitalized(std::string word)
{
    if (!word.empty() && word[0] >= 'a' && word[0] <= 'z') word[0] = static_cast<char>(word[0] - 'a' + 'A');
    return word;
}

}  // namespace

BoxTool::BoxTool(ToolHost& host, Words words) : Tool(host), words_(std::move(words)) {}

void BoxTool::activate()
{
    host().setCursor("cross");
    host().showStatus("Drag to draw: " + words_.shape + ". Shift: " + words_.constrained + ", Alt: from its centre.");
}

void BoxTool::press(const PointerEvent& event)
{
    if (event.button != PointerButton::Left) return;
    dragging_ = true;
    start_ = end_ = event.scene;
    constrain_ = event.modifiers;
}

void BoxTool::drag(const PointerEvent& event)
{
    end_ = event.scene;
    constrain_ = event.modifiers;
    show();
}

void BoxTool::release(const PointerEvent& event)
{
    if (!dragging_) return;
    end_ = event.scene;
    cancel();
    if (box().isEmpty()) return;  // a click without a drag draws nothing
    auto edit = host().items().begin("Create " + words_.shape);
    const Item& item = edit.add<ShapeItem>(host().insertionPoint(edit), shape(box()));
    // A new shape gets a face if there is an effect of that kind; without one its outline still shows.
    if (host().scene().catalog().effect("polygon-face"))
        edit.addEffect(item, "polygon-face", {{"color", host().options().get("color", options())}});
    edit.select(item);
    edit.commit();
}

bool BoxTool::keyPress(const KeyEvent& event) { return constrain(event.key, true); }
bool BoxTool::keyRelease(const KeyEvent& event) { return constrain(event.key, false); }

bool BoxTool::cancel()
{
    if (!dragging_) return false;
    dragging_ = false;
    host().showStatus("");
    host().requestRepaint();
    return true;
}

void BoxTool::paint(Painter& painter) const
{
    if (dragging_ && !box().isEmpty()) painter.stroke(shape(box()), host().layerPen());
}

const PropertyTable& BoxTool::options() const
{
    static const PropertyTable table{color("color", "Color", kGreen).says("Face of new shapes.")};
    return table;
}

void BoxTool::show()
{
    if (!dragging_) return;
    host().showStatus(capitalized(words_.shape) + " " + shortText(box().width()) + " × " + shortText(box().height()));
    host().requestRepaint();
}

// Shift and Alt also count when they are pressed or let go while the pointer rests.
bool BoxTool::constrain(const std::string& key, bool down)
{
    if (!dragging_ || (key != "Shift" && key != "Alt")) return false;
    (key == "Shift" ? constrain_.shift : constrain_.alt) = down;
    show();
    return true;
}

}  // namespace jet
