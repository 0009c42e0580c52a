// Listeners of one (sender, type) pair form a channel; a hash table finds it. Delivery walks the channel's slots, so
// its cost does not depend on how many listeners there are elsewhere. Slots freed during delivery are reused only after
// it ended. Channels belong to the owner's thread and need no lock; other threads subscribe and leave through the
// queue, and what stops a handler at once is a flag in the subscription's link. (A lock around each channel would cost
// more than the delivery itself.)
#include "thread_rule.hpp"

#include <jet/call_watch.hpp>
#include <jet/events.hpp>
#include <jet/result.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

namespace jet {

namespace {

struct Key {
    const void* sender;
    std::uint64_t type;
    bool operator==(const Key&) const = default;
};
struct KeyHash {
    std::size_t operator()(const Key& k) const
    {
        return (reinterpret_cast<std::uintptr_t>(k.sender) >> 4) * 0x9e3779b97f4a7c15ULL ^ k.type;
    }
};

/// Listeners of one plugin in a row share one guarded call: entering for each would cost more than most handlers.
class CallsByOwner {
public:
    CallsByOwner() = default;
    CallsByOwner(const CallsByOwner&) = delete;
    CallsByOwner& operator=(const CallsByOwner&) = delete;
    ~CallsByOwner() { leave(); }

    /// False: the plugin is switched off.
    bool enter(CallWatch::Owner owner)
    {
        if (owner == current_) return true;
        leave();
        if (!watch_ || owner == 0) return true;
        if (!watch_->enter(owner)) return false;
        current_ = owner;
        return true;
    }
    void leave() noexcept
    {
        if (current_ != 0) watch_->leave();
        current_ = 0;
    }
    /// False: it was JET's own.
    bool blame(CallWatch::Owner owner, std::exception_ptr problem)
    {
        if (!watch_ || owner == 0) return false;
        watch_->failed(owner, std::move(problem));
        return true;
    }

private:
    CallWatch* watch_ = CallWatch::get();
    CallWatch::Owner current_ = 0;
};

void countListener(CallWatch::Owner owner, int change)
{
    if (owner == 0) return;
    if (CallWatch* watch = CallWatch::get()) watch->listens(owner, change);
}

/// The owners of all centers, for those who are given one.
struct Owners {
    std::mutex mutex;
    std::unordered_map<const EventsCenter*, std::thread::id> threads;
};

Owners& owners()
{
    static auto* const all = new Owners;  // outlives centers that are static
    return *all;
}

}  // namespace

std::thread::id ownerThreadOf(const EventsCenter& events)
{
    const std::lock_guard lock(owners().mutex);
    return owners().threads.at(&events);
}

void refuseThread(const char* call, const void* code)
{
    const std::string rule = std::string(call) +
                             " was called on another thread than the one that owns the scenes and their events; hand "
                             "the work over with EventsCenter::enqueue or EventsCenter::post";
    if (CallWatch* watch = CallWatch::get()) watch->brokeRule(code, rule);
    throw Failure(Error(rule));
}

/// What subscription and slot share.
struct Subscription::Link {
    std::weak_ptr<EventsCenter::Private> center;
    Key key;
    CallWatch::Owner owner = 0;  // the plugin the handler's code is of; 0: JET's own
    std::uint64_t serial = 0;    // when it was entered: ascending within a channel. Owner's thread
    std::atomic<bool> alive{true};
};

struct EventsCenter::Private {
    using Link = Subscription::Link;
    struct Slot {
        std::function<void(const void*)> handler;
        std::shared_ptr<Link> link;
        std::uint64_t serial = 0;
        bool alive = true;  // entered and not left
    };
    struct Channel {
        std::deque<Slot> slots;  // a deque: a handler stays where it is while others subscribe
        std::size_t alive = 0;
        int delivering = 0;
        bool leftWhileDelivering = false;
    };
    using Channels = std::unordered_map<Key, std::unique_ptr<Channel>, KeyHash>;

    ~Private()
    {
        for (const auto& [key, channel] : channels)
            for (const Slot& slot : channel->slots)
                if (slot.alive) countListener(slot.link->owner, -1);
    }

    Channels channels;
    std::uint64_t serial = 0;
    std::size_t listeners = 0;
    std::thread::id owner = std::this_thread::get_id();
    std::function<void(std::exception_ptr)> onException;

    std::mutex mutex;  // guards the two below
    std::deque<std::function<void()>> queue;
    std::function<void()> wakeUp;

    void run(const Key& key, const void* event)
    {
        const auto found = channels.find(key);
        if (found == channels.end()) return;
        Channel& channel = *found->second;
        const std::uint64_t last = serial;  // who subscribes during delivery hears from the next event on
        ++channel.delivering;
        CallsByOwner calls;
        for (std::size_t i = 0, n = channel.slots.size(); i < n; ++i) {
            Slot& slot = channel.slots[i];
            if (!slot.alive || slot.serial > last || !slot.link->alive.load(std::memory_order_acquire)) continue;
            const CallWatch::Owner owner = slot.link->owner;
            if (!calls.enter(owner)) continue;
            try {
                slot.handler(event);
            } catch (...) {
                calls.leave();
                if (!calls.blame(owner, std::current_exception())) report(std::current_exception());
            }
        }
        calls.leave();
        --channel.delivering;
        sweep(key);
    }

    // Frees the slots of those who left, once they are many or still hold their handlers. Handlers may own objects that
    // end subscriptions of their own: they are destroyed last, when the channel is in order again.
    void sweep(const Key& key)
    {
        const auto found = channels.find(key);
        if (found == channels.end()) return;
        Channel& channel = *found->second;
        const std::size_t left = channel.slots.size() - channel.alive;
        if (channel.delivering > 0 || left == 0 || (left < channel.alive && !channel.leftWhileDelivering)) return;
        std::unique_ptr<Channel> old = std::exchange(found->second, nullptr);
        if (old->alive == 0) {
            channels.erase(found);
            return;
        }
        found->second = std::make_unique<Channel>();
        found->second->alive = old->alive;
        for (Slot& slot : old->slots)
            if (slot.alive) found->second->slots.push_back(std::move(slot));
    }

    /// `caller`: an address in the listener's code. The templates that subscribe are compiled into its library.
    static std::shared_ptr<Link> link(const std::shared_ptr<Private>& center, const Key& key, const void* caller)
    {
        auto made = std::make_shared<Link>();
        made->center = center;
        made->key = key;
        if (const CallWatch* watch = CallWatch::get()) made->owner = watch->ownerOf(caller);
        return made;
    }

    void subscribe(const std::shared_ptr<Link>& link, std::function<void(const void*)> handler)
    {
        if (onOwnerThread()) return enter(link, std::move(handler));
        enqueue([link, h = std::move(handler)]() mutable {
            if (const auto center = link->center.lock()) center->enter(link, std::move(h));
        });
    }

    void enter(const std::shared_ptr<Link>& link, std::function<void(const void*)> handler)
    {
        if (!link->alive.load(std::memory_order_acquire)) return;  // left before it came
        auto& channel = channels[link->key];
        if (!channel) channel = std::make_unique<Channel>();
        link->serial = ++serial;
        channel->slots.push_back({std::move(handler), link, link->serial, true});
        ++channel->alive;
        ++listeners;
        countListener(link->owner, 1);
    }

    void leave(const Link& link)
    {
        const auto found = channels.find(link.key);
        if (found == channels.end()) return;
        Channel& channel = *found->second;
        const auto slot = std::lower_bound(channel.slots.begin(), channel.slots.end(), link.serial,
                                           [](const Slot& s, std::uint64_t at) { return s.serial < at; });
        if (slot == channel.slots.end() || slot->link.get() != &link || !slot->alive) return;
        slot->alive = false;
        --channel.alive;
        --listeners;
        countListener(link.owner, -1);
        // What the handler holds goes now, unless it may be the one that is running.
        std::function<void(const void*)> handler;
        if (channel.delivering == 0) {
            handler = std::move(slot->handler);
        } else {
            channel.leftWhileDelivering = true;
        }
        const Key key = link.key;
        sweep(key);
    }

    bool onOwnerThread() const { return std::this_thread::get_id() == owner; }

    void enqueue(std::function<void()> task)
    {
        std::function<void()> wake;
        {
            const std::lock_guard lock(mutex);
            queue.push_back(std::move(task));
            wake = wakeUp;
        }
        if (wake) wake();
    }

    void report(std::exception_ptr problem)
    {
        try {
            if (onException) return onException(problem);
            std::rethrow_exception(problem);
        } catch (const std::exception& e) {
            std::fprintf(stderr, "error: an event listener failed: %s\n", e.what());
        } catch (...) {
            std::fprintf(stderr, "error: an event listener failed with an unknown exception\n");
        }
    }
};

Subscription::Subscription(Subscription&&) noexcept = default;
Subscription& Subscription::operator=(Subscription&& other) noexcept
{
    if (this != &other) {
        reset();
        link_ = std::move(other.link_);
    }
    return *this;
}
Subscription::~Subscription() { reset(); }

void Subscription::reset()
{
    const auto link = std::exchange(link_, nullptr);
    if (!link) return;
    link->alive.store(false, std::memory_order_release);
    const auto center = link->center.lock();
    if (!center) return;
    if (center->onOwnerThread()) {
        center->leave(*link);
    } else {
        center->enqueue([link] {
            if (const auto still = link->center.lock()) still->leave(*link);
        });
    }
}

EventsCenter::EventsCenter() : d_(std::make_shared<Private>())
{
    const std::lock_guard lock(owners().mutex);
    owners().threads.emplace(this, d_->owner);
}

EventsCenter::~EventsCenter()
{
    const std::lock_guard lock(owners().mutex);
    owners().threads.erase(this);
}

Subscription EventsCenter::subscribeErased(const void* sender, EventType type, std::function<void(const void*)> handler)
{
    Subscription subscription;
    subscription.link_ = d_->link(d_, {sender, type.hash}, __builtin_return_address(0));
    d_->subscribe(subscription.link_, std::move(handler));
    return subscription;
}

Subscription EventsCenter::subscribeBursts(const void* sender, EventType type, std::function<void(const void*)> collect,
                                           std::function<void()> deliver)
{
    struct Burst {
        std::function<void(const void*)> collect;
        std::function<void()> deliver;
        bool queued = false;
    };
    auto burst = std::make_shared<Burst>(Burst{std::move(collect), std::move(deliver)});
    Subscription subscription;
    subscription.link_ = d_->link(d_, {sender, type.hash}, __builtin_return_address(0));
    d_->subscribe(subscription.link_, [burst, link = std::weak_ptr(subscription.link_)](const void* event) {
        burst->collect(event);
        const auto subscribed = link.lock();
        const auto center = subscribed ? subscribed->center.lock() : nullptr;
        if (!center || std::exchange(burst->queued, true)) return;
        center->enqueue([burst, link] {
            burst->queued = false;
            const auto still = link.lock();
            if (!still || !still->alive.load(std::memory_order_acquire)) return;
            CallsByOwner calls;
            if (!calls.enter(still->owner)) return;
            try {
                burst->deliver();
            } catch (...) {
                calls.leave();
                if (!calls.blame(still->owner, std::current_exception())) throw;
            }
        });
    });
    return subscription;
}

void EventsCenter::deliver(const void* sender, EventType type, const void* event)
{
    const auto keepAlive = d_;  // a listener may destroy the center's owner
    keepAlive->run(Key{sender, type.hash}, event);
    if (sender) keepAlive->run(Key{nullptr, type.hash}, event);
}

bool EventsCenter::onOwnerThread() const { return d_->onOwnerThread(); }

void EventsCenter::enqueue(std::function<void()> task) { d_->enqueue(std::move(task)); }

void EventsCenter::dispatchQueued()
{
    const std::weak_ptr<Private> center = d_;
    std::deque<std::function<void()>> tasks;
    {
        const std::lock_guard lock(d_->mutex);
        tasks.swap(d_->queue);
    }
    for (auto& task : tasks) {
        const auto alive = center.lock();
        if (!alive) return;  // a task before destroyed the center
        try {
            task();
        } catch (...) {
            alive->report(std::current_exception());
        }
    }
}

void EventsCenter::setWakeUp(std::function<void()> wakeUp)
{
    const std::lock_guard lock(d_->mutex);
    d_->wakeUp = std::move(wakeUp);
}

void EventsCenter::setExceptionHandler(std::function<void(std::exception_ptr)> handler)
{
    d_->onException = std::move(handler);
}
std::size_t EventsCenter::listenerCount() const { return d_->listeners; }

}  // namespace jet
