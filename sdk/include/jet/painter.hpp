// Painter: what effects and items draw to. The window, PNG, SVG export and the web player are painters: draw once,
// appear everywhere. Coordinates are scene units; sizes in pixels say so in their name.
#pragma once

#include <jet/path.hpp>
#include <jet/value.hpp>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace jet {

enum class LineCap { Butt, Round, Square };
enum class LineJoin { Miter, Round, Bevel };

struct Pen {
    Color color;
    double width = 1;       ///< scene units; with `cosmetic`, pixels
    bool cosmetic = false;  ///< same width at every zoom
    LineCap cap = LineCap::Butt;
    LineJoin join = LineJoin::Miter;
    double miterLimit = 4;
    std::vector<double> dashes;  ///< lengths of dash, gap, …, in units of `width`'s unit; empty: solid
    double dashOffset = 0;
};

struct GradientStop {
    double offset = 0;  ///< 0..1
    Color color;
};
struct LinearGradient {
    Vec2 from, to;
    std::vector<GradientStop> stops;
};
struct RadialGradient {
    Vec2 center;
    double radius = 0;
    Vec2 focus;
    std::vector<GradientStop> stops;
};
enum class GradientSpread { Pad, Reflect, Repeat };

struct Brush {
    std::variant<Color, LinearGradient, RadialGradient> fill;
    Affine transform;  ///< gradient space to scene units
    GradientSpread spread = GradientSpread::Pad;

    Brush(Color color) : fill(color) {}
    Brush(LinearGradient gradient) : fill(std::move(gradient)) {}
    Brush(RadialGradient gradient) : fill(std::move(gradient)) {}
};

/// RGBA pixels, 8 bits a channel, not premultiplied, rows top down without padding: [height x width x 4].
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels;
};

enum class TextAlign { Left, Center, Right };

struct TextStyle {
    Color color;
    double size = 12;  ///< em size, scene units; with `cosmetic`, pixels
    bool cosmetic = false;
    bool centered = false;              ///< `at` is the middle of the text instead of the start of its baseline
    std::string family = {};            ///< font family; empty: the surface's own
    TextAlign align = TextAlign::Left;  ///< which part of the baseline `at` is; without meaning when centered
};

/// A drawing surface. save() and restore() nest and cover transform, clip and opacity. [thread that made it]
class JET_API Painter {
public:
    virtual ~Painter();

    virtual void save() = 0;
    virtual void restore() = 0;
    virtual void transform(const Affine& m) = 0;
    virtual void clip(const Path& path, FillRule rule) = 0;
    /// Multiplies the opacity of what follows, object by object.
    virtual void opacity(double factor) = 0;
    virtual void fill(const Path& path, const Brush& brush, FillRule rule = FillRule::NonZero) = 0;
    virtual void stroke(const Path& path, const Pen& pen) = 0;
    virtual void text(const Vec2& at, std::string_view utf8, const TextStyle& style) = 0;
    virtual void image(const Box& where, const Image& image) = 0;
    /// Draws the picture in `file` (PNG, JPEG, ... as the surface can; a path relative to assetFolder(), or absolute)
    /// over the parallelogram that `frame` makes of the unit square. False where it cannot be read. The default, of
    /// surfaces without pictures, draws the frame's outline and diagonals and returns true.
    virtual bool picture(const Affine& frame, std::string_view file);
    /// Device pixels a scene unit takes now: for level of detail and hit sizes.
    virtual double pixelsPerUnit() const = 0;

    /// The folder that relative names of asset files start from; empty: the working directory. Set by paintScene().
    const std::string& assetFolder() const { return assetFolder_; }
    void setAssetFolder(std::string folder) { assetFolder_ = std::move(folder); }

private:
    std::string assetFolder_;
};

}  // namespace jet
