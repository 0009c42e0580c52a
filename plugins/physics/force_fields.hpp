// Fields of force over regions of the scene (thesis §2.4.1: "pole siłowe"; SPEC PH7).
//
// A field acts on each particle of a soft body that is inside its region, and on a rigid body at its border points,
// each of which carries an equal part of its mass: a body half inside feels half the field, and is turned by it.
#pragma once

#include "edge_grid.hpp"
#include "rigid/stage.hpp"
#include "state.hpp"

namespace jet::physics {

class ForceFields {
public:
    Index add(const ForceFieldDef&);
    void set(Index field, const ForceFieldDef&);
    /// Would that change nothing?
    bool isSet(Index field, const ForceFieldDef&) const;
    Index count() const { return static_cast<Index>(fields_.size()); }

    /// Adds the forces of all fields to the nodes, for a substep of h.
    void addForces(State&, const RigidStage&, const Vec2& gravity, double h) const;

    template <class Archive>
    void archive(Archive& with)
    {
        for (Field& field : fields_) {
            ForceFieldDef& def = field.def;
            with(def.vector), with(def.centre), with(def.strength), with(def.reach), with(def.drag);
            with.list(def.region, [&](std::vector<Vec2>& ring) { with.list(ring, [&](Vec2& at) { with(at); }); });
        }
    }
    /// After the regions were read back.
    void restored();

private:
    struct Field {
        ForceFieldDef def;
        EdgeGrid region;

        bool covers(const Vec2& at) const { return def.region.empty() || region.inside(at); }
        Vec2 acceleration(const Vec2& at, const Vec2& velocity, const Vec2& weight, double h) const;
    };
    static void act(State&, const RigidStage&, const Field&, Index body, const Vec2& weight, double h);

    std::vector<Field> fields_;
};

}  // namespace jet::physics
