#include "check_window.hpp"

#include <jet/ui/panel.hpp>

#include <QApplication>
#include <QPixmap>
#include <QWidget>

#include <memory>
#include <vector>

namespace {

std::vector<std::unique_ptr<QWidget>>& shown()
{
    static std::vector<std::unique_ptr<QWidget>> widgets;
    return widgets;
}

void run(void (*body)(void*), void* data)
{
    int count = 1;
    char name[] = "jet";
    char* arguments[] = {name, nullptr};
    QApplication application(count, arguments);
    QApplication::setQuitOnLastWindowClosed(false);
    body(data);
    shown().clear();
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    QApplication::processEvents();
}

void settle()
{
    for (int i = 0; i < 3; ++i) QApplication::processEvents();
    for (const auto& widget : shown()) (void)widget->grab();
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
}

const char* show(jet::Panel& panel)
{
    std::unique_ptr<QWidget> widget(panel.createWidget());
    if (!widget) return "Panel::createWidget made nothing";
    widget->show();
    shown().push_back(std::move(widget));
    for (const QSize& size : {QSize(280, 400), QSize(1, 1), QSize(2000, 50), QSize(320, 600)}) {
        shown().back()->resize(size);
        settle();
    }
    shown().back()->hide();
    settle();
    shown().back()->show();
    settle();
    return nullptr;
}

void close()
{
    shown().clear();
    settle();
}

}  // namespace

extern "C" __attribute__((visibility("default")))
const JetCheckWindow jet_check_window = {&run, &show, &settle, &close};
