// Builds the physics world of a scene: bodies through their effects, then actuators through their item types.
#pragma once

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
    bool soft = false;
    bool fixed = false;
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
        : scene_(scene), world_(world), messages_(messages)
    {
    }

    void build();

    PhysicsWorld& world() override { return world_; }
    Anchor anchor(const Item& item, const Vec2& point) const override;
    void bind(const Item& item, ActuatorHandle actuator) override { actuators[item.id()] = actuator; }
    void warn(const Item& item, std::string message) override
    {
        messages_.push_back({OutputLine::Kind::Warning, "'" + item.name() + "': " + message, {}, 0});
    }

    std::vector<BodyBinding> bodies;  ///< by handle
    std::map<ItemId, ActuatorHandle> actuators;

private:
    void addBody(const Item& item);
    BodyCommon common(const Item& item);

    const Scene& scene_;
    PhysicsWorld& world_;
    std::vector<OutputLine>& messages_;
    std::unordered_map<std::uint64_t, std::size_t> order_;  // place in tree order
};

WorldSettings worldSettings(const Scene& scene, int threads);

}  // namespace jet
