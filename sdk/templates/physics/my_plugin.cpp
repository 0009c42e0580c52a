// A physics engine as a plugin; its world is in my_plugin_world.hpp.
#include "my_plugin_world.hpp"

#include <jet/plugin.hpp>

namespace {

class MyPluginEngine final : public jet::PhysicsEngine {
public:
    std::unique_ptr<jet::PhysicsWorld> createWorld(const jet::WorldSettings& settings) override
    {
        return std::make_unique<MyPluginWorld>(settings);
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.physicsEngine<MyPluginEngine>("my-plugin"); }
