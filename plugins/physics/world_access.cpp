// Reading the world and acting on it between steps; its snapshots.
#include "snapshot.hpp"
#include "soft/mass_sums.hpp"
#include "validation.hpp"
#include "world.hpp"

namespace jet::physics {

BodyStates World::bodies() const
{
    if (outlines_.lean()) return outlines_.tell();
    refresh();
    const BodyReadings& readings = state_.readings;
    return {readings.position, readings.angle,      readings.velocity,     readings.omega,
            readings.bounds,   readings.firstPoint, state_.points.position};
}

bool World::touching(BodyHandle a, BodyHandle b) const
{
    reportIfAsked();
    if (!hasBody(a) || !hasBody(b)) return false;
    return reports_.touch(a, b);
}

std::span<const ContactEvent> World::contactEvents() const
{
    if (complex_ == 0 && !reports_.watched()) return rigid_.events();
    reportIfAsked();
    return reports_.events(state_, rigid_.events());
}

void World::setTorque(ActuatorHandle torque, double value)
{
    requireActuator(ActuatorKind::Torque, torque);
    checks().number(named("torque", torque), "value", value);
    const Index body = actuators_.bodyOfTorque(torque);
    if (body != kNone && actuators_.torque(torque) != value) wakeUp(body);
    actuators_.setTorque(torque, value);
}

void World::setForce(ActuatorHandle force, const Vec2& value)
{
    requireActuator(ActuatorKind::Force, force);
    checks().number(named("force", force), "value", value);
    const Index body = actuators_.bodyOfForce(force);
    if (body != kNone && actuators_.force(force) != value) wakeUp(body);
    actuators_.setForce(force, value);
}

void World::applyForce(BodyHandle handle, const Vec2& force)
{
    requireBody(handle);
    checks().number(named("body", handle), "force", force);
    const BodyRecord& body = state_.bodies[handle];
    if (force == Vec2(0, 0)) return;
    pushed_ = true;
    stepForces_.cover(state_.nodes.size());
    wakeUp(handle);
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
        stepForces_.add(n, state_.nodes.mass[n] / state_.massOf(body) * force);
}

void World::applyImpulse(BodyHandle handle, const Vec2& impulse)
{
    requireBody(handle);
    checks().number(named("body", handle), "impulse", impulse);
    refresh();
    const BodyRecord& body = state_.bodies[handle];
    if (impulse != Vec2(0, 0)) wakeUp(handle);
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
        if (state_.nodes.invMass[n] > 0) state_.nodes.velocity[n] += impulse / state_.massOf(body);
    reread(handle);
}

void World::setVelocity(BodyHandle handle, const Vec2& velocity)
{
    requireBody(handle);
    checks().number(named("body", handle), "velocity", velocity);
    refresh();
    const BodyRecord& body = state_.bodies[handle];
    const Vec2 now = body.rigid ? state_.nodes.velocity[body.nodes.first] : soft::motionOf(state_, body).velocity;
    const Vec2 change = velocity - now;
    if (change != Vec2(0, 0)) rouse(handle);
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
        if (state_.nodes.invMass[n] > 0 || body.kinematic) state_.nodes.velocity[n] += change;
    reread(handle);
}

void World::setOmega(BodyHandle handle, double omega)
{
    requireBody(handle);
    checks().number(named("body", handle), "turning rate", omega);
    refresh();
    const BodyRecord& body = state_.bodies[handle];
    const soft::MassSums sums = body.rigid ? soft::MassSums() : soft::motionOf(state_, body);
    const double change = omega - (body.rigid ? state_.nodes.omega[body.nodes.first] : sums.omega());
    if (change != 0) rouse(handle);
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n) {
        if (state_.nodes.invMass[n] == 0 && !body.kinematic) continue;
        if (body.rigid) {
            state_.nodes.omega.edit(n) = omega;
        } else {
            state_.nodes.velocity[n] += change * perpendicular(state_.nodes.position[n] - sums.centre);
        }
    }
    reread(handle);
}

void World::setPosition(BodyHandle handle, const Vec2& centre)
{
    requireBody(handle);
    checks().place(named("body", handle), "position", centre);
    reportIfAsked();  // of where things were
    const BodyRecord& body = state_.bodies[handle];
    const Vec2 shift =
        centre - (body.rigid ? state_.nodes.position[body.nodes.first] : state_.readings.position[handle]);
    rigid_.disturb(handle);
    rouse(handle);
    softContacts_.carry(handle, shift.norm());
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n) state_.nodes.position[n] += shift;
    for (Index p = body.points.first; p < body.points.end(); ++p) state_.points.position[p] = state_.pointNow(p);
    reread(handle);
    queries_.outdate();
    if (body.rigid && state_.nodes.invMass[body.nodes.first] == 0) rigid_.rearrange();
}

void World::setGravity(const Vec2& gravity)
{
    checks().number("the world", "gravity", gravity);
    if (gravity != settings_.gravity) wakeAll();
    settings_.gravity = gravity;
}

bool World::springAlive(BodyHandle handle, std::uint32_t index) const
{
    requireBody(handle);
    const auto& soft = state_.bodies[handle].soft;
    const Range springs = soft ? soft->springs : Range();
    requireBelow("spring", index, springs.count);
    return springs_.alive(springs.first + index);
}

template <class Self, class Archive>
void World::archive(Self& self, Archive& with)
{
    auto& nodes = self.state_.nodes;
    with(nodes.position);
    with(nodes.velocity);
    with(nodes.angle.values());
    with(nodes.omega.values());
    with(nodes.rotation.values());
    with(nodes.mass), with(nodes.invMass), with(nodes.invInertia.values());
    self.rigid_.archive(with);
    if (!self.outlines_.lean()) with(self.state_.readings.angle);  // soft bodies: unwrapped from step to step
    self.springs_.archive(with);
    self.shapes_.archive(with);
    self.actuators_.archive(with);
    self.fields_.archive(with);
    for (Index handle = 0; handle < self.state_.bodies.size(); ++handle) {
        BodyRecord& body = self.state_.bodies[handle];
        with(body.material), with(body.gravityScale), with(body.layer);
        Filter filter = self.state_.filters[handle];
        with(filter.mask), with(filter.group), with(filter.sideX), with(filter.sideY);
        self.state_.setFilter(handle, filter);
        const auto flag = [&with](auto get, auto set) {
            std::uint8_t value = get();
            with(value);
            set(value != 0);
        };
        flag([&] { return body.asleep; }, [&](bool is) { body.asleep = is; });
        flag([&] { return body.sensor; }, [&](bool is) { body.sensor = is; });
        flag([&] { return body.enabled; }, [&](bool is) { body.enabled = is; });
        flag([&] { return body.kinematic; }, [&](bool is) { body.kinematic = is; });
        flag([&] { return body.drives; }, [&](bool is) { body.drives = is; });
        flag([&] { return body.fixedRotation; }, [&](bool is) { body.fixedRotation = is; });
        if (!body.soft) continue;
        with(body.soft->mass);
        SoftMatter& matter = body.soft->matter;
        with(matter.thickness), with(matter.pressure), with(matter.areaStiffness), with(matter.yield);
        with(matter.creep), with(matter.mostFlow), with(matter.selfCollision);
        with(matter.shapeStiffness), with(matter.shapeDamping), with(body.soft->twinTurn);
    }
    self.archivePins(with);
    self.slots_.archive(with);
    with.list(self.stepForces_.values(), [&](Vec2& force) { with(force); });
    with(self.settings_.gravity), with(self.impulsesOf_), with(self.pairsOf_);
    with.list(self.contacts_.points, [&](ContactPoint& c) {
        with(c.point), with(c.wall), with(c.bodyA), with(c.bodyB), with(c.active), with(c.engaged), with(c.along);
        with(c.normalImpulse), with(c.tangentImpulse), with(c.stepImpulse);
    });
    self.softContacts_.keep();
    self.softContacts_.archive(with);
    self.softJoints_.archive(with);
    self.accounts_.archive(with);
    self.tears_.archive(with, self.state_);
    self.reports_.archive(with);
    archiveSlumber(self, with);
    archivePulls(self, with);
}

/// Only where there is something to tell, or something follows.
template <class Self, class Archive>
void World::archiveSlumber(Self& self, Archive& with)
{
    if constexpr (std::is_same_v<Archive, RestoreArchive>) {
        if (with.finished()) return self.slumber_.makeFresh(self.state_);
    } else if (self.slumber_.isFresh(self.state_) && !self.anyPull()) {
        return;
    }
    self.slumber_.archive(with, self.state_);
    for (ContactPoint& c : self.contacts_.points) with(c.inside);  // where nothing is sought, as all rests
}

bool World::anyPull() const
{
    return std::any_of(jointsAt_.begin(), jointsAt_.end(), [](const JointAt& at) { return at.pull; });
}

/// Each is one of its stage's.
void World::requirePulls() const
{
    for (const JointAt& at : jointsAt_) {
        if (!at.pull) continue;
        const Index count = at.soft ? softJoints_.count() : rigid_.jointCount();
        if (at.index >= count || !isPull(at.soft ? softJoints_.def(at.index) : rigid_.joint(at.index).def))
            RestoreArchive::fail();
    }
}

/// Last, and only where there are any.
template <class Self, class Archive>
void World::archivePulls(Self& self, Archive& with)
{
    const auto isPull = [](const JointAt& at) { return at.pull; };
    if constexpr (std::is_same_v<Archive, RestoreArchive>) {
        if (with.finished()) {
            self.rigid_.dropPulls(), self.softJoints_.dropPulls();
            return dropPulls(self.jointsAt_, isPull);
        }
    } else if (!self.anyPull()) {
        return;
    }
    self.rigid_.archivePulls(with), self.softJoints_.archivePulls(with, self.state_);
    physics::archivePulls(with, self.jointsAt_, isPull, [&](JointAt& at) {
        at.pull = true;
        with(at.soft), with(at.index);
    });
    self.requirePulls();
}

namespace {

template <class T>
T readAt(std::span<const std::byte> bytes, std::size_t at)
{
    T value{};
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// The dynamic part of a saved state, if it is whole and of a world that is made like this.
std::span<const std::byte> opened(std::span<const std::byte> bytes, const Structure::Tag& made)
{
    if (bytes.size() < kStateHead + kStateSeal || readAt<std::uint64_t>(bytes, 0) != kStateMark)
        checks().fail(
            "these bytes are no saved state of this engine, or one of another version; restore what save() gave.");
    const auto tag = readAt<Structure::Tag>(bytes, sizeof kStateMark);
    if (!(tag == made)) {
        const auto counts = [](const Structure::Tag& of) {
            return std::to_string(of.bodies) + " bodies, " + std::to_string(of.joints) + " joints and " +
                   std::to_string(of.actuators) + " springs, torques, forces and fields";
        };
        const bool other = tag.bodies == made.bodies && tag.joints == made.joints && tag.actuators == made.actuators;
        checks().fail("the saved state is of a world made otherwise" +
                      (other ? ", of as many bodies of other shapes, or joined at other places"
                             : ": it has " + counts(tag) + ", this one " + counts(made)) +
                      "; restore it into the world that saved it, or one built from the same scene.");
    }
    const auto state = dynamicPart(bytes);
    if (hashOf(state) != readAt<std::uint64_t>(bytes, bytes.size() - kStateSeal))
        checks().fail("the saved state is damaged: its bytes are not as they were saved.");
    return state;
}

/// A seal tells of chance, not of what somebody made up.
bool moveInNumbers(const Nodes& nodes)
{
    const auto all = [](const auto& values, auto&& isNumber) {
        return std::all_of(values.begin(), values.end(), isNumber);
    };
    const auto number = [](double value) { return std::isfinite(value); };
    return all(nodes.position, isFinite) && all(nodes.velocity, isFinite) && all(nodes.angle.values(), number) &&
           all(nodes.omega.values(), number) && all(nodes.rotation.values(), isFinite);
}

}  // namespace

std::vector<std::byte> World::save() const
{
    refresh();
    reportIfAsked();
    auto& self = const_cast<World&>(*this);  // stages offer one list for both directions; saving only reads
    SaveArchive archiveOut(savedBytes_ + savedBytes_ / 16);
    archiveOut(kStateMark), archiveOut(structure_.tag());
    archive(self, archiveOut);
    archiveOut(std::uint64_t{0});
    std::vector<std::byte> state = archiveOut.take();
    seal(state);
    self.savedBytes_ = state.size();
    return state;
}

std::uint64_t World::hash() const
{
    const std::vector<std::byte> bytes = save();
    return readAt<std::uint64_t>(bytes, bytes.size() - kStateSeal);
}

void World::restore(std::span<const std::byte> bytes)
{
    const std::span<const std::byte> state = opened(bytes, structure_.tag());
    const std::vector<std::byte> before = save();
    const auto read = [this](std::span<const std::byte> from) {
        RestoreArchive archiveIn(from);
        archive(*this, archiveIn);
        if (!archiveIn.finished()) RestoreArchive::fail();
        for (const ContactPoint& c : contacts_.points)
            if (c.point >= state_.points.size() || c.wall >= state_.walls.size()) RestoreArchive::fail();
        if (!softContacts_.fits(state_) || !slumber_.fits(state_)) RestoreArchive::fail();
        if (!moveInNumbers(state_.nodes))
            checks().fail("the saved state is damaged: a place or a speed in it is no number.");
        softContacts_.restored();
        springs_.restored();
        fields_.restored();
        rate_ = -1;
        pushed_ = anyStepForce();
    };
    try {
        read(state);
    } catch (...) {
        read(opened(before, structure_.tag()));
        throw;
    }
    rigid_.rebuild();
    jointsRemoved_ = true;  // what was restored may have some
    finder_.exclude(softJoints_.excluded());
    queries_.outdate();
    rate_ = -1;
    stale_ = islandsKnown_ = false;
    reports_.restored();
    outlines_.forget();
    updatePoints(state_);
    if (!outlines_.lean()) updateReadings(state_);
}

}  // namespace jet::physics
