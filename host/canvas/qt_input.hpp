// Qt's input events as tools and games get them.
#pragma once

#include <jet/input.hpp>

#include <Qt>

class QKeyEvent;

namespace jet::host {

Modifiers modifiersOf(Qt::KeyboardModifiers modifiers);
PointerButton buttonOf(Qt::MouseButton button);
KeyEvent keyEventOf(const QKeyEvent& event);

}  // namespace jet::host
