#include "canvas/qt_input.hpp"

#include <QKeyEvent>

#include <iterator>

namespace jet::host {

namespace {

struct KeyName {
    int key;
    const char* name;
};

constexpr KeyName kKeyNames[] = {
    {Qt::Key_Left, "Left"},         {Qt::Key_Right, "Right"},     {Qt::Key_Up, "Up"},
    {Qt::Key_Down, "Down"},         {Qt::Key_Space, "Space"},     {Qt::Key_Return, "Enter"},
    {Qt::Key_Enter, "Enter"},       {Qt::Key_Escape, "Escape"},   {Qt::Key_Backspace, "Backspace"},
    {Qt::Key_Delete, "Delete"},     {Qt::Key_Tab, "Tab"},         {Qt::Key_Backtab, "Tab"},
    {Qt::Key_Shift, "Shift"},       {Qt::Key_Control, "Control"}, {Qt::Key_Alt, "Alt"},
    {Qt::Key_Home, "Home"},         {Qt::Key_End, "End"},         {Qt::Key_PageUp, "PageUp"},
    {Qt::Key_PageDown, "PageDown"}, {Qt::Key_Insert, "Insert"},
};

std::string nameOf(const QKeyEvent& event)
{
    const int key = event.key();
    for (const KeyName& known : kKeyNames) {
        if (known.key == key) return known.name;
    }
    if (key >= Qt::Key_F1 && key <= Qt::Key_F12) return "F" + std::to_string(key - Qt::Key_F1 + 1);
    // With Ctrl held the text is a control character: the letter is in the key.
    if ((key >= Qt::Key_A && key <= Qt::Key_Z) || (key >= Qt::Key_0 && key <= Qt::Key_9)) {
        return std::string(1, static_cast<char>(key));
    }
    return event.text().toStdString();
}

}  // namespace

Modifiers modifiersOf(Qt::KeyboardModifiers modifiers)
{
    return {modifiers.testFlag(Qt::ShiftModifier), modifiers.testFlag(Qt::AltModifier),
            modifiers.testFlag(Qt::ControlModifier)};
}

PointerButton buttonOf(Qt::MouseButton button)
{
    switch (button) {
    case Qt::LeftButton: return PointerButton::Left;
    case Qt::RightButton: return PointerButton::Right;
    case Qt::MiddleButton: return PointerButton::Middle;
    default: return PointerButton::None;
    }
}

KeyEvent keyEventOf(const QKeyEvent& event)
{
    return {nameOf(event), event.text().toStdString(), modifiersOf(event.modifiers()), event.isAutoRepeat()};
}

}  // namespace jet::host
