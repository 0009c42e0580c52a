#include "xml_text.hpp"

#include "utf8.hpp"

#include <algorithm>
#include <charconv>

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
    // References count outside of CDATA sections only. A file without any, the normal case, is searched once.
    std::size_t at = text.find("&#");
    std::size_t section = at == std::string::npos ? at : text.find("<![CDATA[");
    while (at != std::string::npos) {
        if (section < at) {
            const std::size_t end = text.find("]]>", section);
            if (end == std::string::npos) return {};  // the parser tells
            if (end > at) at = text.find("&#", end);
            section = text.find("<![CDATA[", end);
            continue;
        }
        if (!isStorableReference(std::string_view(text).substr(at)))
            return Error("this reference names no character; remove it",
                         lines.at(file, static_cast<std::ptrdiff_t>(at)));
        at = text.find("&#", at + 2);
    }
    return {};
}

Result<void> XmlSource::parse()
{
    if (const auto fine = checkBytes(); !fine) return fine;
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
