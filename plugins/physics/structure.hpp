// What a world is made of, as one number and a few counts: only the state of a world that is made of the same can be
// restored into it. Whatever can change while a world runs does not count, and pulls (pulls.hpp) come and go.
#pragma once

#include <jet/physics.hpp>

#include <cstring>

namespace jet::physics {

class Structure {
public:
    struct Tag {
        std::uint64_t hash = 0xcbf29ce484222325ULL;
        std::uint32_t bodies = 0, joints = 0, actuators = 0, unused = 0;

        bool operator==(const Tag&) const = default;
    };
    const Tag& tag() const { return tag_; }

    void add(const RigidBodyDef& def)
    {
        ++tag_.bodies;
        take(1U, static_cast<std::uint32_t>(def.common.fixed));
        for (const auto& ring : def.borders) takeAll(ring);
        for (const ShapeDef& shape : def.shapes) {
            take(static_cast<std::uint32_t>(shape.kind), 2U);
            takeAll(shape.points);
            takeNumber(shape.radius);
        }
    }
    void add(const SoftBodyDef& def)
    {
        ++tag_.bodies;
        take(3U, static_cast<std::uint32_t>(def.common.fixed));
        takeAll(def.particles);
        for (const auto& border : def.borders) {
            take(4U, static_cast<std::uint32_t>(border.size()));
            for (const std::uint32_t particle : border) take(particle, 0);
        }
        for (const SpringDef& spring : def.springs) take(spring.a, spring.b), takeNumber(spring.restLength);
        for (const AngularSpringDef& spring : def.angularSprings)
            take(spring.a, spring.b), take(spring.centre, 5U), takeNumber(spring.restAngle);
    }
    /// One that is no pull. Between pulls it may have another handle, or another place among its like.
    void add(const JointDef& def, std::uint32_t handle, std::uint32_t place)
    {
        ++tag_.joints;
        take(6U, static_cast<std::uint32_t>(def.kind)), take(handle, place);
        takeAnchors({&def.a, &def.b});
    }
    void add(const SpringActuatorDef& def) { addActuator(7U, {&def.a, &def.b}); }
    void add(const AngularSpringActuatorDef& def) { addActuator(8U, {&def.a, &def.centre, &def.b}); }
    void add(const TorqueActuatorDef& def) { addActuator(9U, {&def.at}); }
    void add(const ForceActuatorDef& def) { addActuator(10U, {&def.at}); }
    void add(const ForceFieldDef& def) { addActuator(11U + static_cast<std::uint32_t>(def.kind), {}); }

    void removeBody(std::uint32_t body) { --tag_.bodies, take(20U, body); }
    void removeActuator(std::uint32_t kind, std::uint32_t handle) { --tag_.actuators, take(21U + kind, handle); }

private:
    void mix(std::uint64_t word)
    {
        tag_.hash = (tag_.hash ^ word) * 0x100000001b3ULL;
        tag_.hash ^= tag_.hash >> 32;
    }
    void take(std::uint32_t a, std::uint32_t b) { mix(static_cast<std::uint64_t>(a) << 32 | b); }
    void takeNumber(double value)
    {
        std::uint64_t word = 0;
        std::memcpy(&word, &value, sizeof word);
        mix(word);
    }
    void takeAll(const std::vector<Vec2>& points)
    {
        mix(points.size());
        for (const Vec2& at : points) takeNumber(at.x()), takeNumber(at.y());
    }
    void takeAnchors(std::initializer_list<const Anchor*> anchors)
    {
        for (const Anchor* anchor : anchors) {
            take(anchor->body, 0);
            takeNumber(anchor->point.x()), takeNumber(anchor->point.y()), takeNumber(anchor->radius);
        }
    }
    void addActuator(std::uint32_t kind, std::initializer_list<const Anchor*> anchors)
    {
        ++tag_.actuators;
        take(kind, 0);
        takeAnchors(anchors);
    }

    Tag tag_;
};

}  // namespace jet::physics
