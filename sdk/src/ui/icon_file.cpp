// Icon files: the part of SVG that icons use, so that no SVG plugin of Qt has to be installed.
#include "icon_drawing.hpp"

#include <jet/path.hpp>
#include <jet/ui/icons.hpp>
#include <jet/ui/qt_painter.hpp>

#include <QFile>
#include <QXmlStreamReader>

namespace jet::ui {

namespace {

/// What groups hand down to the shapes in them.
struct Style {
    IconPaint fill = QColor(Qt::black);
    IconPaint stroke;
    qreal width = 1;
    qreal opacity = 1;
};

IconPaint paintOf(const QString& text)
{
    if (text == QLatin1String("none")) return std::nullopt;
    if (text == QLatin1String("currentColor")) return QColor();
    const Result<Color> color = Color::parse(text.toStdString());
    return color ? QColor(color->r, color->g, color->b, color->a) : QColor();
}

Style styleOf(const QXmlStreamAttributes& attributes, Style style)
{
    if (attributes.hasAttribute("fill")) style.fill = paintOf(attributes.value("fill").toString());
    if (attributes.hasAttribute("stroke")) style.stroke = paintOf(attributes.value("stroke").toString());
    if (attributes.hasAttribute("stroke-width")) style.width = attributes.value("stroke-width").toDouble();
    if (attributes.hasAttribute("opacity")) style.opacity *= attributes.value("opacity").toDouble();
    const auto fade = [&](const char* key, IconPaint& paint) {
        const QStringView factor = attributes.value(QLatin1String(key));
        if (!factor.isEmpty() && paint && paint->isValid()) paint->setAlphaF(paint->alphaF() * factor.toFloat());
    };
    fade("fill-opacity", style.fill);
    fade("stroke-opacity", style.stroke);
    return style;
}

QPolygonF pointsOf(const QString& text)
{
    QPolygonF points;
    const std::string bytes = text.toStdString();
    std::string_view rest = bytes;
    const auto next = [&rest](double& value) {
        while (!rest.empty() && (rest.front() == ' ' || rest.front() == ',' || rest.front() == '\n'))
            rest.remove_prefix(1);
        return readNumber(rest, value);
    };
    for (double x = 0, y = 0; next(x) && next(y);) points << QPointF(x, y);
    return points;
}

/// The outline of a shape element; empty for others.
QPainterPath outlineOf(QStringView name, const QXmlStreamAttributes& attributes)
{
    const auto number = [&](const char* key) { return attributes.value(QLatin1String(key)).toDouble(); };
    QPainterPath path;
    if (name == QLatin1String("path")) {
        path = toQt(Path::parsePrefix(attributes.value("d").toString().toStdString()));
    } else if (name == QLatin1String("rect")) {
        path.addRoundedRect(number("x"), number("y"), number("width"), number("height"), number("rx"), number("rx"));
    } else if (name == QLatin1String("circle")) {
        path.addEllipse(QPointF(number("cx"), number("cy")), number("r"), number("r"));
    } else if (name == QLatin1String("ellipse")) {
        path.addEllipse(QPointF(number("cx"), number("cy")), number("rx"), number("ry"));
    } else if (name == QLatin1String("line")) {
        path.moveTo(number("x1"), number("y1"));
        path.lineTo(number("x2"), number("y2"));
    } else if (name == QLatin1String("polyline") || name == QLatin1String("polygon")) {
        path.addPolygon(pointsOf(attributes.value("points").toString()));
        if (name == QLatin1String("polygon")) path.closeSubpath();
    }
    return path;
}

QRectF boxOf(const QXmlStreamAttributes& attributes)
{
    const QPolygonF box = pointsOf(attributes.value("viewBox").toString());
    if (box.size() == 2 && box[1].x() > 0 && box[1].y() > 0) return {box[0], QSizeF(box[1].x(), box[1].y())};
    const qreal width = attributes.value("width").toDouble(), height = attributes.value("height").toDouble();
    return width > 0 && height > 0 ? QRectF(0, 0, width, height) : QRectF(0, 0, 24, 24);
}

}  // namespace

QIcon iconFromFile(const std::filesystem::path& file)
{
    QFile source(QString::fromStdString(file.string()));
    if (!source.open(QIODevice::ReadOnly)) return {};
    IconDrawing drawing;
    std::vector<Style> styles{Style{}};
    for (QXmlStreamReader xml(&source); !xml.atEnd();) {
        switch (xml.readNext()) {
        case QXmlStreamReader::StartElement: {
            if (xml.name() == QLatin1String("svg")) drawing.box = boxOf(xml.attributes());
            const Style style = styleOf(xml.attributes(), styles.back());
            styles.push_back(style);
            QPainterPath path = outlineOf(xml.name(), xml.attributes());
            if (!path.isEmpty()) drawing.shapes.push_back({path, style.fill, style.stroke, style.width, style.opacity});
            break;
        }
        case QXmlStreamReader::EndElement: styles.pop_back(); break;
        default: break;
        }
    }
    return drawing.shapes.empty() ? QIcon() : iconOf(std::move(drawing));
}

}  // namespace jet::ui
