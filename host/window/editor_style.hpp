// EditorStyle: Fusion with check boxes that can be seen on dark ground, and our own icons on dock titles.
#pragma once

#include <QProxyStyle>

namespace jet::host {

class EditorStyle final : public QProxyStyle {
public:
    EditorStyle();

    void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                       const QWidget* widget) const override;
    QIcon standardIcon(StandardPixmap icon, const QStyleOption* option, const QWidget* widget) const override;
    int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                  QStyleHintReturn* data) const override;
    int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override;
};

}  // namespace jet::host
