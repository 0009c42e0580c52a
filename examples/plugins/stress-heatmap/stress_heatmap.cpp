// Stress heatmap: an effect that draws the springs of a running soft body in the colour of their strain, blue where
// they are pressed, grey at rest, red where they are stretched; torn ones are left out.
#include <jet/effect.hpp>
#include <jet/plugin.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

constexpr int kShades = 15;  // odd: the middle one is "at rest". A stroke a shade, not one a spring

/// From -1, pressed, to 1, stretched.
jet::Color shadeColor(double stress)
{
    constexpr jet::Color kRest{150, 150, 150, 255}, kPressed{30, 90, 255, 255}, kStretched{255, 40, 20, 255};
    const jet::Color& end = stress < 0 ? kPressed : kStretched;
    const double part = std::min(std::abs(stress), 1.0);
    const auto mix = [part](int from, int to) {
        return static_cast<std::uint8_t>(std::lround(from + part * (to - from)));
    };
    return {mix(kRest.r, end.r), mix(kRest.g, end.g), mix(kRest.b, end.b), 255};
}

int shadeOf(double strain, double limit)
{
    const double part = std::clamp(strain / limit, -1.0, 1.0);
    return static_cast<int>(std::lround((part + 1) / 2 * (kShades - 1)));
}

class StressHeatmap final : public jet::Effect {
public:
    const jet::PropertyTable& properties() const override
    {
        static const jet::PropertyTable table{
            jet::real("limit", "Strain of full colour", 0.1).range(1e-6, 100).says("0.1: a tenth longer or shorter."),
            jet::real("width", "Line width", 1.5).in("pixels").range(0.1, 100),
        };
        return table;
    }

    // Asks for EffectInput::body.
    bool wantsLiveBody() const override { return true; }

    void paint(const jet::EffectInput& input, const jet::EffectState*, jet::PaintPurpose,
               jet::Painter& painter) const override
    {
        if (!input.body) return;  // while editing there is no stress
        const double limit = input.get<double>("limit");
        std::array<jet::Path, kShades> shades;
        for (const jet::LiveSpring& spring : input.body->springs) {
            if (!spring.whole) continue;
            jet::Path& path = shades[static_cast<std::size_t>(shadeOf(input.body->strain(spring), limit))];
            path.moveTo(input.body->particles[spring.a]);
            path.lineTo(input.body->particles[spring.b]);
        }
        jet::Pen pen;
        pen.width = input.get<double>("width");
        pen.cosmetic = true;
        for (int i = 0; i < kShades; ++i) {
            const jet::Path& path = shades[static_cast<std::size_t>(i)];
            if (path.isEmpty()) continue;
            pen.color = shadeColor(2.0 * i / (kShades - 1) - 1);
            painter.stroke(path, pen);
        }
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.effect<StressHeatmap>("stress-heatmap"); }
