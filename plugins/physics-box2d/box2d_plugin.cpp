// The plugin's contribution: worlds computed by Debian's Box2D 2.4.1. See docs/physics-box2d.md.
#include "world.hpp"

#include <jet/plugin.hpp>

namespace {

class Box2dEngine final : public jet::PhysicsEngine {
public:
    std::unique_ptr<jet::PhysicsWorld> createWorld(const jet::WorldSettings& settings) override
    {
        return std::make_unique<jet::box2d::World>(settings);
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.physicsEngine<Box2dEngine>("physics-box2d"); }
