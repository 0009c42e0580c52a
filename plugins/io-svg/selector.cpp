#include "selector.hpp"

#include "length.hpp"

#include <algorithm>

namespace jet::svg {

namespace {

bool isNameCharacter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           (c & 0x80);
}

std::string takeName(std::string_view& text)
{
    std::string name;
    while (!text.empty() && (isNameCharacter(text.front()) || (text.front() == '\\' && text.size() > 1))) {
        if (text.front() == '\\') text.remove_prefix(1);
        name += text.front();
        text.remove_prefix(1);
    }
    return name;
}

bool takeAttribute(std::string_view& text, Compound& compound)
{
    const std::size_t end = text.find(']');
    if (end == text.npos) return false;
    std::string_view inside = trimmed(text.substr(0, end));
    text.remove_prefix(end + 1);
    Compound::Attribute attribute;
    attribute.name = takeName(inside);
    inside = trimmed(inside);
    if (!inside.empty()) {
        attribute.test = inside.front();
        const std::size_t equals = inside.find('=');
        if (equals == inside.npos || equals > 1) return false;
        inside = trimmed(inside.substr(equals + 1));
        if (inside.size() >= 2 && (inside.front() == '"' || inside.front() == '\'')) {
            inside = inside.substr(1, inside.size() - 2);
        }
        attribute.value = inside;
    }
    compound.attributes.push_back(std::move(attribute));
    return true;
}

std::optional<Compound> takeCompound(std::string_view& text)
{
    Compound compound;
    bool any = false;
    if (text.starts_with('*')) {
        text.remove_prefix(1);
        any = true;
    } else {
        compound.type = takeName(text);
        any = !compound.type.empty();
    }
    while (!text.empty()) {
        const char c = text.front();
        if (c != '#' && c != '.' && c != '[' && c != ':') break;
        text.remove_prefix(1);
        any = true;
        if (c == '#') {
            compound.id = takeName(text);
        } else if (c == '.') {
            compound.classes.push_back(takeName(text));
        } else if (c == '[') {
            if (!takeAttribute(text, compound)) return {};
        } else {
            if (takeName(text) != "first-child") return {};
            compound.firstChild = true;
        }
    }
    return any ? std::optional(compound) : std::nullopt;
}

Compound::Relation takeRelation(std::string_view& text)
{
    skipSpace(text);
    const char c = text.empty() ? ' ' : text.front();
    if (c != '>' && c != '+') return Compound::Relation::Descendant;
    text.remove_prefix(1);
    skipSpace(text);
    return c == '>' ? Compound::Relation::Child : Compound::Relation::Sibling;
}

bool holds(const Element& element, const Compound::Attribute& test)
{
    const pugi::xml_attribute attribute = element.node.attribute(test.name.c_str());
    if (!attribute) return false;
    const std::string_view value = attribute.value(), wanted = test.value;
    switch (test.test) {
    case 0: return true;
    case '=': return value == wanted;
    case '~': return hasWord(value, wanted);
    case '^': return !wanted.empty() && value.starts_with(wanted);
    case '$': return !wanted.empty() && value.ends_with(wanted);
    case '*': return !wanted.empty() && value.find(wanted) != value.npos;
    case '|': return value == wanted || (value.starts_with(wanted) && value.substr(wanted.size()).starts_with('-'));
    default: return false;
    }
}

}  // namespace

std::optional<std::vector<Compound>> parseSelector(std::string_view text)
{
    std::vector<Compound> selector;
    text = trimmed(text);
    while (!text.empty()) {
        std::optional<Compound> compound = takeCompound(text);
        if (!compound) return {};
        if (!text.empty()) compound->relation = takeRelation(text);
        selector.push_back(std::move(*compound));
    }
    if (selector.empty()) return {};
    std::reverse(selector.begin(), selector.end());
    selector.front().relation = Compound::Relation::Self;
    return selector;
}

std::uint64_t specificity(const std::vector<Compound>& selector)
{
    std::uint64_t ids = 0, classes = 0, types = 0;
    for (const Compound& c : selector) {
        ids += c.id.empty() ? 0 : 1;
        classes += c.classes.size() + c.attributes.size() + (c.firstChild ? 1 : 0);
        types += c.type.empty() ? 0 : 1;
    }
    const auto limited = [](std::uint64_t n) { return std::min<std::uint64_t>(n, 255); };
    return limited(ids) << 16 | limited(classes) << 8 | limited(types);
}

bool hasWord(std::string_view list, std::string_view word)
{
    for (std::size_t at = list.find(word); at != list.npos && !word.empty(); at = list.find(word, at + 1)) {
        const auto isGap = [&](std::size_t i) {
            return i >= list.size() || list[i] == ' ' || list[i] == '\t' || list[i] == '\n';
        };
        if ((at == 0 || isGap(at - 1)) && isGap(at + word.size())) return true;
    }
    return false;
}

bool satisfies(const Element& element, const Compound& compound)
{
    if (!compound.type.empty() && element.name() != compound.type) return false;
    if (!compound.id.empty() && element.attribute("id") != compound.id) return false;
    if (compound.firstChild && element.previous != kNoElement) return false;
    const std::string_view classes = compound.classes.empty() ? std::string_view() : element.attribute("class");
    return std::all_of(compound.classes.begin(), compound.classes.end(),
                       [&](const std::string& c) { return hasWord(classes, c); }) &&
           std::all_of(compound.attributes.begin(), compound.attributes.end(),
                       [&](const auto& a) { return holds(element, a); });
}

}  // namespace jet::svg
