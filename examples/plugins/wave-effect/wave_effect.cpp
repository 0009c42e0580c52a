// Wave effect: strokes an item's outline as a sine wave about it. The wave is computed once for each change of the
// item, in update(), and kept by the host until the item, its path or a property changes.
#include <jet/effect.hpp>
#include <jet/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

constexpr int kPointsPerWave = 16;
constexpr std::size_t kMostPoints = 100'000;

/// A point and the direction of the way there.
struct Place {
    jet::Vec2 point, along;
};

/// Walks along a polyline.
class Walker {
public:
    explicit Walker(const jet::Polyline& line) : points_(line.points)
    {
        if (line.closed) points_.push_back(points_.front());
        for (std::size_t i = 1; i < points_.size(); ++i) length_ += (points_[i] - points_[i - 1]).norm();
    }

    double length() const { return length_; }

    /// Distances must not shrink from call to call.
    Place at(double distance)
    {
        while (next_ + 1 < points_.size() && behind_ + step() < distance) behind_ += step(), ++next_;
        const jet::Vec2 along = (points_[next_] - points_[next_ - 1]).normalized();
        return {points_[next_ - 1] + (distance - behind_) * along, along};
    }

private:
    double step() const { return (points_[next_] - points_[next_ - 1]).norm(); }

    std::vector<jet::Vec2> points_;
    double length_ = 0, behind_ = 0;
    std::size_t next_ = 1;
};

jet::Path wave(const jet::Path& path, double amplitude, double wavelength)
{
    std::vector<jet::Contour> contours;
    for (const jet::Polyline& line : path.flatten(std::max(amplitude, wavelength) / 100)) {
        if (line.points.size() < 2) continue;
        Walker walker(line);
        // A closed outline takes a whole number of waves, so that the end meets the start.
        const double waves =
            line.closed ? std::max(1.0, std::round(walker.length() / wavelength)) : walker.length() / wavelength;
        const auto count = std::clamp<std::size_t>(static_cast<std::size_t>(waves * kPointsPerWave), 2, kMostPoints);
        jet::Contour contour;
        contour.closed = line.closed;
        for (std::size_t i = 0; i < count + (line.closed ? 0 : 1); ++i) {
            const double part = static_cast<double>(i) / static_cast<double>(count);
            const Place place = walker.at(part * walker.length());
            const double height = amplitude * std::sin(2 * std::numbers::pi * waves * part);
            contour.segments.emplace_back(jet::Vec2(place.point + height * jet::perpendicular(place.along)));
        }
        contours.push_back(std::move(contour));
    }
    return jet::Path(std::move(contours));
}

struct WaveState final : jet::EffectState {
    jet::Path path;
};

class WaveEffect final : public jet::Effect {
public:
    const jet::PropertyTable& properties() const override
    {
        static const jet::PropertyTable table{
            jet::color("color", "Colour", {30, 110, 200, 255}),
            jet::real("width", "Line width", 1.5).in("units").range(0.01, 1000),
            jet::real("amplitude", "Amplitude", 3).in("units").range(0, 1000),
            jet::real("wavelength", "Wavelength", 12).in("units").range(0.1, 1e5),
        };
        return table;
    }

    std::unique_ptr<jet::EffectState> update(const jet::EffectInput& input) const override
    {
        auto state = std::make_unique<WaveState>();
        state->path = waveOf(input);
        return state;
    }

    void paint(const jet::EffectInput& input, const jet::EffectState* state, jet::PaintPurpose,
               jet::Painter& painter) const override
    {
        jet::Pen pen;
        pen.color = input.get<jet::Color>("color");
        pen.width = input.get<double>("width");
        pen.join = jet::LineJoin::Round;
        // Without a state (at play the path is another in each frame) it is computed here.
        painter.stroke(state ? static_cast<const WaveState*>(state)->path : waveOf(input), pen);
    }

private:
    static jet::Path waveOf(const jet::EffectInput& input)
    {
        return wave(input.path, input.get<double>("amplitude"), input.get<double>("wavelength"));
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.effect<WaveEffect>("wave"); }
