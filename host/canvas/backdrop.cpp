#include "canvas/backdrop.hpp"

#include <QColor>
#include <QPainter>

namespace jet::host {

namespace {

constexpr double kFinestLinePixels = 12;
constexpr int kLinesAMajor = 5;

/// Dark lines on light ground and the other way round.
QColor lineColor(Color background, int alpha)
{
    const double luma = 0.299 * background.r + 0.587 * background.g + 0.114 * background.b;
    return luma > 128 ? QColor(0, 0, 0, alpha) : QColor(255, 255, 255, alpha);
}

void paintLines(QPainter& painter, const View& view, const QRectF& area, double step)
{
    const double stepPixels = step * view.scale;
    const auto firstLine = [&](double anchor, double pixel) { return std::ceil((anchor + pixel / view.scale) / step); };
    for (double i = firstLine(view.anchor.x(), area.left());; ++i) {
        const double x = std::round(i * stepPixels - view.anchor.x() * view.scale) + 0.5;
        if (x > area.right()) break;
        painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
    }
    for (double i = firstLine(view.anchor.y(), area.top());; ++i) {
        const double y = std::round(i * stepPixels - view.anchor.y() * view.scale) + 0.5;
        if (y > area.bottom()) break;
        painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
    }
}

void paintPage(QPainter& painter, const Scene& scene, const View& view, const QColor& color)
{
    const double width = scene.setting("page-width").as<double>(), height = scene.setting("page-height").as<double>();
    if (width <= 0 || height <= 0) return;
    const Vec2 corner = -view.anchor * view.scale;
    painter.setPen(color);
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(QRectF(corner.x(), corner.y(), width * view.scale, height * view.scale));
}

}  // namespace

double gridStep(double scale)
{
    const double smallest = kFinestLinePixels / scale;
    const double power = std::pow(10, std::floor(std::log10(smallest)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= smallest) return factor * power;
    }
    return 10 * power;
}

Color backgroundOf(const Scene& scene) { return scene.setting("background").as<Color>(); }

void paintBackdrop(QPainter& painter, const Scene& scene, const View& view, const QRectF& area, bool grid)
{
    const Color background = backgroundOf(scene);
    painter.fillRect(area, QColor(background.r, background.g, background.b));
    painter.setRenderHint(QPainter::Antialiasing, false);
    if (grid) {
        const double step = gridStep(view.scale);
        painter.setPen(lineColor(background, 12));
        paintLines(painter, view, area, step);
        painter.setPen(lineColor(background, 20));
        paintLines(painter, view, area, kLinesAMajor * step);
    }
    paintPage(painter, scene, view, lineColor(background, 90));
}

}  // namespace jet::host
