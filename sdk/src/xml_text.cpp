#include "xml_text.hpp"

#include <algorithm>

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

Result<void> XmlSource::parse()
{
    const unsigned options = pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol | pugi::parse_ws_pcdata_single;
    const pugi::xml_parse_result result =
        document.load_buffer_inplace(text.data(), text.size(), options, pugi::encoding_utf8);
    if (result) return {};
    return Error(std::string("this is not well-formed XML: ") + result.description() +
                     "; correct it there or restore the file from a copy",
                 lines.at(file, result.offset));
}

void XmlSource::fail(const pugi::xml_node& node, std::string message) const
{
    throw Failure(Error(std::move(message), where(node)));
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
