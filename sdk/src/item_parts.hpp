// What items are in the physics world, and how that follows their properties while playing.
//
// An item type says once, in build(), what its items add to the world. It is called again when a property changes: the
// same calls then change what they added before. So a property that counts when play starts counts while it goes on,
// in item types of plugins, too, and none is read at two places.
#pragma once

#include "forwarding_world.hpp"

#include <jet/item_type.hpp>
#include <jet/result.hpp>

#include <variant>

namespace jet {

/// One call of an item's build(), and the handle it was given.
struct ItemPart {
    using Def = std::variant<SpringActuatorDef, AngularSpringActuatorDef, TorqueActuatorDef, ForceActuatorDef, JointDef,
                             ForceFieldDef>;
    Def def;  ///< as it is now
    std::uint32_t handle = kNoHandle;
};

struct ItemParts {
    std::vector<Anchor> anchors;  ///< in the order asked for; as drawn, so they are not sought again
    std::vector<ItemPart> parts;  ///< in the order added
};

/// The world an item type adds to when play starts.
class RecordingWorld final : public ForwardingWorld {
public:
    using ForwardingWorld::ForwardingWorld;
    ActuatorHandle addSpring(const SpringActuatorDef& def) override;
    ActuatorHandle addAngularSpring(const AngularSpringActuatorDef& def) override;
    ActuatorHandle addTorque(const TorqueActuatorDef& def) override;
    ActuatorHandle addForce(const ForceActuatorDef& def) override;
    ActuatorHandle addForceField(const ForceFieldDef& def) override;
    JointHandle addJoint(const JointDef& def) override;

    ItemParts parts;  ///< since it was last cleared

private:
    std::uint32_t keep(ItemPart::Def def, std::uint32_t handle);
};

/// Changes what the item added when play started to what its properties say now. Throws Failure with the reason when
/// something of it cannot change; then the rest may have changed, and the same call with the properties of before
/// brings it back.
void changeParts(const Item& item, const ItemType& type, ItemParts& parts, PhysicsWorld& world);

}  // namespace jet
