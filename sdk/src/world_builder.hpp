// Builds the physics world of a scene: bodies through their effects, then actuators through their item types.
#pragma once

#include "item_parts.hpp"
#include "skin.hpp"

#include <jet/item_type.hpp>
#include <jet/simulation.hpp>

#include <map>
#include <optional>
#include <unordered_map>

namespace jet {

/// How an item follows its body.
struct BodyBinding {
    ItemId item;
    BodyHandle body = kNoHandle;
    std::size_t effect = 0;  ///< which of the item's builds it
    bool soft = false;
    bool fixed = false;
    double mass = 1;
    Vec2 restPosition;  ///< centre of mass when play started
    Skin skin;
    Path restPath;
    std::optional<LiveBody> live;  ///< of soft bodies
    bool wantsLive = false;        ///< an effect draws it
    std::uint64_t liveAt = 0;      ///< steps + 1 when `live` was brought up to date
};

class SceneWorldBuilder final : public WorldBuilder {
public:
    SceneWorldBuilder(const Scene& scene, PhysicsWorld& world, std::vector<OutputLine>& messages)
        : scene_(scene), world_(world), recording_(world), messages_(messages)
    {
    }

    void build();

    PhysicsWorld& world() override { return recording_; }
    Anchor anchor(const Item& item, const Vec2& point) const override;
    void bind(const Item& item, ActuatorHandle actuator) override { actuators[item.id()] = actuator; }
    void warn(const Item& item, std::string message) override
    {
        messages_.push_back({OutputLine::Kind::Warning, "'" + item.name() + "': " + message, {}, 0});
    }

    std::vector<BodyBinding> bodies;  ///< by handle
    std::map<ItemId, ActuatorHandle> actuators;
    std::map<ItemId, ItemParts> parts;  ///< of items that are no bodies

private:
    void addBody(const Item& item);
    void warnOfUseless(const Item& item);
    Anchor anchorAt(const Item& item, const Vec2& point) const;

    const Scene& scene_;
    PhysicsWorld& world_;
    mutable RecordingWorld recording_;
    std::vector<OutputLine>& messages_;
    std::unordered_map<std::uint64_t, std::size_t> order_;  // place in tree order
};

WorldSettings worldSettings(const Scene& scene, int threads);

/// What a body item's own properties say; `problem` is a sentence where they name a material the scene has not.
BodyCommon commonOf(const Scene& scene, const Item& item, std::string& problem);

double massOf(const BodyDef&);

/// Changes a body that was built as `before` to what is built as `after`. Throws Failure with the reason, and changes
/// nothing, where what it is made of would be another.
void changeDefinition(BodyHandle body, const BodyDef& before, const BodyDef& after, PhysicsWorld& world);

}  // namespace jet
