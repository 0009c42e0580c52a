#include "window/view_controller.hpp"

#include <QCoreApplication>
#include <QSettings>

namespace jet::host {

namespace {

constexpr double kZoomStep = 1.25;

}  // namespace

ViewController::ViewController(Documents& documents, DockArea& docks, QObject* parent)
    : QObject(parent), documents_(documents), docks_(docks)
{
}

std::vector<ActionSpec> ViewController::actions()
{
    const auto open = [this] { return documents_.currentView() != nullptr; };
    const auto zoom = [this](double factor) { return [this, factor] { documents_.currentView()->zoomBy(factor); }; };
    return {
        {"view.zoom-in", QT_TRANSLATE_NOOP("Actions", "Zoom &in"), "", "Ctrl++;Ctrl+=", zoom(kZoomStep), open},
        {"view.zoom-out", QT_TRANSLATE_NOOP("Actions", "Zoom &out"), "", "Ctrl+-", zoom(1 / kZoomStep), open},
        {"view.zoom-reset", QT_TRANSLATE_NOOP("Actions", "&Actual size"), "", "Ctrl+0",
         [this] { documents_.currentView()->resetZoom(); }, open},
        {"view.frame", QT_TRANSLATE_NOOP("Actions", "&Frame selection"), "frame", "F", [this] { frameSelection(); },
         open},
        {"view.grid",
         QT_TRANSLATE_NOOP("Actions", "&Grid"),
         "grid",
         "Ctrl+'",
         [this] { setGrid(!grid_); },
         {},
         [this] { return grid_; }},
        {"view.maximize",
         QT_TRANSLATE_NOOP("Actions", "&Maximize document"),
         "maximize",
         "F11",
         [this] { docks_.setMaximized(!docks_.isMaximized()); },
         {},
         [this] { return docks_.isMaximized(); }},
        {"view.reset-layout", QT_TRANSLATE_NOOP("Actions", "&Reset panel layout"), "", "",
         [this] { docks_.resetLayout(); }},
        {"view.close", QT_TRANSLATE_NOOP("Actions", "&Close tab"), "", "Ctrl+W", [this] { documents_.closeCurrent(); },
         [this] { return documents_.count() > 0; }},
    };
}

void ViewController::frameSelection()
{
    SceneView& view = *documents_.currentView();
    const Scene& scene = view.scene();
    Box box;
    for (const ItemId id : scene.items().selection()) box.extend(scene.items().find(id)->bounds());
    view.frame(box.isNull() ? scene.root().bounds() : box);
}

void ViewController::follow(Editor& editor)
{
    shown_ = editor.events().subscribe<ShowArea>(nullptr, [this, &editor](const ShowArea& wish) {
        if (wish.area.isNull()) return;
        editor.openScene(*wish.scene);
        SceneView* view = documents_.currentView();
        if (!view) return;
        const Vec2 atLeast = 0.5 * Vec2(view->width(), view->height());  // 1:1
        const Vec2 half = (0.5 * wish.area.size()).cwiseMax(atLeast);
        view->frame(Box(wish.area.center() - half, wish.area.center() + half));
    });
}

void ViewController::setGrid(bool on)
{
    grid_ = on;
    for (SceneView* view : documents_.views()) view->setGridVisible(on);
}

void ViewController::restore(QSettings& settings) { setGrid(settings.value("view/grid", true).toBool()); }
void ViewController::save(QSettings& settings) const { settings.setValue("view/grid", grid_); }

}  // namespace jet::host
