// SceneRaster: the picture of a scene at a view, kept between paints.
//
// Painting 10,000 antialiased paths takes hundreds of milliseconds without a GPU, so what is painted is kept: panning
// shifts the picture and paints the strips that came into sight; a change repaints the area the DamageTracker names; a
// zoom of a heavy scene stretches the old picture until the user pauses.
#pragma once

#include "canvas/damage_tracker.hpp"

#include <jet/format.hpp>
#include <jet/scene.hpp>

#include <QPixmap>

class QPainter;

namespace jet::host {

class SceneRaster {
public:
    explicit SceneRaster(const Scene& scene) : scene_(scene) {}

    /// The scene changed in a way the revisions of its items tell.
    void touch() { touched_ = true; }
    /// Everything looks different (settings, effects of a plugin that came or went).
    void invalidate() { picture_ = {}; }
    void setGrid(bool on) { grid_ = on, invalidate(); }

    /// Paints the scene at its view. Unless `exact`, a heavy scene may be shown stretched from an older picture: then
    /// it returns false and wants to be called again soon.
    bool paint(QPainter& painter, const View& view, const QSize& size, qreal devicePixelRatio, bool exact);

private:
    bool canStretch(const View& view) const;
    void renderAll(const View& view, const QSize& size, qreal ratio);
    /// Moves the picture to the new view; false when it must be painted anew.
    bool scrollTo(const View& view);
    void repairDamage();
    void render(const QRect& pixels);  ///< device-independent pixels

    const Scene& scene_;
    DamageTracker tracker_;
    QPixmap picture_;
    View view_;  // of the picture
    QSize size_;
    bool touched_ = true;
    bool grid_ = true;
    double fullMs_ = 0;  // what the last complete painting took
};

}  // namespace jet::host
