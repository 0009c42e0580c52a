// LiveBody: a soft body as it is at this moment of play, for effects that show more of it than its outline.
//
//   bool wantsLiveBody() const override { return true; }
//   void paint(const EffectInput& input, ...) const override
//   {
//       if (!input.body) return;                                    // not at play, or a rigid body
//       for (const LiveSpring& spring : input.body->springs) ...    // input.body->particles[spring.a]
//   }
#pragma once

#include <jet/geometry.hpp>

#include <cstdint>
#include <vector>

namespace jet {

/// A spring of a soft body between two of its particles.
struct LiveSpring {
    std::uint32_t a = 0, b = 0;  ///< indices into LiveBody::particles
    double restLength = 0;       ///< scene units, as the body was built
    double stiffness = 0;        ///< force / unit
    bool whole = true;           ///< false once it tore
};

/// Particles and springs of one soft body after the last step, in the order of its SoftBodyDef.
struct LiveBody {
    std::vector<Vec2> particles;  ///< scene units
    std::vector<LiveSpring> springs;

    double length(const LiveSpring& s) const { return (particles[s.b] - particles[s.a]).norm(); }
    /// Length over length at rest, less 1: positive when stretched, negative when pressed; 0 for a torn spring.
    double strain(const LiveSpring& s) const { return s.whole && s.restLength > 0 ? length(s) / s.restLength - 1 : 0; }
    /// Force along the spring without its damping: positive pulls its ends together.
    double tension(const LiveSpring& s) const { return s.whole ? s.stiffness * (length(s) - s.restLength) : 0; }
};

}  // namespace jet
