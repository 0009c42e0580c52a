#include "validation.hpp"

namespace jet::box2d {

namespace {
constexpr double kFarthest = 1e7;  // scene units; beyond, a float has less than a unit of resolution
constexpr double kLargest = 1e15;
}  // namespace

void fail(std::string message) { throw Failure(Error("Box2D: " + std::move(message))); }

void requireFinite(std::string_view what, std::initializer_list<double> values)
{
    for (const double value : values)
        if (!(std::abs(value) <= kLargest))
            fail(std::string(what) + " is not a finite number of sensible size; give it an ordinary one.");
}

void requireFinite(std::string_view what, const Vec2& value) { requireFinite(what, {value.x(), value.y()}); }

void requirePlace(std::string_view what, const Vec2& at)
{
    if (!isFinite(at) || !(at.cwiseAbs().maxCoeff() <= kFarthest))
        fail(std::string(what) + " is not within 10,000,000 units of the origin, where Box2D can compute.");
}

void requireBelow(std::string_view what, std::size_t index, std::size_t count)
{
    if (index >= count)
        fail(std::string(what) + " " + std::to_string(index) + " does not exist; there are " + std::to_string(count) +
             ".");
}

void requireSpring(std::string_view what, double rest, double ks, double kd, double tearRatio)
{
    requireFinite(what, {rest, ks, kd, tearRatio});
    if (ks < 0 || kd < 0)
        fail(std::string(what) + ": stiffness and damping must not be negative, or it would gain energy.");
}

void validate(const WorldSettings& settings)
{
    requireFinite("gravity", settings.gravity);
    requireFinite("the world's damping", {settings.linearDamping, settings.angularDamping});
    if (settings.linearDamping < 0 || settings.angularDamping < 0) fail("the world's damping must not be negative.");
    const std::size_t wanted = static_cast<std::size_t>(settings.materialCount) * settings.materialCount;
    if (settings.materialCount == 0 || settings.materials.size() != wanted)
        fail("the materials table has " + std::to_string(settings.materials.size()) + " entries; " +
             std::to_string(settings.materialCount) + " materials need " + std::to_string(wanted) + ".");
    for (const MaterialPair& pair : settings.materials) {
        requireFinite("a material's friction or restitution", {pair.friction, pair.restitution});
        if (pair.friction < 0 || pair.restitution < 0)
            fail("a material's friction and restitution must not be negative.");
    }
}

void validate(const BodyCommon& common, const WorldSettings& settings)
{
    requireBelow("material", common.material, settings.materialCount);
    requireFinite("a body's initial velocity", common.velocity);
    requireFinite("a body's initial turning rate or gravity scale", {common.omega, common.gravityScale});
    requireFinite("a body's one-sided direction", common.oneSided);
}

void validate(const RigidBodyDef& def, const WorldSettings& settings)
{
    validate(def.common, settings);
    requireFinite("a rigid body's mass", {def.mass});
    if (!(def.mass > 0)) fail("a rigid body's mass must be greater than 0.");
    for (const auto& border : def.borders)
        for (const Vec2& at : border) requirePlace("a rigid body's border point", at);
    for (const ShapeDef& shape : def.shapes) validate(shape, def.common.fixed);
    if (def.shapes.empty() && def.borders.empty()) fail("a rigid body needs borders or shapes.");
}

void validate(const ShapeDef& shape, bool fixed)
{
    for (const Vec2& at : shape.points) requirePlace("a shape's point", at);
    const std::size_t count = shape.points.size();
    switch (shape.kind) {
    case ShapeDef::Kind::Polygon:
        if (count < 3 || count > 8)
            fail("a polygon shape has 3 to 8 points, not " + std::to_string(count) +
                 "; give other outlines as borders.");
        return;
    case ShapeDef::Kind::Chain:
        if (!fixed) fail("a chain is a shape of fixed bodies only.");
        if (count < 2) fail("a chain has at least two points.");
        return;
    case ShapeDef::Kind::Circle:
    case ShapeDef::Kind::Capsule:
        if (count != (shape.kind == ShapeDef::Kind::Circle ? 1U : 2U))
            fail("a circle shape has one point, a capsule two.");
        requireFinite("a shape's radius", {shape.radius});
        if (!(shape.radius > 0)) fail("a shape's radius must be greater than 0.");
    }
}

void validate(const Anchor& anchor, std::size_t bodyCount)
{
    if (anchor.body != kNoHandle) requireBelow("an anchor's body", anchor.body, bodyCount);
    requirePlace("an anchor's point", anchor.point);
}

void validate(const JointDef& def, std::size_t bodyCount)
{
    validate(def.a, bodyCount);
    validate(def.b, bodyCount);
    if (def.a.body == def.b.body) fail("a joint needs two different bodies.");
    requireFinite("a joint's limits and motor", {def.lower, def.upper, def.motorSpeed, def.maxForce, def.maxTorque,
                                                 def.hertz, def.dampingRatio, def.length, def.ratio, def.breakForce});
    requireFinite("a joint's axis", def.axis);
    requireFinite("a joint's motor velocity", def.motorVelocity);
    if (def.kind == JointDef::Kind::Pulley) {
        requirePlace("a pulley's wheel", def.groundA);
        requirePlace("a pulley's wheel", def.groundB);
        if (!(def.ratio > 1e-6)) fail("a pulley's ratio must be greater than 0.");
    }
    if (def.maxForce < 0 || def.maxTorque < 0 || def.hertz < 0 || def.dampingRatio < 0 || def.lower > def.upper)
        fail("a joint's force, torque, frequency and damping must not be negative, and its lower limit not above its "
             "upper one.");
}

}  // namespace jet::box2d
