#include "carried_path.hpp"

#include <algorithm>

namespace jet {

namespace {

/// Holds its two bodies at one place, which a path of three points or more has in its middle.
bool hasPivot(const JointDef& joint)
{
    using Kind = JointDef::Kind;
    return joint.kind == Kind::Revolute || joint.kind == Kind::Prismatic || joint.kind == Kind::Weld ||
           joint.kind == Kind::Wheel;
}

void move(Segment& segment, const Affine& motion)
{
    segment.point = motion * segment.point;
    segment.in = motion * segment.in;
    segment.out = motion * segment.out;
}

/// A blend of two motions moves no distances truly, but meets both ends.
Affine between(const Affine& from, const Affine& to, double part)
{
    Affine both;
    both.matrix() = (1 - part) * from.matrix() + part * to.matrix();
    return both;
}

}  // namespace

std::optional<CarriedPath> CarriedPath::of(const Item& item, const ItemParts& parts,
                                           const std::vector<BodyBinding>& bodies)
{
    if (parts.anchors.empty() || parts.parts.empty() || item.path().isEmpty()) return std::nullopt;
    CarriedPath path;
    path.drawn_ = item.path();
    bool any = false;
    for (const Anchor& anchor : parts.anchors) {
        Carrier carrier;
        carrier.point = anchor.point;
        for (std::size_t i = 0; i < bodies.size() && !carrier.moves; ++i)
            if (bodies[i].body == anchor.body && !bodies[i].fixed) carrier.moves = true, carrier.binding = i;
        if (carrier.moves && bodies[carrier.binding].live) {
            const auto& particles = bodies[carrier.binding].live->particles;
            const auto nearer = [&](const Vec2& a, const Vec2& b) {
                return (a - anchor.point).squaredNorm() < (b - anchor.point).squaredNorm();
            };
            const auto nearest = std::min_element(particles.begin(), particles.end(), nearer);
            carrier.particle = static_cast<std::uint32_t>(nearest - particles.begin());
            carrier.rest = *nearest;
        }
        any |= carrier.moves;
        path.carriers_.push_back(carrier);
    }
    if (!any) return std::nullopt;
    for (const ItemPart& part : parts.parts) {
        if (const auto* joint = std::get_if<JointDef>(&part.def); joint && !path.joint_)
            path.joint_ = *joint, path.handle_ = part.handle;
        if (const auto* spring = std::get_if<SpringActuatorDef>(&part.def)) {
            const double rest =
                spring->restLength < 0 ? (spring->b.point - spring->a.point).norm() : spring->restLength;
            path.longest_ = rest * spring->tearRatio;
        }
    }
    return path;
}

Affine CarriedPath::motionOf(const Carrier& carrier, const BodyStates& states,
                             const std::vector<BodyBinding>& bodies) const
{
    if (!carrier.moves) return {};
    const BodyBinding& binding = bodies[carrier.binding];
    if (carrier.particle)
        return Affine::translation(states.points[states.firstPoint[binding.body] + *carrier.particle] - carrier.rest);
    return Affine::translation(states.position[binding.body]) * Affine::rotation(states.angle[binding.body]) *
           Affine::translation(-binding.restPosition);
}

/// The joint knows better than the bodies where it holds them.
void CarriedPath::follow(const JointDef& joint, const JointState& state)
{
    using Kind = JointDef::Kind;
    const std::size_t count = now_.segmentCount();
    if (hasPivot(joint)) {
        if (count > 2) now_.segment(count / 2) = Segment(state.pointA);
        return;
    }
    if (joint.kind == Kind::Motor) return;  // it holds no points
    if (joint.kind == Kind::Pulley && count > 3) {
        now_.segment(1) = drawn_.segment(1);
        now_.segment(count - 2) = drawn_.segment(count - 2);
    }
    for (const std::size_t end : {std::size_t{0}, count - 1}) {
        if (drawn_.segment(end).point == joint.a.point) now_.segment(end) = Segment(state.pointA);
        if (drawn_.segment(end).point == joint.b.point) now_.segment(end) = Segment(state.pointB);
    }
}

const Path& CarriedPath::at(const PhysicsWorld& world, const std::vector<BodyBinding>& bodies)
{
    std::optional<JointState> state;
    if (joint_) {
        try {
            state = world.joint(handle_);
        } catch (const Failure&) {  // taken out
        }
        if (!state || state->broken) return now_ = Path();
    }
    const BodyStates states = world.bodies();
    std::vector<Affine> motions;
    for (const Carrier& carrier : carriers_) motions.push_back(motionOf(carrier, states, bodies));
    now_ = drawn_;
    const std::size_t count = now_.segmentCount();
    for (std::size_t i = 0; i < count; ++i) {
        Segment& segment = now_.segment(i);
        const auto here = std::find_if(carriers_.begin(), carriers_.end(),
                                       [&](const Carrier& carrier) { return carrier.point == segment.point; });
        const double part = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0;
        move(segment, here != carriers_.end() ? motions[static_cast<std::size_t>(here - carriers_.begin())]
                                              : between(motions.front(), motions.back(), part));
    }
    if (state) follow(*joint_, *state);
    // Nobody tells whether it tore, but whole ones are not as long.
    if (longest_ > 0 && (now_.segment(0).point - now_.segment(count - 1).point).norm() > longest_) return now_ = Path();
    return now_;
}

}  // namespace jet
