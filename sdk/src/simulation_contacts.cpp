// What scripts hear of touches: those of the last step, and which began and ended.
//
// Beginnings and ends are told by turns for each pair, whatever lies between two steps: the pairs of which the
// beginning was told are kept, and where the engine's events cannot follow from them, after a restore() or when nobody
// has listened so far, the difference to what touches now is told. So a script that counts touches counts right.
#include "simulation_state.hpp"

#include <algorithm>

namespace jet {

namespace {

using Pair = std::pair<BodyHandle, BodyHandle>;

Pair pairOf(const Contact& contact) { return std::minmax(contact.bodyA, contact.bodyB); }

/// What brings those of which the beginning was told to those that touch, in ascending order.
std::vector<ContactEvent> difference(const std::set<Pair>& told, std::span<const Contact> contacts)
{
    std::map<Pair, double> touching;
    for (const Contact& contact : contacts) touching[pairOf(contact)] += contact.impulse;
    std::map<Pair, ContactEvent> events;
    for (const Pair& pair : told)
        if (!touching.contains(pair)) events[pair] = {pair.first, pair.second, false, 0};
    for (const auto& [pair, impulse] : touching)
        if (!told.contains(pair)) events[pair] = {pair.first, pair.second, true, impulse};
    std::vector<ContactEvent> list;
    for (const auto& [pair, event] : events) list.push_back(event);
    return list;
}

}  // namespace

namespace {

/// Of each pair that begins, the point of those the engine tells where it pushes hardest.
std::map<Pair, Contact> hardestPoints(const std::vector<ContactEvent>& events, const std::vector<Contact>& contacts)
{
    std::map<Pair, Contact> hardest;
    for (const ContactEvent& event : events)
        if (event.begins) hardest[{event.bodyA, event.bodyB}].impulse = -1;
    if (hardest.empty()) return hardest;
    for (const Contact& contact : contacts)
        if (const auto found = hardest.find(pairOf(contact));
            found != hardest.end() && contact.impulse > found->second.impulse)
            found->second = contact;
    return hardest;
}

}  // namespace

std::vector<ContactEvent> Simulation::Private::contactEvents()
{
    if (!contactListening || !contactListening->listensToContacts()) {
        touchesTold.clear();
        eventsFollow = false;
        return {};
    }
    const std::span<const ContactEvent> engines = world->contactEvents();  // asked for from now on, each step
    std::vector<ContactEvent> events(engines.begin(), engines.end());
    if (!eventsFollow) events = difference(touchesTold, world->contacts());
    eventsFollow = true;
    std::erase_if(events, [&](const ContactEvent& event) {
        const Pair pair(event.bodyA, event.bodyB);
        return event.begins ? !touchesTold.insert(pair).second : touchesTold.erase(pair) == 0;
    });
    return events;
}

void Simulation::Private::dispatchContacts(const std::vector<ContactEvent>& events,
                                           const std::vector<Contact>& contacts)
{
    const std::map<Pair, Contact> points = hardestPoints(events, contacts);
    for (const ContactEvent& event : events) {
        if (event.bodyA >= bodies.size() || event.bodyB >= bodies.size()) continue;  // of no item
        ScriptEvent told{
            event.begins ? ScriptEventKind::ContactBegin : ScriptEventKind::ContactEnd, {}, {}, {}, {}, {}};
        told.bodyA = bodies[event.bodyA].item, told.bodyB = bodies[event.bodyB].item;
        if (const auto found = points.find({event.bodyA, event.bodyB}); found != points.end()) {
            told.contact = found->second;
            if (told.contact.bodyA != event.bodyA) told.contact.normal = -told.contact.normal;
        }
        told.contact.bodyA = event.bodyA, told.contact.bodyB = event.bodyB, told.contact.impulse = event.impulse;
        scripts->dispatch(told);
    }
}

// One event a pair of bodies and step: scripts ask for more through the contact itself.
void Simulation::Private::dispatchCollisions(const std::vector<Contact>& contacts)
{
    std::set<Pair> seen;
    for (const Contact& contact : contacts) {
        if (contact.bodyA >= bodies.size() || contact.bodyB >= bodies.size()) continue;  // of no item
        if (!seen.insert(pairOf(contact)).second) continue;
        ScriptEvent event{ScriptEventKind::BodyCollision, {}, {}, {}, {}, contact};
        event.bodyA = bodies[contact.bodyA].item;
        event.bodyB = bodies[contact.bodyB].item;
        scripts->dispatch(event);
    }
}

/// All are taken before the first listener is called: it may act on the world.
void Simulation::Private::dispatchTouches()
{
    const std::vector<ContactEvent> events = contactEvents();
    std::vector<Contact> contacts;
    const bool collisions = scripts->listensTo(ScriptEventKind::BodyCollision);
    if (collisions || std::ranges::any_of(events, &ContactEvent::begins)) {
        const std::span<const Contact> told = world->contacts();
        contacts.assign(told.begin(), told.end());
    }
    dispatchContacts(events, contacts);
    if (collisions) dispatchCollisions(contacts);
}

}  // namespace jet
