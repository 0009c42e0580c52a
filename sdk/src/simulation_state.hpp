// What a Simulation consists of; shared by the files that implement it.
#pragma once

#include "carried_path.hpp"
#include "property_place.hpp"
#include "world_builder.hpp"

#include <jet/simulation.hpp>

#include <map>
#include <set>
#include <unordered_map>

namespace jet {

/// What a hand holds, and by which joint.
struct Hand {
    ItemId item;
    JointHandle joint = kNoHandle;
    Vec2 place{0, 0};
};

struct Simulation::Private {
    EventsCenter events;  // the copy's own: nobody listens
    SimulationOptions options;
    std::unique_ptr<Scene> scene;
    std::unique_ptr<PhysicsWorld> world;
    std::vector<BodyBinding> bodies;
    std::unordered_map<std::uint64_t, std::size_t> bodyByItem;
    std::map<ItemId, ActuatorHandle> actuators;
    std::map<ItemId, ItemParts> parts;
    std::map<ItemId, double> torques;
    std::unique_ptr<ScriptRuntime> scripts;
    const ContactListening* contactListening = nullptr;       ///< of `scripts`; null: it hears nothing of them
    std::set<std::pair<BodyHandle, BodyHandle>> touchesTold;  ///< whose beginning scripts heard of, and no end
    std::optional<Hand> hand;
    bool handless = false;      ///< has it been told that the engine lets nothing be dragged?
    bool eventsFollow = false;  ///< do the engine's events of the next step go on from `touchesTold`?

    double timeStep = 1.0 / 60;
    std::uint64_t steps = 0;
    std::set<std::string, std::less<>> keys;
    GameView view;
    std::deque<OutputLine> output;
    std::uint64_t printed = 0;
    std::function<void(const OutputLine&)> onOutput;
    std::function<void(ItemId, std::string_view, const Value&)> onProperty;
    std::optional<std::string> requestedScene;
    std::uint64_t random = 1;
    // Of the scene: asked for once, on the thread that owns the catalog. Null: not installed.
    std::map<std::string, const ItemType*, std::less<>> types;
    std::map<std::string, const Effect*, std::less<>> effects;  // of bodies

    mutable std::vector<Path> poses;  // by body handle; valid where posedAt equals steps + 1
    mutable std::vector<std::uint64_t> posedAt;
    mutable std::map<ItemId, CarriedPath> carried;  // of items that hold bodies

    std::size_t bindingOf(ItemId item) const
    {
        const auto found = bodyByItem.find(item.value);
        return found == bodyByItem.end() ? bodies.size() : found->second;
    }

    Path posed(const BodyBinding& binding) const
    {
        const BodyStates states = world->bodies();
        if (binding.soft) {
            const std::uint32_t first = states.firstPoint[binding.body];
            const std::uint32_t last = states.firstPoint[binding.body + 1];
            return binding.skin.deformed(states.points.subspan(first, last - first));
        }
        const Affine motion = Affine::translation(states.position[binding.body]) *
                              Affine::rotation(states.angle[binding.body]) * Affine::translation(-binding.restPosition);
        return binding.restPath.transformed(motion);
    }

    void refresh(BodyBinding& binding) const
    {
        if (!binding.live || binding.liveAt == steps + 1) return;
        const BodyStates states = world->bodies();
        const auto points = states.points.subspan(states.firstPoint[binding.body], binding.live->particles.size());
        std::copy(points.begin(), points.end(), binding.live->particles.begin());
        for (std::uint32_t s = 0; s < binding.live->springs.size(); ++s)
            binding.live->springs[s].whole = world->springAlive(binding.body, s);
        binding.liveAt = steps + 1;
    }

    // What a hand takes hold of; see simulation_hand.cpp.
    bool mayDrag(const BodyBinding& binding) const;
    const BodyBinding* bodyAt(const Vec2& point) const;
    const BodyBinding* bodyNear(const Simulation& self, const Vec2& point, double reach, Vec2& at) const;
    JointDef pullOn(const BodyBinding& binding, double area, const Vec2& at, const Vec2& place) const;

    // Properties that change while playing; see simulation_live.cpp.
    void keepTables(const Item& item);
    PropertyPlace placeOf(const Item& item, std::string_view property) const;
    std::optional<BodyDef> definitionOf(const Item& item, std::size_t effect) const;
    void changeBody(const Item& item, std::string_view property, const Value& value);
    void changeBody(const Item& item, std::size_t effect, const std::optional<BodyDef>& before);
    void changeItem(const Item& item);
    void bringBack(const Item& item);
    template <class Def>
    std::uint32_t firstOf(ItemId item) const;
    void change(const Item& item, const PropertyPlace& place, std::string_view property, const Value& value);

    // What scripts hear of touches; see simulation_contacts.cpp.
    std::vector<ContactEvent> contactEvents();
    void dispatchContacts(const std::vector<ContactEvent>& events, const std::vector<Contact>& contacts);
    void dispatchCollisions(const std::vector<Contact>& contacts);
    void dispatchTouches();
};

}  // namespace jet
