#include "window/theme.hpp"

#include "window/editor_style.hpp"

#include <QApplication>
#include <QPalette>

namespace jet::host {

namespace {

struct RoleColor {
    QPalette::ColorRole role;
    const char* color;
    const char* disabled;  ///< null: the same
};

constexpr RoleColor kColors[] = {
    {QPalette::Window, "#2b2d31", nullptr},      {QPalette::WindowText, "#d7dae0", "#7c8088"},
    {QPalette::Base, "#222428", nullptr},        {QPalette::AlternateBase, "#26282c", nullptr},
    {QPalette::Text, "#dfe2e7", "#7c8088"},      {QPalette::PlaceholderText, "#80858e", nullptr},
    {QPalette::Button, "#383b40", nullptr},      {QPalette::ButtonText, "#d7dae0", "#7c8088"},
    {QPalette::BrightText, "#ffffff", nullptr},  {QPalette::Light, "#4a4e55", nullptr},
    {QPalette::Midlight, "#414449", nullptr},    {QPalette::Mid, "#5a5f67", nullptr},
    {QPalette::Dark, "#1b1c1f", nullptr},        {QPalette::Shadow, "#101113", nullptr},
    {QPalette::Highlight, "#2f6fd6", "#4a4e55"}, {QPalette::HighlightedText, "#ffffff", "#b0b4ba"},
    {QPalette::ToolTipBase, "#3a3d43", nullptr}, {QPalette::ToolTipText, "#e6e8ec", nullptr},
    {QPalette::Link, "#6aa5ff", nullptr},        {QPalette::LinkVisited, "#b79cff", nullptr},
};

QPalette darkPalette()
{
    QPalette palette;
    for (const RoleColor& entry : kColors) {
        palette.setColor(entry.role, QColor(entry.color));
        if (entry.disabled) palette.setColor(QPalette::Disabled, entry.role, QColor(entry.disabled));
    }
    return palette;
}

// What the palette cannot say: flat bars, tabs with an accent, quiet dock titles.
constexpr const char* kStyleSheet = R"(
QToolTip { border: 1px solid #55595f; padding: 3px; }
QMainWindow::separator { background: #1f2124; width: 4px; height: 4px; }
QMainWindow::separator:hover { background: #2f6fd6; }
QToolBar { background: #2b2d31; border: none; spacing: 2px; padding: 3px; }
QToolBar::separator { background: #44474d; width: 1px; height: 1px; margin: 4px; }
QToolBar QToolButton { border: none; border-radius: 4px; padding: 4px; }
QToolBar QToolButton:hover { background: #3c4047; }
QToolBar QToolButton:pressed { background: #24262a; }
QToolBar QToolButton:checked { background: #2f6fd6; }
QMenuBar { background: #2b2d31; }
QMenuBar::item { padding: 4px 9px; border-radius: 4px; }
QMenuBar::item:selected { background: #3c4047; }
QStatusBar { background: #25272b; }
QStatusBar::item { border: none; }
QDockWidget::title { background: #32353a; padding: 5px 8px; }
QTabBar::tab { background: #26282c; color: #a9adb5; padding: 6px 12px; border: none; border-top: 2px solid transparent; }
QTabBar::tab:selected { background: #32353a; color: #e6e8ec; border-top: 2px solid #2f6fd6; }
QTabBar::tab:hover:!selected { background: #2f3237; }
QTabBar::tab:bottom { border-top: none; border-bottom: 2px solid transparent; }
QTabBar::tab:bottom:selected { border-bottom: 2px solid #2f6fd6; }
QTabWidget::pane { border: none; }
QTabBar QToolButton { border: none; border-radius: 3px; padding: 1px; }
QTabBar QToolButton:hover { background: #4a4e55; }
QPushButton { background: #383b40; border: 1px solid #1b1c1f; border-radius: 4px; padding: 5px 10px; }
QPushButton::menu-indicator { image: none; }
QPushButton:hover { background: #44484f; }
QPushButton:pressed { background: #2a2c30; }
QPushButton:default { border-color: #2f6fd6; }
QPushButton:disabled { color: #7c8088; }
QStatusBar QLabel { padding: 1px 8px; }
QHeaderView::section { background: #2b2d31; border: none; padding: 3px; }
QTreeView, QListView, QPlainTextEdit { border: 1px solid #1b1c1f; }
)";

}  // namespace

void applyTheme(QApplication& application)
{
    QApplication::setStyle(new EditorStyle);  // the application takes it
    QApplication::setPalette(darkPalette());
    application.setStyleSheet(QLatin1String(kStyleSheet));
}

}  // namespace jet::host
