#include "reports.hpp"

#include "told.hpp"

#include <algorithm>

namespace jet::physics {

namespace {

std::uint64_t pairOf(BodyHandle a, BodyHandle b)
{
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}
BodyHandle lower(std::uint64_t pair) { return static_cast<BodyHandle>(pair >> 32); }
BodyHandle higher(std::uint64_t pair) { return static_cast<BodyHandle>(pair & 0xffffffffU); }

/// Are its events told by comparing? Else the rigid stage has them.
bool isCompared(const State& state, std::uint64_t pair)
{
    return !state.bodies[lower(pair)].simple || !state.bodies[higher(pair)].simple;
}

}  // namespace

bool Reports::touch(BodyHandle a, BodyHandle b) const
{
    return std::binary_search(touching_.begin(), touching_.end(), pairOf(a, b));
}

void Reports::begin()
{
    due_ = false;
    contacts_.clear();
    touching_.clear();
}

/// What pushed in this step is told, and what lies on or in a wall without pushing (sensors; collisions not resolved).
void Reports::add(const State& state, const ContactPoint& c)
{
    const Points& points = state.points;
    const Vec2& first = points.position[state.walls.first[c.wall]];
    const Vec2 edge = points.position[state.walls.second[c.wall]] - first;
    const double squared = edge.squaredNorm();
    if (!(squared > 0)) return;
    const Vec2& at = points.position[c.point];
    Vec2 normal = perpendicular(edge) * (state.walls.outward[c.wall] / std::sqrt(squared));
    double separation = (at - first).dot(normal);
    const double along = (at - first).dot(edge) / squared;
    const double distance = (at - first).norm();
    const bool round = c.thickness > 0 && along < 0 && separation > 0 && distance > 0 && !c.inside;
    if (round) normal = (at - first) / distance, separation = distance;
    const bool onWall = (c.inside || round || (along >= 0 && along <= 1)) && separation <= c.slop + c.thickness &&
                        (c.inside || c.engaged || separation >= -kTouchDepth * c.slop);
    if (!(c.stepImpulse > 0) && !onWall) return;
    contacts_.push_back({c.bodyA, c.bodyB, c.point - state.bodies[c.bodyA].points.first,
                         state.walls.first[c.wall] - state.bodies[c.bodyB].points.first, at,
                         std::clamp(along, 0.0, 1.0), normal, c.thickness - separation, c.stepImpulse});
    if (c.bodyA != c.bodyB) touching_.push_back(pairOf(c.bodyA, c.bodyB));
}

void Reports::addRigid(const RigidStage& rigid, const Outlines& outlines)
{
    const std::size_t others = contacts_.size();
    rigid.report(contacts_, touching_);
    for (std::size_t i = others; i < contacts_.size(); ++i) outlines.nameFeatures(contacts_[i]);
}

void Reports::finish()
{
    // A place or a direction that is none cannot be told otherwise; that the bodies touch is, all the same.
    std::erase_if(contacts_, [](const Contact& c) { return !isFinite(c.point) || !isFinite(c.normal); });
    for (Contact& c : contacts_)
        c.edgeParameter = told(c.edgeParameter), c.penetration = told(c.penetration), c.impulse = told(c.impulse);
    std::sort(touching_.begin(), touching_.end());
    touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
}

/// What touched until now.
void Reports::remember(const State& state, bool anyComplex)
{
    eventsTold_ = false;
    if (!watched_) return;
    touchedBefore_ = touching_;
    // The last body that is not simple may have been removed: then the step tells the end of its touches.
    const auto compared = [&](std::uint64_t pair) { return isCompared(state, pair); };
    watched_ = anyComplex || std::any_of(touching_.begin(), touching_.end(), compared);
}

std::span<const ContactEvent> Reports::events(const State& state, std::span<const ContactEvent> ofSimple)
{
    watched_ = true;
    if (!eventsTold_) tellEvents(state, ofSimple);
    return events_;
}

void Reports::tellEvents(const State& state, std::span<const ContactEvent> ofSimple)
{
    eventsTold_ = true;
    events_.assign(ofSimple.begin(), ofSimple.end());
    const auto counts = [&](std::uint64_t pair) { return isCompared(state, pair); };
    auto before = touchedBefore_.begin();
    for (const std::uint64_t pair : touching_) {
        for (; before != touchedBefore_.end() && *before < pair; ++before)
            if (counts(*before)) events_.push_back({lower(*before), higher(*before), false, 0});
        const bool known = before != touchedBefore_.end() && *before == pair;
        if (known) ++before;
        if (!known && counts(pair)) events_.push_back({lower(pair), higher(pair), true, impulseBetween(pair)});
    }
    for (; before != touchedBefore_.end(); ++before)
        if (counts(*before)) events_.push_back({lower(*before), higher(*before), false, 0});
    // Each of both is in ascending order.
    std::inplace_merge(events_.begin(), events_.begin() + static_cast<std::ptrdiff_t>(ofSimple.size()), events_.end(),
                       [](const ContactEvent& a, const ContactEvent& b) {
                           return std::pair(a.bodyA, a.bodyB) < std::pair(b.bodyA, b.bodyB);
                       });
}

double Reports::impulseBetween(std::uint64_t pair) const
{
    double impulse = 0;
    for (const Contact& contact : contacts_)
        if (pairOf(contact.bodyA, contact.bodyB) == pair) impulse += contact.impulse;
    return impulse;
}

void Reports::forget(BodyHandle body)
{
    const auto has = [body](const auto& contact) { return contact.bodyA == body || contact.bodyB == body; };
    std::erase_if(ended_, has);
    std::erase_if(contacts_, has);
}

void Reports::restored()
{
    due_ = eventsTold_ = false;
    touchedBefore_ = touching_;
}

}  // namespace jet::physics
