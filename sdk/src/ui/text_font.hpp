// The font that text is set with; shared by drawing and measuring, so that both agree.
#pragma once

#include <QFont>

#include <string>

namespace jet::ui {

/// Fonts have whole pixel sizes in Qt: text in scene units is set at this size and scaled.
inline constexpr int kFontPixels = 128;

inline QFont textFont(QFont base, const std::string& family, int pixels)
{
    base.setHintingPreference(QFont::PreferNoHinting);
    if (!family.empty()) base.setFamily(QString::fromStdString(family));
    base.setPixelSize(pixels);
    return base;
}

}  // namespace jet::ui
