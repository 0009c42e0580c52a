#include "window/sound_player.hpp"

#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>

#include <algorithm>
#include <csignal>

namespace jet::host {

using State = SimulationCenter::State;

namespace {

constexpr qint64 kShortestLoop = 50;  // ms: what ends sooner was not played, and is not tried again and again

std::vector<SoundPlayer::Program> systemPrograms()
{
    return {
        {"pw-play", false,
         [](const QString& file, double volume) {
             return QStringList{"--volume=" + QString::number(volume), file};
         }},
        {"paplay", false,
         [](const QString& file, double volume) {
             return QStringList{"--volume=" + QString::number(static_cast<int>(volume * 65536)), file};
         }},
        {"aplay", true,
         [](const QString& file, double) {
             return QStringList{"-q", file};
         }},
    };
}

}  // namespace

SoundPlayer::SoundPlayer(Editor& editor, QObject* parent)
    : QObject(parent), editor_(editor), programs_(systemPrograms())
{
    states_ = editor.events().subscribe<SimulationStateChanged>(
        nullptr, [this](const SimulationStateChanged& event) { follow(event.state); });
}

SoundPlayer::~SoundPlayer() { stopAll(); }

void SoundPlayer::follow(State state)
{
    const State before = std::exchange(state_, state);
    if (state == before) return;
    if (state == State::Stopped) return stopAll();
    if (before == State::Stopped) {
        if (const Scene* scene = editor_.simulation().scene()) startAll(*scene);
    }
    suspend(state == State::Paused);
}

void SoundPlayer::startAll(const Scene& scene)
{
    scene.root().walk([&](const Item& item) {
        if (item.is<SoundItem>() && item.property("autoplay")->as<bool>()) startItem(scene, item);
    });
}

void SoundPlayer::startItem(const Scene& scene, const Item& item)
{
    const QString name = QString::fromStdString(item.property("file")->as<std::string>());
    const QString file = QDir(QString::fromStdString(scene.assetFolder())).absoluteFilePath(name);
    if (name.isEmpty() || !QFileInfo(file).isFile())
        return tellOnce(
            tr("The sound “%1” cannot be played: its file “%2” is not there. Choose another one in the Inspector.")
                .arg(QString::fromStdString(item.name()), name));
    const Program* program = programFor(file);
    if (!program)
        return tellOnce(
            tr("Sounds are not heard: no program that plays “%1” is installed. Install pipewire-bin (pw-play) or "
               "pulseaudio-utils (paplay); alsa-utils (aplay) plays WAV files only.")
                .arg(QFileInfo(file).fileName()));
    sounds_.push_back(std::make_unique<Sound>(
        Sound{file, item.property("volume")->as<double>(), item.property("loop")->as<bool>(), nullptr, 0}));
    run(*sounds_.back(), *program);
}

const SoundPlayer::Program* SoundPlayer::programFor(const QString& file) const
{
    const bool isWave = QFileInfo(file).suffix().compare("wav", Qt::CaseInsensitive) == 0;
    for (const Program& program : programs_)
        if ((isWave || !program.waveOnly) && !QStandardPaths::findExecutable(program.name).isEmpty()) return &program;
    return nullptr;
}

void SoundPlayer::run(Sound& sound, const Program& program)
{
    if (sound.process) sound.process.release()->deleteLater();  // it may be telling of its end just now
    sound.process = std::make_unique<QProcess>();
    sound.started = QDateTime::currentMSecsSinceEpoch();
    const QProcess* process = sound.process.get();
    connect(
        process, &QProcess::finished, this,
        [this, process](int code, QProcess::ExitStatus how) {
            ended(process, how == QProcess::NormalExit ? code : -1);
        },
        Qt::QueuedConnection);
    sound.process->setStandardOutputFile(QProcess::nullDevice());
    sound.process->start(program.name, program.arguments(sound.file, std::clamp(sound.volume, 0.0, 1.0)));
}

void SoundPlayer::ended(const QProcess* process, int code)
{
    const auto found = std::find_if(sounds_.begin(), sounds_.end(),
                                    [&](const auto& sound) { return sound->process.get() == process; });
    if (found == sounds_.end()) return;
    Sound& sound = **found;
    const bool tooSoon = QDateTime::currentMSecsSinceEpoch() - sound.started < kShortestLoop;
    if (code != 0) {
        const QString why = QString::fromLocal8Bit(sound.process->readAllStandardError()).section('\n', 0, 0).trimmed();
        tellOnce(tr("Sounds are not heard: %1 says “%2”. Is there an audio device, and is it on?")
                     .arg(sound.process->program(), why.isEmpty() ? tr("no reason") : why));
    } else if (const Program* program = sound.loop && !tooSoon ? programFor(sound.file) : nullptr) {
        return run(sound, *program);
    }
    sounds_.erase(found);
}

void SoundPlayer::suspend(bool on)
{
    for (const auto& sound : sounds_) {
        sound->process->waitForStarted();
        if (const qint64 id = sound->process->processId(); id > 0)
            ::kill(static_cast<pid_t>(id), on ? SIGSTOP : SIGCONT);
    }
}

void SoundPlayer::stopAll()
{
    for (const auto& sound : sounds_) {
        sound->process->disconnect();
        sound->process->kill();
        sound->process->waitForFinished();
    }
    sounds_.clear();
}

void SoundPlayer::tellOnce(const QString& message)
{
    if (told_.insert(message).second) editor_.showMessage(message.toStdString());
}

}  // namespace jet::host
