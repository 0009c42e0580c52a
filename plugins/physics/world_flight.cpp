// Which soft bodies are moved for a whole step at once: see soft/flight.hpp.
#include "soft/enclosed_area.hpp"
#include "world.hpp"

#include <algorithm>
#include <limits>

namespace jet::physics {

/// Before the first of `count` substeps of h, when it is known what may meet within them.
void World::flyFree(double h, int count)
{
    if (count < 2 || plain_ || actuators_.any() || fields_.any() || (pushed_ && anyStepForce())) return;
    for (Index handle = 0; handle < state_.bodies.size(); ++handle) {
        BodyRecord& body = state_.bodies[handle];
        if (!springs_.mayFly(handle) || !isLeftAlone(handle, h * count)) continue;
        const double most =
            settings_.findCollisions ? finder_.freedomOf(handle) : std::numeric_limits<double>::infinity();
        if (!(most > 0)) continue;
        const Vec2 gravity = settings_.applyGravity ? Vec2(body.gravityScale * settings_.gravity) : Vec2(0, 0);
        const double kept = settings_.applyDamping ? decay(settings_.linearDamping * h) : 1;
        body.flown = springs_.fly(state_, handle, h, count, gravity, kept, most);
    }
}

bool World::anyStepForce() const
{
    const std::vector<Vec2>& forces = stepForces_.values();
    return std::any_of(forces.begin(), forces.end(), [](const Vec2& force) { return force != Vec2(0, 0); });
}

/// Does nothing act on it within dt but its springs, gravity and damping, as long as it meets nobody?
bool World::isLeftAlone(Index handle, double dt)
{
    const BodyRecord& body = state_.bodies[handle];
    if (body.fixed || body.kinematic || body.fixedRotation || !body.enabled || body.asleep) return false;
    if (body.soft->angularSprings.count > 0 || body.hasTwin() || soft::holdsGas(body)) return false;
    if (settings_.applyDamping && settings_.angularDamping != 0) return false;
    return !softJoints_.holds(handle) && shapes_.relaxes(state_, handle, dt);
}

}  // namespace jet::physics
