// Gas pressure and area preservation: forces along the outward normals of a soft body's walls.
//
// With A the enclosed area and g = dA/dx (half the outward normal times length of the two walls at a particle), both
// push with p g, where
//
//   p(A) = pressure A0 / A  +  areaStiffness (1 - A / A0).
//
// Net force and torque of p g vanish for closed borders, as A does not change when the body is moved or turned. The
// pressure falls while the body grows: taking p at the end of the substep, p + h p'(A) (g·v), makes the impulse
// h (p - h k g·v) / (1 + h² k Σ g² / m), k = -p'(A), which no stiffness makes unstable. (Spreading the impulse by
// Jacobi iterations, or a position constraint on the area, were the alternatives: one overshoots, the other has no
// pressure one could name.) What remains, the turning of g with the walls, is p itself: held to a quarter of m / h².
#pragma once

#include "state.hpp"

namespace jet::physics::soft {

/// Does it hold gas, or keep its area?
bool holdsGas(const BodyRecord&);
/// Changes the velocities of the bodies that hold gas or keep their area, over h.
void applyPressure(State&, double h);
/// What its gas and its area hold, in substeps of h; 0 at the area at rest.
double gasEnergy(const State&, const BodyRecord&, double h);
/// Area inside the body's walls as they are, units²; below 0 when it is turned inside out.
double enclosedArea(const State&, const BodyRecord&);

}  // namespace jet::physics::soft
