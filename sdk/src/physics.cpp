#include <jet/physics.hpp>

namespace jet {

PhysicsWorld::~PhysicsWorld() = default;
PhysicsEngine::~PhysicsEngine() = default;

}  // namespace jet
