// A small picture of an item with all that is in it.
#pragma once

#include <jet/scene.hpp>

#include <QPixmap>

namespace jet::symbol_list {

/// As it looks while editing, fitted into `size` logical pixels with a margin.
QPixmap thumbnailOf(const Scene& scene, const Item& item, const QSize& size, qreal pixelRatio);

}  // namespace jet::symbol_list
