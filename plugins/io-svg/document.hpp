// Document: the elements of a drawing in document order, with their place in the text. No recursion anywhere: a hostile
// file nests as deep as it likes.
#pragma once

#include "report.hpp"
#include "source_text.hpp"

#include <pugixml.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace jet::svg {

enum class Tag {
    Foreign,  ///< of another namespace
    Unknown,  ///< of SVG's namespace, but none of these
    Svg,
    Group,
    Anchor,
    Switch,
    Use,
    Symbol,
    Defs,
    Style,
    Path,
    Rect,
    Circle,
    Ellipse,
    Line,
    Polyline,
    Polygon,
    Text,
    Image,
    ForeignObject,
    LinearGradient,
    RadialGradient,
    Stop,
    Pattern,
    ClipPath,
    Mask,
    Marker,
    Filter,
    Description,  ///< title, desc, metadata
};

/// An index into Document::elements().
using ElementIndex = int;
inline constexpr ElementIndex kNoElement = -1;

struct Element {
    pugi::xml_node node;
    Tag tag = Tag::Unknown;
    ElementIndex parent = kNoElement;
    ElementIndex next = 0;               ///< the first element after this one's subtree
    ElementIndex previous = kNoElement;  ///< sibling

    std::string_view name() const;  ///< without prefix
    /// The attribute's value without spaces around it; empty where there is none.
    std::string_view attribute(const char* name) const;
    bool has(const char* name) const { return bool(node.attribute(name)); }
    /// href or xlink:href, whatever the prefix is called here.
    std::string_view href() const;
    /// inkscape:label, else id.
    std::string_view label() const;
};

class Document {
public:
    /// Parses as much as can be; what is wrong goes to `report`. The first element is the outermost <svg>; none: no
    /// drawing.
    Document(const SourceText& source, Report& report);

    std::span<const Element> elements() const { return elements_; }
    const Element& operator[](ElementIndex i) const { return elements_[std::size_t(i)]; }
    /// The first element of that id; kNoElement if there is none.
    ElementIndex find(std::string_view id) const;
    /// The target of "#id"; kNoElement for anything else.
    ElementIndex findReference(std::string_view href) const;
    bool contains(ElementIndex ancestor, ElementIndex e) const { return ancestor <= e && e < (*this)[ancestor].next; }
    ElementIndex firstChild(ElementIndex e) const { return (*this)[e].next > e + 1 ? e + 1 : kNoElement; }

    /// Offset of an element's "<" in the source text.
    std::size_t offsetOf(ElementIndex e) const;
    /// Offset of the first character of an attribute's value.
    std::size_t offsetOf(ElementIndex e, std::string_view attribute) const;
    /// Where the XML stopped making sense; none if it is sound.
    std::optional<std::size_t> brokenAt() const { return brokenAt_; }

private:
    void index(pugi::xml_node root);

    const SourceText& source_;
    pugi::xml_document xml_;
    std::vector<Element> elements_;
    std::unordered_map<std::string_view, ElementIndex> ids_;
    std::optional<std::size_t> brokenAt_;
};

/// Without spaces at the ends.
std::string_view trimmed(std::string_view text);

}  // namespace jet::svg
