// Flights of soft bodies: soft/flight.hpp.
#include "soft/flight.hpp"

#include "soft_springs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace jet::physics {

namespace {

// Far below soft::kMostSpeed: what is faster goes substep by substep, where it is held back.
constexpr double kMostFlightSpeed = 1e5;  // units / s

struct FlightRoom {
    std::size_t stride, planes, rows;

    explicit FlightRoom(std::size_t nodes)
    {
        const std::size_t padded = (nodes + soft::kLanes - 1) / soft::kLanes;
        stride = (padded + 2) * soft::kLanes, planes = soft::FlightPlanes::kCount * stride;
        rows = (nodes + soft::kFlightLanes - 1) / soft::kFlightLanes * soft::kFlightRow;
    }
    std::size_t total() const { return planes + rows; }
};

soft::FlightRing ringOf(std::vector<float>& room, const soft::Blocks& blocks)
{
    return {room.data(), soft::FlightRing::sizeFor(blocks.reach)};
}

/// What must be added so that the centre of mass moves as gravity and damping have it move.
soft::FlightReturn returnOf(const soft::FlightSurvey& all, double mass, double h, int count, const Vec2& gravity,
                            double kept)
{
    const Vec2 start(all.startX / mass, all.startY / mass);
    Vec2 velocity = start, way(0, 0);
    for (int i = 0; i < count; ++i) {
        velocity = kept * (velocity + h * gravity);
        way += h * (velocity - start);
    }
    const Vec2 gain = velocity - start;
    return {way.x() - all.wayX / mass, way.y() - all.wayY / mass, gain.x() - all.gainX / mass,
            gain.y() - all.gainY / mass};
}

}  // namespace

void SoftSprings::makeFlightRoom()
{
    std::size_t room = 0, ring = 0, parts = 0;
    for (const soft::Batch& batch : batches_) {
        if (!batch.flies()) continue;
        room = std::max(room, FlightRoom(batch.rows).total());
        const std::size_t planes = 2 * (batch.blocks.pattern.differences.size() + 1);
        const soft::FlightRing needed{nullptr, soft::FlightRing::sizeFor(batch.blocks.reach)};
        ring = std::max(ring, planes * needed.stride());
        parts = std::max(parts, batch.parts.size());
    }
    flight_.resize(room);
    for (std::size_t k = 0; k < parts; ++k) rooms_[k].ring.resize(ring);
}

bool SoftSprings::fly(State& state, Index handle, double h, int count, const Vec2& gravity, double kept, double most)
{
    const soft::FlightKernels& kernels = *kernels_->flight;
    soft::Batch& batch = batches_[meshes_[handle].batch];
    Nodes& nodes = state.nodes;
    const Index first = state.bodies[handle].nodes.first;
    const soft::NodeArrays arrays{nodes.position[first].data(), nodes.velocity[first].data(), nullptr,
                                  &nodes.invMass[first], batch.rows};
    const FlightRoom room(batch.rows);
    const soft::FlightPlanes planes{flight_.data(), room.stride, flight_.data() + room.planes};
    const soft::Frame frame = frameOf(state, handle);
    if (!(std::hypot(frame.vx, frame.vy) < kMostFlightSpeed)) return false;
    const soft::Pattern& lies = batch.blocks.pattern;
    const soft::FlightPattern pattern{lies.differences.data(), lies.differences.size(), lies.present.data()};
    const auto single = [](double value) { return static_cast<float>(value); };
    soft::FlightStep step{single(h),           single(kept * h), single(kept - 1), single(gravity.x()),
                          single(gravity.y()), single(frame.vx), single(frame.vy), true};

    const std::size_t parts = batch.parts.size();
    std::array<std::size_t, soft::kLanes> torn{};
    std::array<bool, soft::kLanes> pinned{};
    state.run(parts, [&](std::size_t k) {
        pinned[k] = kernels.takeOff(arrays, frame, planes, batch.parts[k].first, batch.parts[k].end);
    });
    std::array<soft::FlightSurvey, soft::kLanes> surveys;
    const auto survey = [&](bool sums) {
        state.run(parts, [&](std::size_t k) {
            surveys[k] =
                kernels.survey(arrays, &nodes.mass[first], planes, sums, batch.parts[k].first, batch.parts[k].end);
        });
    };
    for (int i = 0; i < count; ++i) {
        state.run(parts, [&](std::size_t k) {
            torn[k] = kernels.fly(springsOf(batch, rooms_[k]), pattern, step, planes,
                                  ringOf(rooms_[k].ring, batch.blocks), partOf(batch, k));
        });
        if (std::any_of(torn.begin(), torn.end(), [](std::size_t blocks) { return blocks > 0; })) return false;
        if (parts > 1)
            state.run(parts, [&](std::size_t k) {
                if (k > 0) kernels.flyHead(step, planes, partOf(batch, k), rooms_[k - 1].spilt.data());
            });
        step.first = false;
        // What swings may have been further off than it is at the end.
        if (std::isfinite(most) && i + 1 < count) {
            survey(false);
            const auto strays = [&](const soft::FlightSurvey& part) { return !(part.farthest <= most); };
            if (std::any_of(surveys.begin(), surveys.begin() + parts, strays)) return false;
        }
    }

    const bool free = std::find(pinned.begin(), pinned.end(), true) == pinned.end();
    survey(free);
    soft::FlightSurvey all;
    for (std::size_t k = 0; k < parts; ++k) {
        const soft::FlightSurvey& one = surveys[k];
        if (!(one.fastest < kMostFlightSpeed) || !(one.farthest <= most)) return false;
        all.gainX += one.gainX, all.gainY += one.gainY, all.wayX += one.wayX, all.wayY += one.wayY;
        all.startX += one.startX, all.startY += one.startY;
    }
    const double mass = state.bodies[handle].soft->mass;
    const soft::FlightReturn back = free ? returnOf(all, mass, h, count, gravity, kept) : soft::FlightReturn();
    state.run(parts, [&](std::size_t k) {
        kernels.land(nodes.position[first].data(), nodes.velocity[first].data(), planes, h * count, back,
                     batch.parts[k].first, batch.parts[k].end);
    });
    return true;
}

}  // namespace jet::physics
