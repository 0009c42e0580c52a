// A force field's path is its region; an empty one is everywhere. Its centre is that of its bounding box.
#include "item_types.hpp"

namespace jet::physics_items {

namespace {

using Kind = ForceFieldDef::Kind;

constexpr Color kField{90, 60, 200, 255}, kInside{90, 60, 200, 24};
constexpr double kTolerance = 0.25;  // scene units between the curve and the region's sides

Kind kindOf(const std::string& name)
{
    if (name == "radial") return Kind::Radial;
    if (name == "vortex") return Kind::Vortex;
    if (name == "drag") return Kind::Drag;
    if (name == "buoyancy") return Kind::Buoyancy;
    return Kind::Directional;
}

template <class T>
T get(const Item& item, const PropertyTable& table, const char* id)
{
    return item.properties().get(id, table).as<T>();
}

}  // namespace

const PropertyTable& ForceFieldType::properties() const
{
    static const PropertyTable table{
        choice("kind", "Kind", {"directional", "radial", "vortex", "drag", "buoyancy"}),
        vector("vector", "Vector", {0, -100}).in("units/s² or units/s").says("Acceleration, or the wind's velocity."),
        real("strength", "Strength", 1)
            .range(-1e9, 1e9)
            .says("Radial and vortex: units/s²; drag: 1/s; buoyancy: times the weight."),
        real("reach", "Reach", 0)
            .in("units")
            .range(0, 1e9)
            .says("Where radial and vortex halve; 0: the same everywhere."),
        real("drag", "Drag", 0).in("1/s").range(0, 1e9).says("Of water."),
    };
    return table;
}

void ForceFieldType::paint(const Item&, const Path& path, PaintPurpose purpose, Painter& painter) const
{
    if (purpose != PaintPurpose::Edit || path.isEmpty()) return;
    Pen pen;
    pen.color = kField;
    pen.width = 1.5;
    pen.cosmetic = true;
    pen.dashes = {6, 4};
    painter.fill(path, Brush(kInside), FillRule::EvenOdd);
    painter.stroke(path, pen);
}

void ForceFieldType::build(const Item& item, WorldBuilder& builder) const
{
    ForceFieldDef def;
    def.kind = kindOf(get<std::string>(item, properties(), "kind"));
    def.vector = get<Vec2>(item, properties(), "vector");
    def.strength = get<double>(item, properties(), "strength");
    def.reach = get<double>(item, properties(), "reach");
    def.drag = get<double>(item, properties(), "drag");
    if (!item.path().isEmpty()) {
        def.centre = item.path().bounds().center();
        for (const Polyline& line : item.path().flatten(kTolerance))
            if (line.points.size() > 2) def.region.push_back(line.points);
        if (def.region.empty()) return builder.warn(item, "its path encloses nothing; the field does nothing");
    }
    try {
        builder.bind(item, builder.world().addForceField(def));
    } catch (const Failure& failure) {
        builder.warn(item, failure.error().message);
    }
}

}  // namespace jet::physics_items
