// Steps of simple rigid bodies alone, joints, and queries.
#include "integrator.hpp"
#include "outline.hpp"
#include "validation.hpp"
#include "world.hpp"

namespace jet::physics {

bool World::onlySimple() const { return complex_ == 0 && !rigid_.empty() && !actuators_.anySpring(); }

void World::stepSimple(double dt)
{
    state_.nodes.force = stepForces_;
    std::fill(state_.nodes.torque.begin(), state_.nodes.torque.end(), 0.0);
    if (actuators_.any()) actuators_.addForces(state_);
    if (fields_.count() > 0) fields_.addForces(state_, settings_.applyGravity ? settings_.gravity : Vec2(0, 0), dt);
    rigid_.step(state_, settings_, dt, stats_);
    limitVelocities(state_);
    std::fill(stepForces_.begin(), stepForces_.end(), Vec2(0, 0));
    std::fill(state_.nodes.force.begin(), state_.nodes.force.end(), Vec2(0, 0));
    std::fill(state_.nodes.torque.begin(), state_.nodes.torque.end(), 0.0);
    contacts_.points.clear();
    stale_ = untold_ = true;
}

void World::moveKinematic(double h)
{
    Nodes& nodes = state_.nodes;
    for (const BodyRecord& body : state_.bodies) {
        if (!body.kinematic) continue;
        const Index node = body.nodes.first;
        nodes.position[node] += h * nodes.velocity[node];
        nodes.angle[node] += h * nodes.omega[node];
        nodes.rotation[node] = direction(nodes.angle[node]);
    }
}

void World::refresh() const
{
    if (!stale_) return;
    auto& self = const_cast<World&>(*this);  // caches of what the nodes say
    self.stale_ = false;
    updatePoints(self.state_);
    updateReadings(self.state_);
}

void World::reportIfAsked() const
{
    if (!untold_) return;
    refresh();
    auto& self = const_cast<World&>(*this);
    self.untold_ = false;
    self.report();
}

void World::nameFeatures(Contact& contact) const
{
    const BodyRecord &a = state_.bodies[contact.bodyA], &b = state_.bodies[contact.bodyB];
    double nearest = std::numeric_limits<double>::infinity();
    for (Index p = a.points.first; p < a.points.end(); ++p) {
        const double away = (state_.points.position[p] - contact.point).squaredNorm();
        if (away < nearest) nearest = away, contact.particle = p - a.points.first;
    }
    // Where a corner touches, the corner is the point; its place is known more exactly.
    if (nearest < 1e-4 * a.length * a.length) contact.point = state_.points.position[a.points.first + contact.particle];
    nearest = std::numeric_limits<double>::infinity();
    for (Index w = b.walls.first; w < b.walls.end(); ++w) {
        const Vec2& first = state_.points.position[state_.walls.first[w]];
        const Vec2 edge = state_.points.position[state_.walls.second[w]] - first, off = contact.point - first;
        const double squared = edge.squaredNorm();
        if (!(squared > 0)) continue;
        const double along = std::clamp(off.dot(edge) / squared, 0.0, 1.0), away = (off - along * edge).squaredNorm();
        if (away >= nearest) continue;
        nearest = away;
        contact.wall = state_.walls.first[w] - b.points.first;
        contact.edgeParameter = along;
        const Vec2 outward = perpendicular(edge) * (state_.walls.outward[w] / std::sqrt(squared));
        contact.penetration = outward.dot(contact.normal) > 0.999 ? -off.dot(outward) : contact.penetration;
    }
}

std::span<const Contact> World::contacts() const
{
    reportIfAsked();
    return reports_;
}

StepStats World::stats() const
{
    reportIfAsked();
    return stats_;
}

JointHandle World::addJoint(const JointDef& def)
{
    bool soft = false;
    for (const Anchor* anchor : {&def.a, &def.b}) {
        validate(*anchor, bodyCount());
        soft |= anchor->body != kNoHandle && !state_.bodies[anchor->body].rigid;
    }
    for (const Anchor* anchor : {&def.a, &def.b})
        if (anchor->body != kNoHandle && !soft && !rigid_.has(anchor->body))
            throw Failure(Error("Physics: body " + std::to_string(anchor->body) +
                                " has no simple rigid shape; joints hold those, soft bodies and the background. Give "
                                "it shapes, or use a spring between bodies."));
    if (def.a.body == def.b.body) throw Failure(Error("Physics: a joint needs two different bodies."));
    requireFinite("a joint's limits and motor", {def.lower, def.upper, def.motorSpeed, def.maxForce, def.maxTorque,
                                                 def.hertz, def.dampingRatio, def.length, def.ratio, def.breakForce});
    requireFinite("a joint's axis", def.axis);
    requireFinite("a joint's motor velocity", def.motorVelocity);
    requirePlace("a pulley's wheel", def.groundA);
    requirePlace("a pulley's wheel", def.groundB);
    if (def.maxForce < 0 || def.maxTorque < 0 || def.hertz < 0 || def.dampingRatio < 0 || def.lower > def.upper)
        throw Failure(Error("Physics: a joint's force, torque, frequency and damping must not be negative, and its "
                            "lower limit not above its upper one."));
    jointsAt_.push_back({soft, soft ? softJoints_.add(state_, def) : rigid_.addJoint(state_, def)});
    if (soft) finder_.exclude(softJoints_.excluded());
    return static_cast<JointHandle>(jointsAt_.size() - 1);
}

World::JointAt World::jointAt(JointHandle handle) const
{
    requireBelow("joint", handle, jointsAt_.size());
    return jointsAt_[handle];
}

JointState World::joint(JointHandle handle) const
{
    const JointAt at = jointAt(handle);
    if (at.soft) return softJoints_.state(state_, at.index);
    handle = at.index;
    const Joint& joint = rigid_.joint(handle);
    const JointFrame frame = frameOf(joint, state_, rigid_.collider().bodies());
    JointState state = joint.state;
    state.broken = joint.broken;
    state.pointA = frame.pointA;
    state.pointB = frame.pointB;
    const Vec2 apart = frame.pointB - frame.pointA;
    switch (joint.def.kind) {
    case JointDef::Kind::Prismatic:
    case JointDef::Kind::Wheel: state.value = apart.dot(frame.axis); break;
    case JointDef::Kind::Distance:
    case JointDef::Kind::Rope:
    case JointDef::Kind::Mouse: state.value = apart.norm(); break;
    default: state.value = frame.angle;
    }
    return state;
}

void World::setMotor(JointHandle handle, bool driven, double speed)
{
    const JointAt at = jointAt(handle);
    handle = at.index;
    requireFinite("a motor's speed", {speed});
    if (at.soft) return softJoints_.setMotor(at.index, driven, speed);
    rigid_.joint(handle).def.driven = driven;
    rigid_.joint(handle).def.motorSpeed = speed;
}

void World::setJointTarget(JointHandle handle, const Vec2& target)
{
    const JointAt at = jointAt(handle);
    handle = at.index;
    requirePlace("a joint's target", target);
    if (at.soft && softJoints_.setTarget(at.index, target)) return;
    if (at.soft) throw Failure(Error("Physics: only a joint with the background has a target."));
    Joint& joint = rigid_.joint(handle);
    if (joint.a == 0)
        joint.localA = target;
    else if (joint.b == 0)
        joint.localB = target;
    else
        throw Failure(Error("Physics: only a joint with the background has a target."));
}

void World::removeJoint(JointHandle handle)
{
    const JointAt at = jointAt(handle);
    if (at.soft) {
        softJoints_.remove(at.index);
        finder_.exclude(softJoints_.excluded());
        return;
    }
    handle = at.index;
    rigid_.removeJoint(handle);
}

/// Calls visit(body, first, second) for each side of each body whose box meets the region.
template <class Visit>
void World::eachEdge(const QueryFilter& filter, const Box& region, Visit&& visit) const
{
    refresh();
    for (Index handle = 0; handle < state_.bodies.size(); ++handle) {
        const BodyRecord& body = state_.bodies[handle];
        if (handle == filter.except || (body.layer & filter.mask) == 0 || (body.sensor && !filter.sensors)) continue;
        if (!state_.readings.bounds[handle].intersects(region)) continue;
        for (Index w = body.walls.first; w < body.walls.end(); ++w)
            visit(handle, state_.points.position[state_.walls.first[w]], state_.points.position[state_.walls.second[w]],
                  state_.walls.outward[w]);
    }
}

std::optional<CastHit> World::rayCast(const Vec2& from, const Vec2& to, const QueryFilter& filter) const
{
    requirePlace("a ray's start", from);
    requirePlace("a ray's end", to);
    std::optional<CastHit> best;
    const Vec2 way = to - from;
    eachEdge(filter, Box(from, to), [&](BodyHandle body, const Vec2& first, const Vec2& second, int outward) {
        const Vec2 edge = second - first;
        const double across = cross(way, edge);
        if (across == 0) return;
        const double at = cross(first - from, edge) / across, along = cross(first - from, way) / across;
        if (at < 0 || at > 1 || along < 0 || along > 1 || (best && best->fraction <= at)) return;
        const Vec2 normal = perpendicular(edge).normalized() * (outward < 0 ? -1 : 1);
        if (normal.dot(way) > 0) return;  // from within
        best = CastHit{body, from + at * way, normal, at};
    });
    return best;
}

std::vector<BodyHandle> World::overlapping(const Box& box, const QueryFilter& filter) const
{
    std::vector<BodyHandle> found;
    eachEdge(filter, box, [&](BodyHandle body, const Vec2& first, const Vec2& second, int) {
        if (!found.empty() && found.back() == body) return;
        // Clips the side to the box (Liang-Barsky).
        double enter = 0, leave = 1;
        const Vec2 way = second - first;
        for (int axis = 0; axis < 2; ++axis) {
            if (way[axis] == 0) {
                if (first[axis] < box.min[axis] || first[axis] > box.max[axis]) return;
                continue;
            }
            const double a = (box.min[axis] - first[axis]) / way[axis], b = (box.max[axis] - first[axis]) / way[axis];
            enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
        }
        if (enter <= leave) found.push_back(body);
    });
    for (Index handle = 0; handle < state_.bodies.size(); ++handle) {
        const BodyRecord& body = state_.bodies[handle];
        if (handle == filter.except || (body.layer & filter.mask) == 0 || (body.sensor && !filter.sensors)) continue;
        if (state_.readings.bounds[handle].intersects(box) && contains(handle, box.center())) found.push_back(handle);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

std::optional<CastHit> World::nearest(const Vec2& point, double reach, const QueryFilter& filter) const
{
    requirePlace("a query's point", point);
    requireFinite("a query's reach", {reach});
    std::optional<CastHit> best;
    const Vec2 span(reach, reach);
    eachEdge(filter, Box(point - span, point + span),
             [&](BodyHandle body, const Vec2& first, const Vec2& second, int outward) {
                 const Vec2 edge = second - first;
                 const double squared = edge.squaredNorm();
                 const double along = squared > 0 ? std::clamp((point - first).dot(edge) / squared, 0.0, 1.0) : 0;
                 const Vec2 at = first + along * edge;
                 const double fraction = reach > 0 ? (point - at).norm() / reach : 0;
                 if (fraction > 1 || (best && best->fraction <= fraction)) return;
                 best =
                     CastHit{body, at,
                             squared > 0 ? Vec2(perpendicular(edge).normalized() * (outward < 0 ? -1 : 1)) : Vec2(0, 0),
                             fraction};
             });
    return best;
}

}  // namespace jet::physics
