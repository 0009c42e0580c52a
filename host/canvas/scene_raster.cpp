#include "canvas/scene_raster.hpp"

#include "canvas/backdrop.hpp"

#include <jet/scene_painter.hpp>
#include <jet/ui/qt_painter.hpp>

#include <QElapsedTimer>
#include <QPainter>

namespace jet::host {

namespace {

constexpr double kHeavyMs = 25;  // from here on, zooming at one picture a notch is felt
constexpr double kAntialiasPixels = 2;

}  // namespace

bool SceneRaster::paint(QPainter& painter, const View& view, const QSize& size, qreal devicePixelRatio, bool exact)
{
    const bool fits = !picture_.isNull() && size == size_ && picture_.devicePixelRatio() == devicePixelRatio;
    if (fits && !exact && canStretch(view)) {
        const Vec2 corner = (view_.anchor - view.anchor) * view.scale;
        const double factor = view.scale / view_.scale;
        const Color ground = backgroundOf(scene_);
        painter.fillRect(QRect(QPoint(), size), QColor(ground.r, ground.g, ground.b));
        painter.drawPixmap(QRectF(corner.x(), corner.y(), factor * size.width(), factor * size.height()), picture_,
                           QRectF(picture_.rect()));
        return false;
    }
    if (!fits || !scrollTo(view)) {
        renderAll(view, size, devicePixelRatio);
    } else {
        repairDamage();
    }
    painter.drawPixmap(0, 0, picture_);
    return true;
}

bool SceneRaster::canStretch(const View& view) const { return fullMs_ > kHeavyMs && view.scale != view_.scale; }

void SceneRaster::renderAll(const View& view, const QSize& size, qreal ratio)
{
    QElapsedTimer clock;
    clock.start();
    if (size != size_ || picture_.isNull() || picture_.devicePixelRatio() != ratio) {
        picture_ = QPixmap(size * ratio);
        picture_.setDevicePixelRatio(ratio);
    }
    view_ = view;
    size_ = size;
    tracker_.reset(scene_);
    touched_ = false;
    render(QRect(QPoint(), size));
    fullMs_ = static_cast<double>(clock.nsecsElapsed()) * 1e-6;
}

bool SceneRaster::scrollTo(const View& view)
{
    if (view.scale != view_.scale) return false;
    const Vec2 shift = (view_.anchor - view.anchor) * view.scale;
    const int dx = static_cast<int>(std::lround(shift.x())), dy = static_cast<int>(std::lround(shift.y()));
    if (std::abs(dx) >= size_.width() || std::abs(dy) >= size_.height()) return false;
    if ((shift - Vec2(dx, dy)).norm() > 1e-3) return false;  // not by whole pixels: the picture would blur
    if (dx == 0 && dy == 0) return true;
    const qreal ratio = picture_.devicePixelRatio();
    if (ratio != std::floor(ratio)) return false;
    const int step = static_cast<int>(ratio);
    picture_.scroll(dx * step, dy * step, picture_.rect());
    view_ = view;
    if (dx) render(QRect(dx > 0 ? 0 : size_.width() + dx, 0, std::abs(dx), size_.height()));
    if (dy) render(QRect(0, dy > 0 ? 0 : size_.height() + dy, size_.width(), std::abs(dy)));
    return true;
}

void SceneRaster::repairDamage()
{
    if (!touched_) return;
    touched_ = false;
    const Box damage = tracker_.update(scene_);
    if (damage.isNull()) return;
    const Affine toPixels = view_.toPixels();
    const Box pixels = Box(toPixels * damage.min, toPixels * damage.max).inflated(kAntialiasPixels);
    const QRectF seen =
        QRectF(QPointF(), QSizeF(size_)) & QRectF(pixels.min.x(), pixels.min.y(), pixels.width(), pixels.height());
    if (!seen.isEmpty()) render(seen.toAlignedRect());
}

void SceneRaster::render(const QRect& pixels)
{
    QPainter painter(&picture_);
    painter.setClipRect(pixels);
    paintBackdrop(painter, scene_, view_, pixels, grid_);
    const Affine toScene = view_.toPixels().inverse();
    const Box clip(toScene * Vec2(pixels.left() - kAntialiasPixels, pixels.top() - kAntialiasPixels),
                   toScene * Vec2(pixels.right() + kAntialiasPixels, pixels.bottom() + kAntialiasPixels));
    ui::QtPainter target(painter);
    target.save();
    target.transform(view_.toPixels());
    paintScene(scene_, nullptr, PaintPurpose::Edit, clip, target);
    target.restore();
}

}  // namespace jet::host
