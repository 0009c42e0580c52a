// The words of `jet play --debug`: what the picture shows of the physics, as the Physics panel does in the window.
#pragma once

#include <jet/physics_view.hpp>
#include <jet/result.hpp>

#include <string_view>

namespace jet::host {

/// Of words separated by commas, or "all". The error names the word, and those there are.
Result<PhysicsMarks> debugMarks(std::string_view words);

}  // namespace jet::host
