// SceneView: shows one scene for editing and gives the pointer to the active tool.
//
// The view itself does navigation only: right-drag, middle-drag and Space with left-drag pan; the wheel zooms about the
// pointer. Everything else is the tool's. While the scene plays, a PlayView covers it.
#pragma once

#include "canvas/camera.hpp"
#include "canvas/scene_raster.hpp"
#include "canvas/tool_session.hpp"

#include <QTimer>
#include <QWidget>

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace jet::host {

class SceneView final : public QWidget, private ToolSurface {
    Q_OBJECT

public:
    SceneView(Scene& scene, Editor& editor, ToolOptions& options, QWidget* parent);
    ~SceneView() override;

    Scene& scene() const { return scene_; }
    const Camera& camera() const { return camera_; }
    void setView(const View& view);
    /// Shows the whole scene, also when the view gets another size, until the user pans, zooms or clicks.
    void keepAllFramed() { keepFramed_ = true; }
    void frame(const Box& box);
    void resetZoom();
    void zoomBy(double factor);
    void setGridVisible(bool on);
    /// Paints everything anew: settings or plugins changed.
    void invalidate();
    /// The point of the scene in the middle of the view.
    QPointF sceneCentre() const;

    /// The tool keeps its state per view: coming back to it finds it as it was left.
    void setTool(const std::string& id);
    const ToolSession* tool() const { return tool_; }
    /// Ends the gesture under way, so that the scene can be changed by someone else.
    void endGesture();
    bool cancelGesture();
    /// Forgets all tools, because the plugins changed or the view is going.
    void dropTools();

signals:
    void pointerMoved(const QPointF& scenePosition);
    void pointerLeft();
    void viewChanged();
    /// A key the tool had no use for.
    void keyUnused(QKeyEvent* event);
    void contextMenuRequested(const QPoint& globalPosition);
    /// At a point of the scene.
    void filesDropped(const QStringList& files, const QPointF& at);

protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void inputMethodEvent(QInputMethodEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    struct Pan {
        Qt::MouseButton button;
        QPoint last;
        bool moved = false;
    };

    double surfaceScale() const override { return camera_.view().scale; }
    void repaintTool() override { update(); }
    void setToolCursor(const QCursor& cursor) override;
    void clickTool(const PointerEvent& click) override;

    PointerEvent pointerEvent(const QMouseEvent& event, Qt::MouseButton button) const;
    void startPan(const QMouseEvent& event);
    void continuePan(const QMouseEvent& event);
    void endPan(const QMouseEvent& event);
    void frameAll();
    void cameraMoved();
    void updateCursor();

    Scene& scene_;
    Editor& editor_;
    ToolOptions& options_;
    Camera camera_;
    SceneRaster raster_;
    QTimer sharpen_;  // paints exactly once zooming pauses
    bool exact_ = true;
    bool keepFramed_ = false;
    bool spaceHeld_ = false;
    bool leftDown_ = false;
    std::optional<Pan> pan_;
    QCursor toolCursor_ = Qt::ArrowCursor;
    std::map<std::string, std::unique_ptr<ToolSession>, std::less<>> tools_;
    ToolSession* tool_ = nullptr;
    Subscription touched_, selected_, changed_;
};

}  // namespace jet::host
