// What soft bodies are made of beyond their springs, and fields of force. Part of the contract in jet/physics.hpp,
// whose units hold here too.
#pragma once

#include <jet/geometry.hpp>

#include <cstdint>
#include <vector>

namespace jet {

/// Properties of a soft body as a whole. As constructed: springs alone, as in the thesis.
struct SoftMatter {
    /// Scene units, >= 0: its border is felt this far outside its walls. Two bodies keep the sum of theirs apart.
    double thickness = 0;
    /// Force / unit, >= 0: pressure of the gas it holds, above that outside, at its area at rest. The gas keeps
    /// pressure times area.
    double pressure = 0;
    /// Force / unit, >= 0: pressure that resists a change of its area, times the relative change.
    double areaStiffness = 0;
    /// Force / unit, >= 0: ks of the springs that draw each particle to its place in an invisible rigid twin, which has
    /// the shape of the definition, meets nothing, weighs nothing and lies as the body does as a whole (thesis
    /// §2.4.3.6). Of a particle of mean mass; on others it is in proportion to their mass. 0: there is no twin.
    double shapeStiffness = 0;
    /// Force / (unit / s), >= 0: kd of these springs.
    double shapeDamping = 0.1;
    /// Strain, >= 0, beyond which its springs begin to flow and stay changed; 0: they never do.
    double yield = 0;
    /// 1/s, >= 0: how fast the strain beyond the yield becomes permanent.
    double creep = 10;
    /// Part of their rest length by which springs may flow at most, 0 .. 0.95.
    double mostFlow = 0.5;
    /// Does its border collide with itself?
    bool selfCollision = false;
};

/// A field of force on all particles (soft bodies) and on the area (rigid ones) that is in its region.
struct ForceFieldDef {
    enum class Kind : std::uint8_t {
        Directional,  ///< accelerates by `vector`, units / s²
        Radial,       ///< accelerates away from `centre` by `strength`, units / s²; below 0: towards it
        Vortex,       ///< accelerates around `centre`, clockwise on screen, by `strength`, units / s²
        Drag,         ///< draws velocities to `vector` (the wind's, units / s) at the rate `strength`, 1/s
        Buoyancy      ///< lifts by `strength` times the weight, and drags as with `drag`
    };
    Kind kind = Kind::Directional;
    std::vector<std::vector<Vec2>> region;  ///< closed rings, scene coordinates; odd-even; none: everywhere
    Vec2 vector{0, 0};
    Vec2 centre{0, 0};
    double strength = 1;
    /// Radial and vortex: scene units at which they halve and beyond which they fade, as 1 / (1 + (r / reach)²); 0: the
    /// same everywhere.
    double reach = 0;
    double drag = 0;  ///< 1/s, buoyancy only
};

}  // namespace jet
