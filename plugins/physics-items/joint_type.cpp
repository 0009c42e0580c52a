// A joint's path: first the point in body A, last the point in body B; between them the pivot, where there is one, else
// the last point. A pulley has four: A, the wheel above it, the wheel above B, B. A point that no body contains holds
// the background.
#include "item_types.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace jet::physics_items {

namespace {

using Kind = JointDef::Kind;

constexpr std::array<std::pair<const char*, Kind>, 9> kKinds{{{"revolute", Kind::Revolute},
                                                              {"prismatic", Kind::Prismatic},
                                                              {"weld", Kind::Weld},
                                                              {"distance", Kind::Distance},
                                                              {"rope", Kind::Rope},
                                                              {"wheel", Kind::Wheel},
                                                              {"motor", Kind::Motor},
                                                              {"mouse", Kind::Mouse},
                                                              {"pulley", Kind::Pulley}}};
constexpr Color kJoint{0, 120, 90, 255};

Kind kindOf(const std::string& name)
{
    for (const auto& [id, kind] : kKinds)
        if (name == id) return kind;
    return Kind::Revolute;
}

/// Joints that hold both bodies at one place.
bool hasPivot(Kind kind)
{
    return kind == Kind::Revolute || kind == Kind::Prismatic || kind == Kind::Weld || kind == Kind::Wheel;
}

Vec2 pivotOf(const Path& path)
{
    const std::size_t count = path.segmentCount();
    return path.segment(count > 2 ? count / 2 : count - 1).point;
}

/// An effect draws it, as a rope or a rod: at play that is all there is to see.
bool hasLook(const Item& item)
{
    return std::any_of(item.effects().begin(), item.effects().end(),
                       [](const EffectInstance& effect) { return effect.visible; });
}

template <class T>
T get(const Item& item, const PropertyTable& table, const char* id)
{
    return item.properties().get(id, table).as<T>();
}

JointDef definition(const Item& item, const PropertyTable& table)
{
    JointDef def;
    def.kind = kindOf(get<std::string>(item, table, "kind"));
    def.axis = get<Vec2>(item, table, "axis");
    def.limited = get<bool>(item, table, "limited");
    def.lower = get<double>(item, table, "lower");
    def.upper = get<double>(item, table, "upper");
    def.driven = get<bool>(item, table, "driven");
    def.motorSpeed = get<double>(item, table, "motor-speed");
    def.motorVelocity = get<Vec2>(item, table, "motor-velocity");
    def.maxForce = get<double>(item, table, "max-force");
    def.maxTorque = get<double>(item, table, "max-torque");
    def.hertz = get<double>(item, table, "hertz");
    def.dampingRatio = get<double>(item, table, "damping-ratio");
    def.length = get<double>(item, table, "length");
    def.ratio = get<double>(item, table, "ratio");
    def.breakForce = get<double>(item, table, "break-force");
    def.collide = get<bool>(item, table, "collide");
    return def;
}

}  // namespace

const PropertyTable& JointType::properties() const
{
    static const PropertyTable table{
        choice("kind", "Kind",
               {"revolute", "prismatic", "weld", "distance", "rope", "wheel", "motor", "mouse", "pulley"}),
        vector("axis", "Axis", {1, 0}).says("Direction of sliding; prismatic and wheel."),
        flag("limited", "Limited", false).says("Keeps the angle or travel between the limits."),
        real("lower", "Lower limit", 0).in("rad or units").range(-1e9, 1e9),
        real("upper", "Upper limit", 0).in("rad or units").range(-1e9, 1e9),
        flag("driven", "Motor on", false),
        real("motor-speed", "Motor speed", 0).in("rad/s or units/s").range(-1e9, 1e9).says("Clockwise is positive."),
        vector("motor-velocity", "Motor velocity", {0, 0}).in("units/s").says("Of a motor joint."),
        real("max-force", "Greatest force", 0).in("mass·unit/s²").range(0, 1e12).says("Of the motor or mouse."),
        real("max-torque", "Greatest torque", 0).in("mass·unit²/s²").range(0, 1e12).says("Of the motor."),
        real("hertz", "Spring frequency", 0).in("Hz").range(0, 1e4).says("0: rigid."),
        real("damping-ratio", "Damping ratio", 1).range(0, 1e3).says("1: critical."),
        real("length", "Length", -1).in("units").range(-1, 1e9).says("Distance and rope; -1: as drawn."),
        real("ratio", "Pulley ratio", 1).range(1e-3, 1e3),
        real("break-force", "Breaks at", 0).in("mass·unit/s²").range(0, 1e12).says("0: never."),
        flag("collide", "Joined bodies collide", false),
        real("radius", "Holds within", 0)
            .in("units")
            .range(0, 1e9)
            .says(
                "Of a soft body: all of it that is no farther from where the joint holds it; 0: only what is nearest."),
    };
    return table;
}

void JointType::paint(const Item& item, const Path& path, PaintPurpose purpose, Painter& painter) const
{
    if (purpose == PaintPurpose::Export || path.segmentCount() < 2) return;
    if (purpose == PaintPurpose::Play && hasLook(item)) return;
    Pen pen;
    pen.color = kJoint;
    pen.width = 2;
    pen.cosmetic = true;
    painter.stroke(path, pen);
    const double pixel = 1 / std::max(painter.pixelsPerUnit(), 1e-9);
    const auto dot = [&](const Vec2& at, double radius) {
        const Vec2 half = Vec2(radius, radius) * pixel;
        painter.fill(Path::ellipse(Box(at - half, at + half)), Brush(kJoint), FillRule::NonZero);
    };
    for (std::size_t i = 0; i < path.segmentCount(); ++i) dot(path.segment(i).point, 3);
    if (hasPivot(kindOf(get<std::string>(item, properties(), "kind")))) dot(pivotOf(path), 5);
}

void JointType::build(const Item& item, WorldBuilder& builder) const
{
    const Path& path = item.path();
    const std::size_t count = path.segmentCount();
    JointDef def = definition(item, properties());
    const std::size_t wanted = def.kind == Kind::Pulley ? 4 : 2;
    if (count < wanted)
        return builder.warn(item, wanted == 4 ? "a pulley needs a path of four points: body, wheel, wheel, body"
                                              : "a joint needs a path with two ends; it does nothing");
    def.a = builder.anchor(item, path.segment(0).point);
    def.b = builder.anchor(item, path.segment(count - 1).point);
    if (def.a.body == def.b.body)
        return builder.warn(item, def.a.body == kNoHandle ? "no body lies under either end; it does nothing"
                                                          : "both ends lie in one body; it does nothing");
    // A mouse joint pulls b: Box2D's moves nothing else.
    if (def.kind == Kind::Mouse && def.b.body == kNoHandle) std::swap(def.a, def.b);
    if (hasPivot(def.kind)) def.a.point = def.b.point = pivotOf(path);
    def.a.radius = def.b.radius = get<double>(item, properties(), "radius");
    if (def.kind == Kind::Pulley) def.groundA = path.segment(1).point, def.groundB = path.segment(count - 2).point;
    try {
        builder.world().addJoint(def);
    } catch (const Failure& failure) {
        builder.warn(item, failure.error().message);
    }
}

}  // namespace jet::physics_items
