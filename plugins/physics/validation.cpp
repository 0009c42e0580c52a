#include "validation.hpp"

namespace jet::physics {

namespace {

// Beyond these, squares and products leave the range of double.
constexpr double kFarthest = 1e12, kLargest = 1e30;

constexpr int kMostThreads = 64, kMostSubsteps = 4096;

[[noreturn]] void fail(std::string message) { throw Failure(Error("Physics: " + std::move(message))); }

void requireCount(std::string_view what, int count, int least, int most)
{
    if (count < least || count > most)
        fail("the number of " + std::string(what) + " is " + std::to_string(count) + ", not " + std::to_string(least) +
             " to " + std::to_string(most) + ".");
}

}  // namespace

void requireFinite(std::string_view what, const Vec2& v) { requireFinite(what, {v.x(), v.y()}); }

void requirePlace(std::string_view what, const Vec2& at)
{
    if (!(at.cwiseAbs().maxCoeff() <= kFarthest) || !isFinite(at))
        fail(std::string(what) + " is not a place in the scene; give it two ordinary numbers.");
}

void requireFinite(std::string_view what, std::initializer_list<double> values)
{
    for (double value : values)
        if (!(std::abs(value) <= kLargest))
            fail(std::string(what) + " is not a finite number of sensible size; give it an ordinary one.");
}

void requireBelow(std::string_view what, std::size_t index, std::size_t count)
{
    if (index >= count)
        fail(std::string(what) + " " + std::to_string(index) + " does not exist; there are " + std::to_string(count) +
             ".");
}

void requireSpring(std::string_view what, double restLength, double ks, double kd, double tearRatio)
{
    requireFinite(what, {restLength, ks, kd, tearRatio});
    if (ks < 0 || kd < 0)
        fail(std::string(what) + ": stiffness and damping must not be negative, or it would gain energy.");
    if (tearRatio < 0) fail(std::string(what) + ": its tear ratio must not be negative; 0 never tears.");
}

void validate(const WorldSettings& settings)
{
    requireFinite("gravity", settings.gravity);
    requireFinite("the world's damping", {settings.linearDamping, settings.angularDamping});
    requireCount("threads", settings.threads, 1, kMostThreads);
    requireCount("substeps", settings.substeps, 0, kMostSubsteps);
    if (settings.linearDamping < 0 || settings.angularDamping < 0) fail("the world's damping must not be negative.");
    const std::size_t wanted = static_cast<std::size_t>(settings.materialCount) * settings.materialCount;
    if (settings.materialCount == 0 || settings.materials.size() != wanted)
        fail("the materials table has " + std::to_string(settings.materials.size()) + " entries; " +
             std::to_string(settings.materialCount) + " materials need " + std::to_string(wanted) + ".");
    for (const MaterialPair& pair : settings.materials) {
        requireFinite("a material's friction or restitution", {pair.friction, pair.restitution});
        if (pair.friction < 0 || pair.restitution < 0)
            fail("a material's friction and restitution must not be negative.");
        if (pair.restitution > 1) fail("a material's restitution must not be above 1, or hits would give energy.");
    }
    const auto same = [](const MaterialPair& p, const MaterialPair& q) {
        return p.friction == q.friction && p.restitution == q.restitution && p.collides == q.collides;
    };
    const auto pairOf = [&](std::size_t a, std::size_t b) -> const MaterialPair& {
        return settings.materials[a * settings.materialCount + b];
    };
    for (std::size_t a = 0; a < settings.materialCount; ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (!same(pairOf(a, b), pairOf(b, a)))
                fail("the materials " + std::to_string(b) + " and " + std::to_string(a) +
                     " meet differently in the two places of the table; give both the same.");
}

void validate(const BodyCommon& common, const WorldSettings& settings)
{
    requireBelow("material", common.material, settings.materialCount);
    requireFinite("a body's initial velocity", common.velocity);
    requireFinite("a body's initial turning rate or gravity scale", {common.omega, common.gravityScale});
    requireFinite("a body's one-sided direction", common.oneSided);
}

void validate(const SoftBodyDef& def, const WorldSettings& settings)
{
    validate(def.common, settings);
    const std::size_t count = def.particles.size();
    if (def.masses.size() != count || (!def.movable.empty() && def.movable.size() != count))
        fail("a soft body of " + std::to_string(count) +
             " particles needs as many masses, and as many movable flags or none.");
    validate(def.matter);
    for (const Vec2& at : def.particles) requirePlace("a particle's position", at);
    for (double mass : def.masses) {
        requireFinite("a particle's mass", {mass});
        if (!(mass > 0)) fail("a particle's mass must be greater than 0.");
    }
    for (const auto& border : def.borders)
        for (std::uint32_t index : border) requireBelow("a border's particle", index, count);
    for (const SpringDef& spring : def.springs) {
        requireBelow("a spring's particle", std::max(spring.a, spring.b), count);
        if (spring.restLength < 0) fail("a spring's rest length must not be negative.");
        requireSpring("a spring", spring.restLength, spring.ks, spring.kd, spring.tearRatio);
    }
    for (const AngularSpringDef& spring : def.angularSprings) {
        requireBelow("an angular spring's particle", std::max({spring.a, spring.centre, spring.b}), count);
        requireSpring("an angular spring", spring.restAngle, spring.ks, spring.kd, 0);
    }
}

void validate(const SoftMatter& matter)
{
    requireFinite(
        "a soft body's thickness, pressure, area stiffness, yield, creep or flow",
        {matter.thickness, matter.pressure, matter.areaStiffness, matter.yield, matter.creep, matter.mostFlow});
    if (matter.thickness < 0 || matter.pressure < 0 || matter.areaStiffness < 0 || matter.yield < 0 || matter.creep < 0)
        fail("a soft body's thickness, pressure, area stiffness, yield and creep must not be negative.");
    if (matter.mostFlow < 0 || matter.mostFlow > 0.95)
        fail("the springs of a soft body may flow by 0 to 0.95 of their length.");
}

void validate(const ForceFieldDef& def)
{
    requireFinite("a field's vector", def.vector);
    requirePlace("a field's centre", def.centre);
    requireFinite("a field's strength, reach or drag", {def.strength, def.reach, def.drag});
    if (def.drag < 0 || (def.kind == ForceFieldDef::Kind::Drag && def.strength < 0))
        fail("a field's drag must not be negative, or it would give energy without end.");
    if (def.reach < 0) fail("a field's reach must not be negative; 0 is everywhere the same.");
    for (const auto& ring : def.region)
        for (const Vec2& at : ring) requirePlace("a point of a field's region", at);
}

void validate(const RigidBodyDef& def, const WorldSettings& settings)
{
    validate(def.common, settings);
    requireFinite("a rigid body's mass", {def.mass});
    if (!(def.mass > 0)) fail("a rigid body's mass must be greater than 0.");
    for (const auto& border : def.borders)
        for (const Vec2& at : border) requirePlace("a rigid body's border point", at);
    for (const ShapeDef& shape : def.shapes) {
        validate(shape);
        if (shape.kind == ShapeDef::Kind::Chain && !def.common.fixed)
            fail("a chain has no inside, so only a fixed body may have one; draw a closed border for one that moves.");
    }
}

void validate(const ShapeDef& shape)
{
    for (const Vec2& at : shape.points) requirePlace("a shape's point", at);
    requireFinite("a shape's radius", {shape.radius});
    if (shape.kind == ShapeDef::Kind::Polygon) {
        if (shape.points.size() < 3 || shape.points.size() > 8)
            fail("a polygon shape has 3 to 8 points, not " + std::to_string(shape.points.size()) +
                 "; give other outlines as borders.");
        return;
    }
    if (shape.kind == ShapeDef::Kind::Chain) {
        if (shape.points.size() < 2) fail("a chain shape has 2 points or more.");
        return;
    }
    const std::size_t wanted = shape.kind == ShapeDef::Kind::Circle ? 1 : 2;
    if (shape.points.size() != wanted) fail("a circle shape has one point, a capsule two.");
    if (!(shape.radius > 0)) fail("a shape's radius must be greater than 0.");
}

void validate(const Anchor& anchor, std::size_t bodyCount)
{
    if (anchor.body != kNoHandle) requireBelow("an anchor's body", anchor.body, bodyCount);
    requirePlace("an anchor's point", anchor.point);
    requireFinite("an anchor's radius", {anchor.radius});
    if (anchor.radius < 0) fail("an anchor's radius must not be negative.");
}

void validateJoint(const JointDef& def)
{
    requireFinite("a joint's limits and motor", {def.lower, def.upper, def.motorSpeed, def.maxForce, def.maxTorque,
                                                 def.hertz, def.dampingRatio, def.length, def.ratio, def.breakForce});
    requireFinite("a joint's axis", def.axis);
    requireFinite("a joint's motor velocity", def.motorVelocity);
    requirePlace("a pulley's wheel", def.groundA);
    requirePlace("a pulley's wheel", def.groundB);
    if (def.maxForce < 0 || def.maxTorque < 0 || def.hertz < 0 || def.dampingRatio < 0 || def.lower > def.upper)
        throw Failure(Error("Physics: a joint's force, torque, frequency and damping must not be negative, and its "
                            "lower limit not above its upper one."));
    if (def.breakForce < 0) fail("a joint's breaking force must not be negative; 0 never breaks.");
    if (def.kind == JointDef::Kind::Pulley && !(def.ratio > 0)) fail("a pulley's ratio must be greater than 0.");
}

}  // namespace jet::physics
