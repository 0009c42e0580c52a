#include "engine.hpp"

#include <jet/plugin.hpp>

JET_PLUGIN(plugin) { plugin.physicsEngine<jet::physics::JetPhysics>("jet-physics"); }
