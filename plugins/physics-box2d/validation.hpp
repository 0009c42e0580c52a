// What is refused before it reaches Box2D, whose answer to such values is to abort: with a sentence that names the
// item.
#pragma once

#include <jet/physics_checks.hpp>
#include <jet/result.hpp>

#include <string>

namespace jet::box2d {

/// Places are in scene units: beyond 10,000,000, a float has less than a unit of resolution.
inline const PhysicsChecks& checks()
{
    static const PhysicsChecks all("Box2D", {1e7, 1e15});
    return all;
}

[[noreturn]] inline void fail(const std::string& message) { checks().fail(message); }

inline void requireBelow(std::string_view what, std::size_t index, std::size_t count)
{
    checks().index(what, index, count);
}

inline std::string named(std::string_view kind, std::size_t handle)
{
    return std::string(kind) + " " + std::to_string(handle);
}

}  // namespace jet::box2d
