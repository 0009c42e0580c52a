// Constraints of joints: where they lie, and how they stay from step to step.
//
// Points that joints hold together lie in groups of lanes, in the order of the joints; that order, and the colours that
// follow from it, are those of the joints there are, whatever was before. So they are laid out anew only when something
// about the joints or their bodies has changed, and a step has to find no more than where the points are. Rows are made
// anew in every step.
#include "solver.hpp"

#include <cmath>
#include <utility>

namespace jet::physics {

template <class Real>
void Solver<Real>::addJoint(const Joint& joint, Index index)
{
    const Index slotA = domains_.slotOf(joint.a), slotB = domains_.slotOf(joint.b);
    const bool movesA = states_[slotA].invMass > 0, movesB = states_[slotB].invMass > 0;
    if (!movesA && !movesB) return;
    if (joint.hasRows()) rowed_[nodeOf(joint.a, movesA, joint.b, movesB)].push_back({index, slotA, slotB});
    if (!joint.hasPoint()) return;
    const std::size_t which = colourOf(joint.a, movesA, joint.b, movesB, takenByJoints_);
    JointColour& colour = jointColours_[which];
    if (isLast(which)) colour.count = groups(colour.count) * kWidth;
    const std::size_t at = colour.count++, lane = at % kWidth;
    if (lane == 0) {
        colour.joints.emplace_back(JointLanes<Real>{});
        colour.anchors.emplace_back(AnchorLanes<Real>{});
        colour.index.resize(colour.joints.size() * kWidth, kNone);
    }
    colour.index[at] = index;
    anyPoint_ = true;
    JointLanes<Real>& g = colour.joints[at / kWidth];
    g.a[lane] = farOf<Real>(slotA), g.b[lane] = farOf<Real>(slotB);
    g.impulseX[lane] = static_cast<Real>(joint.warm(0, shape_.h));
    g.impulseY[lane] = static_cast<Real>(joint.warm(1, shape_.h));
    AnchorLanes<Real>& anchors = colour.anchors[at / kWidth];
    const std::size_t four = lane / 4, of = lane % 4;
    anchors.ax[four][of] = joint.localA.x(), anchors.ay[four][of] = joint.localA.y();
    anchors.bx[four][of] = joint.localB.x(), anchors.by[four][of] = joint.localB.y();
}

template <class Real>
void Solver<Real>::layOutJoints(std::vector<Joint>& joints, const std::vector<RigidBody>& bodies, std::uint64_t version)
{
    if (jointsVersion_ == version && jointsH_ == shape_.h) return;
    releaseJoints(joints);
    if (!joints.empty()) takenByJoints_.resize(bodies.size(), domains_.depth());
    for (Index i = 0; i < joints.size(); ++i) {
        Joint& joint = joints[i];
        const RigidBody &a = bodies[joint.a], &b = bodies[joint.b];
        const bool holds = joint.lives() && a.enabled && b.enabled;
        if (holds && (a.asleep || b.asleep)) continue;
        joint.state.force = Vec2(0, 0), joint.state.torque = 0;
        if (holds) {
            addJoint(joint, i);
        } else {
            joint.substep = 0;  // what it holds again one day starts from rest
        }
    }
    jointsVersion_ = version, jointsH_ = shape_.h;
}

template <class Real>
void Solver<Real>::startJoints(const std::vector<Joint>& joints, const State& state,
                               const std::vector<RigidBody>& bodies)
{
    const Nodes& nodes = state.nodes;
    if (anyPoint_) {
        const std::span<BodyPlace> places = arena_->take<BodyPlace>(domains_.slotCount());
        places[0] = BodyPlace();
        domains_.eachBody(*pool_, [&](Index body, Index slot) {
            const Index node = bodies[body].node;
            places[slot] = {nodes.position[node].x(), nodes.position[node].y(), nodes.rotation[node].x(),
                            nodes.rotation[node].y()};
        });
        eachNode([&](Node node) {
            for (std::size_t i = 0; i < kColours; ++i) {
                JointColour& c = jointColours_[firstColourOf(node) + i];
                kernels_->startJoints(states_.data(), places.data(), c.joints.data(), c.anchors.data(),
                                      c.joints.size());
            }
        });
    }
    for (std::size_t node = Domains::kRoot; node <= Domains::kNodes; ++node) {
        rows_[node].clear(), turning_[node].clear();
        for (const Rowed& each : rowed_[node]) {
            const Joint& joint = joints[each.joint];
            const JointFrame f = frameOf(joint, state, bodies);
            const std::size_t first = rows_[node].size();
            addRows(joint, each.joint, f, states_.data(), each.a, each.b, shape_.h, rows_[node]);
            for (std::size_t i = first; i < rows_[node].size(); ++i)
                rows_[node][i].stored = rows_[node][i].springEnergy(rows_[node][i].error);
            if (joint.rowsTurn())
                turning_[node].emplace_back(joint, each.joint, f, each.a, each.b, first, rows_[node].size() - first);
        }
    }
}

/// What ran away starts from nothing in the next step, as its bodies do (speed_limit.hpp).
template <class Real>
void Solver<Real>::calmJoints(Node node)
{
    const auto calm = [](Lanes<Real>& impulse) { impulse = impulse - impulse == 0 ? impulse : Lanes<Real>{}; };
    for (std::size_t i = 0; i < usedByJoints_[node]; ++i)
        for (JointLanes<Real>& g : jointColours_[firstColourOf(node) + i].joints) calm(g.impulseX), calm(g.impulseY);
}

/// Their rows begin with what they are given here.
template <class Real>
void Solver<Real>::keepRows(std::vector<Joint>& joints)
{
    for (auto& rows : rows_)
        for (JointRow<Real>& row : rows) {
            if (!std::isfinite(row.impulse)) row.impulse = 0;
            joints[row.joint].impulse[row.slot] = static_cast<double>(row.impulse);
            joints[row.joint].substep = shape_.h;
        }
    jointsTold_ = false;
}

template <class Real>
void Solver<Real>::tellJoints(std::vector<Joint>& joints)
{
    if (std::exchange(jointsTold_, true)) return;
    for (const auto& rowed : rowed_)
        for (const Rowed& each : rowed)
            joints[each.joint].state.force = Vec2(0, 0), joints[each.joint].state.torque = 0;
    for (const JointColour& colour : jointColours_) {
        for (std::size_t at = 0; at < colour.count; ++at) {
            if (colour.index[at] == kNone) continue;
            Joint& joint = joints[colour.index[at]];
            const JointLanes<Real>& g = colour.joints[at / kWidth];
            joint.impulse[0] = static_cast<double>(g.impulseX[at % kWidth]);
            joint.impulse[1] = static_cast<double>(g.impulseY[at % kWidth]);
            joint.state.force = Vec2(joint.impulse[0], joint.impulse[1]) / jointsH_;
            joint.substep = jointsH_;
        }
    }
    for (const auto& rows : rows_)
        for (const JointRow<Real>& row : rows) {
            Joint& joint = joints[row.joint];
            joint.state.force += static_cast<double>(row.impulse) / jointsH_ * Vec2(row.bx, row.by);
            if (row.bx == 0 && row.by == 0) joint.state.torque += row.torqueOfB() / jointsH_;
        }
    for (const auto& rowed : rowed_)
        for (const Rowed& each : rowed) {
            jet::JointState& told = joints[each.joint].state;
            if (!isFinite(told.force)) told.force = Vec2(0, 0);
            if (!std::isfinite(told.torque)) told.torque = 0;
        }
}

template <class Real>
void Solver<Real>::scaleJoints(std::vector<Joint>& joints, const std::function<double(const Joint&)>& factor)
{
    for (JointColour& colour : jointColours_) {
        for (std::size_t at = 0; at < colour.count; ++at) {
            if (colour.index[at] == kNone) continue;
            const auto by = static_cast<Real>(factor(joints[colour.index[at]]));
            JointLanes<Real>& g = colour.joints[at / kWidth];
            g.impulseX[at % kWidth] *= by, g.impulseY[at % kWidth] *= by;
        }
    }
    for (auto& rows : rows_)
        for (JointRow<Real>& row : rows) {
            row.impulse *= static_cast<Real>(factor(joints[row.joint]));
            joints[row.joint].impulse[row.slot] = static_cast<double>(row.impulse);
        }
}

template <class Real>
void Solver<Real>::releaseJoints(std::vector<Joint>& joints)
{
    tellJoints(joints);
    dropJoints();
}

template <class Real>
void Solver<Real>::dropJoints()
{
    for (JointColour& colour : jointColours_)
        colour.joints.clear(), colour.anchors.clear(), colour.index.clear(), colour.count = 0;
    for (auto& rowed : rowed_) rowed.clear();
    for (auto& rows : rows_) rows.clear();
    for (auto& turning : turning_) turning.clear();
    takenByJoints_.clear();
    anyPoint_ = false;
    jointsTold_ = true;
    jointsVersion_ = 0;
}

template class Solver<float>;
template class Solver<double>;

}  // namespace jet::physics
