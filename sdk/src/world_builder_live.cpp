// What a body becomes when a property of the effect that builds it changes while playing.
#include "world_builder.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace jet {

namespace {

[[noreturn]] void refuseShape()
{
    throw Failure(Error("it decides what the body is made of, and that is made when play starts"));
}

bool isLike(const ShapeDef& a, const ShapeDef& b)
{
    return a.kind == b.kind && a.points == b.points && a.radius == b.radius;
}

bool joinsAlike(const SpringDef& a, const SpringDef& b)
{
    return a.a == b.a && a.b == b.b && a.restLength == b.restLength;
}

bool isLike(const AngularSpringDef& a, const AngularSpringDef& b)
{
    const auto parts = [](const AngularSpringDef& s) { return std::tie(s.a, s.centre, s.b, s.restAngle, s.ks, s.kd); };
    return parts(a) == parts(b);
}

auto strengthOf(const SpringDef& spring) { return std::tie(spring.ks, spring.kd, spring.tearRatio); }

bool isLike(const SoftMatter& a, const SoftMatter& b)
{
    const auto parts = [](const SoftMatter& m) {
        return std::tie(m.thickness, m.pressure, m.areaStiffness, m.shapeStiffness, m.shapeDamping, m.yield, m.creep,
                        m.mostFlow, m.selfCollision);
    };
    return parts(a) == parts(b);
}

template <class T, class Like>
bool areLike(const std::vector<T>& a, const std::vector<T>& b, Like&& like)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), like);
}

/// May only all become heavier or lighter alike?
bool inProportion(const std::vector<double>& before, const std::vector<double>& after)
{
    for (std::size_t i = 0; i < before.size(); ++i)
        if (std::abs(after[i] * before[0] - before[i] * after[0]) > 1e-9 * before[i] * after[0]) return false;
    return true;
}

void change(BodyHandle body, const RigidBodyDef& before, const RigidBodyDef& after, PhysicsWorld& world)
{
    if (before.borders != after.borders ||
        !areLike(before.shapes, after.shapes, [](const auto& a, const auto& b) { return isLike(a, b); }))
        refuseShape();
    if (before.mass != after.mass) world.setMass(body, after.mass);
}

void change(BodyHandle body, const SoftBodyDef& before, const SoftBodyDef& after, PhysicsWorld& world)
{
    const auto angularAlike = [](const AngularSpringDef& a, const AngularSpringDef& b) { return isLike(a, b); };
    if (before.particles != after.particles || before.movable != after.movable || before.borders != after.borders ||
        !areLike(before.springs, after.springs, joinsAlike) ||
        !areLike(before.angularSprings, after.angularSprings, angularAlike) ||
        !inProportion(before.masses, after.masses))
        refuseShape();
    const auto strongAlike = [](const SpringDef& a, const SpringDef& b) { return strengthOf(a) == strengthOf(b); };
    if (!areLike(before.springs, after.springs, strongAlike)) {
        const SpringDef& first = after.springs.front();
        for (const SpringDef& spring : after.springs)
            if (!strongAlike(first, spring)) refuseShape();
        world.setSprings(body, first.ks, first.kd, first.tearRatio);
    }
    if (!isLike(before.matter, after.matter)) world.setSoftMatter(body, after.matter);
    if (before.masses != after.masses)
        world.setMass(body, std::accumulate(after.masses.begin(), after.masses.end(), 0.0));
}

}  // namespace

void changeDefinition(BodyHandle body, const BodyDef& before, const BodyDef& after, PhysicsWorld& world)
{
    if (before.index() != after.index()) refuseShape();
    if (const auto* rigid = std::get_if<RigidBodyDef>(&before)) {
        change(body, *rigid, std::get<RigidBodyDef>(after), world);
    } else {
        change(body, std::get<SoftBodyDef>(before), std::get<SoftBodyDef>(after), world);
    }
}

}  // namespace jet
