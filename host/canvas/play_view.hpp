// PlayView: a running game, laid over the scene view it was started from. Keys and pointer go to the game; when it is
// taken away, the edited scene is seen as it was left, at the same zoom.
//
// Bodies are dragged with the left button: where the game listens to the pointer, with Ctrl, as the rest is the game's.
// Of such a drag the game hears nothing.
#pragma once

#include <jet/simulation.hpp>

#include <QSet>
#include <QWidget>

namespace jet::host {

class PlayView final : public QWidget {
    Q_OBJECT

public:
    /// Until a script moves the camera the game is seen at `editView`, in place.
    PlayView(SimulationCenter& simulation, EventsCenter& events, const View& editView, QWidget* parent);

protected:
    bool event(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;

private:
    View shownView(const SimulationFrame& frame) const;
    View shownView() const;
    void sendPointer(ScriptEventKind kind, const QMouseEvent& event);
    bool beginsDrag(const QMouseEvent& event) const;
    void letGo();
    void followFrame();
    void paintGame(QPainter& painter, const SimulationFrame& frame);
    void paintFrame(QPainter& painter);

    SimulationCenter& simulation_;
    View editView_;
    QSet<int> held_;         // keys that are down, to be let go when the focus leaves
    bool dragging_ = false;  // is the left button down for a drag of the editor's?
    Subscription frames_, states_, marks_;
};

}  // namespace jet::host
