#include "text_font.hpp"

#include <jet/ui/qt_painter.hpp>
#include <jet/ui/text_metrics.hpp>

#include <QFontMetricsF>
#include <QGuiApplication>

namespace jet::ui {

double textWidth(std::string_view utf8, const TextStyle& style)
{
    ensureGuiApplication();
    const QFontMetricsF metrics(textFont(QGuiApplication::font(), style.family, kFontPixels));
    const QString text = QString::fromUtf8(utf8.data(), qsizetype(utf8.size()));
    return metrics.horizontalAdvance(text) * style.size / kFontPixels;
}

}  // namespace jet::ui
