// History focus: which history Edit > Undo works on while the keyboard focus is in a panel. Without it that is the
// front scene's, whatever panel has the focus.
#pragma once

#include <jet/scene.hpp>

#include <functional>
#include <memory>
#include <optional>

class QWidget;

namespace jet::ui {

struct HistoryFocus {
    Scene* scene = nullptr;  ///< null: the history of the project's tree, Editor::projectTree()
    bool operator==(const HistoryFocus&) const = default;
};

/// While the focus is in this widget or in one inside of it, Edit > Undo and Redo work on that history. Set it anew
/// when the user did something that went to another one. [GUI thread]
JET_API void setHistoryFocus(QWidget& widget, HistoryFocus focus);
/// That of the widget or of the nearest one around it that has one. The scene may have gone since: look for it in the
/// project before using it. [GUI thread]
JET_API std::optional<HistoryFocus> historyFocus(const QWidget* widget);

/// Follows the history focus of the widget that has the keyboard focus. Menus do not count: they take the focus while
/// they are open, and Undo in them is meant for where it was. [GUI thread]
class JET_API HistoryFocusWatch {
public:
    /// `changed` is called when another history may be the one that Undo works on.
    explicit HistoryFocusWatch(std::function<void()> changed);
    ~HistoryFocusWatch();
    HistoryFocusWatch(const HistoryFocusWatch&) = delete;
    HistoryFocusWatch& operator=(const HistoryFocusWatch&) = delete;

    /// None: the front scene's. A scene may have gone since, as with historyFocus().
    std::optional<HistoryFocus> now() const;

private:
    struct Private;
    std::unique_ptr<Private> d_;
};

}  // namespace jet::ui
