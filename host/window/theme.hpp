// The look of the editor: Fusion with one dark, neutral palette, so that the colours of the game stand out.
#pragma once

class QApplication;

namespace jet::host {

void applyTheme(QApplication& application);

}  // namespace jet::host
