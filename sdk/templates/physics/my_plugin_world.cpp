#include "my_plugin_world.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

jet::BodyHandle MyPluginWorld::add(const jet::BodyCommon& common, const std::vector<std::vector<jet::Vec2>>& rings,
                                   double mass)
{
    const auto body = static_cast<jet::BodyHandle>(position_.size());
    jet::Box box;
    for (const auto& ring : rings)
        for (const jet::Vec2& p : ring) box.extend(p);
    for (const auto& ring : rings)
        for (const jet::Vec2& p : ring) shape_.push_back(p - box.center());
    points_.resize(shape_.size());
    firstPoint_.push_back(static_cast<std::uint32_t>(points_.size()));
    position_.push_back(box.center());
    velocity_.push_back(common.velocity);
    pushed_.emplace_back(0, 0);
    angle_.push_back(0);
    omega_.push_back(common.omega);
    mass_.push_back(mass);
    fixed_.push_back(common.fixed);
    bounds_.push_back(box);
    place(body);
    return body;
}

jet::ActuatorHandle MyPluginWorld::addTorque(const jet::TorqueActuatorDef& def)
{
    torques_.push_back(def);
    return static_cast<jet::ActuatorHandle>(torques_.size() - 1);
}

jet::ActuatorHandle MyPluginWorld::addForce(const jet::ForceActuatorDef& def)
{
    forces_.push_back(def);
    return static_cast<jet::ActuatorHandle>(forces_.size() - 1);
}

void MyPluginWorld::place(jet::BodyHandle body)
{
    const auto turn = jet::Affine::rotation(angle_[body]);
    jet::Box box;
    for (std::uint32_t i = firstPoint_[body]; i < firstPoint_[body + 1]; ++i) {
        points_[i] = position_[body] + turn * shape_[i];
        box.extend(points_[i]);
    }
    bounds_[body] = box;
}

double MyPluginWorld::floor() const
{
    double y = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < fixed_.size(); ++i)
        if (fixed_[i] && (std::isinf(y) || bounds_[i].min.y() > y)) y = bounds_[i].min.y();
    return y;
}

void MyPluginWorld::step(double dt)
{
    for (const jet::ForceActuatorDef& force : forces_)
        if (force.at.body != jet::kNoHandle) pushed_[force.at.body] += force.force;
    for (const jet::TorqueActuatorDef& torque : torques_)
        if (torque.at.body != jet::kNoHandle) omega_[torque.at.body] += torque.value / mass_[torque.at.body] * dt;

    const double ground = floor();
    const double bounce = settings_.materials.empty() ? 0 : settings_.materials.front().restitution;
    for (jet::BodyHandle i = 0; i < position_.size(); ++i) {
        const jet::Vec2 push = std::exchange(pushed_[i], jet::Vec2(0, 0));
        if (fixed_[i]) continue;
        velocity_[i] += ((settings_.applyGravity ? settings_.gravity : jet::Vec2(0, 0)) + push / mass_[i]) * dt;
        position_[i] += velocity_[i] * dt;
        angle_[i] += omega_[i] * dt;
        place(i);
        const double depth = bounds_[i].max.y() - ground;
        if (depth <= 0 || !settings_.resolveCollisions) continue;
        position_[i].y() -= depth;
        velocity_[i].y() = std::min(velocity_[i].y(), -bounce * velocity_[i].y());
        place(i);
    }
}

std::uint64_t MyPluginWorld::hash() const
{
    std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a of all that moves
    for (const std::byte byte : save()) hash = (hash ^ static_cast<std::uint8_t>(byte)) * 1099511628211ULL;
    return hash;
}

// The state is, a body: position, velocity, angle, spin. Points and bounds follow from it.
std::vector<std::byte> MyPluginWorld::save() const
{
    std::vector<double> state;
    for (std::size_t i = 0; i < position_.size(); ++i)
        for (const double v :
             {position_[i].x(), position_[i].y(), velocity_[i].x(), velocity_[i].y(), angle_[i], omega_[i]})
            state.push_back(v);
    const auto bytes = std::as_bytes(std::span(state));
    return {bytes.begin(), bytes.end()};
}

void MyPluginWorld::restore(std::span<const std::byte> bytes)
{
    std::vector<double> state(6 * position_.size());
    if (bytes.size() != state.size() * sizeof(double)) return;  // of another world
    std::memcpy(state.data(), bytes.data(), bytes.size());
    for (jet::BodyHandle i = 0; i < position_.size(); ++i) {
        const double* v = &state[6 * std::size_t{i}];
        position_[i] = {v[0], v[1]};
        velocity_[i] = {v[2], v[3]};
        angle_[i] = v[4];
        omega_[i] = v[5];
        place(i);
    }
}
