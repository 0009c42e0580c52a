// An effect: fills the shape a second time, moved and in one colour, as a shadow.
#include <jet/effect.hpp>
#include <jet/plugin.hpp>

namespace {

class MyPluginEffect final : public jet::Effect {
public:
    // The Inspector, files, undo and scripts follow from this table.
    const jet::PropertyTable& properties() const override
    {
        static const jet::PropertyTable table{
            jet::color("color", "Colour", {0, 0, 0, 96}),
            jet::vector("offset", "Offset", {4, 4}).in("units").range(-1000, 1000),
        };
        return table;
    }

    std::string rejects(const jet::Item& item) const override
    {
        return item.path().isEmpty() ? "A shadow needs a shape, and '" + item.name() + "' has no path." : std::string();
    }

    void paint(const jet::EffectInput& input, const jet::EffectState*, jet::PaintPurpose,
               jet::Painter& painter) const override
    {
        painter.save();
        painter.transform(jet::Affine::translation(input.get<jet::Vec2>("offset")));
        painter.fill(input.path, jet::Brush(input.get<jet::Color>("color")));
        painter.restore();
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.effect<MyPluginEffect>("my-plugin"); }
