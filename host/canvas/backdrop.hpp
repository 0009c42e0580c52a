// What lies under a scene while it is edited: its background colour, its page and a grid.
#pragma once

#include <jet/format.hpp>
#include <jet/scene.hpp>

class QPainter;
class QRectF;

namespace jet::host {

/// Distance of the grid's fine lines at this zoom, scene units: 1, 2 or 5 times a power of ten, at least 12 pixels
/// apart.
double gridStep(double scale);
/// Paints in pixels, within `area` of a view that shows `view`.
void paintBackdrop(QPainter& painter, const Scene& scene, const View& view, const QRectF& area, bool grid);
Color backgroundOf(const Scene& scene);

}  // namespace jet::host
