// EventsCenter: listeners register for (sender, event type) pairs and receive only those (thesis §3.2.3, SPEC EN3).
//
//   auto subscription = events.subscribe<SelectionChanged>(&scene, [](const SelectionChanged& e) { ... });
//
// An event type is any struct with `static constexpr EventType type{"org.jet.selection-changed"};`. Types are compared
// by that name, not by typeid, so that they mean the same in every library.
#pragma once

#include <jet/version.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

namespace jet {

/// Names an event type; the hash is FNV-1a of the name.
struct EventType {
    std::uint64_t hash;
    constexpr EventType(std::string_view name) : hash(14695981039346656037ULL)
    {
        for (char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    }
    constexpr bool operator==(const EventType&) const = default;
};

class EventsCenter;

/// Ends the subscription when destroyed: no call of the handler starts any more. Ended on another thread than the
/// owner's, one that has started may still be running. Movable; may outlive the EventsCenter. [any thread]
class JET_API Subscription {
public:
    Subscription() = default;
    Subscription(Subscription&& other) noexcept;
    Subscription& operator=(Subscription&& other) noexcept;
    ~Subscription();
    void reset();

private:
    friend class EventsCenter;
    struct Link;
    std::shared_ptr<Link> link_;
};

/// Delivers typed events. Created on, and delivering on, one owner thread.
///
/// - Listeners may subscribe and unsubscribe (themselves, too) while being called; a new one hears from the next event
/// on.
/// - An exception in one listener does not stop the others; it goes to the exception handler.
/// - post() from another thread queues a copy for the owner's thread and calls the wake-up hook; so does subscribe(),
///   which then hears from the next dispatchQueued() on. Handlers are called on the owner's thread, always.
/// - What shows a state and not each step of it (a panel, a view) subscribes coalesced: one call a frame, however many
///   events there were.
class JET_API EventsCenter {
public:
    EventsCenter();
    ~EventsCenter();
    EventsCenter(const EventsCenter&) = delete;
    EventsCenter& operator=(const EventsCenter&) = delete;

    /// Calls `handler` for events of type E sent by `sender` (null: by anyone). [any thread]
    template <class E, class Handler>
    Subscription subscribe(const void* sender, Handler handler)
    {
        return subscribeErased(sender, E::type,
                               [h = std::move(handler)](const void* event) { h(*static_cast<const E*>(event)); });
    }

    /// Calls `handler` once for all events of type E sent by `sender` (null: by anyone) since its last call, at the
    /// next dispatchQueued(): with an `E::Burst` made by `burst.add(event)` for each, where E declares one, else with a
    /// copy of the last event. [any thread]
    template <class E, class Handler>
    Subscription subscribeCoalesced(const void* sender, Handler handler)
    {
        auto burst = std::make_shared<std::optional<BurstOf<E>>>();
        const auto collect = [burst](const void* event) {
            if constexpr (requires { typename E::Burst; }) {
                if (!*burst) burst->emplace();
                (*burst)->add(*static_cast<const E*>(event));
            } else {
                *burst = *static_cast<const E*>(event);
            }
        };
        const auto deliver = [burst, h = std::move(handler)] {
            const std::optional<BurstOf<E>> collected = std::exchange(*burst, std::nullopt);
            if (collected) h(*collected);
        };
        return subscribeBursts(sender, E::type, collect, deliver);
    }

    /// Delivers at once on the owner's thread; queues a copy from any other. [any thread]
    template <class E>
    void post(const void* sender, const E& event)
    {
        if (onOwnerThread()) {
            deliver(sender, E::type, &event);
        } else {
            enqueue([this, sender, copy = event] { deliver(sender, E::type, &copy); });
        }
    }

    /// Runs `task` on the owner's thread at its next dispatchQueued(). [any thread]
    void enqueue(std::function<void()> task);
    /// Runs what other threads queued, in order. [owner's thread]
    void dispatchQueued();
    /// Called (from any thread) when something was queued, so that the owner's event loop can call dispatchQueued().
    void setWakeUp(std::function<void()> wakeUp);
    /// Receives exceptions thrown by listeners; the default prints to stderr. [owner's thread]
    void setExceptionHandler(std::function<void(std::exception_ptr)> handler);
    /// [owner's thread]
    std::size_t listenerCount() const;

private:
    template <class E>
    struct Latest {
        using Burst = E;
    };
    template <class E>
    using BurstOf = typename std::conditional_t < requires
    {
        typename E::Burst;
    }
    , E, Latest < E >> ::Burst;

    Subscription subscribeBursts(const void* sender, EventType type, std::function<void(const void*)> collect,
                                 std::function<void()> deliver);
    Subscription subscribeErased(const void* sender, EventType type, std::function<void(const void*)> handler);
    void deliver(const void* sender, EventType type, const void* event);
    bool onOwnerThread() const;

    friend class Subscription;

    struct Private;
    std::shared_ptr<Private> d_;
};

}  // namespace jet
