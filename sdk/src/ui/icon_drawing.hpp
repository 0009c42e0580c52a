// A drawing on a square, painted in the colours of the palette: what built-in icons and icon files become.
#pragma once

#include <QColor>
#include <QIcon>
#include <QPainterPath>

#include <optional>
#include <vector>

namespace jet::ui {

/// A colour of a drawing; none: nothing is painted; invalid: the colour of the text.
using IconPaint = std::optional<QColor>;

struct IconShape {
    QPainterPath path;
    IconPaint fill, stroke;
    qreal width = 1.6;
    qreal opacity = 1;
};

struct IconDrawing {
    QRectF box{0, 0, 24, 24};
    std::vector<IconShape> shapes;
};

/// An icon that paints the drawing at whatever size is asked.
QIcon iconOf(IconDrawing drawing);

}  // namespace jet::ui
