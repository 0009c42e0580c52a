// Effect: what gives an item its look or its body (thesis §3.5.2, SPEC EF). An effect is stateless; its values live in
// the item (EffectInstance), so undo, files and copies work without the plugin. Geometry changes reach it by
// themselves: paint and build always get the present path.
#pragma once

#include <jet/item.hpp>
#include <jet/live_body.hpp>
#include <jet/painter.hpp>
#include <jet/physics.hpp>

#include <memory>
#include <optional>
#include <string>
#include <variant>

namespace jet {

class Transaction;

/// Where painting happens.
enum class PaintPurpose {
    Edit,    ///< the scene view while editing: helpers (lattice, indices) are shown
    Play,    ///< a running game
    Export,  ///< pictures and files
};

/// A soft or a rigid body, as an effect builds it from an item.
using BodyDef = std::variant<SoftBodyDef, RigidBodyDef>;

/// Derived data an effect keeps between paints; dropped by the host when item, path or properties change.
class JET_API EffectState {
public:
    virtual ~EffectState();
};

/// What an effect works on.
struct EffectInput {
    const Item& item;
    const Path& path;              ///< the item's path, or its deformed path while playing
    const Properties& properties;  ///< of this effect instance
    const PropertyTable& table;    ///< of this effect
    /// The item's soft body while playing, for effects whose wantsLiveBody() says so; else null. Lives during the call.
    const LiveBody* body = nullptr;

    /// The stored value, or the default.
    template <class T>
    T get(std::string_view property) const
    {
        return properties.get(property, table).as<T>();
    }
};

class JET_API Effect {
public:
    virtual ~Effect();

    /// The declared properties. Same table for the life of the effect.
    virtual const PropertyTable& properties() const = 0;
    /// Item types it can be applied to; by default all that have a path. An empty string: fine; else why not.
    virtual std::string rejects(const Item& item) const;
    /// Called in the transaction that applies the effect, after it was added: e.g. turns a shape into a body.
    virtual void applied(Transaction& edit, const Item& item) const;
    /// Computes what paint() would otherwise compute every time (the thesis's update()). Null: nothing to keep.
    virtual std::unique_ptr<EffectState> update(const EffectInput& input) const;
    /// Draws. `state` is what update() returned for this very input, or null.
    virtual void paint(const EffectInput& input, const EffectState* state, PaintPurpose purpose,
                       Painter& painter) const;
    /// The body this effect gives the item, in scene coordinates; none for effects that are only looks. `common` holds
    /// the body item's own properties (fixed, material, ...), to be copied into the definition.
    virtual std::optional<BodyDef> buildBody(const EffectInput& input, const BodyCommon& common) const;
    /// Shall paint() get the item's running soft body (EffectInput::body)? Asked when play starts. It costs a copy of
    /// the body in each frame, so the answer is no unless the effect draws particles or springs.
    virtual bool wantsLiveBody() const;
};

}  // namespace jet
