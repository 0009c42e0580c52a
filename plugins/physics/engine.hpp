// The plugin's contribution: an engine that makes worlds.
#pragma once

#include <jet/physics.hpp>

namespace jet::physics {

class JetPhysics final : public PhysicsEngine {
public:
    std::unique_ptr<PhysicsWorld> createWorld(const WorldSettings&) override;
};

}  // namespace jet::physics
