// QtPainter: jet::Painter over a QPainter.
#include <jet/ui/qt_painter.hpp>

#include "picture_files.hpp"
#include "qt_convert.hpp"
#include "text_font.hpp"

#include <QFontMetricsF>
#include <QGuiApplication>
#include <QImage>
#include <QPainter>
#include <QPainterPath>

#include <cmath>

namespace jet::ui {

namespace {

QPointF alignment(const QFont& font, const QString& text, const TextStyle& style)
{
    if (!style.centered && style.align == TextAlign::Left) return {};
    const QFontMetricsF metrics(font);
    if (!style.centered) return {(style.align == TextAlign::Center ? -0.5 : -1) * metrics.horizontalAdvance(text), 0};
    return {-0.5 * metrics.horizontalAdvance(text), 0.5 * (metrics.ascent() - metrics.descent())};
}

// A dot: a piece of path without length. SVG gives it a cap all around; Qt draws nothing.
bool isDot(const Contour& contour)
{
    if (contour.segments.empty() || (contour.segments.size() == 1 && !contour.closed)) return false;
    const Vec2 p = contour.segments.front().point;
    for (const Segment& s : contour.segments) {
        if (s.point != p || s.in != p || s.out != p) return false;
    }
    return true;
}

QPainterPath dotsOf(const Path& path, const Pen& pen)
{
    QPainterPath dots;
    dots.setFillRule(Qt::WindingFill);
    const double r = 0.5 * pen.width;
    for (const Contour& contour : path.contours()) {
        if (!isDot(contour)) continue;
        const QPointF p = toQt(contour.segments.front().point);
        const QRectF square(p.x() - r, p.y() - r, pen.width, pen.width);
        pen.cap == LineCap::Round ? dots.addEllipse(square) : dots.addRect(square);
    }
    return dots;
}

}  // namespace

QtPainter::QtPainter(QPainter& target) : target_(target)
{
    target_.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing | QPainter::SmoothPixmapTransform);
}

QtPainter::~QtPainter() = default;

void QtPainter::save() { target_.save(); }
void QtPainter::restore() { target_.restore(); }
void QtPainter::transform(const Affine& m) { target_.setTransform(toQt(m), true); }
void QtPainter::opacity(double factor) { target_.setOpacity(target_.opacity() * factor); }

void QtPainter::clip(const Path& path, FillRule rule)
{
    QPainterPath outline = toQt(path);
    outline.setFillRule(rule == FillRule::EvenOdd ? Qt::OddEvenFill : Qt::WindingFill);
    target_.setClipPath(outline, Qt::IntersectClip);
}

void QtPainter::fill(const Path& path, const Brush& brush, FillRule rule)
{
    QPainterPath outline = toQt(path);
    outline.setFillRule(rule == FillRule::EvenOdd ? Qt::OddEvenFill : Qt::WindingFill);
    target_.fillPath(outline, toQt(brush));
}

void QtPainter::stroke(const Path& path, const Pen& pen)
{
    if (!(pen.width > 0)) return;  // Qt would take a width of 0 for a hair line
    const double length = pen.dashes.empty() ? 0 : path.length() * (pen.cosmetic ? pixelsPerUnit() : 1);
    target_.strokePath(toQt(path), toQt(pen, length));
    if (pen.cap != LineCap::Butt && !pen.cosmetic) target_.fillPath(dotsOf(path, pen), toQt(pen.color));
}

void QtPainter::text(const Vec2& at, std::string_view utf8, const TextStyle& style)
{
    if (!(style.size > 0)) return;
    ensureGuiApplication();  // fonts belong to it
    const QString string = QString::fromUtf8(utf8.data(), qsizetype(utf8.size()));
    const int pixels = style.cosmetic ? std::max(1, int(std::lround(style.size))) : kFontPixels;
    const QFont font = textFont(target_.font(), style.family, pixels);

    target_.save();
    target_.setPen(toQt(style.color));
    if (style.cosmetic) {
        const QPointF where = target_.transform().map(toQt(at));
        target_.setTransform(QTransform::fromTranslate(where.x(), where.y()));
    } else {
        target_.translate(toQt(at));
        target_.scale(style.size / kFontPixels, style.size / kFontPixels);
    }
    target_.setFont(font);
    target_.drawText(alignment(font, string, style), string);
    target_.restore();
}

void QtPainter::image(const Box& where, const Image& image)
{
    if (where.isEmpty() || image.width <= 0 || image.height <= 0) return;
    if (image.pixels.size() < std::size_t(image.width) * std::size_t(image.height) * 4) return;
    const QImage pixels(image.pixels.data(), image.width, image.height, 4 * qsizetype(image.width),
                        QImage::Format_RGBA8888);
    target_.drawImage(QRectF(toQt(where.min), toQt(where.max)), pixels);
}

bool QtPainter::picture(const Affine& frame, std::string_view file)
{
    ensureGuiApplication();
    const QImage pixels = pictureFile(assetFolder(), file);
    if (pixels.isNull()) return false;
    if (!frame.isInvertible()) return true;
    target_.save();
    target_.setTransform(toQt(frame), true);
    target_.drawImage(QRectF(0, 0, 1, 1), pixels);
    target_.restore();
    return true;
}

double QtPainter::pixelsPerUnit() const { return std::sqrt(std::abs(target_.deviceTransform().determinant())); }

void ensureGuiApplication()
{
    if (QCoreApplication::instance()) return;
    // Never destroyed: what painted with it may live as long as the process.
    static int count = 3;
    static char name[] = "jet", option[] = "-platform", platform[] = "offscreen";
    static char* arguments[] = {name, option, platform, nullptr};
    new QGuiApplication(count, arguments);
}

}  // namespace jet::ui
