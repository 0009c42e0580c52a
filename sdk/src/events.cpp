// Listeners of one (sender, type) pair form a channel; a hash table finds it. Delivery walks the channel's slots, so
// its cost does not depend on how many listeners there are elsewhere. Slots freed during delivery are reused only after
// it ended.
#include <jet/events.hpp>

#include <algorithm>
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

struct Slot {
    std::function<void(const void*)> handler;
    std::uint64_t serial = 0;  // when it subscribed: ascending within a channel
    bool alive = true;
};

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

struct Channel {
    std::deque<Slot> slots;  // a deque: a handler stays where it is while others subscribe
    std::size_t alive = 0;
    int delivering = 0;
    bool leftWhileDelivering = false;
};

using Channels = std::unordered_map<Key, std::unique_ptr<Channel>, KeyHash>;

}  // namespace

struct EventsCenter::Private {
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
        for (std::size_t i = 0, n = channel.slots.size(); i < n; ++i) {
            Slot& slot = channel.slots[i];
            if (!slot.alive || slot.serial > last) continue;
            try {
                slot.handler(event);
            } catch (...) {
                report(std::current_exception());
            }
        }
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

struct Subscription::Link {
    std::weak_ptr<EventsCenter::Private> center;
    Key key;
    std::uint64_t serial;
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
    const auto center = link->center.lock();
    if (!center) return;
    const auto found = center->channels.find(link->key);
    if (found == center->channels.end()) return;
    Channel& channel = *found->second;
    const auto slot = std::lower_bound(channel.slots.begin(), channel.slots.end(), link->serial,
                                       [](const Slot& s, std::uint64_t serial) { return s.serial < serial; });
    if (slot == channel.slots.end() || slot->serial != link->serial || !slot->alive) return;
    slot->alive = false;
    --channel.alive;
    --center->listeners;
    // What the handler holds goes now, unless it may be the one that is running.
    std::function<void(const void*)> handler;
    if (channel.delivering == 0) {
        handler = std::move(slot->handler);
    } else {
        channel.leftWhileDelivering = true;
    }
    center->sweep(link->key);
}

EventsCenter::EventsCenter() : d_(std::make_shared<Private>()) {}
EventsCenter::~EventsCenter() = default;

Subscription EventsCenter::subscribeErased(const void* sender, EventType type, std::function<void(const void*)> handler)
{
    const Key key{sender, type.hash};
    auto& channel = d_->channels[key];
    if (!channel) channel = std::make_unique<Channel>();
    channel->slots.push_back({std::move(handler), ++d_->serial, true});
    ++channel->alive;
    ++d_->listeners;
    Subscription subscription;
    subscription.link_ = std::make_shared<Subscription::Link>(Subscription::Link{d_, key, d_->serial});
    return subscription;
}

void EventsCenter::deliver(const void* sender, EventType type, const void* event)
{
    const auto keepAlive = d_;  // a listener may destroy the center's owner
    keepAlive->run(Key{sender, type.hash}, event);
    if (sender) keepAlive->run(Key{nullptr, type.hash}, event);
}

bool EventsCenter::onOwnerThread() const { return std::this_thread::get_id() == d_->owner; }

void EventsCenter::enqueue(std::function<void()> task)
{
    std::function<void()> wakeUp;
    {
        const std::lock_guard lock(d_->mutex);
        d_->queue.push_back(std::move(task));
        wakeUp = d_->wakeUp;
    }
    if (wakeUp) wakeUp();
}

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
