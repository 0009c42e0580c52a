// GuardedApplication: events go to plugins' widgets through the guard. Whatever leaves an event handler ends here: the
// plugin it came from is switched off and named, and the editor goes on.
#pragma once

#include "window/plugin_runtime.hpp"

#include <QApplication>

namespace jet::host {

class GuardedApplication final : public QApplication {
    Q_OBJECT

public:
    GuardedApplication(int& argc, char** argv, PluginRuntime* plugins) : QApplication(argc, argv), plugins_(plugins) {}

    bool notify(QObject* receiver, QEvent* event) override;

    /// Everything below this widget is the plugin's. For panels, by whoever puts them into the window.
    static void setOwner(QWidget& widget, const std::string& plugin);
    /// The plugin the object is of; empty: JET's own.
    static QString ownerOf(const QObject* object);

    /// Receives sentences about failures that cannot be attributed to a plugin.
    void setMessageHandler(std::function<void(const std::string&)> handler) { onMessage_ = std::move(handler); }

private:
    bool notifyPlugin(const QString& plugin, QObject* receiver, QEvent* event);
    void failed(const void* receiverKind, std::exception_ptr problem);

    PluginRuntime* plugins_;
    std::function<void(const std::string&)> onMessage_;
};

}  // namespace jet::host
