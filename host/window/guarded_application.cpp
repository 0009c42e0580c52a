#include "window/guarded_application.hpp"

#include <QEvent>
#include <QVariant>
#include <QWidget>

#include <cstdio>
#include <typeinfo>

namespace jet::host {

namespace {

constexpr const char* kOwner = "jetPlugin";  // a dynamic property

/// What a widget of a plugin that was switched off still gets: what concerns its life, not its work.
bool isOfUse(const QEvent& event)
{
    switch (event.type()) {
    case QEvent::Paint:
    case QEvent::Timer:
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseMove:
    case QEvent::Wheel:
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
    case QEvent::MetaCall: return true;
    default: return false;
    }
}

std::string textOf(const std::exception_ptr& problem)
{
    try {
        std::rethrow_exception(problem);
    } catch (const std::exception& e) {
        return e.what();
    } catch (...) {
        return "an unknown exception";
    }
}

// The first word of an object is the address of its class's virtual functions, which lie in the library of the class.
const void* classOf(const QObject* object) { return *reinterpret_cast<const void* const*>(object); }

}  // namespace

void GuardedApplication::setOwner(QWidget& widget, const std::string& plugin)
{
    widget.setProperty(kOwner, plugin.empty() ? QVariant() : QVariant(QString::fromStdString(plugin)));
}

QString GuardedApplication::ownerOf(const QObject* object)
{
    for (; object; object = object->parent()) {
        const QVariant owner = object->property(kOwner);
        if (owner.isValid()) return owner.toString();
    }
    return {};
}

bool GuardedApplication::notify(QObject* receiver, QEvent* event)
{
    if (!plugins_) return QApplication::notify(receiver, event);
    plugins_->showLife();
    const QString plugin = ownerOf(receiver);
    if (!plugin.isEmpty()) return notifyPlugin(plugin, receiver, event);
    const void* kind = classOf(receiver);
    try {
        return QApplication::notify(receiver, event);
    } catch (...) {
        failed(kind, std::current_exception());
        return false;
    }
}

bool GuardedApplication::notifyPlugin(const QString& plugin, QObject* receiver, QEvent* event)
{
    const std::string id = plugin.toStdString();
    bool used = false;
    if (plugins_->isUsable(id)) {
        plugins_->guardEvent(id, [&] { used = QApplication::notify(receiver, event); });
        return used;
    }
    if (isOfUse(*event)) return true;
    try {
        return QApplication::notify(receiver, event);
    } catch (...) {
        return false;  // its first failure was told
    }
}

void GuardedApplication::failed(const void* receiverKind, std::exception_ptr problem)
{
    std::string plugin = plugins_->ownerOf(receiverKind);
    // The type of the exception, where it is one of a plugin's own.
    if (const std::type_info* type = problem ? problem.__cxa_exception_type() : nullptr; plugin.empty() && type)
        plugin = plugins_->ownerOf(type);
    if (!plugin.empty()) return plugins_->blame(plugin, problem);
    const std::string message = "Something failed while an event was handled: " + textOf(problem);
    if (onMessage_) {
        onMessage_(message);
    } else {
        std::fprintf(stderr, "error: %s\n", message.c_str());
    }
}

}  // namespace jet::host
