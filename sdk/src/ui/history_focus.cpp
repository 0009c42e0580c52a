#include <jet/ui/history_focus.hpp>

#include <QApplication>
#include <QDynamicPropertyChangeEvent>
#include <QMenu>
#include <QMenuBar>
#include <QPointer>
#include <QVariant>
#include <QWidget>

namespace jet::ui {

namespace {

constexpr const char* kProperty = "jet-history-focus";

/// The widget whose word counts for `widget`.
QWidget* holder(const QWidget* widget)
{
    for (; widget; widget = widget->parentWidget())
        if (widget->property(kProperty).isValid()) return const_cast<QWidget*>(widget);
    return nullptr;
}

}  // namespace

void setHistoryFocus(QWidget& widget, HistoryFocus focus)
{
    widget.setProperty(kProperty, QVariant::fromValue(static_cast<void*>(focus.scene)));
}

std::optional<HistoryFocus> historyFocus(const QWidget* widget)
{
    const QWidget* found = holder(widget);
    if (!found) return std::nullopt;
    return HistoryFocus{static_cast<Scene*>(found->property(kProperty).value<void*>())};
}

struct HistoryFocusWatch::Private final : QObject {
    explicit Private(std::function<void()> told)
    {
        connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) { follow(now); });
        follow(QApplication::focusWidget());
        changed = std::move(told);  // from now on: whoever makes this is not done with its own making
    }

    void follow(QWidget* now)
    {
        if (!now || qobject_cast<QMenu*>(now) || qobject_cast<QMenuBar*>(now)) return;
        focus = now;
        if (watched) watched->removeEventFilter(this);
        watched = holder(now);
        if (watched) watched->installEventFilter(this);
        if (changed) changed();
    }

    // The panel that has the focus says that it works on another history now.
    bool eventFilter(QObject*, QEvent* event) override
    {
        if (event->type() != QEvent::DynamicPropertyChange) return false;
        if (static_cast<QDynamicPropertyChangeEvent*>(event)->propertyName() == kProperty && changed) changed();
        return false;
    }

    std::function<void()> changed;
    QPointer<QWidget> focus;    // the last one that is no menu
    QPointer<QWidget> watched;  // around it: where its history focus is set
};

HistoryFocusWatch::HistoryFocusWatch(std::function<void()> changed) : d_(new Private(std::move(changed))) {}
HistoryFocusWatch::~HistoryFocusWatch() = default;
std::optional<HistoryFocus> HistoryFocusWatch::now() const { return historyFocus(d_->focus); }

}  // namespace jet::ui
