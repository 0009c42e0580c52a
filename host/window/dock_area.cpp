#include "window/dock_area.hpp"

#include "window/guarded_application.hpp"

#include <jet/ui/panel.hpp>

#include <QLabel>
#include <QMainWindow>
#include <QMenu>
#include <QScrollArea>
#include <QSettings>
#include <QShortcut>
#include <QTimer>

#include <algorithm>

namespace jet::host {

namespace {

constexpr int kLayoutVersion = 1;  // a change of the default arrangement that old files must not hide
constexpr int kTabGroup = 100;     // panels whose `order` has the same hundreds share a tab bar

QString dockName(const Contribution& panel) { return QStringLiteral("panel:") + QString::fromStdString(panel.id); }

Qt::DockWidgetArea areaOf(const Contribution& panel)
{
    if (panel.area == "left") return Qt::LeftDockWidgetArea;
    if (panel.area == "bottom") return Qt::BottomDockWidgetArea;
    return Qt::RightDockWidgetArea;
}

/// A panel that is higher than its place scrolls, else the tallest panel of a tab bar would take the others' room.
QScrollArea* scrolling(QWidget& content)
{
    constexpr int kWidest = 300;  // pixels
    auto* area = new QScrollArea;
    area->setFrameShape(QFrame::NoFrame);
    area->setWidgetResizable(true);
    area->setMinimumWidth(std::min(content.minimumSizeHint().width(), kWidest));
    area->setWidget(&content);
    area->setFocusProxy(&content);
    return area;
}

}  // namespace

DockArea::DockArea(QMainWindow& window, Editor& editor) : QObject(&window), window_(window), editor_(editor) {}

DockArea::~DockArea()
{
    for (const auto& dock : docks_) delete dock->widget;  // panels go after their widgets
}

void DockArea::createDocks()
{
    for (Contribution& panel : editor_.catalog().contributions(ContributionKind::Panel)) createDock(std::move(panel));
    placeDefault();
}

DockArea::Dock& DockArea::createDock(Contribution panel)
{
    auto* widget = new QDockWidget(QString::fromStdString(panel.label), &window_);
    widget->setObjectName(dockName(panel));
    docks_.push_back(std::make_unique<Dock>(Dock{std::move(panel), widget, nullptr}));
    Dock& dock = *docks_.back();
    connect(widget, &QDockWidget::visibilityChanged, this,
            [this, &dock](bool visible) { fillWhenSeen(dock, visible); });
    if (!dock.panel.shortcut.empty()) {
        auto* shortcut = new QShortcut(QKeySequence::fromString(QString::fromStdString(dock.panel.shortcut)), &window_);
        connect(shortcut, &QShortcut::activated, this, [this, &dock] { bringUp(dock); });
    }
    return dock;
}

void DockArea::bringUp(Dock& dock)
{
    if (dock.gone) return;
    dock.widget->show();
    dock.widget->raise();
    fillWhenSeen(dock, true);
    if (QWidget* content = dock.widget->widget()) content->setFocus(Qt::ShortcutFocusReason);
}

void DockArea::empty(Dock& dock)
{
    delete dock.widget->widget();
    dock.content.reset();  // after its widget
    dock.failed = false;
}

void DockArea::rebuild()
{
    std::vector<Contribution> panels = editor_.catalog().contributions(ContributionKind::Panel);
    const auto isOf = [](const Contribution& panel) {
        return [&panel](const auto& dock) { return dock->panel.id == panel.id; };
    };
    for (const auto& dock : docks_) {
        const bool there =
            std::any_of(panels.begin(), panels.end(), [&](const auto& panel) { return panel.id == dock->panel.id; });
        if (there || dock->gone) continue;
        dock->gone = true;
        dock->wasShown = !dock->widget->isHidden();
        dock->widget->hide();
        empty(*dock);
    }
    for (Contribution& panel : panels) {
        const auto known = std::find_if(docks_.begin(), docks_.end(), isOf(panel));
        if (known == docks_.end()) {
            Dock& dock = createDock(std::move(panel));
            window_.addDockWidget(areaOf(dock.panel), dock.widget);
        } else if ((*known)->gone || (*known)->failed) {
            (*known)->gone = false;
            empty(**known);
            if ((*known)->wasShown) (*known)->widget->show();
            fillWhenSeen(**known, (*known)->widget->isVisible());
        }
    }
}

void DockArea::fillWhenSeen(Dock& dock, bool visible)
{
    if (!visible || dock.content || dock.failed || dock.gone) return;
    dock.content = editor_.catalog().createPanel(dock.panel.id, editor_);
    QWidget* widget = dock.content ? dock.content->createWidget() : nullptr;
    if (!widget) {
        dock.failed = true;
        const std::string why = editor_.catalog().explain(ContributionKind::Panel, dock.panel.id);
        auto* label = new QLabel(QString::fromStdString(why));
        label->setWordWrap(true);
        label->setMargin(10);
        widget = label;
    }
    GuardedApplication::setOwner(*widget, dock.failed ? std::string() : dock.panel.plugin);
    dock.widget->setWidget(scrolling(*widget));
}

void DockArea::dropContent(const std::string& plugin)
{
    for (const auto& dock : docks_)
        if (dock->panel.plugin == plugin && (dock->content || dock->failed)) empty(*dock);
}

void DockArea::showFailures(const PluginRuntime& plugins)
{
    for (const auto& dock : docks_) {
        if (!dock->content || plugins.isUsable(dock->panel.plugin)) continue;
        empty(*dock);
        fillWhenSeen(*dock, dock->widget->isVisible());
    }
}

void DockArea::refillContent()
{
    for (const auto& dock : docks_) fillWhenSeen(*dock, dock->widget->isVisible());
}

void DockArea::placeDefault()
{
    // In each area: panels of one hundred of `order` are tabs, the next hundred lies below (beside, at the bottom).
    QMap<Qt::DockWidgetArea, std::pair<int, QDockWidget*>> last;
    QList<QDockWidget*> fronts;
    for (const auto& dock : docks_) {
        const Qt::DockWidgetArea area = areaOf(dock->panel);
        const int group = dock->panel.order / kTabGroup;
        const auto before = last.constFind(area);
        window_.addDockWidget(area, dock->widget);
        if (before != last.constEnd() && before->first == group) {
            window_.tabifyDockWidget(before->second, dock->widget);
        } else {
            fronts << dock->widget;
        }
        last.insert(area, {group, dock->widget});
        dock->widget->show();
    }
    for (QDockWidget* front : fronts) front->raise();
    fronts_ = fronts;
    shareOut();
    QTimer::singleShot(0, this, [this] {  // a window that was not shown yet has no room to share
        if (!restored_) shareOut();
    });
}

/// Columns of equal parts beside a canvas that gets most of the window.
void DockArea::shareOut()
{
    constexpr int kColumn = 360, kBottom = 210;  // pixels
    for (const auto area : {Qt::LeftDockWidgetArea, Qt::RightDockWidgetArea, Qt::BottomDockWidgetArea}) {
        QList<QDockWidget*> here;
        for (QDockWidget* front : std::as_const(fronts_))
            if (window_.dockWidgetArea(front) == area) here << front;
        const bool column = area != Qt::BottomDockWidgetArea;
        const auto along = column ? Qt::Vertical : Qt::Horizontal, across = column ? Qt::Horizontal : Qt::Vertical;
        window_.resizeDocks(here, QList<int>(here.size(), window_.height()), along);
        window_.resizeDocks(here, QList<int>(here.size(), column ? kColumn : kBottom), across);
    }
}

// --- the layout between runs

void DockArea::createStandIns(const QStringList& names)
{
    for (const QString& name : names) {
        if (window_.findChild<QDockWidget*>(name)) continue;
        auto* standIn = new QDockWidget(&window_);
        standIn->setObjectName(name);
        standIns_.insert(name, standIn);
        window_.addDockWidget(Qt::RightDockWidgetArea, standIn);
    }
}

void DockArea::restoreLayout(QSettings& settings)
{
    window_.restoreGeometry(settings.value("layout/geometry").toByteArray());
    createStandIns(settings.value("layout/docks").toStringList());
    restored_ = window_.restoreState(settings.value("layout/state").toByteArray(), kLayoutVersion);
    for (const auto& standIn : std::as_const(standIns_)) {
        if (!standIn->isHidden()) shownStandIns_ << standIn->objectName();
        standIn->hide();
    }
    // Restoring a hidden layout leaves docks unseen that the user never closed by hand; first seen is when they are
    // filled.
    for (const auto& dock : docks_) fillWhenSeen(*dock, dock->widget->isVisible());
}

void DockArea::saveLayout(QSettings& settings)
{
    setMaximized(false);
    for (const QString& name : std::as_const(shownStandIns_)) standIns_[name]->show();
    QStringList names = standIns_.keys();
    for (const auto& dock : docks_) names << dock->widget->objectName();
    settings.setValue("layout/docks", names);
    settings.setValue("layout/state", window_.saveState(kLayoutVersion));
    settings.setValue("layout/geometry", window_.saveGeometry());
    for (const QString& name : std::as_const(shownStandIns_)) standIns_[name]->hide();
}

void DockArea::resetLayout()
{
    setMaximized(false);
    restored_ = false;
    for (const auto& dock : docks_) {
        dock->widget->setFloating(false);
        window_.removeDockWidget(dock->widget);
    }
    placeDefault();
}

void DockArea::fillMenu(QMenu& menu) const
{
    for (const auto& dock : docks_)
        if (!dock->gone) menu.addAction(dock->widget->toggleViewAction());
}

void DockArea::setMaximized(bool on)
{
    if (on == maximized_) return;
    maximized_ = on;
    if (!on) {
        for (QDockWidget* dock : std::as_const(hiddenByMaximize_)) dock->show();
        hiddenByMaximize_.clear();
        return;
    }
    for (const auto& dock : docks_) {
        if (dock->gone || dock->widget->isHidden() || dock->widget->isFloating()) continue;
        hiddenByMaximize_ << dock->widget;
        dock->widget->hide();
    }
}

}  // namespace jet::host
