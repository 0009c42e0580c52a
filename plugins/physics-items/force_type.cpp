// A constant force: it acts at the centre of its path's bounding box, on the body that lies there, in the direction of
// the scene that its value has, however the body turns.
#include "item_types.hpp"

#include <algorithm>
#include <array>

namespace jet::physics_items {

namespace {

constexpr Color kForce{200, 90, 0, 255};
constexpr double kArrow = 40, kHead = 7;  // pixels

Vec2 valueOf(const Item& item, const PropertyTable& table) { return item.properties().get("value", table).as<Vec2>(); }

}  // namespace

const PropertyTable& ForceType::properties() const
{
    static const PropertyTable table{
        vector("value", "Force", {0, 0})
            .in("mass·unit/s²")
            .range(-1e12, 1e12)
            .says("In the directions of the scene: y grows downwards."),
    };
    return table;
}

/// As a torque: its path, and a dot where it acts; and an arrow of fixed length in its direction.
void ForceType::paint(const Item& item, const Path& path, PaintPurpose purpose, Painter& painter) const
{
    if (purpose != PaintPurpose::Edit || path.isEmpty()) return;
    Pen pen;
    pen.color = kForce;
    pen.width = 2;
    pen.cosmetic = true;
    painter.stroke(path, pen);
    const double pixel = 1 / std::max(painter.pixelsPerUnit(), 1e-9);
    const Vec2 centre = path.bounds().center(), half = 3 * pixel * Vec2(1, 1);
    painter.fill(Path::ellipse(Box(centre - half, centre + half)), Brush(kForce), FillRule::NonZero);
    const Vec2 value = valueOf(item, properties());
    if (!(value.norm() > 0)) return;
    const Vec2 along = value.normalized(), across = perpendicular(along);
    const Vec2 tip = centre + kArrow * pixel * along, neck = tip - kHead * pixel * along;
    painter.stroke(Path::line(centre, neck), pen);
    painter.fill(Path::polygon(std::array{tip, Vec2(neck + 0.6 * kHead * pixel * across),
                                          Vec2(neck - 0.6 * kHead * pixel * across)}),
                 Brush(kForce), FillRule::NonZero);
}

void ForceType::build(const Item& item, WorldBuilder& builder) const
{
    if (item.path().isEmpty()) return builder.warn(item, "a force needs a path to tell where it acts; it does nothing");
    ForceActuatorDef def;
    def.at = builder.anchor(item, item.path().bounds().center());
    if (def.at.body == kNoHandle) return builder.warn(item, "no body lies under the force's centre; it does nothing");
    def.force = valueOf(item, properties());
    try {
        builder.bind(item, builder.world().addForce(def));
    } catch (const Failure& failure) {
        builder.warn(item, failure.error().message);
    }
}

}  // namespace jet::physics_items
