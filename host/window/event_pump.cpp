#include "window/event_pump.hpp"

#include <QMetaObject>

namespace jet::host {

EventPump::EventPump(EventsCenter& events) : events_(events)
{
    events_.setWakeUp([this] {
        if (waiting_.exchange(true)) return;
        QMetaObject::invokeMethod(
            this,
            [this] {
                waiting_ = false;
                events_.dispatchQueued();
            },
            Qt::QueuedConnection);
    });
}

EventPump::~EventPump() { events_.setWakeUp({}); }

}  // namespace jet::host
