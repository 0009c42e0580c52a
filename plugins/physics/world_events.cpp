// Which bodies began to touch in the last step, and which ended.
//
// Simple rigid bodies have events of their own. Those of others come from the touches that are told anyway, compared
// with those of the step before. As telling takes time, that is done only once somebody asked for events: the first
// time all that touch begin.
#include "world.hpp"

#include <algorithm>

namespace jet::physics {

namespace {

BodyHandle lower(std::uint64_t pair) { return static_cast<BodyHandle>(pair >> 32); }
BodyHandle higher(std::uint64_t pair) { return static_cast<BodyHandle>(pair & 0xffffffffU); }

}  // namespace

/// Is it told by comparing? Else the rigid stage has events for it.
bool World::isCompared(std::uint64_t pair) const
{
    return !state_.bodies[lower(pair)].simple || !state_.bodies[higher(pair)].simple;
}

/// Before a step: what touched until now.
void World::rememberTouches()
{
    eventsTold_ = false;
    if (!watched_) return;
    reportIfAsked();
    touchedBefore_ = touching_;
    // The last body that is not simple may have been removed: then the step tells the end of its touches.
    const auto isCompared = [&](std::uint64_t pair) { return this->isCompared(pair); };
    watched_ = complex_ > 0 || std::any_of(touching_.begin(), touching_.end(), isCompared);
}

std::span<const ContactEvent> World::contactEvents() const
{
    if (complex_ == 0 && !watched_) return rigid_.events();
    auto& self = const_cast<World&>(*this);  // a cache of what the last step left
    self.watched_ = true;
    reportIfAsked();
    if (!eventsTold_) self.tellEvents();
    return events_;
}

void World::tellEvents()
{
    eventsTold_ = true;
    const std::span<const ContactEvent> own = rigid_.events();
    events_.assign(own.begin(), own.end());
    const auto counts = [&](std::uint64_t pair) { return isCompared(pair); };
    auto before = touchedBefore_.begin();
    for (const std::uint64_t pair : touching_) {
        for (; before != touchedBefore_.end() && *before < pair; ++before)
            if (counts(*before)) events_.push_back({lower(*before), higher(*before), false, 0});
        const bool known = before != touchedBefore_.end() && *before == pair;
        if (known) ++before;
        if (!known && counts(pair)) events_.push_back({lower(pair), higher(pair), true, impulseBetween(pair)});
    }
    for (; before != touchedBefore_.end(); ++before)
        if (counts(*before)) events_.push_back({lower(*before), higher(*before), false, 0});
    // Each of both is in ascending order.
    std::inplace_merge(events_.begin(), events_.begin() + static_cast<std::ptrdiff_t>(own.size()), events_.end(),
                       [](const ContactEvent& a, const ContactEvent& b) {
                           return std::pair(a.bodyA, a.bodyB) < std::pair(b.bodyA, b.bodyB);
                       });
}

double World::impulseBetween(std::uint64_t pair) const
{
    double impulse = 0;
    for (const Contact& contact : reports_)
        if (std::min(contact.bodyA, contact.bodyB) == lower(pair) &&
            std::max(contact.bodyA, contact.bodyB) == higher(pair))
            impulse += contact.impulse;
    return impulse;
}

}  // namespace jet::physics
