#include "canvas/play_view.hpp"

#include "canvas/backdrop.hpp"
#include "canvas/qt_input.hpp"

#include <jet/physics_view.hpp>
#include <jet/scene_painter.hpp>
#include <jet/ui/qt_painter.hpp>

#include <QMouseEvent>
#include <QPainter>

#include <algorithm>

namespace jet::host {

namespace {

const QColor kPlaying(76, 175, 80), kPaused(242, 140, 30);
constexpr int kFramePixels = 3;
constexpr double kReachPixels = 8;       // so far from a body it is still taken hold of
constexpr Color kBand{0, 120, 90, 255};  // as marks of joints

void paintHand(const HeldBody& held, Painter& painter)
{
    const double pixel = 1 / painter.pixelsPerUnit();
    Pen pen;
    pen.color = kBand, pen.width = 2, pen.cosmetic = true, pen.cap = LineCap::Round;
    painter.stroke(Path::line(held.at, held.hand), pen);
    for (const auto& [at, pixels] : {std::pair(held.at, 4.0), std::pair(held.hand, 3.0)})
        painter.fill(Path::ellipse(Box(at, at).inflated(pixels * pixel)), kBand);
}

/// The poses of one frame.
class FramePoses final : public PoseSource {
public:
    explicit FramePoses(const SimulationFrame& frame) : frame_(frame) {}

    const Path* pose(const Item& item) const override { return find(frame_.poses, item.id()); }
    const LiveBody* liveBody(const Item& item) const override { return find(frame_.bodies, item.id()); }

private:
    /// In a list that is sorted by id.
    template <class T>
    static const T* find(const std::vector<std::pair<ItemId, T>>& list, ItemId id)
    {
        const auto found = std::lower_bound(list.begin(), list.end(), id,
                                            [](const auto& entry, ItemId wanted) { return entry.first < wanted; });
        return found != list.end() && found->first == id ? &found->second : nullptr;
    }

    const SimulationFrame& frame_;
};

}  // namespace

PlayView::PlayView(SimulationCenter& simulation, EventsCenter& events, const View& editView, QWidget* parent)
    : QWidget(parent), simulation_(simulation), editView_(editView)
{
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setCursor(Qt::ArrowCursor);
    parent->installEventFilter(this);  // to stay as large as the view below
    setGeometry(parent->rect());
    frames_ = events.subscribe<SimulationFrameReady>(nullptr, [this](const SimulationFrameReady&) { followFrame(); });
    states_ = events.subscribe<SimulationStateChanged>(nullptr, [this](const SimulationStateChanged&) { update(); });
    marks_ = events.subscribe<PhysicsMarksChanged>(nullptr, [this](const PhysicsMarksChanged&) { update(); });
}

bool PlayView::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::Resize) setGeometry(parentWidget()->rect());
    return QWidget::eventFilter(watched, event);
}

void PlayView::resizeEvent(QResizeEvent*)
{
    simulation_.setViewSize({static_cast<double>(width()), static_cast<double>(height())});
}

// --- painting

View PlayView::shownView(const SimulationFrame& frame) const
{
    const View& game = frame.view.view;
    const bool untouched = game.anchor == Vec2(0, 0) && game.scale == 1;
    return untouched ? editView_ : game;
}

View PlayView::shownView() const
{
    const std::shared_ptr<const SimulationFrame> frame = simulation_.frame();
    return frame ? shownView(*frame) : editView_;
}

void PlayView::followFrame()
{
    setCursor(dragging_ && simulation_.held() ? Qt::ClosedHandCursor : Qt::ArrowCursor);
    update();
}

void PlayView::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    const std::shared_ptr<const SimulationFrame> frame = simulation_.frame();
    if (frame && simulation_.runningScene()) {
        paintGame(painter, *frame);
    } else {
        painter.fillRect(rect(), palette().color(QPalette::Base));
    }
    paintFrame(painter);
}

void PlayView::paintGame(QPainter& painter, const SimulationFrame& frame)
{
    const Scene& scene = *simulation_.runningScene();
    const Color ground = backgroundOf(scene);
    painter.fillRect(rect(), QColor(ground.r, ground.g, ground.b));
    const View view = shownView(frame);
    const Vec2 size(width(), height());
    const FramePoses poses(frame);
    ui::QtPainter target(painter);
    target.save();
    target.transform(view.toPixels());
    paintScene(scene, &poses, PaintPurpose::Play, Box(view.anchor, view.anchor + size / view.scale), target);
    if (frame.physics) paintPhysics(*frame.physics, simulation_.physicsMarks(), target);
    if (const std::optional<HeldBody> held = simulation_.held()) paintHand(*held, target);
    target.restore();
}

void PlayView::paintFrame(QPainter& painter)
{
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(simulation_.state() == SimulationCenter::State::Paused ? kPaused : kPlaying, kFramePixels));
    const int inset = kFramePixels / 2;
    painter.drawRect(rect().adjusted(inset, inset, -inset - 1, -inset - 1));
}

// --- input

bool PlayView::event(QEvent* event)
{
    // Keys are the game's, but the function keys still pause and stop it, and Ctrl still saves.
    if (event->type() == QEvent::ShortcutOverride) {
        const auto* key = static_cast<QKeyEvent*>(event);
        const bool function = key->key() >= Qt::Key_F1 && key->key() <= Qt::Key_F35;
        if (!function && !(key->modifiers() & Qt::ControlModifier)) event->accept();
    }
    if (event->type() == QEvent::KeyPress) {  // QWidget would turn Tab into a change of focus
        keyPressEvent(static_cast<QKeyEvent*>(event));
        return true;
    }
    return QWidget::event(event);
}

void PlayView::keyPressEvent(QKeyEvent* event)
{
    if (!event->isAutoRepeat()) held_.insert(event->key());
    simulation_.key(keyEventOf(*event), true);
}

void PlayView::keyReleaseEvent(QKeyEvent* event)
{
    if (event->isAutoRepeat()) return;
    held_.remove(event->key());
    simulation_.key(keyEventOf(*event), false);
}

void PlayView::focusOutEvent(QFocusEvent* event)
{
    // The releases will go elsewhere: without this the hero keeps running.
    for (const int key : std::as_const(held_)) {
        simulation_.key(keyEventOf(QKeyEvent(QEvent::KeyRelease, key, Qt::NoModifier)), false);
    }
    held_.clear();
    letGo();
    QWidget::focusOutEvent(event);
}

void PlayView::sendPointer(ScriptEventKind kind, const QMouseEvent& event)
{
    const View view = shownView();
    const Vec2 pixels(event.position().x(), event.position().y());
    simulation_.pointer(
        kind, {view.anchor + pixels / view.scale, pixels, buttonOf(event.button()), modifiersOf(event.modifiers())});
}

bool PlayView::beginsDrag(const QMouseEvent& event) const
{
    if (event.button() != Qt::LeftButton) return false;
    return event.modifiers().testFlag(Qt::ControlModifier) || !simulation_.listensToPointer();
}

void PlayView::mousePressEvent(QMouseEvent* event)
{
    if (dragging_) return;  // other buttons in the midst of a drag
    if (!beginsDrag(*event)) return sendPointer(ScriptEventKind::PointerDown, *event);
    dragging_ = true;
    const View view = shownView();
    simulation_.grab(view.anchor + Vec2(event->position().x(), event->position().y()) / view.scale,
                     kReachPixels / view.scale);
}

void PlayView::mouseMoveEvent(QMouseEvent* event)
{
    if (!dragging_) return sendPointer(ScriptEventKind::PointerMove, *event);
    if (!event->buttons().testFlag(Qt::LeftButton)) return letGo();  // its release went elsewhere
    // Beyond the border nobody would see it again.
    const View view = shownView();
    const Vec2 pixels(std::clamp<double>(event->position().x(), 0, width()),
                      std::clamp<double>(event->position().y(), 0, height()));
    simulation_.drag(view.anchor + pixels / view.scale);
}

void PlayView::mouseReleaseEvent(QMouseEvent* event)
{
    if (!dragging_) return sendPointer(ScriptEventKind::PointerUp, *event);
    if (event->button() == Qt::LeftButton) letGo();
}

void PlayView::letGo()
{
    if (!std::exchange(dragging_, false)) return;
    simulation_.letGo();
    setCursor(Qt::ArrowCursor);
}

}  // namespace jet::host
