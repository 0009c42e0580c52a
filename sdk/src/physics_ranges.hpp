// What a scene may ask of its physics, for files, edits and play alike.
#pragma once

#include <jet/materials.hpp>
#include <jet/result.hpp>

namespace jet {

/// Larger numbers are beyond what one engine or the other computes with (jet/physics_checks.hpp): a scene that plays
/// with one of them is to play with each.
inline constexpr double kMostOfPhysics = 1e15;

/// Of how two materials meet; the error names them.
Result<void> checkPair(std::string_view a, std::string_view b, const MaterialPair& pair);
/// Of all pairs.
Result<void> checkMaterials(const MaterialTable& table);

}  // namespace jet
