#include "text_items.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace jet::svg {

namespace {

constexpr double kAscent = 0.93, kLineHeight = 1.2;  // of the size, as text items are drawn
constexpr double kMeanWidth = 0.55;                  // of the size: of a letter, where only a guess is needed
constexpr std::size_t kMostRuns = 100'000;           // of one <text>
constexpr double kFarthest = 1e9, kLargest = 1e6;    // scene units

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

double guessedWidth(std::string_view text, double size)
{
    const auto letters = std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; });  // UTF-8
    return kMeanWidth * size * double(letters);
}

/// The first family of a list, without quotes.
std::string firstFamily(std::string_view list)
{
    std::string_view family = trimmed(list.substr(0, list.find(',')));
    if (family.size() >= 2 && (family.front() == '"' || family.front() == '\'')) {
        const std::size_t end = family.find(family.front(), 1);
        family = family.substr(1, end == family.npos ? family.npos : end - 1);
    }
    return std::string(family);
}

/// How far below the point a baseline is that SVG wants elsewhere there; of the size.
double baselineShift(std::string_view baseline)
{
    if (baseline == "middle" || baseline == "central") return 0.33;
    if (baseline == "hanging" || baseline == "text-before-edge" || baseline == "text-top") return 0.76;
    if (baseline == "text-after-edge" || baseline == "ideographic" || baseline == "text-bottom") return -0.22;
    return 0;
}

bool sameLook(const Style& a, const Style& b)
{
    return a.fontSize == b.fontSize && a.fontFamily == b.fontFamily && a.fill.kind == b.fill.kind &&
           a.fill.color == b.fill.color && a.fill.server == b.fill.server && a.fillOpacity == b.fillOpacity &&
           a.opacity == b.opacity && a.anchor == b.anchor && a.visible == b.visible && a.color == b.color;
}

}  // namespace

// Walks the text and its spans, without recursion, and gathers runs.
class TextItems::Reader {
public:
    Reader(TextItems& items, const Place& place) : items_(items), document_(items.document_), lengths_(place.lengths) {}

    std::vector<Run> read(ElementIndex e, const Style& style)
    {
        struct Level {
            pugi::xml_node next;  // what of it is to be read
            Style style;
            bool preserved;
        };
        ElementIndex element = e;  // elements are numbered in the order they are met
        std::vector<Level> open{{document_[e].node.first_child(), style, isPreserved(e, style, false)}};
        place(e, style);
        while (!open.empty() && runs_.size() < kMostRuns) {
            Level& level = open.back();
            const pugi::xml_node node = level.next;
            if (!node) {
                open.pop_back();
                continue;
            }
            level.next = node.next_sibling();
            if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) {
                write(node.value(), level.style, level.preserved);
            } else if (node.type() == pugi::node_element) {
                const ElementIndex child = ++element;
                Style own = enter(child, level.style);
                const bool preserved = isPreserved(child, own, level.preserved);
                Level inner{node.first_child(), std::move(own), preserved};
                if (skips(child, inner.style)) {
                    element = document_[child].next - 1;
                } else {
                    open.push_back(std::move(inner));
                }
            }
        }
        trimEnds();
        return std::move(runs_);
    }

private:
    /// Are all its spaces kept? CSS's white-space has the last word, as in SVG 2.
    bool isPreserved(ElementIndex e, const Style& style, bool around) const
    {
        if (!style.whiteSpace.empty())
            return style.whiteSpace.starts_with("pre") ? style.whiteSpace != "pre-line"
                                                       : style.whiteSpace == "break-spaces";
        const Element& element = document_[e];
        return element.has("xml:space") ? element.attribute("xml:space") == "preserve" : around;
    }

    Style enter(ElementIndex e, const Style& around)
    {
        Style style = items_.styles_.compute(e, around, lengths_);
        style.opacity *= around.opacity;  // what is in a span is in the text, too
        style.baseline = style.baseline == "auto" ? around.baseline : style.baseline;
        return style;
    }

    bool skips(ElementIndex e, const Style& style)
    {
        const std::string_view name = document_[e].name();
        if (!style.display || document_[e].tag == Tag::Description) return true;
        if (name == "textPath") {
            items_.report_.count("text along a path is not drawn", document_.offsetOf(e));
            return true;
        }
        if (name != "tspan" && document_[e].tag != Tag::Anchor) return true;
        place(e, style);
        return false;
    }

    /// Coordinates of a span: those of its first letter count.
    void place(ElementIndex e, const Style& style)
    {
        const Element& element = document_[e];
        LengthContext lengths = lengths_;
        lengths.fontSize = style.fontSize;
        const auto first = [&](const char* name, Axis axis) -> std::optional<double> {
            std::string_view text = element.attribute(name);
            const auto value = takeLength(text, lengths, axis);
            skipCommaSpace(text);
            if (value && !text.empty())
                items_.report_.count("letters that are placed one by one are drawn together", document_.offsetOf(e));
            return value;
        };
        const auto x = first("x", Axis::X), y = first("y", Axis::Y), dx = first("dx", Axis::X),
                   dy = first("dy", Axis::Y);
        if (element.has("rotate"))
            items_.report_.count("letters that are turned one by one are drawn upright", document_.offsetOf(e));
        if (element.has("textLength"))
            items_.report_.count("text that is stretched to a length keeps its own", document_.offsetOf(e));
        if (x) at_.x() = *x;
        if (y) at_.y() = *y;
        if (x || y) shift_ = Vec2(0, 0);
        shift_ += Vec2(dx.value_or(0), dy.value_or(0));
        if (x) isPlaced_ = true;
        if (x || y || dx || dy) isNew_ = true;
    }

    void write(std::string_view text, const Style& style, bool preserved)
    {
        if (runs_.empty() || isNew_ || !sameLook(runs_.back().style, style)) {
            const bool placed = runs_.empty() || isPlaced_;
            runs_.push_back({{}, style, Vec2(at_ + shift_), placed});
            isNew_ = isPlaced_ = false;
            if (placed) lastSpace_ = true;
        }
        std::string& into = runs_.back().text;
        for (const char c : text) {
            if (isSpace(c) && !preserved && lastSpace_) continue;
            lastSpace_ = isSpace(c);
            into += lastSpace_ ? ' ' : c;
        }
        if (preserved) lastSpace_ = false;
    }

    void trimEnds()
    {
        for (std::size_t i = 0; i < runs_.size(); ++i) {
            const bool last = i + 1 == runs_.size() || runs_[i + 1].placed;
            if (last && runs_[i].text.ends_with(' ')) runs_[i].text.pop_back();
        }
        giveSpacesAway();
    }

    /// Runs of nothing but space make no items: their spaces go to the run before in the line, else to the one after.
    void giveSpacesAway()
    {
        std::vector<Run> kept;
        std::size_t lineStart = 0;
        std::optional<Run> blank;  // the line has nothing else so far
        for (Run& run : runs_) {
            if (run.placed) blank.reset(), lineStart = kept.size();
            if (run.text.find_first_not_of(' ') != std::string::npos) {
                if (blank) run.placed = true;
                if (blank && !blank->text.empty()) run.at = blank->at, run.text.insert(0, blank->text);
                blank.reset();
                kept.push_back(std::move(run));
            } else if (kept.size() > lineStart) {
                kept.back().text += run.text;
            } else if (blank) {
                blank->text += run.text;
            } else {
                blank = std::move(run);
            }
        }
        runs_ = std::move(kept);
    }

    TextItems& items_;
    const Document& document_;
    LengthContext lengths_;
    std::vector<Run> runs_;
    Vec2 at_{0, 0}, shift_{0, 0};
    bool isNew_ = false, isPlaced_ = false, lastSpace_ = true;
};

void TextItems::add(ElementIndex e, std::string_view name, const Place& place)
{
    if (!place.toScene.isInvertible()) return;
    Style style = place.style;
    style.opacity = 1;  // in the place's already
    std::vector<Run> runs = Reader(*this, place).read(e, style);
    for (Run& run : runs) run.element = e;
    if (runs.empty()) return;
    arrange(runs);
    const Item* container = place.container;
    if (runs.size() > 1) {
        container = &edit_.add<GroupItem>(*place.container);
        if (!name.empty()) edit_.set(*container, "name", name);
        name = {};
        ++count_;
    }
    for (const Run& run : runs) addItem(run, *container, name, place);
}

// Runs that follow others stand where those are guessed to end.
void TextItems::arrange(std::vector<Run>& runs)
{
    for (std::size_t first = 0; first < runs.size();) {
        std::size_t end = first + 1;
        while (end < runs.size() && !runs[end].placed) ++end;
        if (end - first > 1) {
            report_.count("pieces of text in one line are placed by guessed widths",
                          document_.offsetOf(runs[first].element));
            double width = 0;
            for (std::size_t i = first; i < end; ++i) width += guessedWidth(runs[i].text, runs[i].style.fontSize);
            const std::string_view anchor = runs[first].style.anchor;
            double x = runs[first].at.x() - (anchor == "middle" ? 0.5 : anchor == "end" ? 1 : 0) * width;
            const double start = runs[first].at.x();
            for (std::size_t i = first; i < end; ++i) {
                const double moved = runs[i].at.x() - start;  // by dx
                runs[i].at.x() = x + std::max(0.0, moved);
                runs[i].style.anchor = "start";
                x += guessedWidth(runs[i].text, runs[i].style.fontSize);
            }
        }
        first = end;
    }
}

void TextItems::addItem(const Run& run, const Item& container, std::string_view name, const Place& place)
{
    const Style& style = run.style;
    const std::size_t offset = document_.offsetOf(run.element);
    const double scale = place.toScene.meanScale(), size = style.fontSize * scale;
    if (!(size > 1e-3) || !(size < kLargest)) return;
    const double width = std::max(guessedWidth(run.text, style.fontSize), style.fontSize);
    const double left = style.anchor == "middle" ? 0.5 * width : style.anchor == "end" ? width : 0;
    const Vec2 corner = run.at + Vec2(-left, (baselineShift(style.baseline) - kAscent) * style.fontSize);
    Path frame =
        Path::rectangle(Box(corner, corner + Vec2(width, kLineHeight * style.fontSize))).transformed(place.toScene);
    if (!(frame.bounds().min.cwiseAbs().maxCoeff() < kFarthest)) return;
    const auto linear = place.toScene.linear();
    if (std::abs(linear.col(0).norm() - linear.col(1).norm()) > 1e-3 * scale)
        report_.count("text that is stretched one way is drawn in its own proportions", offset);
    if (style.bold || style.italic) report_.count("bold and italic text is drawn in the regular font", offset);
    if (style.stroke.kind != Paint::Kind::None && style.strokeWidth > 0)
        report_.count("the outline of text is not drawn", offset);

    if (place.shown && style.visible) drawn_.extend(frame.bounds());
    const Item& item = edit_.add<TextItem>(container, std::move(frame));
    ++count_;
    if (!name.empty()) edit_.set(item, "name", name);
    edit_.set(item, "text", run.text);
    edit_.set(item, "size", size);
    edit_.set(item, "align", style.anchor == "middle" ? "center" : style.anchor == "end" ? "right" : "left");
    if (!style.fontFamily.empty()) edit_.set(item, "font", firstFamily(style.fontFamily));
    Color color = paints_.colorOf(style.fill, style, run.element).value_or(Color{0, 0, 0, 0});
    color.a = std::uint8_t(std::lround(color.a * style.fillOpacity * place.opacity * style.opacity));
    edit_.set(item, "color", color);
    if (!place.shown || !style.visible) edit_.set(item, "visible", false);
}

}  // namespace jet::svg
