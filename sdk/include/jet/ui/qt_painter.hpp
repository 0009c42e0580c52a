// QtPainter: the SDK's Painter over a QPainter, for the window, pictures and plugins' widgets.
#pragma once

#include <jet/painter.hpp>

#include <memory>

class QPainter;
class QPainterPath;
class QTransform;

namespace jet::ui {

/// Draws to a QPainter that outlives it. Antialiased. [the QPainter's thread]
class JET_API QtPainter final : public Painter {
public:
    explicit QtPainter(QPainter& target);
    ~QtPainter() override;

    void save() override;
    void restore() override;
    void transform(const Affine& m) override;
    void clip(const Path& path, FillRule rule) override;
    void opacity(double factor) override;
    void fill(const Path& path, const Brush& brush, FillRule rule) override;
    void stroke(const Path& path, const Pen& pen) override;
    void text(const Vec2& at, std::string_view utf8, const TextStyle& style) override;
    void image(const Box& where, const Image& image) override;
    bool picture(const Affine& frame, std::string_view file) override;
    double pixelsPerUnit() const override;

private:
    QPainter& target_;
};

JET_API QPainterPath toQt(const Path& path);
JET_API QTransform toQt(const Affine& m);

/// Makes sure fonts and images can be painted without a window: starts an offscreen QGuiApplication if there is none.
/// [main thread]
JET_API void ensureGuiApplication();

}  // namespace jet::ui
