#include "world.hpp"

#include "border.hpp"
#include "outline.hpp"
#include "room.hpp"
#include "validation.hpp"

#include <numeric>

namespace jet::physics {

World::World(const WorldSettings& settings) : settings_(settings)
{
    checks().check(settings);
    if (settings.method == Method::SemiImplicitEuler) settings_.substeps = 1;
    const bool avx2 = settings.simd != Simd::Sse2 && soft::hasAvx2();
    springs_.use(soft::kernelsFor(settings.simd));
    const soft::CloudKernels& clouds = avx2 ? soft::avx2::clouds : soft::sse2::clouds;
    shapes_.use(clouds), twins_.use(clouds), finder_.use(clouds);
    state_.clouds = &clouds;
    softContacts_.use(avx2 ? soft::avx2::contacts : soft::sse2::contacts);
    queries_.use(rigid_);
    rigid_.onWaking([this] { spreadWaking(false); });
    keepMark();
    pairsOf_ = tableMark_;
}

BodyRecord& World::newBody(const BodyCommon& common, bool rigid)
{
    BodyRecord body;
    body.rigid = rigid;
    body.fixed = common.fixed;
    body.sensor = common.sensor;
    body.material = common.material;
    body.gravityScale = common.gravityScale;
    body.drives = body.kinematic = common.kinematic && !common.fixed;
    body.fixedRotation = common.fixedRotation;
    body.layer = common.layer;
    state_.setFilter(static_cast<Index>(state_.bodies.size()), Filter::of(common));
    body.nodes.first = static_cast<Index>(state_.nodes.size());
    body.points.first = static_cast<Index>(state_.points.size());
    body.walls.first = static_cast<Index>(state_.walls.size());
    makeRoom(1, state_.bodies);
    return state_.bodies.emplace_back(std::move(body));
}

/// A body comes that is met by points and walls.
void World::keepNormals()
{
    if (!state_.points.normal.empty()) return;
    state_.points.normal.assign(state_.points.size(), Vec2(0, 0));
    for (const BodyRecord& body : state_.bodies) updateCorners(state_, body);
}

namespace {

bool isSingle(const RigidBodyDef& def) { return def.borders.empty() && def.shapes.size() == 1 && !def.common.fixed; }

/// Closed rings for what collides by points and walls: the borders, or those of the parts.
std::vector<std::vector<Vec2>> outlinesOf(const RigidBodyDef& def)
{
    std::vector<std::vector<Vec2>> rings = def.borders;
    for (const ShapeDef& shape : def.shapes) rings.push_back(outlineOf(shape));
    return rings;
}

Drawing takenApart(BodyHandle handle, const RigidBodyDef& def)
{
    try {
        return RigidStage::takeApart(def);
    } catch (const Failure& failure) {
        checks().fail(named("body", handle) + ": its outline " + failure.error().message);
    }
}

/// The side of a square as large as the region; for bodies without area, a part of their extent.
double typicalLength(const Region& region, const Box& bounds)
{
    if (region.area > 0) return std::sqrt(region.area);
    const double extent = bounds.isNull() ? 0 : bounds.size().maxCoeff();
    return extent > 0 ? 0.1 * extent : 1;
}

}  // namespace

BodyHandle World::addSoftBody(const SoftBodyDef& def)
{
    checks().check(static_cast<BodyHandle>(state_.bodies.size()), def, settings_.materialCount);
    outlineAll();
    BodyRecord& body = newBody(def.common, false);
    body.soft = std::make_unique<SoftRecord>();
    SoftRecord& soft = *body.soft;
    const auto count = static_cast<Index>(def.particles.size());
    body.nodes.count = body.points.count = count;
    Nodes& nodes = state_.nodes;
    makeRoom(count, nodes.position, nodes.velocity, nodes.mass, nodes.invMass);
    Points& points = state_.points;
    makeRoom(count, points.node, points.position, points.collidable);
    if (!points.normal.empty()) makeRoom(count, points.normal);
    // Points keep the order of the definition; nodes take one that suits the springs.
    const std::vector<Index> particleOf = soft::orderOf(def);
    std::vector<Index> nodeOf(count);
    for (Index k = 0; k < count; ++k) {
        const Index i = particleOf[k];
        const bool moves = !def.common.fixed && (def.movable.empty() || def.movable[i] != 0);
        state_.nodes.addParticle(def.particles[i], def.masses[i], moves ? 1 / def.masses[i] : 0);
        nodeOf[i] = body.nodes.first + k;
    }
    for (Index i = 0; i < count; ++i) addPoint(state_, body, nodeOf[i], Vec2(0, 0), def.particles[i]);
    soft.inOrder = std::is_sorted(nodeOf.begin(), nodeOf.end());
    soft.mass = std::accumulate(def.masses.begin(), def.masses.end(), 0.0);
    Vec2 centre(0, 0);
    for (Index i = 0; i < count; ++i) centre += def.masses[i] / soft.mass * def.particles[i];
    soft.restArms.reserve(count);
    for (Index i : particleOf) {
        soft.restArms.push_back(def.particles[i] - centre);
        soft.restGyrationSquared += def.masses[i] / soft.mass * soft.restArms.back().squaredNorm();
    }

    std::vector<std::vector<Index>> rings = def.borders;
    for (auto& ring : rings)
        for (Index& index : ring) index += body.points.first;
    keepNormals();
    addBorders(state_, body, rings);
    Box bounds;
    for (const Vec2& at : def.particles) bounds.extend(at);
    const Region region = measureRegion(state_, body);
    body.length = typicalLength(region, bounds);
    soft.restArea = region.area;
    soft.matter = def.matter;
    soft.watch.mayRest = soft.watch.drawnMayRest = def.common.allowSleep;
    softMovers_ += !body.fixed;
    body.wide = soft::fitsContacts(state_, body);

    soft.springs = {springs_.springCount(), static_cast<Index>(def.springs.size())};
    soft.angularSprings = {springs_.angularCount(), static_cast<Index>(def.angularSprings.size())};
    const Index firstNode = body.nodes.first;
    const BodyHandle handle = settleIn(buildOf(static_cast<BodyHandle>(state_.bodies.size() - 1)));
    BodyRecord& settled = state_.bodies[handle];
    for (Index& node : nodeOf) node -= firstNode - settled.nodes.first;
    springs_.add(state_, def, handle, nodeOf);
    shapes_.add(state_, def, handle, nodeOf);
    queries_.addSoft(handle);
    structure_.add(def);
    if (settled.kinematic) holdSoft(settled, false);  // its springs know it as it is when it is not
    return finishBody(handle, def.common);
}

BodyHandle World::addRigidBody(const RigidBodyDef& def)
{
    const auto next = static_cast<BodyHandle>(state_.bodies.size());
    checks().check(next, def, settings_.materialCount);
    const Drawing drawing = takenApart(next, def);  // may refuse: nothing is changed before
    BodyRecord& body = newBody(def.common, true);
    body.nodes.count = 1;
    Nodes& nodes = state_.nodes;
    makeRoom(1, nodes.position, nodes.velocity, nodes.mass, nodes.invMass);
    nodes.addRigid(def.mass);
    body.single = isSingle(def);
    const std::vector<std::vector<Vec2>> outlines = outlinesOf(def);
    if (!outlines_.lean() || !body.single)
        outlines_.add(body, outlines, def.shapes.empty() ? Inside::OddRings : Inside::AnyRing);
    const BodyHandle handle = setRigidMass(def, outlines, drawing);
    BodyRecord& settled = state_.bodies[handle];
    if (settled.simple) {
        settled.grid.reset();
    } else {
        outlineAll();
        rebuildGrid(state_, settled);
        keepNormals();
    }
    queries_.addRigid(state_, handle, def);
    structure_.add(def);
    return finishBody(handle, def.common);
}

/// Puts the node of the newest body at the centre of mass and makes the points local to it. Borders without area count
/// as equal masses at their points, so that a degenerate drawing still has a finite centre and moment of inertia.
BodyHandle World::setRigidMass(const RigidBodyDef& def, const std::vector<std::vector<Vec2>>& outlines,
                               const Drawing& drawing)
{
    BodyRecord& body = state_.bodies.back();
    const Region region = def.shapes.empty() ? measureRegion(state_, body) : measureShapes(def.shapes);
    double points = 0;
    for (const auto& outline : outlines) points += static_cast<double>(outline.size());
    Box bounds;
    Vec2 centre(0, 0);
    for (const auto& outline : outlines)
        for (const Vec2& at : outline) bounds.extend(at), centre += at / points;
    body.length = typicalLength(region, bounds);
    double second = region.inertia;
    if (region.area > 0) centre = region.centroid;
    for (const auto& outline : outlines) {
        for (const Vec2& at : outline) {
            const Vec2 local = at - centre;
            body.radius = std::max(body.radius, static_cast<float>(local.norm()));
            if (!(region.area > 0)) second += local.squaredNorm() / points;
        }
    }
    if (!(second > 1e-12 * body.length * body.length)) second = body.length * body.length / 6;
    for (Index p = body.points.first; p < body.points.end(); ++p) state_.points.local.edit(p) -= centre;

    state_.nodes.position[body.nodes.first] = centre;
    const double gyration = std::sqrt(second);
    const std::vector<DrawnPart> parts = RigidStage::partsOf(def, drawing, centre, body.length);
    body.simple = !parts.empty();
    Build build = buildOf(static_cast<BodyHandle>(state_.bodies.size() - 1));
    build.parts = static_cast<Index>(parts.size());
    if (body.isLean()) build.points = build.walls = ringSizeOf(parts.front().part);
    const BodyHandle handle = settleIn(build);
    if (!parts.empty()) {
        rigid_.add(state_, handle, def, parts, gyration);
    } else {
        gyrations_.cover(handle + std::size_t{1}), gyrations_.edit(handle) = gyration;
    }
    applyMotion(handle);
    return handle;
}

/// What its node is for the solvers, from what the rigid body is.
void World::applyMotion(BodyHandle handle)
{
    BodyRecord& body = state_.bodies[handle];
    const Index node = body.nodes.first;
    const bool moves = !body.fixed && !body.drives && body.enabled;
    body.kinematic = body.drives && body.enabled;
    const double mass = state_.nodes.mass[node];
    state_.nodes.invMass[node] = moves ? 1 / mass : 0;
    const double gyration = body.simple ? rigid_.gyrationOf(handle) : gyrations_[handle];
    state_.nodes.invInertia.edit(node) = moves && !body.fixedRotation ? 1 / (mass * gyration * gyration) : 0;
}

void World::outlineAll()
{
    if (outlines_.addAll()) stale_ = true;
}

void World::extendReadings()
{
    BodyReadings& readings = state_.readings;
    makeRoom(state_.bodies.size() - readings.bounds.size(), readings.position, readings.velocity, readings.angle,
             readings.omega, readings.bounds, readings.firstPoint);
    for (std::size_t handle = readings.bounds.size(); handle < state_.bodies.size(); ++handle) {
        readings.position.push_back(Vec2(0, 0));
        readings.velocity.push_back(Vec2(0, 0));
        readings.angle.push_back(0);
        readings.omega.push_back(0);
        readings.bounds.push_back(Box());
        readings.firstPoint.push_back(state_.bodies[handle].points.end());
    }
}

BodyHandle World::finishBody(BodyHandle handle, const BodyCommon& common)
{
    complex_ += !state_.bodies[handle].simple;
    if (!outlines_.lean()) extendReadings(), state_.readings.angle[handle] = 0;
    rate_ = -1;
    islandsKnown_ = false;
    reread(handle);
    setVelocity(handle, common.velocity);
    setOmega(handle, common.omega);
    if (common.fixed || common.kinematic) stir(handle);
    return handle;
}

ActuatorHandle World::addSpring(const SpringActuatorDef& def)
{
    checks().check(actuators_.springCount(), def, bodyCount());
    requireBodies({&def.a, &def.b});
    wakeHeld(def.a), wakeHeld(def.b);
    rate_ = -1;
    structure_.add(def);
    return actuators_.add(state_, def);
}

ActuatorHandle World::addAngularSpring(const AngularSpringActuatorDef& def)
{
    checks().check(actuators_.angularSpringCount(), def, bodyCount());
    requireBodies({&def.a, &def.centre, &def.b});
    wakeHeld(def.a), wakeHeld(def.centre), wakeHeld(def.b);
    rate_ = -1;
    structure_.add(def);
    return actuators_.add(state_, def);
}

ActuatorHandle World::addTorque(const TorqueActuatorDef& def)
{
    const std::string item = named("torque", actuators_.torqueCount());
    checks().check(item, def.at, bodyCount());
    checks().number(item, "value", def.value);
    requireBodies({&def.at});
    wakeHeld(def.at);
    structure_.add(def);
    return actuators_.add(state_, def);
}

ActuatorHandle World::addForceField(const ForceFieldDef& def)
{
    checks().check(fields_.count(), def);
    wakeAll();
    const ActuatorHandle field = fields_.add(def);  // may refuse its region
    structure_.add(def);
    return field;
}

ActuatorHandle World::addForce(const ForceActuatorDef& def)
{
    const std::string item = named("force", actuators_.forceCount());
    checks().check(item, def.at, bodyCount());
    checks().number(item, "value", def.force);
    requireBodies({&def.at});
    wakeHeld(def.at);
    structure_.add(def);
    return actuators_.add(state_, def);
}

}  // namespace jet::physics
