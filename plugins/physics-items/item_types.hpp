// The item types of this plugin.
#pragma once

#include <jet/item_type.hpp>

namespace jet::physics_items {

/// Holds what lies under the first and the last point of its path together.
class JointType final : public ItemType {
public:
    const PropertyTable& properties() const override;
    std::string label() const override { return "Joint"; }
    void paint(const Item&, const Path&, PaintPurpose, Painter&) const override;
    void build(const Item&, WorldBuilder&) const override;
};

/// Pushes the body under its centre, always the same way.
class ForceType final : public ItemType {
public:
    const PropertyTable& properties() const override;
    std::string label() const override { return "Force"; }
    void paint(const Item&, const Path&, PaintPurpose, Painter&) const override;
    void build(const Item&, WorldBuilder&) const override;
};

/// Pushes everything within its path.
class ForceFieldType final : public ItemType {
public:
    const PropertyTable& properties() const override;
    std::string label() const override { return "Force field"; }
    void paint(const Item&, const Path&, PaintPurpose, Painter&) const override;
    void build(const Item&, WorldBuilder&) const override;
};

}  // namespace jet::physics_items
