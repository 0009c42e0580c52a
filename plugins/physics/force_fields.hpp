// Fields of force over regions of the scene (thesis §2.4.1: "pole siłowe"; SPEC PH7).
//
// A field acts on each particle of a soft body that is inside its region, and on the part of a rigid body's area that
// is inside, each with its part of the mass: what floats sinks in until it displaces its weight, and a jet narrower
// than a body lifts it. Bodies without convex parts feel it at their border points.
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
    /// With those that were removed, as handles go.
    Index count() const { return static_cast<Index>(fields_.size()); }
    bool exists(Index field) const { return field < count() && !fields_[field].removed; }
    bool any() const { return removed_ < fields_.size(); }
    /// The next one takes its place.
    void remove(Index field);

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
    /// Convex, of the region.
    struct Piece {
        Box box;
        std::vector<Vec2> corners;
    };
    struct Field {
        explicit Field(const ForceFieldDef&);

        ForceFieldDef def;
        EdgeGrid region;
        std::vector<Piece> pieces;
        bool removed = false;

        /// Does what it does to a surface follow from its area, centroid and moment?
        bool isLinear() const
        {
            return def.kind != ForceFieldDef::Kind::Radial && def.kind != ForceFieldDef::Kind::Vortex;
        }
        /// 1/s by which it slows what turns.
        double slowing(double h) const;

        bool covers(const Vec2& at) const { return def.region.empty() || region.inside(at); }
        Vec2 acceleration(const Vec2& at, const Vec2& velocity, const Vec2& weight, double h) const;
    };
    static Field made(Index handle, const ForceFieldDef&);
    struct Pull;
    static void act(State&, const RigidStage&, const Field&, Index body, const Vec2& weight, double h);
    static void actOnSurface(Pull&, std::span<const Part>);

    std::vector<Field> fields_;
    std::size_t removed_ = 0;
};

}  // namespace jet::physics
