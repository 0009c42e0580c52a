#include <jet/catalog.hpp>
#include <jet/item_type.hpp>
#include <jet/ui/text_frame.hpp>
#include <jet/ui/text_metrics.hpp>

#include <algorithm>

namespace jet::ui {

TextStyle textStyleOf(const Item& text)
{
    const PropertyTable& table = builtInItemType(TextItem::type)->properties();
    const auto get = [&](const char* property) { return text.properties().get(property, table); };
    TextStyle style;
    style.family = get("font").as<std::string>();
    style.size = get("size").as<double>();
    style.color = get("color").as<Color>();
    const auto align = get("align").as<std::string>();
    if (align == "center") style.align = TextAlign::Center;
    if (align == "right") style.align = TextAlign::Right;
    return style;
}

bool shapesText(std::string_view property) { return property == "text" || property == "font" || property == "size"; }

Path fittedTextFrame(const Item& text)
{
    const Affine frame = frameOf(text.path());
    const Vec2 right = frame.linear().col(0), down = frame.linear().col(1);
    const double oldWidth = right.norm(), height = down.norm();
    if (!(oldWidth > 0) || !(height > 0)) return text.path();
    const TextStyle style = textStyleOf(text);
    const auto all = text.property("text").value_or(Value(std::string())).as<std::string>();
    double width = kNarrowestText * style.size;
    int lines = 0;
    for (std::size_t begin = 0; begin <= all.size(); ++lines) {
        const std::size_t end = std::min(all.find('\n', begin), all.size());
        width = std::max(width, textWidth(std::string_view(all).substr(begin, end - begin), style));
        begin = end + 1;
    }
    double shift = 0;
    if (style.align == TextAlign::Center) shift = 0.5 * (oldWidth - width);
    if (style.align == TextAlign::Right) shift = oldWidth - width;
    Affine now = frame;
    now.linear().col(0) = right / oldWidth * width;
    now.linear().col(1) = down / height * (lines * kTextLineHeight * style.size);
    now = Affine::translation(right / oldWidth * shift) * now;
    return Path::rectangle(Box({0, 0}, {1, 1})).transformed(now);
}

}  // namespace jet::ui
