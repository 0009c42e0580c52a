#include <jet/ui/history_focus.hpp>

#include <QVariant>
#include <QWidget>

namespace jet::ui {

namespace {

constexpr const char* kProperty = "jet-history-focus";

}  // namespace

void setHistoryFocus(QWidget& widget, HistoryFocus focus)
{
    widget.setProperty(kProperty, QVariant::fromValue(static_cast<void*>(focus.scene)));
}

std::optional<HistoryFocus> historyFocus(const QWidget* widget)
{
    for (; widget; widget = widget->parentWidget()) {
        const QVariant set = widget->property(kProperty);
        if (set.isValid()) return HistoryFocus{static_cast<Scene*>(set.value<void*>())};
    }
    return std::nullopt;
}

}  // namespace jet::ui
