// Box2D's shapes of a body: chains around what is fixed, convex parts of what moves.
#pragma once

#include "outline.hpp"

#include <box2d/b2_body.h>

namespace jet::box2d {

/// Adds fixtures without density to `body`, which stands at `centre`. Throws a Failure when nothing is left of the
/// outline that Box2D can compute with.
void addFixtures(b2Body& body, const RigidBodyDef& def, const Vec2& centre);

}  // namespace jet::box2d
