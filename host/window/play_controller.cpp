#include "window/play_controller.hpp"

#include <QCoreApplication>

namespace jet::host {

using State = SimulationCenter::State;

PlayController::PlayController(Editor& editor, Documents& documents, QObject* parent)
    : QObject(parent), editor_(editor), documents_(documents)
{
    connect(&documents, &Documents::viewClosing, this, &PlayController::stopIfShownIn);
    states_ = editor.events().subscribe<SimulationStateChanged>(nullptr, [this](const SimulationStateChanged& event) {
        if (event.state == State::Stopped) hideGame();
    });
    frames_ = editor.events().subscribe<SimulationFrameReady>(
        nullptr, [this](const SimulationFrameReady&) { tellOfDragging(); });
}

std::vector<ActionSpec> PlayController::actions()
{
    const auto state = [this] { return editor_.simulation().state(); };
    const auto canPlay = [this, state] {
        return state() == State::Paused || (state() == State::Stopped && documents_.currentScene());
    };
    const auto running = [state] { return state() != State::Stopped; };
    const auto pause = [this, state] {
        SimulationCenter& simulation = editor_.simulation();
        state() == State::Paused ? simulation.resume() : simulation.pause();
    };
    return {
        {"play.play", QT_TRANSLATE_NOOP("Actions", "&Play"), "play", "F5", [this] { play(); }, canPlay},
        {"play.pause", QT_TRANSLATE_NOOP("Actions", "P&ause"), "pause", "F7", pause, running,
         [state] { return state() == State::Paused; }},
        {"play.step", QT_TRANSLATE_NOOP("Actions", "Single &step"), "step", "F10",
         [this] { editor_.simulation().singleStep(); }, running},
        {"play.stop", QT_TRANSLATE_NOOP("Actions", "&Stop"), "stop", "F8", [this] { stop(); }, running},
    };
}

bool PlayController::isPlaying() const { return editor_.simulation().state() != State::Stopped; }

void PlayController::play()
{
    SimulationCenter& simulation = editor_.simulation();
    if (simulation.state() == State::Paused) return simulation.resume();
    Scene* scene = documents_.currentScene();
    if (!scene || simulation.state() != State::Stopped) return;
    documents_.commitScripts();
    SceneView& view = documents_.openScene(*scene);
    view.endGesture();
    SimulationOptions options;
    options.viewSize = Vec2(view.width(), view.height());
    options.sceneByName = [this](std::string_view name) -> const Scene* { return editor_.project().scene(name); };
    if (const Result<void> started = simulation.play(*scene, std::move(options)); !started) {
        return editor_.showMessage(started.error().text());
    }
    showGame(view);
}

void PlayController::stop()
{
    editor_.simulation().stop();
    hideGame();
}

void PlayController::showGame(SceneView& view)
{
    game_ = new PlayView(editor_.simulation(), editor_.events(), view.camera().view(), &view);
    game_->show();
    view.setFocusProxy(game_);
    game_->setFocus();
    tellOfDragging();
}

void PlayController::tellOfDragging()
{
    const bool listens = editor_.simulation().listensToPointer();
    if (!game_ || toldOfPointer_ == listens) return;
    toldOfPointer_ = listens;
    editor_.showStatus((listens ? tr("The game follows the mouse. Drag bodies with Ctrl and the left button.")
                                : tr("Drag bodies with the left button."))
                           .toStdString());
}

void PlayController::hideGame()
{
    if (!game_) return;
    toldOfPointer_.reset();
    editor_.showStatus({});
    QWidget* view = game_->parentWidget();
    view->setFocusProxy(nullptr);
    game_->hide();
    game_->deleteLater();
    game_ = nullptr;
    view->setFocus();
}

void PlayController::stopIfShownIn(SceneView* view)
{
    const bool shownHere = game_ && game_->parentWidget() == view;
    if (shownHere || editor_.simulation().scene() == &view->scene()) stop();
}

}  // namespace jet::host
