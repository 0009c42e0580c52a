#include "item_types.hpp"

#include <jet/plugin.hpp>

JET_PLUGIN(plugin)
{
    plugin.itemType<jet::physics_items::JointType>("joint");
    plugin.itemType<jet::physics_items::ForceType>("force");
    plugin.itemType<jet::physics_items::ForceFieldType>("force-field");
}
