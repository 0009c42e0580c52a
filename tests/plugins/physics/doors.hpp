// All doors through which a world tells numbers: each names the first thing it told that is none.
#pragma once

#include "scenes.hpp"

#include <jet/result.hpp>

#include <cmath>
#include <string>

namespace jet::physics::test {

template <class Act>
std::string refusalOf(Act&& act)
{
    try {
        act();
    } catch (const Failure& failure) {
        return failure.error().message;
    }
    return {};
}

/// Which of what the world tells is no number; empty: all are.
inline std::string stateWithoutNumber(const PhysicsWorld& world)
{
    const BodyStates told = world.bodies();
    for (std::size_t i = 0; i < world.bodyCount(); ++i) {
        const std::string body = " of body " + std::to_string(i);
        if (!isFinite(told.position[i])) return "the position" + body;
        if (!isFinite(told.velocity[i])) return "the velocity" + body;
        if (!std::isfinite(told.angle[i])) return "the angle" + body;
        if (!std::isfinite(told.omega[i])) return "the turning rate" + body;
        if (!told.bounds[i].isNull() && !(isFinite(told.bounds[i].min) && isFinite(told.bounds[i].max)))
            return "the bounds" + body;
        for (std::uint32_t p = told.firstPoint[i]; p < told.firstPoint[i + 1]; ++p)
            if (!isFinite(told.points[p])) return "point " + std::to_string(p) + body;
    }
    return {};
}

inline std::string springWithoutNumber(const PhysicsWorld& world)
{
    for (BodyHandle body = 0; body < world.bodyCount(); ++body) {
        for (std::uint32_t spring = 0;; ++spring) {
            double tension = 0;
            if (!refusalOf([&] { tension = world.springTension(body, spring); }).empty()) break;  // no more
            if (!std::isfinite(tension))
                return "the tension of spring " + std::to_string(spring) + " of body " + std::to_string(body);
        }
    }
    return {};
}

inline std::string meetingWithoutNumber(const PhysicsWorld& world)
{
    for (const Contact& c : world.contacts()) {
        if (!isFinite(c.point) || !isFinite(c.normal)) return "the place or normal of a contact";
        if (!std::isfinite(c.edgeParameter)) return "the place of a contact on its wall";
        if (!std::isfinite(c.penetration)) return "the penetration of a contact";
        if (!std::isfinite(c.impulse)) return "the impulse of a contact";
    }
    for (const ContactEvent& event : world.contactEvents())
        if (!std::isfinite(event.impulse)) return "the impulse of an event";
    for (JointHandle j = 0; j < world.jointCount(); ++j) {
        const JointState joint = world.joint(j);
        if (!isFinite(joint.force) || !std::isfinite(joint.torque)) return "what joint " + std::to_string(j) + " bears";
        if (!std::isfinite(joint.value)) return "the value of joint " + std::to_string(j);
        if (!isFinite(joint.pointA) || !isFinite(joint.pointB)) return "a point of joint " + std::to_string(j);
    }
    return {};
}

inline std::string queryWithoutNumber(const PhysicsWorld& world)
{
    QueryFilter all;
    all.sensors = true;
    const auto bad = [](const std::optional<CastHit>& hit) {
        return hit && !(isFinite(hit->point) && isFinite(hit->normal) && std::isfinite(hit->fraction));
    };
    for (const double far : {150.0, 1e4, 4e11}) {
        const Vec2 from(-far, -0.3 * far), to(far, 0.1 * far);
        if (bad(world.rayCast(from, to, all)) || bad(world.rayCast(to, {0, 0}, all))) return "where a ray hits";
        if (bad(world.nearest(from, far, all)) || bad(world.nearest({0, -far}, 1e29, all))) return "what is nearest";
        if (bad(world.shapeCast({ShapeDef::Kind::Circle, {from}, 3}, to - from, all)) ||
            bad(world.shapeCast({ShapeDef::Kind::Polygon, {from, from + Vec2(far, 0), from + Vec2(0, far)}, 0},
                                {far, far / 2}, all)))
            return "where a shape hits";
    }
    return {};
}

inline std::string fieldWithoutNumber(const PhysicsWorld& world)
{
    for (const auto& door : {stateWithoutNumber, springWithoutNumber, meetingWithoutNumber, queryWithoutNumber})
        if (std::string none = door(world); !none.empty()) return none;
    const StepStats stats = world.stats();
    for (const double time : {stats.broadPhaseMs, stats.narrowPhaseMs, stats.solverMs, stats.springsMs, stats.islandsMs,
                              stats.continuousMs})
        if (!(std::isfinite(time) && time >= 0)) return "a time of the step";
    return {};
}

}  // namespace jet::physics::test
