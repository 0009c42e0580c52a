#include "icon_drawing.hpp"

#include <QGuiApplication>
#include <QIconEngine>
#include <QPainter>
#include <QPalette>
#include <QPixmap>

namespace jet::ui {

namespace {

class DrawingEngine final : public QIconEngine {
public:
    explicit DrawingEngine(IconDrawing drawing) : drawing_(std::move(drawing)) {}

    void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override
    {
        const QColor text = textColor(mode);
        painter->save();
        painter->setRenderHint(QPainter::Antialiasing);
        const qreal scale = std::min(rect.width() / drawing_.box.width(), rect.height() / drawing_.box.height());
        painter->translate(QRectF(rect).center());
        painter->scale(scale, scale);
        painter->translate(-drawing_.box.center());
        for (const IconShape& shape : drawing_.shapes) paintShape(*painter, shape, text, mode);
        painter->restore();
    }

    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override
    {
        return scaledPixmap(size, mode, state, 1);
    }

    QPixmap scaledPixmap(const QSize& size, QIcon::Mode mode, QIcon::State state, qreal) override
    {
        QPixmap pixmap(size);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        paint(&painter, pixmap.rect(), mode, state);
        return pixmap;
    }

    QIconEngine* clone() const override { return new DrawingEngine(*this); }

private:
    static QColor textColor(QIcon::Mode mode)
    {
        const QPalette palette = QGuiApplication::palette();
        if (mode == QIcon::Disabled) return palette.color(QPalette::Disabled, QPalette::WindowText);
        return palette.color(mode == QIcon::Selected ? QPalette::HighlightedText : QPalette::WindowText);
    }

    static void paintShape(QPainter& painter, const IconShape& shape, const QColor& text, QIcon::Mode mode)
    {
        // A file's own colours stay, but a disabled icon is pale as a whole.
        const auto colorOf = [&](const QColor& own) { return own.isValid() ? own : text; };
        painter.setOpacity(shape.opacity * (mode == QIcon::Disabled ? 0.6 : 1));
        painter.setBrush(shape.fill ? QBrush(colorOf(*shape.fill)) : QBrush(Qt::NoBrush));
        painter.setPen(shape.stroke
                           ? QPen(colorOf(*shape.stroke), shape.width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin)
                           : QPen(Qt::NoPen));
        painter.drawPath(shape.path);
    }

    IconDrawing drawing_;
};

}  // namespace

QIcon iconOf(IconDrawing drawing)
{
    return QIcon(new DrawingEngine(std::move(drawing)));  // the icon owns its engine
}

}  // namespace jet::ui
