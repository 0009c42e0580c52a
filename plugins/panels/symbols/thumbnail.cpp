#include "thumbnail.hpp"

#include <jet/scene_painter.hpp>
#include <jet/ui/qt_painter.hpp>

#include <QPainter>

#include <algorithm>

namespace jet::symbol_list {

namespace {

constexpr double kMargin = 4;             // pixels
constexpr std::size_t kMostItems = 2000;  // of one picture: a list is drawn quickly, whatever is in it

}  // namespace

QPixmap thumbnailOf(const Scene& scene, const Item& item, const QSize& size, qreal pixelRatio)
{
    QPixmap picture(size * pixelRatio);
    picture.setDevicePixelRatio(pixelRatio);
    picture.fill(QColor(250, 250, 252));  // paper: what is drawn for a light scene is seen
    const Box area = item.bounds();
    if (area.isNull()) return picture;
    const Vec2 room(size.width() - 2 * kMargin, size.height() - 2 * kMargin);
    const Vec2 extent = area.size().cwiseMax(Vec2(1e-6, 1e-6));
    const double scale = std::min(room.x() / extent.x(), room.y() / extent.y());
    const Vec2 centre(0.5 * size.width(), 0.5 * size.height());

    QPainter pixels(&picture);
    ui::QtPainter painter(pixels);
    painter.setAssetFolder(scene.assetFolder());
    painter.transform(Affine::translation(centre) * Affine::scaling({scale, scale}) *
                      Affine::translation(-area.center()));
    std::size_t painted = 0;
    item.walk([&](const Item& one) {
        if (!one.visible() || painted > kMostItems) return false;
        if (!one.path().isEmpty()) paintItem(scene, one, one.path(), PaintPurpose::Edit, painter), ++painted;
        return true;
    });
    return picture;
}

}  // namespace jet::symbol_list
