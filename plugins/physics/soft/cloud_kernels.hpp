// Passes over all particles of a body: where they are as a whole, how far they stray, and what draws them back to the
// shape they remember. Two particles at a time in double; the choice of instructions and the promise of equal bits are
// those of kernels.hpp.
#pragma once

#include <cstddef>

namespace jet::physics::soft {

/// Particles that lie one after the other.
struct Cloud {
    const double *position = nullptr, *velocity = nullptr;  // [count][2]
    const double* mass = nullptr;                           // [count]
    const double* rest = nullptr;                           // [count][2] from the centre at rest; null: unknown
    std::size_t count = 0;
};

struct CloudSums {
    double mass = 0;
    double x = 0, y = 0, vx = 0, vy = 0;  // of the centre of mass
    double inertia = 0;                   // sum m |p|², p from the centre
    double momentum = 0;                  // sum m p x v
    double along = 0, across = 0;         // with a shape at rest q, whose own sum m q is null: sum m q·p, sum m q x p

    double lowest[2]{}, greatest[2]{};  // x and y of any particle

    double omega() const { return inertia > 0 ? momentum / inertia : 0; }
};

/// A rigid motion, and the turned shape at rest.
struct CloudMotion {
    double x = 0, y = 0, vx = 0, vy = 0, omega = 0;
    double c = 1, s = 0;  // (cos, sin) of the turn
};

/// How far the particles are from the motion, squared.
struct CloudStray {
    double off = 0;    // from where the shape at rest has them, units²; 0 where that is unknown
    double speed = 0;  // from its velocities, units² / s²
};

struct CloudPull {
    double tolerance = 0;  // units from its goal at which a particle is drawn
    double elastic = 0;    // h omega²
    double damped = 0;     // part of its velocity a drawn particle loses
};

/// Sums over what draws the particles: m dv and m p x dv, of the elastic part and the damping.
struct CloudPulled {
    double x = 0, y = 0, turn = 0;
    double dampedX = 0, dampedY = 0, dampedTurn = 0;
    bool any = false;
};

/// What all particles get besides: v, and parts of the goal and of the place, from the centre, turned by a right angle.
struct CloudReturn {
    double x = 0, y = 0, goal = 0, place = 0;
};

/// sum m e·e', e what is drawn of each particle's way to its goal, e' the same before the last move over h.
double drawn(const Cloud&, const CloudMotion&, double tolerance, double h);

struct CloudKernels {
    CloudSums (*sums)(const Cloud&);
    CloudStray (*stray)(const Cloud&, const CloudMotion&);
    /// Fills change [count][2] with what draws each particle to its goal, unless there is nothing.
    CloudPulled (*pull)(const Cloud&, const CloudMotion&, const CloudPull&, double* change);
    /// velocity += change + what all get.
    void (*give)(const Cloud&, const CloudMotion&, const CloudReturn&, const double* change, double* velocity);
    /// The greatest |position - from - t moving|² of the particles; moving may be null.
    double (*farthest)(const double* position, const double* from, const double* moving, double t, std::size_t count);
};

namespace sse2 {
extern const CloudKernels clouds;
}
namespace avx2 {
extern const CloudKernels clouds;
}

}  // namespace jet::physics::soft
