// What is refused before it can do harm, with a sentence for the person who wrote the scene.
#pragma once

#include <jet/physics_checks.hpp>
#include <jet/result.hpp>

#include <string>

namespace jet::physics {

inline const PhysicsChecks& checks()
{
    static const PhysicsChecks all("Physics", {});
    return all;
}

/// Handles and indices that the caller made up.
inline void requireBelow(std::string_view what, std::size_t index, std::size_t count)
{
    checks().index(what, index, count);
}

inline std::string named(std::string_view kind, std::size_t handle)
{
    return std::string(kind) + " " + std::to_string(handle);
}

}  // namespace jet::physics
