#include "window/documents.hpp"

#include <jet/ui/icons.hpp>

#include <QTabBar>
#include <QToolButton>

#include <algorithm>

namespace jet::host {

Documents::Documents(Editor& editor, ToolOptions& options, QWidget* parent)
    : QTabWidget(parent), editor_(editor), options_(options)
{
    setDocumentMode(true);
    setMovable(true);
    setElideMode(Qt::ElideRight);
    connect(this, &QTabWidget::currentChanged, this, [this] {
        emit frontChanged();
        if (currentWidget()) currentWidget()->setFocus();
    });
}

void Documents::addPage(QWidget* page, const char* icon, const QString& title)
{
    const int index = addTab(page, ui::icon(icon), title);
    auto* close = new QToolButton(this);  // the style's own close button does not follow the palette
    close->setIcon(ui::icon("close"));
    close->setIconSize(QSize(12, 12));
    close->setAutoRaise(true);
    close->setToolTip(tr("Close"));
    connect(close, &QToolButton::clicked, page, [this, page] { closePage(page); });
    tabBar()->setTabButton(index, QTabBar::RightSide, close);
}

SceneView& Documents::openScene(Scene& scene)
{
    SceneView* view = viewOf(scene);
    if (!view) {
        view = new SceneView(scene, editor_, options_, this);
        view->keepAllFramed();
        emit viewOpened(view);
        addPage(view, "scene", QString::fromStdString(scene.name()));
    }
    setCurrentWidget(view);
    return *view;
}

ScriptTab& Documents::openScript(Scene& scene, ItemId script, int line)
{
    ScriptTab* tab = nullptr;
    for (ScriptTab* open : pages<ScriptTab>()) {
        if (&open->scene() == &scene && open->script() == script) tab = open;
    }
    if (!tab) {
        tab = new ScriptTab(scene, script, editor_, this);
        addPage(tab, "script", tab->title());
        connect(tab, &ScriptTab::titleChanged, this, &Documents::updateTitles);
        connect(tab, &ScriptTab::scriptGone, this, [this, tab] { closePage(tab); });
    }
    setCurrentWidget(tab);
    if (line > 0) tab->code().goToLine(line);
    return *tab;
}

void Documents::closePage(QWidget* page)
{
    if (auto* script = qobject_cast<ScriptTab*>(page)) script->commit();
    if (auto* view = qobject_cast<SceneView*>(page)) {
        view->endGesture();
        emit viewClosing(view);
        view->dropTools();
    }
    removeTab(indexOf(page));
    page->hide();
    page->deleteLater();
}

std::vector<const Scene*> Documents::scenes() const
{
    std::vector<const Scene*> found;
    for (const SceneView* view : pages<SceneView>()) found.push_back(&view->scene());
    for (const ScriptTab* script : pages<ScriptTab>())
        if (std::find(found.begin(), found.end(), &script->scene()) == found.end()) found.push_back(&script->scene());
    return found;
}

void Documents::closeScene(const Scene& scene)
{
    for (ScriptTab* script : pages<ScriptTab>()) {
        if (&script->scene() != &scene) continue;
        script->commit();
        delete script;  // now: its scene may be about to go
    }
    if (SceneView* view = viewOf(scene)) {
        view->endGesture();
        emit viewClosing(view);
        delete view;
    }
}

void Documents::closeAll()
{
    commitScripts();
    for (ScriptTab* script : pages<ScriptTab>()) delete script;
    for (SceneView* view : pages<SceneView>()) {
        view->endGesture();
        emit viewClosing(view);
        delete view;
    }
}

void Documents::closeCurrent()
{
    if (currentWidget()) closePage(currentWidget());
}

SceneView* Documents::currentView() const { return qobject_cast<SceneView*>(currentWidget()); }

Scene* Documents::currentScene() const
{
    if (SceneView* view = currentView()) return &view->scene();
    const auto* script = qobject_cast<ScriptTab*>(currentWidget());
    return script ? &script->scene() : nullptr;
}

SceneView* Documents::viewOf(const Scene& scene) const
{
    for (SceneView* view : pages<SceneView>()) {
        if (&view->scene() == &scene) return view;
    }
    return nullptr;
}

void Documents::commitScripts()
{
    for (ScriptTab* script : pages<ScriptTab>()) script->commit();
}

void Documents::updateTitles()
{
    for (int i = 0; i < count(); ++i) {
        QString title;
        if (const auto* view = qobject_cast<SceneView*>(widget(i))) {
            title = QString::fromStdString(view->scene().name());
            if (!view->scene().undoRedo().isClean()) title += QLatin1Char('*');
        } else if (const auto* script = qobject_cast<ScriptTab*>(widget(i))) {
            title = script->title();
        }
        if (title != tabText(i)) setTabText(i, title);
    }
}

}  // namespace jet::host
