// Listeners of one (sender, type) pair form a channel; a hash table finds it. Delivery walks the channel's slots, so its cost
// does not depend on how many listeners there are elsewhere. Slots freed during delivery are reused only after it ended.
#include <jet/events.hpp>

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
    std::uint64_t serial = 0;  // when it subscribed; 0: free
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
};

}  // namespace

struct EventsCenter::Private {
    std::unordered_map<Key, std::unique_ptr<Channel>, KeyHash> channels;
    std::uint64_t serial = 0;
    std::size_t listeners = 0;
    std::thread::id owner = std::this_thread::get_id();
    std::function<void(std::exception_ptr)> onException;

    std::mutex mutex;  // guards the two below
    std::deque<std::function<void()>> queue;
    std::function<void()> wakeUp;

    void run(Channel& channel, const void* event)
    {
        const std::uint64_t last = serial;  // who subscribes during delivery hears from the next event on
        ++channel.delivering;
        for (std::size_t i = 0, n = channel.slots.size(); i < n; ++i) {
            Slot& slot = channel.slots[i];
            if (slot.serial == 0 || slot.serial > last) continue;
            try {
                slot.handler(event);
            } catch (...) {
                report(std::current_exception());
            }
        }
        --channel.delivering;
        if (channel.delivering == 0) sweep(channel);
    }

    void sweep(Channel& channel)
    {
        if (channel.alive == channel.slots.size()) return;
        std::erase_if(channel.slots, [](const Slot& slot) { return slot.serial == 0; });
    }

    void report(std::exception_ptr problem)
    {
        if (onException) return onException(problem);
        try {
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
    for (Slot& slot : channel.slots) {
        if (slot.serial != link->serial) continue;
        slot.serial = 0;  // the handler itself may be running: it is destroyed by the sweep
        --channel.alive;
        --center->listeners;
        break;
    }
    if (channel.delivering == 0) {
        center->sweep(channel);
        if (channel.slots.empty()) center->channels.erase(found);
    }
}

EventsCenter::EventsCenter() : d_(std::make_shared<Private>()) {}
EventsCenter::~EventsCenter() = default;

Subscription EventsCenter::subscribeErased(const void* sender, EventType type, std::function<void(const void*)> handler)
{
    const Key key{sender, type.hash};
    auto& channel = d_->channels[key];
    if (!channel) channel = std::make_unique<Channel>();
    channel->slots.push_back({std::move(handler), ++d_->serial});
    ++channel->alive;
    ++d_->listeners;
    Subscription subscription;
    subscription.link_ = std::make_shared<Subscription::Link>(Subscription::Link{d_, key, d_->serial});
    return subscription;
}

void EventsCenter::deliver(const void* sender, EventType type, const void* event)
{
    const auto keepAlive = d_;  // a listener may destroy the center's owner
    const auto send = [&](const void* from) {
        const auto found = keepAlive->channels.find(Key{from, type.hash});
        if (found != keepAlive->channels.end()) keepAlive->run(*found->second, event);
    };
    send(sender);
    if (sender) send(nullptr);
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
    std::deque<std::function<void()>> tasks;
    {
        const std::lock_guard lock(d_->mutex);
        tasks.swap(d_->queue);
    }
    for (auto& task : tasks) task();
}

void EventsCenter::setWakeUp(std::function<void()> wakeUp)
{
    const std::lock_guard lock(d_->mutex);
    d_->wakeUp = std::move(wakeUp);
}

void EventsCenter::setExceptionHandler(std::function<void(std::exception_ptr)> handler) { d_->onException = std::move(handler); }
std::size_t EventsCenter::listenerCount() const { return d_->listeners; }

}  // namespace jet
