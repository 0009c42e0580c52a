// The rule of threads: a scene and its events belong to the thread that made the EventsCenter.
#pragma once

#include <thread>

namespace jet {

class EventsCenter;

/// The thread that made it. [any thread]
std::thread::id ownerThreadOf(const EventsCenter& events);
/// Tells the host who broke the rule, and throws Failure. `code`: an address in the caller, if known.
[[noreturn]] void refuseThread(const char* call, const void* code);

inline void requireThread(std::thread::id owner, const char* call, const void* code)
{
    if (std::this_thread::get_id() != owner) [[unlikely]]
        refuseThread(call, code);
}

}  // namespace jet
