#include "style.hpp"

#include "font.hpp"

#include <algorithm>

namespace jet::svg {

namespace {

// Ranks of declarations (CSS 2.1, section 6.4.1): importance, then origin, then what the style sheet says.
constexpr std::uint64_t kAttributeRank = 0;
constexpr std::uint64_t kSheetRank = std::uint64_t(1) << 60;
constexpr std::uint64_t kStyleAttributeRank = std::uint64_t(2) << 60;
constexpr std::uint64_t kImportant = std::uint64_t(4) << 60;

constexpr std::size_t kMostProperties = 40;
constexpr int kDeepest = 64;  // ancestors of a gradient's stop that are looked at

Style inherited(const Style& parent)
{
    Style style = parent;
    const Style initial;
    for (const PropertyRule& rule : propertyRules()) {
        if (!rule.inherited) rule.copy(style, initial);
    }
    return style;
}

void apply(const PropertyRule& rule, std::string_view value, Style& style, const Style& parent,
           const LengthContext& lengths)
{
    if (value == "inherit") {
        rule.copy(style, parent);
    } else if (value == "initial") {
        rule.copy(style, Style());
    } else {
        rule.read(style, value, lengths);  // what cannot be read counts as not written
    }
}

}  // namespace

struct StyleResolver::Winner {
    std::string_view value;
    std::uint64_t rank = 0;

    void offer(std::string_view other, std::uint64_t otherRank)
    {
        if (value.data() && otherRank < rank) return;
        value = other, rank = otherRank;
    }
};

void StyleResolver::gather(ElementIndex e, std::span<Winner> winners)
{
    const auto offerOne = [&](std::string_view name, std::string_view value, std::uint64_t rank) {
        const int property = findProperty(name);
        if (property >= 0) winners[std::size_t(property)].offer(value, rank);
    };
    const auto offer = [&](const Declaration& d, std::uint64_t rank) {
        rank |= d.important ? kImportant : 0;
        if (d.property != "font") return offerOne(d.property, d.value, rank);
        const bool isWide = d.value == "inherit" || d.value == "initial";
        const auto font = isWide ? FontShorthand{d.value, d.value, d.value, d.value} : parseFont(d.value);
        if (!font) return;
        offerOne("font-style", font->style, rank);
        offerOne("font-weight", font->weight, rank);
        offerOne("font-size", font->size, rank);
        offerOne("font-family", font->family, rank);
    };
    std::string_view styleAttribute;
    for (const pugi::xml_attribute& a : document_[e].node.attributes()) {
        const std::string_view name = a.name();
        if (name == "style") {
            styleAttribute = a.value();
        } else if (name == "font") {
            offer({name, trimmed(a.value()), false}, kAttributeRank);
        } else if (const int property = findProperty(name);
                   property >= 0 && propertyRules()[std::size_t(property)].attribute) {
            offer({name, trimmed(a.value()), false}, kAttributeRank);
        }
    }
    if (!sheet_.isEmpty()) {
        sheet_.match(e, [&](const Declaration& d, std::uint64_t rank) { offer(d, kSheetRank | rank); });
    }
    if (styleAttribute.find("/*") != styleAttribute.npos) {
        styleAttribute = texts_.emplace_back(withoutComments(styleAttribute));
    }
    for (const Declaration& d : parseDeclarations(styleAttribute)) offer(d, kStyleAttributeRank);
}

Style StyleResolver::compute(ElementIndex e, const Style& parent, const LengthContext& lengths)
{
    const std::span<const PropertyRule> rules = propertyRules();
    std::array<Winner, kMostProperties> winners;
    gather(e, std::span(winners).first(rules.size()));

    Style style = inherited(parent);
    LengthContext own = lengths;
    own.fontSize = parent.fontSize;
    for (std::size_t i = 0; i < rules.size(); ++i) {
        if (winners[i].value.data()) apply(rules[i], winners[i].value, style, parent, own);
        if (i == 0) own.fontSize = style.fontSize;  // font-size is the first rule; em in the others means it
    }
    return style;
}

Style StyleResolver::computeFromRoot(ElementIndex e)
{
    std::vector<ElementIndex> way;
    for (ElementIndex i = e; i != kNoElement && way.size() < kDeepest; i = document_[i].parent) way.push_back(i);
    Style style;
    const LengthContext lengths{Vec2(100, 100), Vec2(100, 100), style.fontSize};
    for (auto i = way.rbegin(); i != way.rend(); ++i) style = compute(*i, style, lengths);
    return style;
}

}  // namespace jet::svg
