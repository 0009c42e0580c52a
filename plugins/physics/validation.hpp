// What is refused before it can do harm, with a sentence for the person who wrote the scene.
#pragma once

#include <jet/physics.hpp>
#include <jet/result.hpp>

#include <initializer_list>
#include <string_view>

namespace jet::physics {

void requireFinite(std::string_view what, const Vec2&);
void requirePlace(std::string_view what, const Vec2&);
void requireFinite(std::string_view what, std::initializer_list<double> values);

void validate(const WorldSettings&);
void validate(const BodyCommon&, const WorldSettings&);
void validate(const SoftBodyDef&, const WorldSettings&);
void validate(const RigidBodyDef&, const WorldSettings&);
void validate(const ShapeDef&);
void validate(const SoftMatter&);
void validate(const ForceFieldDef&);
void validate(const Anchor&, std::size_t bodyCount);
void requireSpring(std::string_view what, double restLength, double ks, double kd, double tearRatio);
/// All but its anchors.
void validateJoint(const JointDef&);
/// Handles and indices that the caller made up.
void requireBelow(std::string_view what, std::size_t index, std::size_t count);

}  // namespace jet::physics
