#include "engine.hpp"

#include "world.hpp"

namespace jet::physics {

std::unique_ptr<PhysicsWorld> JetPhysics::createWorld(const WorldSettings& settings)
{
    return std::make_unique<World>(settings);
}

}  // namespace jet::physics
