// RecordingPainter: a Painter that notes what is drawn, in scene units, for tests to look at.
//
//   RecordingPainter painter;
//   effect.paint(input, nullptr, PaintPurpose::Edit, painter);
//   ASSERT_EQ(painter.fills().size(), 1u);
//   EXPECT_EQ(painter.fills()[0].path, rectangle);
#pragma once

#include <jet/painter.hpp>

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace jet::test {

/// One drawing call. Paths and points have the painter's transforms applied.
struct Drawn {
    enum class Kind { Fill, Stroke, Text, Image } kind;
    Path path;                   ///< Fill, Stroke; of an Image its rectangle
    std::optional<Brush> brush;  ///< Fill
    FillRule rule = FillRule::NonZero;
    Pen pen;           ///< Stroke
    std::string text;  ///< Text
    Vec2 at;           ///< Text
    TextStyle style;   ///< Text
    double opacity = 1;

    /// The colour of a fill with one, of a stroke or of a text.
    Color color() const
    {
        if (kind == Kind::Fill) return std::get<Color>(brush->fill);
        return kind == Kind::Stroke ? pen.color : style.color;
    }
};

class RecordingPainter final : public Painter {
public:
    explicit RecordingPainter(double pixelsPerUnit = 1) : pixelsPerUnit_(pixelsPerUnit) {}

    void save() override { stack_.push_back(state_); }
    void restore() override
    {
        if (stack_.empty()) std::abort();  // a restore() without a save()
        state_ = stack_.back();
        stack_.pop_back();
    }
    void transform(const Affine& m) override { state_.transform = Affine(state_.transform * m); }
    void clip(const Path& path, FillRule) override { clips_.push_back(placed(path)); }
    void opacity(double factor) override { state_.opacity *= factor; }
    void fill(const Path& path, const Brush& brush, FillRule rule) override
    {
        Drawn& d = add(Drawn::Kind::Fill);
        d.path = placed(path), d.brush = brush, d.rule = rule;
    }
    void stroke(const Path& path, const Pen& pen) override
    {
        Drawn& d = add(Drawn::Kind::Stroke);
        d.path = placed(path), d.pen = pen;
    }
    void text(const Vec2& at, std::string_view utf8, const TextStyle& style) override
    {
        Drawn& d = add(Drawn::Kind::Text);
        d.at = state_.transform * at, d.text = utf8, d.style = style;
    }
    void image(const Box& where, const Image&) override
    {
        add(Drawn::Kind::Image).path = placed(Path::rectangle(where));
    }
    double pixelsPerUnit() const override { return pixelsPerUnit_ * state_.transform.meanScale(); }

    const std::vector<Drawn>& drawn() const { return drawn_; }
    std::vector<Drawn> fills() const { return of(Drawn::Kind::Fill); }
    std::vector<Drawn> strokes() const { return of(Drawn::Kind::Stroke); }
    std::vector<Drawn> texts() const { return of(Drawn::Kind::Text); }
    std::vector<Drawn> images() const { return of(Drawn::Kind::Image); }
    /// The paths of all clip() calls, also of those that restore() ended.
    const std::vector<Path>& clips() const { return clips_; }
    bool isEmpty() const { return drawn_.empty(); }
    /// The smallest box around the paths that were filled, stroked or covered by a picture; pens have no width here.
    Box bounds() const
    {
        Box box;
        for (const Drawn& d : drawn_)
            if (!d.path.isEmpty()) box.extend(d.path.bounds());
        return box;
    }
    /// Is each save() matched by a restore()?
    bool balanced() const { return stack_.empty(); }

private:
    struct State {
        Affine transform;
        double opacity = 1;
    };

    Drawn& add(Drawn::Kind kind)
    {
        drawn_.push_back({});
        drawn_.back().kind = kind;
        drawn_.back().opacity = state_.opacity;
        return drawn_.back();
    }
    Path placed(const Path& path) const
    {
        return state_.transform.isIdentity() ? path : path.transformed(state_.transform);
    }
    std::vector<Drawn> of(Drawn::Kind kind) const
    {
        std::vector<Drawn> found;
        for (const Drawn& d : drawn_)
            if (d.kind == kind) found.push_back(d);
        return found;
    }

    double pixelsPerUnit_;
    State state_;
    std::vector<State> stack_;
    std::vector<Drawn> drawn_;
    std::vector<Path> clips_;
};

}  // namespace jet::test
