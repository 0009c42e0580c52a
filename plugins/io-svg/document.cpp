#include "document.hpp"

#include <algorithm>

namespace jet::svg {

namespace {

constexpr std::string_view kNamespace = "http://www.w3.org/2000/svg";

std::string_view prefixOf(std::string_view name)
{
    const std::size_t colon = name.find(':');
    return colon == name.npos ? std::string_view() : name.substr(0, colon);
}

std::string_view localName(std::string_view name)
{
    const std::size_t colon = name.find(':');
    return colon == name.npos ? name : name.substr(colon + 1);
}

Tag tagOf(std::string_view name)
{
    static const std::unordered_map<std::string_view, Tag> tags = {{"svg", Tag::Svg},
                                                                   {"g", Tag::Group},
                                                                   {"a", Tag::Anchor},
                                                                   {"switch", Tag::Switch},
                                                                   {"use", Tag::Use},
                                                                   {"symbol", Tag::Symbol},
                                                                   {"defs", Tag::Defs},
                                                                   {"style", Tag::Style},
                                                                   {"path", Tag::Path},
                                                                   {"rect", Tag::Rect},
                                                                   {"circle", Tag::Circle},
                                                                   {"ellipse", Tag::Ellipse},
                                                                   {"line", Tag::Line},
                                                                   {"polyline", Tag::Polyline},
                                                                   {"polygon", Tag::Polygon},
                                                                   {"text", Tag::Text},
                                                                   {"flowRoot", Tag::Text},
                                                                   {"image", Tag::Image},
                                                                   {"foreignObject", Tag::ForeignObject},
                                                                   {"linearGradient", Tag::LinearGradient},
                                                                   {"radialGradient", Tag::RadialGradient},
                                                                   {"stop", Tag::Stop},
                                                                   {"pattern", Tag::Pattern},
                                                                   {"clipPath", Tag::ClipPath},
                                                                   {"mask", Tag::Mask},
                                                                   {"marker", Tag::Marker},
                                                                   {"filter", Tag::Filter},
                                                                   {"title", Tag::Description},
                                                                   {"desc", Tag::Description},
                                                                   {"metadata", Tag::Description}};
    const auto found = tags.find(name);
    return found == tags.end() ? Tag::Unknown : found->second;
}

// Which prefixes mean SVG at the present place of a walk through the document.
class Namespaces {
public:
    // A drawing whose root has a broken or no namespace is one all the same.
    explicit Namespaces(pugi::xml_node root) : rootPrefix_(prefixOf(root.name()))
    {
        const std::string declaration = rootPrefix_.empty() ? "xmlns" : "xmlns:" + std::string(rootPrefix_);
        rootUri_ = root.attribute(declaration.c_str()).value();
    }

    void enter(pugi::xml_node element)
    {
        declared_.push_back(0);
        for (const pugi::xml_attribute& a : element.attributes()) {
            const std::string_view name = a.name();
            const bool standard = name == "xmlns";
            if (!standard && !name.starts_with("xmlns:")) continue;
            const std::string_view prefix = standard ? std::string_view() : localName(name);
            meanings_[prefix].push_back(a.value() == kNamespace || a.value() == rootUri_);
            order_.push_back(prefix);
            ++declared_.back();
        }
    }

    void leave()
    {
        for (int n = declared_.back(); n > 0; --n) {
            meanings_[order_.back()].pop_back();
            order_.pop_back();
        }
        declared_.pop_back();
    }

    bool isSvg(std::string_view elementName) const
    {
        const std::string_view prefix = prefixOf(elementName);
        const auto found = meanings_.find(prefix);
        if (found != meanings_.end() && !found->second.empty()) return found->second.back();
        return prefix == rootPrefix_ || (prefix.empty() && rootUri_.empty());
    }

private:
    std::string_view rootPrefix_, rootUri_;
    std::unordered_map<std::string_view, std::vector<bool>> meanings_;
    std::vector<std::string_view> order_;  // of the prefixes declared by the open elements
    std::vector<int> declared_;            // how many each of them declared
};

pugi::xml_node nextElement(pugi::xml_node node)
{
    while (node && node.type() != pugi::node_element) node = node.next_sibling();
    return node;
}

}  // namespace

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view kSpace = " \t\r\n\f";
    const std::size_t first = text.find_first_not_of(kSpace);
    return first == text.npos ? std::string_view() : text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string_view Element::name() const { return localName(node.name()); }

std::string_view Element::attribute(const char* name) const { return trimmed(node.attribute(name).value()); }

std::string_view Element::href() const
{
    if (const pugi::xml_attribute plain = node.attribute("href")) return trimmed(plain.value());
    for (const pugi::xml_attribute& a : node.attributes()) {
        if (localName(a.name()) == "href") return trimmed(a.value());
    }
    return {};
}

std::string_view Element::label() const
{
    const std::string_view label = attribute("inkscape:label");
    return label.empty() ? attribute("id") : label;
}

Document::Document(const SourceText& source, Report& report) : source_(source)
{
    if (source.firstBadByte()) {
        report.note("a byte here is no text in this file's encoding; such bytes are read as '?'",
                    *source.firstBadByte());
    }
    const std::string& text = source.text();
    if (!source.refusedEntities().empty()) {
        const std::string& name = source.refusedEntities().front();
        report.note("the entity '" + name + "' contains itself or grows beyond measure; it is left out",
                    std::min(text.find("<!ENTITY " + name), text.size()));
    }
    // Space between the spans of a text is a part of it; drawings without any do without those nodes.
    const bool hasSpans = text.find("tspan") != text.npos;
    const unsigned how = pugi::parse_default | (hasSpans ? pugi::parse_ws_pcdata : 0U);
    const pugi::xml_parse_result parsed = xml_.load_buffer(text.data(), text.size(), how, pugi::encoding_utf8);
    if (!parsed) brokenAt_ = std::size_t(std::max<std::ptrdiff_t>(parsed.offset, 0));
    for (pugi::xml_node root = nextElement(xml_.first_child()); root; root = nextElement(root.next_sibling())) {
        if (localName(root.name()) != "svg") continue;
        index(root);
        break;
    }
    if (brokenAt_ && !elements_.empty()) {
        report.note(std::string("the file is broken here (") + parsed.description() +
                        "); what comes before is drawn, the rest is lost",
                    *brokenAt_);
    }
}

void Document::index(pugi::xml_node root)
{
    Namespaces namespaces(root);
    ElementIndex open = kNoElement, previous = kNoElement;
    for (pugi::xml_node node = root; node;) {
        namespaces.enter(node);
        const auto i = ElementIndex(elements_.size());
        const Tag tag = namespaces.isSvg(node.name()) ? tagOf(localName(node.name())) : Tag::Foreign;
        elements_.push_back({node, tag, open, i + 1, previous});
        if (const pugi::xml_attribute id = node.attribute("id"); id && *id.value()) ids_.emplace(id.value(), i);

        if (const pugi::xml_node child = nextElement(node.first_child())) {
            open = i, previous = kNoElement, node = child;
            continue;
        }
        // Up to the nearest element with one more sibling, closing those on the way.
        ElementIndex closing = i;
        for (;;) {
            elements_[std::size_t(closing)].next = ElementIndex(elements_.size());
            namespaces.leave();
            if (closing == 0) return;
            previous = closing;
            open = elements_[std::size_t(closing)].parent;
            node = nextElement(elements_[std::size_t(closing)].node.next_sibling());
            if (node) break;
            closing = open;
        }
    }
}

ElementIndex Document::find(std::string_view id) const
{
    const auto found = ids_.find(id);
    return found == ids_.end() ? kNoElement : found->second;
}

ElementIndex Document::findReference(std::string_view href) const
{
    return href.starts_with('#') ? find(href.substr(1)) : kNoElement;
}

std::size_t Document::offsetOf(ElementIndex e) const
{
    const std::ptrdiff_t offset = (*this)[e].node.offset_debug();
    return offset > 0 ? std::size_t(offset - 1) : 0;  // pugixml tells where the name begins
}

std::size_t Document::offsetOf(ElementIndex e, std::string_view attribute) const
{
    const std::string& text = source_.text();
    const std::size_t start = offsetOf(e);
    std::size_t at = text.find_first_of(" \t\r\n/>", start);
    while (at < text.size() && text[at] != '>') {
        const std::size_t name = text.find_first_not_of(" \t\r\n/", at);
        const std::size_t nameEnd = text.find_first_of(" \t\r\n=>", name);
        const std::size_t quote = text.find_first_of("\"'>", nameEnd);
        if (quote >= text.size() || text[quote] == '>') break;
        if (text.compare(name, nameEnd - name, attribute) == 0) return quote + 1;
        const std::size_t end = text.find(text[quote], quote + 1);
        if (end >= text.size()) break;
        at = end + 1;
    }
    return start;
}

}  // namespace jet::svg
