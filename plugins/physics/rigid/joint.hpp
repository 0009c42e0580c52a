// Joints between rigid bodies and the background (SPEC PH7 and beyond).
//
// Each joint is at most one point-to-point constraint, solved in wide kernels, and a few rows. A row says: the speed
// J v, with J = (jA, angularA, jB, angularB), shall be such that the error C decays; its impulse is limited. The
// effective mass is 1 / (J M⁻¹ Jᵀ); angular parts are in radii of gyration (solver_data.hpp). Within half a substep C =
// C0 + J (moves since the start); rows whose J depends on where the bodies are are made anew once a substep, see
// solver_data.hpp.
#pragma once

#include "contact.hpp"
#include "solver_data.hpp"

#include <jet/physics.hpp>

#include <cmath>
#include <vector>

namespace jet::physics {

template <class Real>
struct JointRow {
    Index a = 0, b = 0, joint = 0, slot = 0;  // a, b: of the states
    Real ax = 0, ay = 0, angularA = 0, bx = 0, by = 0, angularB = 0;
    Real error = 0;             // units or radians, less J (moves since the start of the step)
    Real bend = 0;              // units or radians a second by which C comes to differ from C + J v, in this substep
    Real speed = 0;             // wanted, units / s or rad / s
    Real least = 0, most = 0;   // impulse of a substep
    bool soft = false;          // has a spring of its own
    bool velocityOnly = false;  // motors
    bool limit = false;         // one-sided: error may be positive
    Softness<Real> spring;
    Real frequency = 0;           // of that, rad / s
    Real strongest = Real(1e30);  // of that, mass units / s²; a mouse joint's is limited
    Real mass = 0, impulse = 0;
    Real far = Real(1e30);  // units or radians: greater errors are not pushed out at once
    Real given = 0;         // by a motor in the step, mass units² / s² or mass / s²
    Real stored = 0;        // energy of a spring of its own at the start of the step

    /// Changes the velocities so that the row is met, with or without pushing errors out.
    void solve(BodyState<Real>* bodies, const Softness<Real>& standard, Real inverseH, bool push);
    void warm(BodyState<Real>* bodies) const;
    /// J times the velocities, and the moves, of its bodies.
    Real moving(const BodyState<Real>* bodies) const;
    Real moved(const BodyState<Real>* bodies) const;
    /// Of a spring of its own; its stiffness is that of the effective mass, and changes with it.
    Real springEnergy(Real at) const
    {
        const Real stiffness = mass * frequency * frequency;
        if (!soft || !(stiffness > 0)) return 0;
        const Real yields = strongest / stiffness;  // beyond it pulls with all it has, as a weight does
        const Real far = std::abs(at);
        return far <= yields ? stiffness * at * at / 2 : strongest * (far - yields / 2);
    }
    /// Of its impulse, when it is a row of turning alone; mass units² / s.
    double torqueOfB() const
    {
        return std::copysign(1.0, static_cast<double>(angularB)) * static_cast<double>(impulse);
    }

private:
    void apply(BodyState<Real>& a, BodyState<Real>& b, Real impulse) const;
};

struct Joint {
    JointDef def;
    Index a = 0, b = 0;    // rigid bodies; 0: the background
    Vec2 localA, localB;   // in the bodies' frames, from their centres; background: scene coordinates
    Vec2 localAxis;        // in a's frame
    double restAngle = 0;  // b's angle less a's at the time of adding
    double length = 0;     // units
    bool removed = false, broken = false;
    // Of the last substep: the point's two, then the rows'. Warm starting.
    double impulse[6] = {0, 0, 0, 0, 0, 0};
    double substep = 0;  // seconds: the impulses are of substeps of this; 0: there are none yet
    JointState state;

    /// The impulse of a substep of h that stands for the same force.
    double warm(int slot, double h) const { return substep > 0 ? impulse[slot] * (h / substep) : 0; }
    bool lives() const { return !removed && !broken; }
    /// Do its bodies pass each other because of it?
    bool keepsApart() const { return lives() && !def.collide && a != 0 && b != 0; }
    bool hasPoint() const { return def.kind == JointDef::Kind::Revolute || def.kind == JointDef::Kind::Weld; }
    bool hasRows() const { return def.kind != JointDef::Kind::Revolute || def.driven || def.limited; }
    /// Does the J of its rows depend on where the bodies are?
    bool rowsTurn() const { return !hasPoint(); }
};

/// What of a joint may change while the world runs, changed; the rest as it is.
JointDef liveDef(const JointDef& wanted, const JointDef& now);
/// Would that change nothing?
bool isLike(const JointDef& wanted, const Joint& now);
/// What a pulley keeps, units.
double pulleyLength(const JointDef&, const Vec2& pointA, const Vec2& pointB);

struct JointFrame {
    Vec2 armA, armB, pointA, pointB;  // scene directions; scene coordinates
    Vec2 axis;                        // scene direction, turns with a
    double angle = 0;                 // radians since the time of adding
};
JointFrame frameOf(const Joint&, const State&, const std::vector<RigidBody>&);

/// A joint whose rows turn with its bodies, in a step.
template <class Real>
class TurningRows {
public:
    /// Its rows are `count` of those of its node, from `first` on.
    TurningRows(const Joint& joint, Index index, const JointFrame& start, Index a, Index b, std::size_t first,
                std::size_t count)
        : joint_(&joint), index_(index), a_(a), b_(b), first_(first), count_(count), start_(start)
    {
    }
    /// Makes the rows anew for where the bodies are; what their impulses warm follows. `made`: scratch. Says
    /// whether they are strained.
    bool turn(const BodyState<Real>*, BodyPush<Real>*, double h, std::vector<JointRow<Real>>& rows,
              std::vector<JointRow<Real>>& made) const;
    /// Looks where the velocities lead in a substep.
    void foresee(const BodyState<Real>*, double h, std::vector<JointRow<Real>>& rows,
                 std::vector<JointRow<Real>>& made) const;

private:
    JointFrame frameIn(const BodyState<Real>*, double seconds) const;
    bool make(const JointFrame&, const BodyState<Real>*, double h, std::vector<JointRow<Real>>& made) const;

    const Joint* joint_;
    Index index_, a_, b_;
    std::size_t first_, count_;
    JointFrame start_;
};

/// Appends the joint's rows for substeps of h, between the states of its bodies.
template <class Real>
void addRows(const Joint&, Index index, const JointFrame&, const BodyState<Real>* states, Index a, Index b, double h,
             std::vector<JointRow<Real>>&);

template <class Real>
double kineticEnergy(const BodyState<Real>& s)
{
    const auto x = static_cast<double>(s.velocityX), y = static_cast<double>(s.velocityY),
               w = static_cast<double>(s.spin);
    return s.invMass > 0 ? (x * x + y * y + w * w) / (2 * static_cast<double>(s.invMass)) : 0;
}

Softness<double> softnessOf(double hertz, double dampingRatio, double h);

}  // namespace jet::physics
