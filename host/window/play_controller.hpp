// PlayController: play, pause, step and stop of the front scene, in place.
#pragma once

#include "canvas/play_view.hpp"
#include "window/actions.hpp"
#include "window/documents.hpp"

#include <QPointer>

namespace jet::host {

class PlayController final : public QObject {
    Q_OBJECT

public:
    PlayController(Editor& editor, Documents& documents, QObject* parent);

    std::vector<ActionSpec> actions();
    void play();
    void stop();
    bool isPlaying() const;

private:
    void showGame(SceneView& view);
    void hideGame();
    void tellOfDragging();
    void stopIfShownIn(SceneView* view);

    Editor& editor_;
    Documents& documents_;
    QPointer<PlayView> game_;
    std::optional<bool> toldOfPointer_;  // what the status bar tells: does the game listen to it?
    Subscription states_, frames_;
};

}  // namespace jet::host
