// CheckedPainter: draws nothing, and notes the first thing no painter could draw: NaN and infinite numbers, restore()
// without save(), text that is not UTF-8, pictures of another size than they say.
#pragma once

#include <jet/painter.hpp>

#include <string>

namespace jet::host::check {

class CheckedPainter final : public Painter {
public:
    explicit CheckedPainter(double pixelsPerUnit = 1) : pixelsPerUnit_(pixelsPerUnit) {}

    void save() override { ++depth_; }
    void restore() override;
    void transform(const Affine& m) override;
    void clip(const Path& path, FillRule rule) override;
    void opacity(double factor) override;
    void fill(const Path& path, const Brush& brush, FillRule rule) override;
    void stroke(const Path& path, const Pen& pen) override;
    void text(const Vec2& at, std::string_view utf8, const TextStyle& style) override;
    void image(const Box& where, const Image& image) override;
    double pixelsPerUnit() const override { return pixelsPerUnit_; }

    /// A sentence; empty if all was well. Ask when painting is over: a save() must have had its restore().
    std::string problem() const;

private:
    void check(bool fine, const char* what);
    double pixelsPerUnit_;
    int depth_ = 0;
    std::string problem_;
};

}  // namespace jet::host::check
