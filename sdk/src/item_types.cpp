// The item types every scene knows (SPEC IT1-IT9, images and text): their properties, their look while editing, what
// they add to a simulation.
#include <jet/catalog.hpp>
#include <jet/item_type.hpp>

#include <algorithm>
#include <array>
#include <numbers>

namespace jet {

namespace {

/// At play what an effect draws of a spring is its look; without one it is seen as while editing.
bool helperShows(const Item& item, PaintPurpose purpose)
{
    if (purpose == PaintPurpose::Edit) return true;
    return purpose == PaintPurpose::Play && std::none_of(item.effects().begin(), item.effects().end(),
                                                         [](const EffectInstance& effect) { return effect.visible; });
}

class PlainType : public ItemType {
public:
    PlainType(std::string label, PropertyTable table) : label_(std::move(label)), table_(std::move(table)) {}
    const PropertyTable& properties() const override { return table_; }
    std::string label() const override { return label_; }

protected:
    template <class T>
    T get(const Item& item, std::string_view property) const
    {
        return item.properties().get(property, table_).as<T>();
    }

private:
    std::string label_;
    PropertyTable table_;
};

constexpr Color kOutline{120, 120, 128, 255};
constexpr Color kActuator{176, 64, 0, 255};
constexpr Color kFrame{120, 120, 128, 120};
constexpr Color kMissing{200, 0, 120, 255};

Pen cosmeticPen(Color color, double pixels)
{
    Pen pen;
    pen.color = color;
    pen.width = pixels;
    pen.cosmetic = true;
    return pen;
}

/// A shape without any effect would be invisible: while editing, its outline shows.
class ShapeType final : public PlainType {
public:
    using PlainType::PlainType;
    void paint(const Item& item, const Path& path, PaintPurpose purpose, Painter& painter) const override
    {
        if (purpose != PaintPurpose::Edit) return;
        for (const EffectInstance& effect : item.effects())
            if (effect.visible) return;
        painter.stroke(path, cosmeticPen(kOutline, 1));
    }
};

PropertyTable springProperties()
{
    return PropertyTable{
        real("ks", "Stiffness ks", 10).in("force/unit").range(0, 1e9),
        real("kd", "Damping kd", 0.1).in("force·s/unit").range(0, 1e9),
        real("rest-length", "Rest length", -1).in("units").range(-1, 1e9).says("-1: the length as drawn."),
        real("tear-ratio", "Tears at", 0).in("× rest length").range(0, 1e6).says("0: never tears."),
    };
}

/// One item that the engine refuses does not keep the scene from playing.
template <class Add>
void bindOrWarn(const Item& item, WorldBuilder& builder, Add&& add)
{
    try {
        builder.bind(item, add());
    } catch (const Failure& failure) {
        builder.warn(item, failure.error().message + " It does nothing.");
    }
}

/// Ends = first and last segment of the path (thesis §3.4.6).
class SpringType final : public PlainType {
public:
    SpringType() : PlainType("Spring", springProperties()) {}
    void paint(const Item& item, const Path& path, PaintPurpose purpose, Painter& painter) const override
    {
        if (helperShows(item, purpose)) painter.stroke(path, cosmeticPen(kActuator, 2));
    }
    void build(const Item& item, WorldBuilder& builder) const override
    {
        const std::size_t count = item.path().segmentCount();
        if (count < 2) return builder.warn(item, "a spring needs a path with two ends; it does nothing");
        SpringActuatorDef def;
        def.a = builder.anchor(item, item.path().segment(0).point);
        def.b = builder.anchor(item, item.path().segment(count - 1).point);
        def.ks = get<double>(item, "ks");
        def.kd = get<double>(item, "kd");
        def.restLength = get<double>(item, "rest-length");
        def.tearRatio = get<double>(item, "tear-ratio");
        bindOrWarn(item, builder, [&] { return builder.world().addSpring(def); });
    }
};

class AngularSpringType final : public PlainType {
public:
    AngularSpringType()
        : PlainType(
              "Angular spring",
              PropertyTable{
                  real("ks", "Stiffness ks", 1000).in("torque/rad").range(0, 1e12),
                  real("kd", "Damping kd", 10).in("torque·s/rad").range(0, 1e12),
                  flag("rest-as-drawn", "Rest angle as drawn", true),
                  real("rest-angle", "Rest angle", 0).in("rad").range(-4 * std::numbers::pi, 4 * std::numbers::pi),
              })
    {
    }
    void paint(const Item& item, const Path& path, PaintPurpose purpose, Painter& painter) const override
    {
        if (helperShows(item, purpose)) painter.stroke(path, cosmeticPen(kActuator, 2));
    }
    void build(const Item& item, WorldBuilder& builder) const override
    {
        const std::size_t count = item.path().segmentCount();
        if (count < 3) return builder.warn(item, "an angular spring needs a path with three points; it does nothing");
        AngularSpringActuatorDef def;
        def.a = builder.anchor(item, item.path().segment(0).point);
        def.centre = builder.anchor(item, item.path().segment(count / 2).point);
        def.b = builder.anchor(item, item.path().segment(count - 1).point);
        def.ks = get<double>(item, "ks");
        def.kd = get<double>(item, "kd");
        def.restFromPose = get<bool>(item, "rest-as-drawn");
        def.restAngle = get<double>(item, "rest-angle");
        bindOrWarn(item, builder, [&] { return builder.world().addAngularSpring(def); });
    }
};

/// Point of action = centre of the bounding box, drawn as a dot (thesis §3.4.7).
class TorqueType final : public PlainType {
public:
    TorqueType()
        : PlainType("Torque", PropertyTable{real("value", "Torque", 0)
                                                .in("force·unit")
                                                .range(-1e12, 1e12)
                                                .says("Positive turns left, negative right.")})
    {
    }
    void paint(const Item&, const Path& path, PaintPurpose purpose, Painter& painter) const override
    {
        if (purpose != PaintPurpose::Edit || path.isEmpty()) return;
        painter.stroke(path, cosmeticPen(kActuator, 2));
        const double r = 3 / std::max(painter.pixelsPerUnit(), 1e-9);
        const Vec2 centre = path.bounds().center();
        painter.fill(Path::ellipse(Box(centre - Vec2(r, r), centre + Vec2(r, r))), Brush(kActuator), FillRule::NonZero);
    }
    void build(const Item& item, WorldBuilder& builder) const override
    {
        if (item.path().isEmpty())
            return builder.warn(item, "a torque needs a path to tell where it acts; it does nothing");
        TorqueActuatorDef def;
        def.at = builder.anchor(item, item.path().bounds().center());
        if (def.at.body == kNoHandle)
            return builder.warn(item, "no body lies under the torque's centre; it does nothing");
        def.value = -get<double>(item, "value");  // the world counts clockwise on screen
        bindOrWarn(item, builder, [&] { return builder.world().addTorque(def); });
    }
};

PropertyTable bodyProperties()
{
    return PropertyTable{
        flag("fixed", "Fixed", false).says("Never moves; collides with everything that does."),
        text("material", "Material", "").says("Name in the scene's table of materials; empty: the first."),
        vector("velocity", "Start velocity", {0, 0}).in("units/s"),
        real("omega", "Start spin", 0).in("rad/s").range(-1e6, 1e6),
        real("gravity-scale", "Gravity scale", 1).range(-1e6, 1e6),
        flag("sensor", "Sensor", false).says("Reports contacts without being pushed."),
        flag("kinematic", "Kinematic", false).says("Moves with its velocity and spin, and nothing pushes it."),
        flag("fixed-rotation", "Never turns", false),
        vector("one-sided", "One-sided", {0, 0})
            .says("A platform: holds only what comes against this direction, as 0 -1 for what falls; 0 0: all sides."),
        integer("group", "Group", 0).range(0, 1e6).says("Bodies of one group above 0 pass each other."),
        integer("layer", "Layers", 1).range(0, 4294967295.0).says("The layers it is on: the sum of 1, 2, 4, 8, …"),
        integer("mask", "Meets layers", 4294967295)
            .range(0, 4294967295.0)
            .says("The layers it collides with, as such a sum; both bodies must agree."),
        flag("allow-sleep", "May sleep", true).says("May it be left out of the computation while it rests?"),
    };
}

/// Lines of a text item, one below the other from the frame's top.
class TextType final : public PlainType {
public:
    TextType()
        : PlainType("Text", PropertyTable{
                                text("text", "Text", "Text", true),
                                text("font", "Font", "").says("Family, such as DejaVu Sans; empty: the usual one."),
                                real("size", "Size", 24).in("units").range(1e-3, 1e6).says("Of the letter M."),
                                color("color", "Color", Color{0, 0, 0, 255}),
                                choice("align", "Alignment", {"left", "center", "right"}),
                            })
    {
    }
    void paint(const Item& item, const Path& path, PaintPurpose purpose, Painter& painter) const override
    {
        if (path.isEmpty()) return;
        if (purpose == PaintPurpose::Edit) painter.stroke(path, cosmeticPen(kFrame, 1));
        const Affine frame = frameOf(path);
        const Vec2 right = frame.linear().col(0), down = frame.linear().col(1);
        const double width = right.norm(), height = down.norm();
        if (!(width > 0) || !(height > 0)) return;
        Affine upright = frame;  // turns as the frame does, but letters keep their size
        upright.linear().col(0) = right / width;
        upright.linear().col(1) = down / height;
        painter.save();
        painter.transform(upright);
        paintLines(item, width, painter);
        painter.restore();
    }

private:
    static constexpr double kAscent = 0.93, kLineHeight = 1.2;  // of the size

    void paintLines(const Item& item, double width, Painter& painter) const
    {
        TextStyle style;
        style.color = get<Color>(item, "color");
        style.size = get<double>(item, "size");
        style.family = get<std::string>(item, "font");
        const auto align = get<std::string>(item, "align");
        double x = 0;
        if (align == "center") style.align = TextAlign::Center, x = 0.5 * width;
        if (align == "right") style.align = TextAlign::Right, x = width;
        const auto all = get<std::string>(item, "text");
        double y = kAscent * style.size;
        for (std::size_t begin = 0; begin <= all.size(); y += kLineHeight * style.size) {
            const std::size_t end = std::min(all.find('\n', begin), all.size());
            if (end > begin) painter.text({x, y}, std::string_view(all).substr(begin, end - begin), style);
            begin = end + 1;
        }
    }
};

class ImageType final : public PlainType {
public:
    ImageType()
        : PlainType("Image", PropertyTable{
                                 text("file", "File", "").says("PNG or JPEG, from the project's folder."),
                                 real("opacity", "Opacity", 1).range(0, 1),
                             })
    {
    }
    void paint(const Item& item, const Path& path, PaintPurpose purpose, Painter& painter) const override
    {
        if (path.isEmpty()) return;
        painter.save();
        painter.opacity(get<double>(item, "opacity"));
        const bool drawn = painter.picture(frameOf(path), get<std::string>(item, "file"));
        painter.restore();
        if (drawn || purpose != PaintPurpose::Edit) return;
        painter.stroke(path, cosmeticPen(kMissing, 1.5));  // the file cannot be read: the place shows while editing
        painter.text(path.bounds().center(), get<std::string>(item, "file"), TextStyle{kMissing, 12, true, true});
    }
};

/// Shown while editing as a loudspeaker in its frame.
class SoundType final : public PlainType {
public:
    SoundType()
        : PlainType("Sound", PropertyTable{
                                 text("file", "File", "").says("WAV or OGG, from the project's folder."),
                                 real("volume", "Volume", 1).range(0, 1),
                                 flag("loop", "Loop", false),
                                 flag("autoplay", "Plays at start", false).says("When play starts."),
                             })
    {
    }
    void paint(const Item&, const Path& path, PaintPurpose purpose, Painter& painter) const override
    {
        if (purpose != PaintPurpose::Edit || path.isEmpty()) return;
        const Affine frame = frameOf(path);
        const auto at = [&](double x, double y) -> Vec2 { return frame * Vec2(x, y); };
        const std::array horn{at(0.2, 0.4), at(0.4, 0.4), at(0.65, 0.2), at(0.65, 0.8), at(0.4, 0.6), at(0.2, 0.6)};
        painter.fill(Path::polygon(horn), Brush(kActuator), FillRule::NonZero);
        Path wave;
        wave.moveTo(at(0.75, 0.35));
        wave.quadTo(at(0.9, 0.5), at(0.75, 0.65));
        painter.stroke(wave, cosmeticPen(kActuator, 2));
    }
};

struct BuiltIn {
    std::string_view id;
    std::unique_ptr<ItemType> type;
};

const std::array<BuiltIn, 11>& builtIns()
{
    static const std::array<BuiltIn, 11> all{{
        {GroupItem::type, std::make_unique<PlainType>("Group", PropertyTable{})},
        {LayerItem::type, std::make_unique<PlainType>("Layer", PropertyTable{})},
        {ShapeItem::type, std::make_unique<ShapeType>("Shape", PropertyTable{})},
        {BodyItem::type, std::make_unique<ShapeType>("Body", bodyProperties())},
        {ScriptItem::type,
         std::make_unique<PlainType>("Script",
                                     PropertyTable{text("code", "Code", "", true).says("JavaScript, run at play.")})},
        {SpringItem::type, std::make_unique<SpringType>()},
        {RSpringItem::type, std::make_unique<AngularSpringType>()},
        {TorqueItem::type, std::make_unique<TorqueType>()},
        {SoundItem::type, std::make_unique<SoundType>()},
        {ImageItem::type, std::make_unique<ImageType>()},
        {TextItem::type, std::make_unique<TextType>()},
    }};
    return all;
}

}  // namespace

const ItemType* builtInItemType(std::string_view id)
{
    for (const BuiltIn& one : builtIns())
        if (one.id == id) return one.type.get();
    return nullptr;
}

std::vector<std::string_view> builtInItemTypeIds()
{
    std::vector<std::string_view> ids;
    for (const BuiltIn& one : builtIns()) ids.push_back(one.id);
    return ids;
}

}  // namespace jet
