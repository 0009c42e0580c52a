#include "png_exporter.hpp"

#include "framing.hpp"

#include <jet/scene_painter.hpp>
#include <jet/ui/qt_painter.hpp>

#include <QBuffer>
#include <QImage>
#include <QPainter>

namespace jet::png {

namespace {

constexpr int kDotsPerMeter = 3780;  // 96 dpi; set, because Qt would ask the screen for it

QColor backgroundOf(const ExportRequest& request)
{
    const std::optional<Color> c = request.background;
    return c ? QColor(c->r, c->g, c->b, c->a) : QColor(Qt::transparent);
}

void draw(const ExportRequest& request, const Frame& frame, QImage& image)
{
    QPainter target(&image);
    ui::QtPainter painter(target);
    painter.transform(frame.toPixels);
    // A game that runs is shown as its player sees it, springs and joints included.
    const PaintPurpose purpose = request.poses ? PaintPurpose::Play : PaintPurpose::Export;
    paintScene(request.scene, request.poses, purpose, frame.visible(), painter);
}

Result<std::vector<std::byte>> encoded(const QImage& image)
{
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    if (!image.save(&buffer, "PNG")) return Error("Qt could not write the picture as PNG.");
    const auto* begin = reinterpret_cast<const std::byte*>(bytes.constData());
    return std::vector<std::byte>(begin, begin + bytes.size());
}

}  // namespace

Result<std::vector<std::byte>> PngExporter::write(const ExportRequest& request)
{
    const Result<Frame> frame = frameOf(request);
    if (!frame) return frame.error();
    QImage image(frame->width, frame->height, QImage::Format_ARGB32_Premultiplied);
    if (image.isNull()) {
        return Error("There is not enough memory for a picture of " + std::to_string(frame->width) + " x " +
                     std::to_string(frame->height) + " pixels. Give a smaller width or height.");
    }
    image.setDotsPerMeterX(kDotsPerMeter);
    image.setDotsPerMeterY(kDotsPerMeter);
    image.fill(backgroundOf(request));
    draw(request, *frame, image);
    if (!request.progress(0.8)) return Error("Writing the picture was cancelled.");
    return encoded(image);
}

}  // namespace jet::png
