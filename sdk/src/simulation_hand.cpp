// The hand that drags bodies about while a scene plays: a mouse joint between the body and the background.
//
// Its spring is that of a point mass as heavy as the body, so that everything follows the hand alike, and its force is
// limited by the body's weight: it lifts what lies in a heap or hangs on others, and what is stuck it does not crush.
// With less than 2 zeta v / w for braking, v² / 2 a, a body overshoots a hand that stops: at 2,000 units/s that takes
// 17,600 units/s². A soft body is held by a region: drawn by a part of it, what trails behind is folded (decision
// 0092).
#include "scene_state.hpp"
#include "simulation_state.hpp"

#include <jet/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace jet {

namespace {

constexpr double kHertz = 5, kDampingRatio = 0.9;
constexpr double kWeights = 200;        // that it lifts
constexpr double kLeastGravity = 98.1;  // units / s²: a hand has that strength where nothing weighs anything, too
constexpr double kRegion = 1;           // of the side of a square as large as a soft body: how far it is held

/// At least the nearest one is held.
double regionOf(std::span<const Vec2> particles, const Vec2& point, double area)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec2& particle : particles) nearest = std::min(nearest, (particle - point).norm());
    return std::max(kRegion * std::sqrt(std::abs(area)), nearest * (1 + 1e-9));
}

}  // namespace

bool Simulation::Private::mayDrag(const BodyBinding& binding) const
{
    if (binding.fixed) return false;
    const Item& body = *scene->items().find(binding.item);
    if (body.properties().get("kinematic", builtInItemType(BodyItem::type)->properties()).as<bool>()) return false;
    for (const Item* item = &body; item; item = item->parent())
        if (!item->visible()) return false;
    return true;
}

const BodyBinding* Simulation::Private::bodyAt(const Vec2& point) const
{
    const BodyBinding* top = nullptr;
    scene->root().walk([&](const Item& item) {  // what comes later is drawn over it
        const std::size_t i = bindingOf(item.id());
        if (i < bodies.size() && mayDrag(bodies[i]) && world->contains(bodies[i].body, point)) top = &bodies[i];
    });
    return top;
}

/// By the outline that is drawn; `at`: the place on it.
const BodyBinding* Simulation::Private::bodyNear(const Simulation& self, const Vec2& point, double reach,
                                                 Vec2& at) const
{
    const BodyBinding* nearest = nullptr;
    for (const BodyBinding& binding : bodies) {
        const Box& bounds = world->bodies().bounds[binding.body];
        if (!(reach > 0) || bounds.isNull() || !mayDrag(binding)) continue;
        if (!Box(bounds.min - Vec2(reach, reach), bounds.max + Vec2(reach, reach)).contains(point)) continue;
        const Path* path = self.pose(*scene->items().find(binding.item));
        const PathPosition position = path ? path->nearest(point) : PathPosition{0, 0, 0, {0, 0}, 2 * reach};
        if (!(position.distance <= reach)) continue;
        reach = position.distance, at = position.point, nearest = &binding;
    }
    return nearest;
}

JointDef Simulation::Private::pullOn(const BodyBinding& binding, double area, const Vec2& at, const Vec2& place) const
{
    JointDef def;
    def.kind = JointDef::Kind::Mouse;
    def.a.point = place;
    def.b = {binding.body, at};
    def.hertz = kHertz, def.dampingRatio = kDampingRatio;
    const double gravity = scene->setting("gravity").as<Vec2>().norm();
    def.maxForce = kWeights * std::max(gravity, kLeastGravity) * binding.mass;
    if (!binding.soft) return def;
    const BodyStates states = world->bodies();
    const std::uint32_t first = states.firstPoint[binding.body], last = states.firstPoint[binding.body + 1];
    const std::span<const Vec2> particles = states.points.subspan(first, last - first);
    if (particles.empty()) return def;
    def.b.radius = regionOf(particles, at, area);
    // The joint's frequency is that of the region alone, which has the rest of the body to carry.
    const auto held = std::count_if(particles.begin(), particles.end(),
                                    [&](const Vec2& p) { return (p - at).norm() <= def.b.radius; });
    const double carried = std::sqrt(static_cast<double>(particles.size()) / static_cast<double>(held));
    def.hertz *= carried, def.dampingRatio *= carried;
    return def;
}

ItemId Simulation::grab(const Vec2& point, double reach)
{
    letGo();
    if (!isFinite(point)) return {};
    Vec2 at = point;
    const BodyBinding* body = d_->bodyAt(point);
    if (!body) body = d_->bodyNear(*this, point, reach, at);
    if (!body) return {};
    const Path* outline = pose(*d_->scene->items().find(body->item));
    try {
        const JointDef pull = d_->pullOn(*body, outline ? outline->area() : 0, at, point);
        d_->hand = Hand{body->item, d_->world->addJoint(pull), point};
    } catch (const Failure& failure) {
        if (!std::exchange(d_->handless, true))
            print({OutputLine::Kind::Warning, std::string("bodies cannot be dragged: ") + failure.what(), {}, 0});
        return {};
    }
    return body->item;
}

void Simulation::drag(const Vec2& to)
{
    if (!d_->hand || !isFinite(to)) return;
    try {
        d_->world->setJointTarget(d_->hand->joint, to);
        d_->hand->place = to;
    } catch (const Failure&) {  // it went with the body, or it is beyond all places
        letGo();
    }
}

void Simulation::letGo()
{
    if (!d_->hand) return;
    const JointHandle joint = std::exchange(d_->hand, std::nullopt)->joint;
    try {
        d_->world->removeJoint(joint);
    } catch (const Failure&) {  // it went with the body
    }
}

std::optional<HeldBody> Simulation::held() const
{
    if (!d_->hand) return std::nullopt;
    try {
        return HeldBody{d_->hand->item, d_->world->joint(d_->hand->joint).pointB, d_->hand->place};
    } catch (const Failure&) {  // it went with the body
        return std::nullopt;
    }
}

}  // namespace jet
