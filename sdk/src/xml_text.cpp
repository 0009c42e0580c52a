#include "xml_text.hpp"

#include "utf8.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

namespace jet {

void appendXmlEscaped(std::string& out, std::string_view text)
{
    for (const char c : text) {
        switch (c) {
        case '&': out += "&amp;"; break;
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '"': out += "&quot;"; break;
        default:
            if (static_cast<unsigned char>(c) < 0x20) {
                out += "&#" + std::to_string(static_cast<int>(c)) + ";";
            } else {
                out += c;
            }
        }
    }
}

void appendXmlContent(std::string& out, std::string_view text)
{
    const bool plain = std::none_of(text.begin(), text.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
    });
    if (plain && text.find('\n') != std::string_view::npos && text.find("]]>") == std::string_view::npos) {
        out += "<![CDATA[";
        out += text;
        out += "]]>";
    } else {
        appendXmlEscaped(out, text);
    }
}

std::string xmlAttribute(std::string_view name, std::string_view value)
{
    std::string out = " " + std::string(name) + "=\"";
    appendXmlEscaped(out, value);
    return out + "\"";
}

LineTable::LineTable(std::string_view text)
{
    starts_.push_back(0);
    for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
        starts_.push_back(static_cast<std::uint32_t>(at + 1));
}

Location LineTable::at(const std::string& file, std::ptrdiff_t offset) const
{
    if (offset < 0) return {file, 0, 0};
    const auto line = std::upper_bound(starts_.begin(), starts_.end(), static_cast<std::uint32_t>(offset)) - 1;
    return {file, static_cast<int>(line - starts_.begin()) + 1, static_cast<int>(offset - *line) + 1};
}

namespace {

/// Does a character reference such as `&#65;` or `&#x41;` at the start of `text` name a character that can be stored?
bool isStorableReference(std::string_view text)
{
    text.remove_prefix(2);
    const bool hexadecimal = text.starts_with('x');
    if (hexadecimal) text.remove_prefix(1);
    std::uint32_t code = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), code, hexadecimal ? 16 : 10);
    if (problem == std::errc::invalid_argument || end == text.data() + text.size() || *end != ';')
        return true;  // plain text
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    return problem == std::errc() && code != 0 && code <= 0x10ffff && !surrogate;
}

}  // namespace

Result<void> XmlSource::checkBytes() const
{
    if (const std::size_t bad = firstUnstorable(text); bad != std::string::npos)
        return Error(text[bad] == '\0' ? "there is a NUL byte here; this is not a text file of JET, or it is damaged"
                                       : "this is not UTF-8; save the file in that encoding",
                     lines.at(file, static_cast<std::ptrdiff_t>(bad)));
    // References count outside of these only. A file without any, the normal case, is searched once.
    static constexpr std::pair<std::string_view, std::string_view> verbatim[] = {
        {"<![CDATA[", "]]>"}, {"<!--", "-->"}, {"<?", "?>"}};
    const std::string_view all = text;
    for (std::size_t at = all.find("&#"), from = 0; at != std::string_view::npos;) {
        std::size_t begin = at;
        std::string_view opens, closes;
        for (const auto& [open, close] : verbatim)
            if (const std::size_t found = all.substr(0, begin).find(open, from); found != std::string_view::npos)
                begin = found, opens = open, closes = close;
        if (begin < at) {
            const std::size_t end = all.find(closes, begin + opens.size());
            if (end == std::string_view::npos) return {};  // the parser tells
            from = end + closes.size();
            if (from > at) at = all.find("&#", from);
            continue;
        }
        if (!isStorableReference(all.substr(at)))
            return Error("this reference names no character; remove it",
                         lines.at(file, static_cast<std::ptrdiff_t>(at)));
        from = at + 2;
        at = all.find("&#", from);
    }
    return {};
}

namespace {

/// The first node with a name, value or attribute that could not be written back; null where there is none. What looks
/// like a CDATA section to checkBytes() may stand in an attribute or a DOCTYPE, and hide a reference from it.
pugi::xml_node firstUnstorableNode(const pugi::xml_node& root)
{
    const auto bad = [](const char* value) { return firstUnstorable(value) != std::string::npos; };
    for (pugi::xml_node node = root; node;) {
        if (bad(node.value())) return node;
        for (const pugi::xml_attribute attribute : node.attributes())
            if (bad(attribute.value())) return node;
        if (node.first_child()) {
            node = node.first_child();
            continue;
        }
        while (node != root && !node.next_sibling()) node = node.parent();
        if (node == root) break;
        node = node.next_sibling();
    }
    return {};
}

}  // namespace

Result<void> XmlSource::parse()
{
    if (const auto fine = checkBytes(); !fine) return fine;
    const bool references = text.find("&#") != std::string::npos;
    const unsigned options = pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol | pugi::parse_ws_pcdata_single;
    const pugi::xml_parse_result result =
        document.load_buffer_inplace(text.data(), text.size(), options, pugi::encoding_utf8);
    if (!result)
        return Error(std::string("this is not well-formed XML: ") + result.description() +
                         "; correct it there or restore the file from a copy",
                     lines.at(file, result.offset));
    const pugi::xml_node root = document.document_element();
    if (const pugi::xml_node second = root.next_sibling())
        return Error(std::string("there is a second <") + second.name() + "> after <" + root.name() +
                         ">; a file holds one of them",
                     where(second));
    if (references)
        if (const pugi::xml_node bad = firstUnstorableNode(document))
            return Error("a reference here names no character; remove it", where(bad));
    return {};
}

std::string XmlSource::textOf(const pugi::xml_node& node) const
{
    std::string content;
    for (const pugi::xml_node child : node.children()) {
        if (child.type() == pugi::node_element)
            fail(child, "<" + std::string(node.name()) + "> holds text, no <" + child.name() + ">; write '<' as &lt;");
        content += child.value();
    }
    return content;
}

void XmlSource::fail(const pugi::xml_node& node, std::string message) const
{
    throw Failure(Error(std::move(message), where(node)));
}

void XmlSource::unexpected(const pugi::xml_node& node, const char* instead) const
{
    if (node.type() == pugi::node_element)
        fail(node, "<" + std::string(node.name()) + "> is not known here; " + instead);
    const std::size_t begin = std::string_view(node.value()).find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return;
    throw Failure(Error(std::string("stray text here; ") + instead,
                        lines.at(file, node.offset_debug() + static_cast<std::ptrdiff_t>(begin))));
}

std::string_view XmlSource::required(const pugi::xml_node& node, const char* attribute) const
{
    const auto found = node.attribute(attribute);
    if (!found) fail(node, "<" + std::string(node.name()) + "> needs the attribute " + attribute + "=\"...\"");
    return found.value();
}

void XmlSource::onlyAttributes(const pugi::xml_node& node, std::initializer_list<std::string_view> known) const
{
    for (const auto attribute : node.attributes())
        if (std::find(known.begin(), known.end(), std::string_view(attribute.name())) == known.end())
            fail(node, "<" + std::string(node.name()) + "> has no attribute '" + attribute.name() + "'; remove it");
}

bool XmlSource::boolean(const pugi::xml_node& node, const char* attribute, bool fallback) const
{
    const auto found = node.attribute(attribute);
    if (!found) return fallback;
    const std::string_view text = found.value();
    if (text != "true" && text != "false")
        fail(node, std::string(attribute) + "=\"" + std::string(text) + "\" is neither \"true\" nor \"false\"");
    return text == "true";
}

}  // namespace jet
