// Watchdog: tells of calls into plugins that do not return, while they go on. A thread that looks at the CallBoard
// twice a second; the calls themselves know nothing of it.
#pragma once

#include "callbacks.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace jet::host {

class Watchdog {
public:
    /// `patience` scales the time each callback may take (see CallbackInfo::hangMs).
    explicit Watchdog(std::chrono::milliseconds interval = std::chrono::milliseconds(500), double patience = 1);
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

private:
    void run();
    void look() const;

    std::chrono::milliseconds interval_;
    double patience_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool quit_ = false;
    std::thread thread_;
};

}  // namespace jet::host
