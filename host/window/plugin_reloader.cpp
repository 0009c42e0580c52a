#include "window/plugin_reloader.hpp"

#include <QCoreApplication>

namespace jet::host {

PluginReloader::PluginReloader(Editor& editor, Documents& documents, ToolController& tools, DockArea& docks,
                               PluginRuntime* plugins, QObject* parent)
    : QObject(parent), editor_(editor), documents_(documents), tools_(tools), docks_(docks), plugins_(plugins)
{
    playing_ = editor.events().subscribe<SimulationStateChanged>(nullptr, [this](const SimulationStateChanged& event) {
        // Later: the play is in the middle of its own end.
        if (event.state == SimulationCenter::State::Stopped && !waiting_.empty())
            QMetaObject::invokeMethod(this, &PluginReloader::reloadWaiting, Qt::QueuedConnection);
    });
}

std::vector<ActionSpec> PluginReloader::actions()
{
    return {{"plugins.reload", QT_TRANSLATE_NOOP("Actions", "&Reload plugins"), "", "Ctrl+Shift+F5",
             [this] { reloadAll(); }, [this] { return plugins_ != nullptr; }}};
}

void PluginReloader::watch(const std::vector<std::filesystem::path>& folders)
{
    if (!plugins_ || folders.empty()) return;
    watcher_ = std::make_unique<PluginWatcher>(folders);
    connect(watcher_.get(), &PluginWatcher::changed, this, &PluginReloader::folderChanged);
}

void PluginReloader::folderChanged(const QString& folder)
{
    const Result<std::string> plugin = plugins_->add(folder.toStdString());
    if (!plugin) return editor_.showMessage(plugin.error().text());
    reload(*plugin);
}

void PluginReloader::reloadAll()
{
    for (const std::string& plugin : plugins_->loaded()) reload(plugin);
}

void PluginReloader::reload(const std::string& plugin)
{
    waiting_.insert(plugin);
    if (editor_.simulation().state() == SimulationCenter::State::Stopped) return reloadWaiting();
    editor_.showStatus(
        tr("%1 was rebuilt; it is reloaded when the play stops").arg(QString::fromStdString(plugin)).toStdString());
}

void PluginReloader::reloadWaiting()
{
    if (editor_.simulation().state() != SimulationCenter::State::Stopped) return;
    for (const std::string& plugin : std::exchange(waiting_, {})) swapAndTell(plugin);
}

Result<PluginChange> PluginReloader::request(const std::string& plugin)
{
    if (!plugins_) return Error(tr("there are no plugins to reload here").toStdString());
    PluginChange change{{plugin}, false, {}};
    const QString title = QString::fromStdString(plugins_->titleOf(plugin));
    if (editor_.simulation().state() != SimulationCenter::State::Stopped) {
        waiting_.insert(plugin);
        change.message = tr("%1 is reloaded when the play stops.").arg(title).toStdString();
    } else if (plugins_->isInCall(plugin)) {
        waiting_.insert(plugin);
        QMetaObject::invokeMethod(this, &PluginReloader::reloadWaiting, Qt::QueuedConnection);
        change.message = tr("%1 is reloaded as soon as it is done with this.").arg(title).toStdString();
    } else {
        if (const auto swapped = swap(plugin); !swapped) return swapped.error();
        change.message = tr("%1 was reloaded.").arg(QString::fromStdString(plugins_->titleOf(plugin))).toStdString();
    }
    return change;
}

void PluginReloader::swapAndTell(const std::string& plugin)
{
    if (const auto swapped = swap(plugin); !swapped) return editor_.showMessage(swapped.error().message);
    editor_.showStatus(tr("%1 was reloaded").arg(QString::fromStdString(plugins_->titleOf(plugin))).toStdString());
}

Result<void> PluginReloader::swap(const std::string& plugin)
{
    const auto letGo = [&] {
        for (SceneView* view : documents_.views()) {
            view->endGesture();
            view->dropTools();
        }
        docks_.dropContent(plugin);
        for (const Scene* scene : editor_.project().scenes()) scene->dropEffectStates();
        editor_.events().dispatchQueued();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    };
    if (const auto swapped = plugins_->reload(plugin, letGo); !swapped) return swapped;
    tools_.rebuild();
    docks_.refillContent();
    for (SceneView* view : documents_.views()) view->invalidate();
    editor_.events().post(&editor_, PluginsChanged{{plugin}});
    return {};
}

}  // namespace jet::host
