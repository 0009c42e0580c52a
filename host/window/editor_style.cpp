#include "window/editor_style.hpp"

#include <jet/ui/icons.hpp>

#include <QPainter>
#include <QPainterPath>
#include <QStyleFactory>
#include <QStyleOption>

namespace jet::host {

namespace {

void paintCheckBox(QPainter& painter, const QStyleOption& option)
{
    const bool checked = option.state & QStyle::State_On, partly = option.state & QStyle::State_NoChange;
    const bool enabled = option.state & QStyle::State_Enabled;
    const QPalette::ColorGroup group = enabled ? QPalette::Normal : QPalette::Disabled;
    const QRectF box = QRectF(option.rect).adjusted(0.5, 0.5, -0.5, -0.5);
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    const bool hovered = enabled && (option.state & QStyle::State_MouseOver);
    painter.setPen(option.palette.color(group, hovered ? QPalette::Highlight : QPalette::Mid));
    painter.setBrush(option.palette.color(group, checked ? QPalette::Highlight : QPalette::Base));
    painter.drawRoundedRect(box, 3, 3);
    const QPointF middle = box.center();
    const qreal unit = box.width() / 12;
    QPainterPath mark;
    if (checked) {
        mark.moveTo(middle + unit * QPointF(-3.2, 0.2));
        mark.lineTo(middle + unit * QPointF(-1, 2.6));
        mark.lineTo(middle + unit * QPointF(3.4, -2.6));
    } else if (partly) {
        mark.moveTo(middle + unit * QPointF(-3, 0));
        mark.lineTo(middle + unit * QPointF(3, 0));
    }
    const QPalette::ColorRole ink = checked ? QPalette::HighlightedText : QPalette::Text;
    painter.strokePath(mark,
                       QPen(option.palette.color(group, ink), 1.6 * unit, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.restore();
}

}  // namespace

EditorStyle::EditorStyle() : QProxyStyle(QStyleFactory::create(QStringLiteral("Fusion"))) {}

void EditorStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                                const QWidget* widget) const
{
    if (element == PE_IndicatorCheckBox) return paintCheckBox(*painter, *option);
    QProxyStyle::drawPrimitive(element, option, painter, widget);
}

QIcon EditorStyle::standardIcon(StandardPixmap icon, const QStyleOption* option, const QWidget* widget) const
{
    switch (icon) {
    case SP_TitleBarCloseButton:
    case SP_DockWidgetCloseButton: return ui::icon("close");
    case SP_TitleBarNormalButton:
        return ui::icon("duplicate");  // a window above another: float or dock
    // Fusion's are dark arrows, which nobody sees on dark ground.
    case SP_ToolBarHorizontalExtensionButton: return ui::icon("more-right");
    case SP_ToolBarVerticalExtensionButton: return ui::icon("more-below");
    default: return QProxyStyle::standardIcon(icon, option, widget);
    }
}

int EditorStyle::pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const
{
    if (metric == PM_ToolBarExtensionExtent) return 18;
    return metric == PM_DockWidgetTitleBarButtonMargin ? 4 : QProxyStyle::pixelMetric(metric, option, widget);
}

int EditorStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                           QStyleHintReturn* data) const
{
    // On dark ground the etching of disabled text is a second, brighter text.
    return hint == SH_EtchDisabledText ? 0 : QProxyStyle::styleHint(hint, option, widget, data);
}

}  // namespace jet::host
