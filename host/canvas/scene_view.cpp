#include "canvas/scene_view.hpp"

#include "canvas/qt_input.hpp"

#include <jet/ui/qt_painter.hpp>
#include <jet/ui/scene_drop.hpp>

#include <QDragEnterEvent>
#include <QMimeData>
#include <QMouseEvent>
#include <QPainter>
#include <QUrl>

#include <algorithm>

namespace jet::host {

namespace {

constexpr int kSharpenMs = 90;
constexpr int kClickPixels = 4;  // a right press that moves less is a click
constexpr double kZoomANotch = 1.2;
constexpr double kWheelNotch = 120;  // Qt counts eighths of a degree, 15 degrees a notch

Vec2 toVec(const QPointF& p) { return {p.x(), p.y()}; }

bool isSettingsChange(const ItemsChanged& event)
{
    return std::any_of(event.changes.begin(), event.changes.end(),
                       [](const Change& change) { return std::holds_alternative<ScenePropertyChanged>(change); });
}

}  // namespace

SceneView::SceneView(Scene& scene, Editor& editor, ToolOptions& options, QWidget* parent)
    : QWidget(parent), scene_(scene), editor_(editor), options_(options), raster_(scene)
{
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setAcceptDrops(true);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setMinimumSize(80, 60);
    sharpen_.setSingleShot(true);
    connect(&sharpen_, &QTimer::timeout, this, [this] {
        exact_ = true;
        update();
    });
    EventsCenter& events = editor.events();
    touched_ = events.subscribe<SceneTouched>(&scene, [this](const SceneTouched&) {
        raster_.touch();
        update();
    });
    selected_ = events.subscribe<SelectionChanged>(&scene, [this](const SelectionChanged&) { update(); });
    changed_ = events.subscribe<ItemsChanged>(&scene, [this](const ItemsChanged& event) {
        if (isSettingsChange(event)) raster_.invalidate();
        raster_.touch();
        update();
    });
}

SceneView::~SceneView() { dropTools(); }

// --- camera

void SceneView::cameraMoved()
{
    keepFramed_ = false;
    update();
    emit viewChanged();
}

void SceneView::setView(const View& view)
{
    camera_.setView(view);
    cameraMoved();
}

void SceneView::frame(const Box& box)
{
    camera_.frame(box, {width(), height()});
    cameraMoved();
}

void SceneView::resetZoom() { zoomBy(1 / camera_.view().scale); }

void SceneView::zoomBy(double factor)
{
    camera_.zoomAbout({0.5 * width(), 0.5 * height()}, factor);
    cameraMoved();
}

void SceneView::setGridVisible(bool on)
{
    raster_.setGrid(on);
    update();
}

void SceneView::invalidate()
{
    raster_.invalidate();
    update();
}

QPointF SceneView::sceneCentre() const
{
    const Vec2 at = camera_.toScene({0.5 * width(), 0.5 * height()});
    return {at.x(), at.y()};
}

void SceneView::frameAll()
{
    const Box box = scene_.root().bounds();
    if (box.isNull()) return;
    camera_.frame(box, {width(), height()});
    emit viewChanged();
}

void SceneView::resizeEvent(QResizeEvent*)
{
    if (keepFramed_) frameAll();
}

// --- tool

void SceneView::setTool(const std::string& id)
{
    if (tool_ && tool_->id() == id) return;
    if (tool_) tool_->deactivate();
    leftDown_ = false;
    ToolSurface& surface = *this;  // a private base: nobody else sees it
    auto found = tools_.find(id);
    if (found == tools_.end()) {
        found = tools_.emplace(id, std::make_unique<ToolSession>(id, scene_, editor_, options_, surface)).first;
    }
    tool_ = found->second.get();
    if (!tool_->tool()) editor_.showMissing(ContributionKind::Tool, id);
    tool_->activate();
    update();
}

void SceneView::endGesture()
{
    leftDown_ = false;
    if (tool_) tool_->cancel();
    if (scene_.items().inTransaction()) scene_.items().abandon();
}

bool SceneView::cancelGesture()
{
    leftDown_ = false;
    return tool_ && tool_->cancel();
}

void SceneView::dropTools()
{
    if (tool_) tool_->deactivate();
    tool_ = nullptr;
    tools_.clear();
}

void SceneView::setToolCursor(const QCursor& cursor)
{
    toolCursor_ = cursor;
    setAttribute(Qt::WA_InputMethodEnabled, cursor.shape() == Qt::IBeamCursor);  // else it would take the letter keys
    updateCursor();
}

void SceneView::clickTool(const PointerEvent& click)
{
    if (!tool_) return;
    tool_->press(click);
    tool_->release(click);
}

void SceneView::updateCursor()
{
    if (pan_ && pan_->moved) {
        setCursor(Qt::ClosedHandCursor);
    } else {
        setCursor(spaceHeld_ ? QCursor(Qt::OpenHandCursor) : toolCursor_);
    }
}

// --- painting

void SceneView::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    if (!raster_.paint(painter, camera_.view(), size(), devicePixelRatioF(), exact_)) sharpen_.start(kSharpenMs);
    exact_ = false;
    if (!tool_) return;
    ui::QtPainter target(painter);
    target.save();
    target.transform(camera_.view().toPixels());
    tool_->paint(target);
    target.restore();
}

// --- pointer

PointerEvent SceneView::pointerEvent(const QMouseEvent& event, Qt::MouseButton button) const
{
    const Vec2 pixels = toVec(event.position());
    return {camera_.toScene(pixels), pixels, buttonOf(button), modifiersOf(event.modifiers())};
}

void SceneView::startPan(const QMouseEvent& event)
{
    pan_ = Pan{event.button(), event.position().toPoint(), false};
    updateCursor();
}

void SceneView::continuePan(const QMouseEvent& event)
{
    const QPoint here = event.position().toPoint();
    const QPoint by = here - pan_->last;
    if (!pan_->moved && by.manhattanLength() < kClickPixels) return;
    pan_->moved = true;
    pan_->last = here;
    camera_.panBy({static_cast<double>(by.x()), static_cast<double>(by.y())});
    updateCursor();
    cameraMoved();
}

void SceneView::endPan(const QMouseEvent& event)
{
    const Pan ended = *pan_;
    pan_.reset();
    updateCursor();
    if (ended.button == Qt::RightButton && !ended.moved) emit contextMenuRequested(event.globalPosition().toPoint());
}

void SceneView::mousePressEvent(QMouseEvent* event)
{
    keepFramed_ = false;
    if (pan_) return;
    const bool left = event->button() == Qt::LeftButton;
    if (!left || spaceHeld_) {
        if (!leftDown_) startPan(*event);
        return;
    }
    leftDown_ = true;
    if (tool_) tool_->press(pointerEvent(*event, Qt::LeftButton));
}

void SceneView::mouseMoveEvent(QMouseEvent* event)
{
    const Vec2 scene = camera_.toScene(toVec(event->position()));
    emit pointerMoved({scene.x(), scene.y()});
    if (pan_) return continuePan(*event);
    if (!tool_) return;
    if (leftDown_) {
        tool_->drag(pointerEvent(*event, Qt::LeftButton));
    } else if (event->buttons() == Qt::NoButton) {
        tool_->move(pointerEvent(*event, Qt::NoButton));
    }
}

void SceneView::mouseReleaseEvent(QMouseEvent* event)
{
    if (pan_ && event->button() == pan_->button) return endPan(*event);
    if (event->button() != Qt::LeftButton || !leftDown_) return;
    leftDown_ = false;
    if (tool_) tool_->release(pointerEvent(*event, Qt::LeftButton));
}

void SceneView::mouseDoubleClickEvent(QMouseEvent* event)
{
    if (event->button() == Qt::LeftButton && tool_ && !spaceHeld_) {
        tool_->doubleClick(pointerEvent(*event, Qt::LeftButton));
    } else {
        mousePressEvent(event);
    }
}

void SceneView::wheelEvent(QWheelEvent* event)
{
    const double steps = event->angleDelta().y() / kWheelNotch;
    if (steps == 0) return;
    const Vec2 pixels = toVec(event->position());
    const WheelEvent wheel{camera_.toScene(pixels), steps, modifiersOf(event->modifiers())};
    if (!tool_ || !tool_->wheel(wheel)) {
        camera_.zoomAbout(pixels, std::pow(kZoomANotch, steps));
        cameraMoved();
    }
    event->accept();
}

void SceneView::leaveEvent(QEvent*) { emit pointerLeft(); }

// --- keys

bool SceneView::event(QEvent* event)
{
    // Plain keys are the tool's first: without this, Delete, arrows and letters would go to menu shortcuts. Tab would
    // move the focus.
    if (event->type() == QEvent::ShortcutOverride) {
        const auto* key = static_cast<QKeyEvent*>(event);
        const bool plain = !(key->modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier));
        const bool function = key->key() >= Qt::Key_F1 && key->key() <= Qt::Key_F35;
        const bool letters =
            tool_ && tool_->isTextEditing() && !(key->modifiers() & (Qt::AltModifier | Qt::MetaModifier));
        if ((plain || letters) && !function) event->accept();
    }
    return QWidget::event(event);
}

void SceneView::keyPressEvent(QKeyEvent* event)
{
    const bool isPan = event->key() == Qt::Key_Space && !leftDown_;
    if (isPan && spaceHeld_) return;
    if (tool_ && tool_->keyPress(keyEventOf(*event))) return;  // also the space bar: a tool may take text
    if (!isPan) {
        emit keyUnused(event);
        return;
    }
    spaceHeld_ = true;
    updateCursor();
}

// What an input method made of several keys comes as one.
void SceneView::inputMethodEvent(QInputMethodEvent* event)
{
    const std::string text = event->commitString().toStdString();
    if (tool_ && !text.empty()) tool_->keyPress({text, text, {}, false});
    event->accept();
}

void SceneView::keyReleaseEvent(QKeyEvent* event)
{
    if (event->key() == Qt::Key_Space && !event->isAutoRepeat()) {
        spaceHeld_ = false;
        updateCursor();
    } else if (tool_) {
        tool_->keyRelease(keyEventOf(*event));
    }
}

void SceneView::focusOutEvent(QFocusEvent* event)
{
    spaceHeld_ = false;
    updateCursor();
    QWidget::focusOutEvent(event);
}

// --- what is dropped on the view

void SceneView::dragEnterEvent(QDragEnterEvent* event)
{
    if (event->mimeData()->hasUrls() || event->mimeData()->hasFormat(ui::kSceneDrag)) event->acceptProposedAction();
}

void SceneView::dropEvent(QDropEvent* event)
{
    const Vec2 at = camera_.toScene(toVec(event->position()));
    if (event->mimeData()->hasFormat(ui::kSceneDrag)) {
        event->acceptProposedAction();
        endGesture();
        setFocus();  // what was dropped is selected there
        const std::string data = event->mimeData()->data(ui::kSceneDrag).toStdString();
        editor_.events().post(&editor_, ui::DroppedOnScene{&scene_, at, data});
        return;
    }
    QStringList files;
    for (const QUrl& url : event->mimeData()->urls()) {
        if (url.isLocalFile()) files << url.toLocalFile();
    }
    if (files.isEmpty()) return;
    event->acceptProposedAction();
    emit filesDropped(files, {at.x(), at.y()});
}

}  // namespace jet::host
