// The part of the conformance run with Qt: libjet-check-ui.so, loaded by the child processes that test panels and
// commands, so that bin/jet itself links no Qt.
#pragma once

namespace jet {
class Panel;
}

extern "C" {
struct JetCheckWindow {
    /// Makes an application on the offscreen platform and calls `body(data)` in it.
    void (*run)(void (*body)(void*), void* data);
    /// Makes the panel's widget, shows it in several sizes, lets events pass. Null, or why it cannot be used.
    const char* (*show)(jet::Panel& panel);
    /// Lets events pass, and repaints what is shown.
    void (*settle)();
    /// Destroys the widgets that show() made.
    void (*close)();
};
}

inline constexpr const char* kJetCheckWindowSymbol = "jet_check_window";
