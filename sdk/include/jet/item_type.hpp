// ItemType: what the items of one kind are: their properties, their look while editing, what they add to a simulation.
#pragma once

#include <jet/effect.hpp>

#include <functional>
#include <string>

namespace jet {

/// What an item may add to the physics world when play starts.
class JET_API WorldBuilder {
public:
    virtual ~WorldBuilder();
    virtual PhysicsWorld& world() = 0;
    /// Anchor for a point of `item`: the body with the least distance in the tree that contains the point (of equally
    /// near ones, the one before the item), else the background (thesis §3.4.6, SPEC PH7).
    virtual Anchor anchor(const Item& item, const Vec2& point) const = 0;
    /// Makes the actuator scriptable as item.spring / item.torque.
    virtual void bind(const Item& item, ActuatorHandle actuator) = 0;
    /// A message for the Output panel about an item that could not be built as drawn.
    virtual void warn(const Item& item, std::string message) = 0;
};

class JET_API ItemType {
public:
    virtual ~ItemType();
    virtual const PropertyTable& properties() const = 0;
    /// Label for people, e.g. "Shape"; new items are named from it.
    virtual std::string label() const = 0;
    /// Draws what the effects do not: helpers while editing. Called after the item's effects.
    virtual void paint(const Item& item, const Path& path, PaintPurpose purpose, Painter& painter) const;
    /// Called for each item when play starts, after all bodies are built; and again, with the same calls expected in
    /// the same order, when a property of it is changed while playing: what these calls added is then changed to what
    /// they say now. One that adds more, less or other things then is refused, and nothing is changed.
    virtual void build(const Item& item, WorldBuilder& builder) const;
};

}  // namespace jet
