// EventPump: lets other threads' events reach the window: the wake-up hook posts a Qt event, whose handling delivers
// the queue.
#pragma once

#include <jet/events.hpp>

#include <QObject>

#include <atomic>

namespace jet::host {

class EventPump final : public QObject {
    Q_OBJECT

public:
    explicit EventPump(EventsCenter& events);
    ~EventPump() override;

private:
    EventsCenter& events_;
    std::atomic<bool> waiting_ = false;  // one Qt event carries many of ours
};

}  // namespace jet::host
