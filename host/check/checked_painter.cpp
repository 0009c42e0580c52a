#include "checked_painter.hpp"

#include <cmath>

namespace jet::host::check {

namespace {

bool finite(const std::vector<GradientStop>& stops)
{
    for (const GradientStop& stop : stops)
        if (!std::isfinite(stop.offset)) return false;
    return true;
}

bool finite(const Brush& brush)
{
    if (!brush.transform.matrix().allFinite()) return false;
    if (const auto* linear = std::get_if<LinearGradient>(&brush.fill))
        return isFinite(linear->from) && isFinite(linear->to) && finite(linear->stops);
    if (const auto* radial = std::get_if<RadialGradient>(&brush.fill))
        return isFinite(radial->center) && isFinite(radial->focus) && std::isfinite(radial->radius) &&
               finite(radial->stops);
    return true;
}

bool finite(const Pen& pen)
{
    bool fine = std::isfinite(pen.width) && std::isfinite(pen.miterLimit) && std::isfinite(pen.dashOffset);
    for (const double dash : pen.dashes) fine = fine && std::isfinite(dash);
    return fine;
}

bool isUtf8(std::string_view text)
{
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i++]);
        const int more = lead < 0x80                   ? 0
                         : lead >= 0xc2 && lead < 0xe0 ? 1
                         : lead >= 0xe0 && lead < 0xf0 ? 2
                         : lead >= 0xf0 && lead < 0xf5 ? 3
                                                       : -1;
        if (more < 0) return false;
        for (int n = 0; n < more; ++n, ++i)
            if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return false;
    }
    return true;
}

}  // namespace

void CheckedPainter::check(bool fine, const char* what)
{
    if (!fine && problem_.empty()) problem_ = what;
}

void CheckedPainter::restore()
{
    check(depth_ > 0, "calls restore() without a save()");
    depth_ -= depth_ > 0;
}
void CheckedPainter::transform(const Affine& m) { check(m.matrix().allFinite(), "transforms by NaN or infinity"); }
void CheckedPainter::clip(const Path& path, FillRule)
{
    check(path.isFinite(), "clips to a path with NaN or infinity");
}
void CheckedPainter::opacity(double factor)
{
    check(factor >= 0 && factor <= 1, "sets an opacity that is not within 0 and 1");
}
void CheckedPainter::fill(const Path& path, const Brush& brush, FillRule)
{
    check(path.isFinite(), "fills a path with NaN or infinity");
    check(finite(brush), "fills with a brush that has NaN or infinity");
}
void CheckedPainter::stroke(const Path& path, const Pen& pen)
{
    check(path.isFinite(), "strokes a path with NaN or infinity");
    check(finite(pen), "strokes with a pen that has NaN or infinity");
    check(pen.width >= 0, "strokes with a pen of negative width");
}
void CheckedPainter::text(const Vec2& at, std::string_view utf8, const TextStyle& style)
{
    check(isFinite(at) && std::isfinite(style.size), "writes text at NaN or infinity");
    check(isUtf8(utf8), "writes text that is not UTF-8");
}
void CheckedPainter::image(const Box& where, const Image& image)
{
    check(where.isNull() || (isFinite(where.min) && isFinite(where.max)), "draws a picture at NaN or infinity");
    const auto size =
        static_cast<std::size_t>(std::max(image.width, 0)) * static_cast<std::size_t>(std::max(image.height, 0)) * 4;
    check(image.width >= 0 && image.height >= 0 && image.pixels.size() == size,
          "draws a picture of another size than it says");
}

std::string CheckedPainter::problem() const
{
    if (!problem_.empty()) return problem_;
    return depth_ == 0 ? "" : "calls save() without a restore()";
}

}  // namespace jet::host::check
