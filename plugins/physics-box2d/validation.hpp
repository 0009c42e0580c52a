// What is refused before it reaches Box2D, whose answer to such values is to abort: with a sentence that names the
// item.
#pragma once

#include <jet/physics.hpp>
#include <jet/result.hpp>

#include <initializer_list>
#include <string>
#include <string_view>

namespace jet::box2d {

[[noreturn]] void fail(std::string message);
void requireFinite(std::string_view what, std::initializer_list<double> values);
void requireFinite(std::string_view what, const Vec2& value);
/// A place Box2D's floats can tell apart from its neighbours.
void requirePlace(std::string_view what, const Vec2& at);
void requireBelow(std::string_view what, std::size_t index, std::size_t count);

void validate(const WorldSettings&);
void validate(const BodyCommon&, const WorldSettings&);
void validate(const RigidBodyDef&, const WorldSettings&);
void validate(const ShapeDef&, bool fixed);
void validate(const Anchor&, std::size_t bodyCount);
void validate(const JointDef&, std::size_t bodyCount);
void requireSpring(std::string_view what, double rest, double ks, double kd, double tearRatio);

}  // namespace jet::box2d
