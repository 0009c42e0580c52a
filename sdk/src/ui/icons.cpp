#include <jet/ui/icons.hpp>

#include "icon_drawing.hpp"

#include <jet/path.hpp>
#include <jet/ui/qt_painter.hpp>

namespace jet::ui {

namespace {

struct IconData {
    std::string_view name;
    std::string_view lines;  ///< SVG path data on a square of 24, stroked
    std::string_view areas;  ///< the same, filled
};

// Drawn on whole and half units, so that lines of 1.6 look alike at 16, 20 and 24 pixels.
constexpr IconData kIcons[] = {
    {"new", "M 6 3 H 14 L 19 8 V 21 H 6 Z M 14 3 V 8 H 19", ""},
    {"open", "M 3 19 V 5 H 9 L 11 7.5 H 19 V 10 M 3 19 L 6 10 H 22 L 19 19 Z", ""},
    {"save", "M 4 4 H 16.5 L 20 7.5 V 20 H 4 Z M 8 4 V 9 H 15 V 4 M 7 20 V 13 H 17 V 20", ""},
    {"undo", "M 8.5 5 L 4 9.5 L 8.5 14 M 4 9.5 H 14 A 5.2 5.2 0 0 1 14 20 H 9", ""},
    {"redo", "M 15.5 5 L 20 9.5 L 15.5 14 M 20 9.5 H 10 A 5.2 5.2 0 0 0 10 20 H 15", ""},
    {"play", "", "M 7 4 L 20 12 L 7 20 Z"},
    {"pause", "", "M 6 4.5 H 10 V 19.5 H 6 Z M 14 4.5 H 18 V 19.5 H 14 Z"},
    {"stop", "", "M 5.5 5.5 H 18.5 V 18.5 H 5.5 Z"},
    {"step", "M 19 5 V 19", "M 5 5 L 15.5 12 L 5 19 Z"},
    {"eye", "M 2 12 C 5 6.5 8.5 5 12 5 C 15.5 5 19 6.5 22 12 C 19 17.5 15.5 19 12 19 C 8.5 19 5 17.5 2 12 Z",
     "M 15 12 A 3 3 0 1 1 9 12 A 3 3 0 1 1 15 12 Z"},
    {"eye-off", "M 3 10 C 6 14.5 9 16 12 16 C 15 16 18 14.5 21 10 M 6.5 14 L 4.5 17 M 12 16 V 19.5 M 17.5 14 L 19.5 17",
     ""},
    {"lock", "M 8 11 V 7.5 A 4 4 0 0 1 16 7.5 V 11", "M 5.5 11 H 18.5 V 20.5 H 5.5 Z"},
    {"unlock", "M 8 11 V 7 A 4 4 0 0 1 15.5 5.5 M 5.5 11 H 18.5 V 20.5 H 5.5 Z", ""},
    {"plus", "M 12 5 V 19 M 5 12 H 19", ""},
    {"minus", "M 5 12 H 19", ""},
    {"close", "M 6 6 L 18 18 M 18 6 L 6 18", ""},
    {"trash", "M 4 6.5 H 20 M 9 6.5 V 4 H 15 V 6.5 M 6 6.5 L 7 20.5 H 17 L 18 6.5 M 10 10.5 V 16.5 M 14 10.5 V 16.5",
     ""},
    {"up", "M 5 14.5 L 12 7.5 L 19 14.5", ""},
    {"down", "M 5 9.5 L 12 16.5 L 19 9.5", ""},
    {"more-right", "M 5 5 L 12 12 L 5 19 M 12 5 L 19 12 L 12 19", ""},
    {"more-below", "M 5 5 L 12 12 L 19 5 M 5 12 L 12 19 L 19 12", ""},
    {"duplicate", "M 8.5 8.5 H 20 V 20 H 8.5 Z M 15.5 8.5 V 4 H 4 V 15.5 H 8.5", ""},
    {"copy", "M 8.5 8.5 H 20 V 20 H 8.5 Z M 15.5 8.5 V 4 H 4 V 15.5 H 8.5", ""},
    {"cut",
     "M 6 3 L 15.5 16 M 18 3 L 8.5 16 M 9 18 A 2.5 2.5 0 1 1 4 18 A 2.5 2.5 0 1 1 9 18 Z M 20 18 A 2.5 2.5 0 1 1 15 18 "
     "A "
     "2.5 2.5 0 1 1 20 18 Z",
     ""},
    {"paste", "M 8 5 H 5 V 21 H 19 V 5 H 16 M 8.5 3 H 15.5 V 7 H 8.5 Z", ""},
    {"group", "M 3 6.5 H 10 L 12 9 H 21 V 19.5 H 3 Z", ""},
    {"symbol", "M 3 6.5 H 10 L 12 9 H 21 V 19.5 H 3 Z M 12 11.5 L 14.8 14.3 L 12 17.1 L 9.2 14.3 Z", ""},
    {"ungroup", "M 4 4 H 12 V 12 H 4 Z M 12 12 H 20 V 20 H 12 Z", ""},
    {"layer", "M 12 3.5 L 21.5 9 L 12 14.5 L 2.5 9 Z M 3 14 L 12 19.5 L 21 14", ""},
    {"shape", "M 4 9.5 H 14.5 V 20 H 4 Z M 9 9 A 5.5 5.5 0 1 1 15 15", ""},
    {"body", "M 20 12 A 8 8 0 1 1 4 12 A 8 8 0 1 1 20 12 Z M 12 4 V 20 M 4 12 H 20", ""},
    {"script", "M 8.5 6 L 3 12 L 8.5 18 M 15.5 6 L 21 12 L 15.5 18 M 13.5 4.5 L 10.5 19.5", ""},
    {"spring", "M 2 12 H 5 L 7 6 L 10 18 L 13 6 L 16 18 L 18.5 12 H 22", ""},
    {"rspring", "M 4 20 L 19 20 M 4 20 L 15 6 M 12 20 A 8 8 0 0 0 9 13.5", ""},
    {"text", "M 5 8 V 5 H 19 V 8 M 12 5 V 19.5 M 9 19.5 H 15", ""},
    {"image", "M 3 4.5 H 21 V 19.5 H 3 Z M 3 16 L 9 10 L 13 14 L 16 11.5 L 21 16",
     "M 17.6 8 A 1.4 1.4 0 1 1 14.8 8 A 1.4 1.4 0 1 1 17.6 8 Z"},
    {"sound", "M 16.5 8.5 C 18.5 10.5 18.5 13.5 16.5 15.5 M 19 6 C 22.3 9.3 22.3 14.7 19 18",
     "M 3.5 9.5 H 7.5 L 13 5 V 19 L 7.5 14.5 H 3.5 Z"},
    {"torque", "M 19 12 A 7 7 0 1 1 12 5 H 15 M 12.5 1.5 L 16 5 L 12.5 8.5", ""},
    {"effect",
     "M 12 3 L 13.8 9.2 L 20 11 L 13.8 12.8 L 12 19 L 10.2 12.8 L 4 11 L 10.2 9.2 Z M 18.5 16 V 21 M 16 18.5 H 21", ""},
    {"item", "M 5 5 H 19 V 19 H 5 Z", ""},
    {"unknown", "M 8 8.5 A 4 4 0 1 1 12.5 12.5 C 12 13 12 13.5 12 15",
     "M 13.2 18.8 A 1.2 1.2 0 1 1 10.8 18.8 A 1.2 1.2 0 1 1 13.2 18.8 Z"},
    {"import", "M 12 3 V 14 M 7.5 10 L 12 14.5 L 16.5 10 M 4 15 V 20.5 H 20 V 15", ""},
    {"export", "M 12 15 V 4 M 7.5 8 L 12 3.5 L 16.5 8 M 4 15 V 20.5 H 20 V 15", ""},
    {"frame", "M 3 8 V 3 H 8 M 16 3 H 21 V 8 M 21 16 V 21 H 16 M 8 21 H 3 V 16", "M 8.5 8.5 H 15.5 V 15.5 H 8.5 Z"},
    {"grid", "M 3.5 3.5 H 20.5 V 20.5 H 3.5 Z M 9.2 3.5 V 20.5 M 14.8 3.5 V 20.5 M 3.5 9.2 H 20.5 M 3.5 14.8 H 20.5",
     ""},
    {"maximize", "M 4 4 H 20 V 20 H 4 Z M 4 8 H 20", ""},
    {"clear", "M 4 20.5 H 20 M 7 16.5 L 3.5 13 L 13 3.5 L 19.5 10 L 13 16.5 Z M 8 8.5 L 14.5 15", ""},
    {"warning", "M 12 3.5 L 22 20.5 H 2 Z M 12 9.5 V 14.5",
     "M 13.1 17.4 A 1.1 1.1 0 1 1 10.9 17.4 A 1.1 1.1 0 1 1 13.1 17.4 Z"},
    {"scene", "M 3 4.5 H 21 V 19.5 H 3 Z M 3 16 L 9 10 L 13 14 L 16 11.5 L 21 16",
     "M 17.6 8 A 1.4 1.4 0 1 1 14.8 8 A 1.4 1.4 0 1 1 17.6 8 Z"},
    {"edit", "M 4 20 L 5 15.5 L 16 4.5 L 19.5 8 L 8.5 19 Z", ""},
    {"cursor", "M 6 3 L 18.5 12.5 L 12.5 13.5 L 15.5 20 L 13 21 L 10.2 14.7 L 6 18.5 Z", ""},
};

IconDrawing drawingOf(const IconData& data)
{
    IconDrawing drawing;
    const auto outline = [](std::string_view text) { return toQt(Path::parsePrefix(text)); };
    if (!data.areas.empty()) drawing.shapes.push_back({outline(data.areas), QColor(), std::nullopt});
    if (!data.lines.empty()) drawing.shapes.push_back({outline(data.lines), std::nullopt, QColor()});
    return drawing;
}

}  // namespace

QIcon icon(std::string_view name)
{
    for (const IconData& data : kIcons) {
        if (data.name == name) return iconOf(drawingOf(data));
    }
    return {};
}

std::vector<std::string_view> iconNames()
{
    std::vector<std::string_view> names;
    for (const IconData& data : kIcons) names.push_back(data.name);
    return names;
}

}  // namespace jet::ui
