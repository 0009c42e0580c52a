// SoundPlayer: sound items are heard while a scene plays: those marked to play at start, with their volume, once or in
// a loop; paused and stopped with the game.
//
// It runs the system's own player (pw-play, paplay or aplay) rather than bringing a library of codecs along: Qt
// Multimedia would add 74 packages. Where none is there, or it finds no device, the user is told once.
#pragma once

#include <jet/editor.hpp>

#include <QObject>
#include <QProcess>
#include <QStringList>

#include <functional>
#include <memory>
#include <set>
#include <vector>

namespace jet::host {

class SoundPlayer final : public QObject {
    Q_OBJECT

public:
    /// A program that plays a file and ends.
    struct Program {
        QString name;
        bool waveOnly = false;
        std::function<QStringList(const QString& file, double volume)> arguments;
    };

    SoundPlayer(Editor& editor, QObject* parent);
    ~SoundPlayer() override;

    /// The ones to look for instead of the usual ones, the best first; for tests.
    void setPrograms(std::vector<Program> programs) { programs_ = std::move(programs); }
    /// How many are being played, or are paused.
    std::size_t playing() const { return sounds_.size(); }

private:
    struct Sound {
        QString file;
        double volume = 1;
        bool loop = false;
        std::unique_ptr<QProcess> process;
        qint64 started = 0;  // ms since 1970
    };

    void follow(SimulationCenter::State state);
    void startAll(const Scene& scene);
    void startItem(const Scene& scene, const Item& item);
    void run(Sound& sound, const Program& program);
    void ended(const QProcess* process, int code);
    void suspend(bool on);
    void stopAll();
    void tellOnce(const QString& message);
    const Program* programFor(const QString& file) const;

    Editor& editor_;
    std::vector<Program> programs_;
    std::vector<std::unique_ptr<Sound>> sounds_;
    std::set<QString> told_;
    SimulationCenter::State state_ = SimulationCenter::State::Stopped;
    Subscription states_;
};

}  // namespace jet::host
