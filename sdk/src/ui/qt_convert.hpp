// Pens, brushes and colours of the SDK as Qt's. Private to libjet-sdk-ui.
#pragma once

#include <jet/painter.hpp>

#include <QBrush>
#include <QColor>
#include <QPen>
#include <QPointF>

namespace jet::ui {

inline QColor toQt(Color c) { return QColor(c.r, c.g, c.b, c.a); }
inline QPointF toQt(const Vec2& v) { return {v.x(), v.y()}; }
QBrush toQt(const Brush& brush);
/// `length` is the path's length in the pen's unit of width; it decides whether dashes are worth making.
QPen toQt(const Pen& pen, double length);

}  // namespace jet::ui
