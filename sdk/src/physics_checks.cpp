// The ranges of the physics contract, for all engines alike.
#include <jet/physics_checks.hpp>
#include <jet/result.hpp>
#include <jet/value.hpp>

#include <algorithm>
#include <array>
#include <span>

namespace jet {

namespace {

constexpr int kMostThreads = 64, kMostSubsteps = 4096;
constexpr double kMostFlow = 0.95;
constexpr double kLeastAxis = 1e-12;

std::string named(std::string_view kind, std::size_t handle)
{
    return std::string(kind) + " " + std::to_string(handle);
}

std::string nameOf(JointHandle handle, const JointDef& def)
{
    constexpr std::array<const char*, 9> kNames = {"revolute", "prismatic", "weld",  "distance", "rope",
                                                   "wheel",    "motor",     "mouse", "pulley"};
    const auto kind = static_cast<std::size_t>(def.kind);
    return named("joint", handle) + (kind < kNames.size() ? std::string(" (") + kNames[kind] + ")" : std::string());
}

// Of a polygon's extent: what is nearer counts as one place, and so deep may a corner lie that rounding pushed in.
constexpr double kSamePlace = 1e-9, kRounding = 1e-6;

// Units. Squares of what is smaller are lost, and with them moments of inertia and directions.
constexpr double kLeastSize = 1e-12;

/// All at one place is allowed: it has no size.
template <class Points>
double sizeOf(const Points& lists)
{
    Box bounds;
    for (const auto& list : lists)
        for (const Vec2& at : list) bounds.extend(at);
    return bounds.isNull() ? 0 : bounds.size().maxCoeff();
}

/// Why a polygon is none that an engine can take; empty: it is one.
std::string faultOf(const std::vector<Vec2>& polygon)
{
    Box bounds;
    for (const Vec2& at : polygon) bounds.extend(at);
    const double extent = bounds.size().maxCoeff();
    double twiceArea = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twiceArea += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    if (!(extent >= kLeastSize && std::abs(twiceArea) > kSamePlace * extent * extent))
        return "encloses no area; draw one that does";
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t next = (i + 1) % polygon.size();
        const Vec2 side = polygon[next] - polygon[i];
        const double length = side.norm();
        if (!(length > kSamePlace * extent))
            return "has its points " + std::to_string(i) + " and " + std::to_string(next) +
                   " at one place; leave one of them out";
        for (const Vec2& at : polygon)
            if (cross(side, at - polygon[i]) * (twiceArea > 0 ? 1 : -1) < -kRounding * extent * length)
                return "is not convex; give such an outline as borders";
    }
    return {};
}

bool sameMeeting(const MaterialPair& p, const MaterialPair& q)
{
    return p.friction == q.friction && p.restitution == q.restitution && p.collides == q.collides;
}

}  // namespace

void PhysicsChecks::fail(const std::string& sentence) const { throw Failure(Error(engine_ + ": " + sentence)); }

void PhysicsChecks::refuse(std::string_view item, std::string_view field, double value, const std::string& range) const
{
    const std::string is = std::isfinite(value) ? numberText(value)
                           : std::isnan(value)  ? "not a number"
                           : value > 0          ? "infinite"
                                                : "minus infinite";
    fail(std::string(item) + ": " + std::string(field) + " is " + is + "; it must be " + range + ".");
}

void PhysicsChecks::number(std::string_view item, std::string_view field, double value) const
{
    if (std::abs(value) <= reach_.largest) return;
    refuse(item, field, value, "a number from -" + numberText(reach_.largest) + " to " + numberText(reach_.largest));
}

void PhysicsChecks::number(std::string_view item, std::string_view field, const Vec2& value) const
{
    if (std::abs(value.x()) <= reach_.largest && std::abs(value.y()) <= reach_.largest) return;
    number(item, std::string(field) + "'s x", value.x());
    number(item, std::string(field) + "'s y", value.y());
}

void PhysicsChecks::atLeast(std::string_view item, std::string_view field, double value, double least) const
{
    number(item, field, value);
    if (value < least) refuse(item, field, value, numberText(least) + " or more");
}

void PhysicsChecks::above(std::string_view item, std::string_view field, double value, double limit) const
{
    number(item, field, value);
    if (!(value > limit)) refuse(item, field, value, "above " + numberText(limit));
}

void PhysicsChecks::within(std::string_view item, std::string_view field, double value, double least, double most) const
{
    if (!(value >= least && value <= most))
        refuse(item, field, value, "from " + numberText(least) + " to " + numberText(most));
}

void PhysicsChecks::place(std::string_view item, std::string_view field, const Vec2& at) const
{
    if (std::abs(at.x()) <= reach_.farthest && std::abs(at.y()) <= reach_.farthest) return;
    const std::string range =
        "within " + numberText(reach_.farthest) + " units of the origin, where the engine can compute";
    if (!(std::abs(at.x()) <= reach_.farthest)) refuse(item, std::string(field) + "'s x", at.x(), range);
    if (!(std::abs(at.y()) <= reach_.farthest)) refuse(item, std::string(field) + "'s y", at.y(), range);
}

void PhysicsChecks::index(std::string_view what, std::size_t index, std::size_t count) const
{
    if (index >= count)
        fail(std::string(what) + " " + std::to_string(index) + " does not exist; there are " + std::to_string(count) +
             ".");
}

void PhysicsChecks::spring(std::string_view item, double ks, double kd, double tearRatio) const
{
    atLeast(item, "stiffness ks", ks, 0);
    atLeast(item, "damping kd", kd, 0);
    atLeast(item, "tear ratio", tearRatio, 0);
}

void PhysicsChecks::check(const WorldSettings& settings) const
{
    number("the world", "gravity", settings.gravity);
    atLeast("the world", "linear damping", settings.linearDamping, 0);
    atLeast("the world", "angular damping", settings.angularDamping, 0);
    within("the world", "the number of threads", settings.threads, 1, kMostThreads);
    within("the world", "the number of substeps", settings.substeps, 0, kMostSubsteps);
    if (settings.precision > Precision::Single || settings.simd > Simd::Avx512 ||
        settings.method > Method::SemiImplicitEuler)
        fail("the world: its precision, instructions or method is none that there is.");
    const std::size_t count = settings.materialCount;
    if (count == 0 || settings.materials.size() != count * count)
        fail("the materials table has " + std::to_string(settings.materials.size()) + " entries; " +
             std::to_string(count) + " materials need " + std::to_string(count * count) +
             ", and there is at least one.");
    const auto meeting = [&](std::size_t a, std::size_t b) -> const MaterialPair& {
        return settings.materials[a * count + b];
    };
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b < count; ++b) {
            const std::string item = "materials " + std::to_string(a) + " and " + std::to_string(b);
            atLeast(item, "friction", meeting(a, b).friction, 0);
            within(item, "restitution", meeting(a, b).restitution, 0, 1);
            if (!sameMeeting(meeting(a, b), meeting(b, a)))
                fail(item + " meet differently in the two places of the table; give both the same.");
        }
    }
}

void PhysicsChecks::check(BodyHandle handle, const BodyCommon& common, std::uint32_t materialCount) const
{
    const std::string item = named("body", handle);
    index(item + ": material", common.material, materialCount);
    number(item, "initial velocity", common.velocity);
    number(item, "initial turning rate", common.omega);
    number(item, "gravity scale", common.gravityScale);
    number(item, "one-sided direction", common.oneSided);
}

void PhysicsChecks::checkMass(BodyHandle handle, double mass) const
{
    above(named("body", handle), "mass", mass, 0);
    atLeast(named("body", handle), "mass", mass, 1 / reach_.largest);  // engines divide by it
}

void PhysicsChecks::check(BodyHandle handle, const RigidBodyDef& def, std::uint32_t materialCount) const
{
    check(handle, def.common, materialCount);
    checkMass(handle, def.mass);
    const std::string item = named("body", handle);
    for (const auto& border : def.borders)
        for (const Vec2& at : border) place(item, "a point of its border", at);
    if (const double size = sizeOf(def.borders); size > 0) atLeast(item, "its size", size, kLeastSize);
    for (const ShapeDef& shape : def.shapes) check(item, shape, def.common.fixed);
}

void PhysicsChecks::check(BodyHandle handle, const SoftBodyDef& def, std::uint32_t materialCount) const
{
    check(handle, def.common, materialCount);
    check(handle, def.matter);
    const std::string item = named("body", handle);
    const std::size_t count = def.particles.size();
    if (def.masses.size() != count || (!def.movable.empty() && def.movable.size() != count))
        fail(item + ": its " + std::to_string(count) +
             " particles need as many masses, and as many movable flags or none.");
    for (std::size_t i = 0; i < count; ++i) {
        place(item, "particle " + std::to_string(i) + "'s position", def.particles[i]);
        const std::string mass = "particle " + std::to_string(i) + "'s mass";
        above(item, mass, def.masses[i], 0);
        atLeast(item, mass, def.masses[i], 1 / reach_.largest);
    }
    if (const double size = sizeOf(std::span(&def.particles, 1)); size > 0) atLeast(item, "its size", size, kLeastSize);
    for (const auto& border : def.borders)
        for (const std::uint32_t at : border) index(item + ": a border's particle", at, count);
    for (std::size_t i = 0; i < def.springs.size(); ++i) {
        const SpringDef& one = def.springs[i];
        const std::string own = item + ", spring " + std::to_string(i);
        index(own + ": particle", std::max(one.a, one.b), count);
        atLeast(own, "rest length", one.restLength, 0);
        spring(own, one.ks, one.kd, one.tearRatio);
    }
    for (std::size_t i = 0; i < def.angularSprings.size(); ++i) {
        const AngularSpringDef& angular = def.angularSprings[i];
        const std::string own = item + ", angular spring " + std::to_string(i);
        index(own + ": particle", std::max({angular.a, angular.centre, angular.b}), count);
        number(own, "rest angle", angular.restAngle);
        spring(own, angular.ks, angular.kd);
    }
}

void PhysicsChecks::check(BodyHandle handle, const SoftMatter& matter) const
{
    const std::string item = named("body", handle);
    atLeast(item, "thickness", matter.thickness, 0);
    atLeast(item, "pressure", matter.pressure, 0);
    atLeast(item, "area stiffness", matter.areaStiffness, 0);
    atLeast(item, "shape stiffness", matter.shapeStiffness, 0);
    atLeast(item, "shape damping", matter.shapeDamping, 0);
    atLeast(item, "yield", matter.yield, 0);
    atLeast(item, "creep", matter.creep, 0);
    within(item, "the most that springs may flow", matter.mostFlow, 0, kMostFlow);
}

void PhysicsChecks::check(std::string_view item, const ShapeDef& shape, bool fixed) const
{
    for (const Vec2& at : shape.points) place(item, "a point of its shape", at);
    const std::size_t count = shape.points.size();
    const auto points = [&](const std::string& wanted) {
        fail(std::string(item) + ": " + wanted + ", not " + std::to_string(count) + ".");
    };
    number(item, "the radius of its shape", shape.radius);
    switch (shape.kind) {
    case ShapeDef::Kind::Polygon:
        if (count < 3 || count > 8) points("a polygon has 3 to 8 points (other outlines are given as borders)");
        if (const std::string fault = faultOf(shape.points); !fault.empty())
            fail(std::string(item) + ": a polygon of its shape " + fault + ".");
        return;
    case ShapeDef::Kind::Chain:
        if (!fixed)
            fail(
                std::string(item) +
                ": a chain has no inside, so only a fixed body may have one; draw a closed border for one that moves.");
        if (count < 2) points("a chain has 2 points or more");
        if (!(sizeOf(std::span(&shape.points, 1)) >= kLeastSize))
            fail(std::string(item) +
                 ": the points of its chain are all at one place; a chain needs two different ones.");
        return;
    case ShapeDef::Kind::Circle:
    case ShapeDef::Kind::Capsule:
        if (count != (shape.kind == ShapeDef::Kind::Circle ? 1U : 2U)) points("a circle has one point, a capsule two");
        above(item, "the radius of its shape", shape.radius, 0);
        atLeast(item, "the radius of its shape", shape.radius, kLeastSize);
        if (count == 2 && !((shape.points[1] - shape.points[0]).norm() > kSamePlace * shape.radius))
            fail(std::string(item) + ": both points of its capsule are at one place; use a circle instead.");
        return;
    }
    fail(std::string(item) + ": its kind of shape is none that there is.");
}

void PhysicsChecks::check(std::string_view item, const Anchor& anchor, std::size_t bodyCount) const
{
    if (anchor.body != kNoHandle) index(std::string(item) + ": its body", anchor.body, bodyCount);
    place(item, "its anchor", anchor.point);
    atLeast(item, "its anchor's radius", anchor.radius, 0);
}

void PhysicsChecks::check(ActuatorHandle handle, const ForceFieldDef& def) const
{
    const std::string item = named("force field", handle);
    if (def.kind > ForceFieldDef::Kind::Buoyancy) fail(item + ": its kind is none that there is.");
    number(item, "vector", def.vector);
    place(item, "centre", def.centre);
    number(item, "strength", def.strength);
    if (def.kind == ForceFieldDef::Kind::Drag) atLeast(item, "strength of drag", def.strength, 0);
    atLeast(item, "reach", def.reach, 0);
    atLeast(item, "drag", def.drag, 0);
    for (const auto& ring : def.region)
        for (const Vec2& at : ring) place(item, "a point of its region", at);
}

void PhysicsChecks::check(ActuatorHandle handle, const SpringActuatorDef& def, std::size_t bodyCount) const
{
    const std::string item = named("spring", handle);
    for (const Anchor* anchor : {&def.a, &def.b}) check(item, *anchor, bodyCount);
    number(item, "rest length", def.restLength);
    spring(item, def.ks, def.kd, def.tearRatio);
}

void PhysicsChecks::check(ActuatorHandle handle, const AngularSpringActuatorDef& def, std::size_t bodyCount) const
{
    const std::string item = named("angular spring", handle);
    for (const Anchor* anchor : {&def.a, &def.centre, &def.b}) check(item, *anchor, bodyCount);
    number(item, "rest angle", def.restAngle);
    spring(item, def.ks, def.kd);
}

void PhysicsChecks::check(JointHandle handle, const JointDef& def) const
{
    const std::string item = nameOf(handle, def);
    if (def.kind > JointDef::Kind::Pulley) fail(item + ": its kind is none that there is.");
    number(item, "axis", def.axis);
    const bool slides = def.kind == JointDef::Kind::Prismatic || def.kind == JointDef::Kind::Wheel;
    if (slides && !(def.axis.norm() > kLeastAxis))
        fail(item + ": its axis is (0, 0); give it a direction to slide in.");
    number(item, "lower limit", def.lower);
    number(item, "upper limit", def.upper);
    if (def.lower > def.upper)
        refuse(item, "lower limit", def.lower, "no greater than the upper one, which is " + numberText(def.upper));
    number(item, "motor speed", def.motorSpeed);
    number(item, "motor velocity", def.motorVelocity);
    atLeast(item, "maximal force", def.maxForce, 0);
    atLeast(item, "maximal torque", def.maxTorque, 0);
    atLeast(item, "frequency", def.hertz, 0);
    atLeast(item, "damping ratio", def.dampingRatio, 0);
    number(item, "length", def.length);
    number(item, "ratio", def.ratio);
    if (def.kind == JointDef::Kind::Pulley) above(item, "ratio", def.ratio, 0);
    place(item, "its first wheel", def.groundA);
    place(item, "its second wheel", def.groundB);
    atLeast(item, "breaking force", def.breakForce, 0);
}

void PhysicsChecks::checkAnchors(JointHandle handle, const JointDef& def, std::size_t bodyCount) const
{
    const std::string item = nameOf(handle, def);
    for (const Anchor* anchor : {&def.a, &def.b}) check(item, *anchor, bodyCount);
    if (def.a.body == def.b.body)
        fail(item +
             (def.a.body == kNoHandle ? ": both its ends are in the background"
                                      : ": both its ends are on body " + std::to_string(def.a.body)) +
             "; a joint needs two different bodies, or one and the background.");
}

}  // namespace jet
