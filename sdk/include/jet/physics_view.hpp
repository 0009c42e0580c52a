// What a running physics world looks like from inside, for people who tune a scene: contacts, islands, stress, boxes,
// centres of mass, joints. Works with every engine: it asks the contract's world alone.
//
//   editor.simulation().setPhysicsMarks({.contacts = true, .joints = true});  // the play view draws them from now on
//   simulation.frame()->physics->stats.solverMs                              // while any mark is set
#pragma once

#include <jet/events.hpp>
#include <jet/item.hpp>
#include <jet/painter.hpp>
#include <jet/physics.hpp>

#include <vector>

namespace jet {

/// What is drawn over the game.
struct PhysicsMarks {
    bool contacts = false;    ///< points, normals, and impulses as lengths
    bool islands = false;     ///< bodies by the colour of their group; sleeping ones grey
    bool stress = false;      ///< springs of soft bodies: blue pressed, red stretched
    bool boxes = false;       ///< axis-parallel bounds
    bool centres = false;     ///< centres of mass, with an axis that turns with the body
    bool joints = false;      ///< both points of each, broken ones crossed out
    bool statistics = false;  ///< nothing is drawn; frames carry the numbers

    bool any() const { return contacts || islands || stress || boxes || centres || joints || statistics; }
    bool operator==(const PhysicsMarks&) const = default;
};

/// A world after a step. Immutable; bodies by handle.
struct PhysicsPicture {
    struct Body {
        ItemId item;
        Box bounds;
        Vec2 centre;
        double angle = 0;
        bool soft = false, moves = false, awake = true;
        std::uint32_t island = kNoHandle;
        std::uint32_t firstPoint = 0, pointCount = 0;  ///< in `points`
    };
    struct Spring {
        Vec2 a, b;
        double stress = 0;  ///< force over stiffness and rest length: strain as an engine without damping has it
    };
    std::vector<Body> bodies;
    std::vector<Vec2> points;
    std::vector<Contact> contacts;
    std::vector<JointState> joints;
    std::vector<Spring> springs;  ///< whole ones
    StepStats stats;
    double stepMs = 0;  ///< wall time of the step in the engine
};

/// Draws in scene coordinates.
JET_API void paintPhysics(const PhysicsPicture& picture, const PhysicsMarks& marks, Painter& painter);

/// Sent by the SimulationCenter on the owner thread of its EventsCenter.
struct PhysicsMarksChanged {
    static constexpr EventType type{"org.jet.physics-marks-changed"};
};

}  // namespace jet
