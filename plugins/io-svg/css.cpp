#include "css.hpp"

#include "length.hpp"
#include "selector.hpp"

#include <algorithm>

namespace jet::svg {

namespace {

// Ancestors and siblings one selector may try on one element: enough for any drawing, too little for an attack.
constexpr int kMostSteps = 1000;

// The text of an element, with CDATA sections.
std::string contentOf(pugi::xml_node node)
{
    std::string text;
    for (const pugi::xml_node& child : node.children()) {
        if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) text += child.value();
    }
    return text;
}

// Offset behind the block that begins with the "{" at `open`.
std::size_t blockEnd(std::string_view css, std::size_t open)
{
    int depth = 0;
    for (std::size_t i = open; i < css.size(); ++i) {
        if (css[i] == '{') ++depth;
        if (css[i] == '}' && --depth == 0) return i + 1;
    }
    return css.size();
}

// "@import ...;" or "@media ... { ... }"
std::size_t atRuleEnd(std::string_view css, std::size_t at)
{
    const std::size_t end = css.find_first_of(";{", at);
    if (end == css.npos) return css.size();
    return css[end] == ';' ? end + 1 : blockEnd(css, end);
}

}  // namespace

std::string withoutComments(std::string_view text)
{
    std::string out;
    for (;;) {
        const std::size_t open = text.find("/*");
        out += text.substr(0, open);
        if (open == text.npos) return out;
        const std::size_t close = text.find("*/", open + 2);
        if (close == text.npos) return out;
        text.remove_prefix(close + 2);
    }
}

std::vector<Declaration> parseDeclarations(std::string_view text)
{
    std::vector<Declaration> result;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(';'), text.size());
        std::string_view one = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t colon = one.find(':');
        if (colon == one.npos) continue;
        Declaration d{trimmed(one.substr(0, colon)), trimmed(one.substr(colon + 1)), false};
        if (const std::size_t mark = d.value.rfind('!'); mark != d.value.npos) {
            d.important = trimmed(d.value.substr(mark + 1)) == "important";
            if (d.important) d.value = trimmed(d.value.substr(0, mark));
        }
        if (!d.property.empty() && !d.value.empty()) result.push_back(d);
    }
    return result;
}

StyleSheet::StyleSheet(const Document& document) : document_(document)
{
    for (const Element& element : document.elements()) {
        if (element.tag != Tag::Style) continue;
        const std::string_view type = element.attribute("type");
        if (!type.empty() && type != "text/css") continue;
        texts_.push_back(std::make_unique<std::string>(withoutComments(contentOf(element.node))));
        read(*texts_.back());
    }
}

void StyleSheet::read(std::string_view css)
{
    std::size_t at = 0;
    while (at < css.size()) {
        at = css.find_first_not_of(" \t\r\n", at);
        if (at == css.npos) return;
        if (css.compare(at, 4, "<!--") == 0 || css.compare(at, 3, "-->") == 0) {
            at += css[at] == '<' ? 4 : 3;
            continue;
        }
        if (css[at] == '@') {
            at = atRuleEnd(css, at);
            continue;
        }
        const std::size_t open = css.find('{', at);
        if (open == css.npos) return;
        const std::size_t close = std::min(css.find('}', open), css.size());
        addRule(css.substr(at, open - at), css.substr(open + 1, close - open - 1));
        at = close + 1;
    }
}

void StyleSheet::addRule(std::string_view selectors, std::string_view block)
{
    const auto declarations = std::make_shared<std::vector<Declaration>>(parseDeclarations(block));
    while (!selectors.empty()) {
        const std::size_t comma = std::min(selectors.find(','), selectors.size());
        auto selector = parseSelector(selectors.substr(0, comma));
        selectors.remove_prefix(std::min(comma + 1, selectors.size()));
        if (!selector) continue;
        const std::size_t index = rules_.size();
        const Compound& last = selector->front();
        if (!last.id.empty()) {
            byId_[last.id].push_back(index);
        } else if (!last.classes.empty()) {
            byClass_[last.classes.front()].push_back(index);
        } else if (!last.type.empty()) {
            byType_[last.type].push_back(index);
        } else {
            general_.push_back(index);
        }
        const std::uint64_t rank = specificity(*selector) << 32 | index;
        rules_.push_back({std::move(*selector), rank, declarations});
    }
}

bool StyleSheet::matches(const Rule& rule, ElementIndex e) const
{
    int budget = kMostSteps;
    return satisfies(document_[e], rule.selector.front()) && matchesFrom(rule, 1, e, budget);
}

// Is there, from the neighbour of `e` that the relation names onwards, a place for the compounds from `step` on?
bool StyleSheet::matchesFrom(const Rule& rule, std::size_t step, ElementIndex e, int& budget) const
{
    if (step == rule.selector.size()) return true;
    const Compound& compound = rule.selector[step];
    const bool toSibling = compound.relation == Compound::Relation::Sibling;
    const bool anyAncestor = compound.relation == Compound::Relation::Descendant;
    for (ElementIndex other = toSibling ? document_[e].previous : document_[e].parent; other != kNoElement;
         other = document_[other].parent) {
        if (--budget < 0) return false;
        if (satisfies(document_[other], compound) && matchesFrom(rule, step + 1, other, budget)) return true;
        if (!anyAncestor) return false;
    }
    return false;
}

void StyleSheet::match(ElementIndex e, const std::function<void(const Declaration&, std::uint64_t)>& visit) const
{
    const auto tryAll = [&](const std::vector<std::size_t>& indices) {
        for (const std::size_t i : indices) {
            if (!matches(rules_[i], e)) continue;
            for (const Declaration& d : *rules_[i].declarations) visit(d, rules_[i].rank);
        }
    };
    const auto tryKey = [&](const auto& map, std::string_view key) {
        if (const auto found = map.find(std::string(key)); found != map.end()) tryAll(found->second);
    };
    const Element& element = document_[e];
    if (!byId_.empty()) tryKey(byId_, element.attribute("id"));
    if (!byClass_.empty()) {
        std::string_view classes = element.attribute("class");
        while (!classes.empty()) {
            const std::size_t end = std::min(classes.find_first_of(" \t\r\n"), classes.size());
            tryKey(byClass_, classes.substr(0, end));
            classes = trimmed(classes.substr(end));
        }
    }
    if (!byType_.empty()) tryKey(byType_, element.name());
    tryAll(general_);
}

}  // namespace jet::svg
