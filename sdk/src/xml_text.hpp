// Small XML helpers shared by the scene and project files: writing text safely, finding the place of an error.
#pragma once

#include <jet/result.hpp>

#include <pugixml.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace jet {

/// Escapes for an attribute or element text; control characters become character references.
void appendXmlEscaped(std::string& out, std::string_view text);
/// Element text: a CDATA section where it spans lines (scripts), else escaped.
void appendXmlContent(std::string& out, std::string_view text);
/// ` name="escaped value"`.
std::string xmlAttribute(std::string_view name, std::string_view value);

/// Tells line and column of an offset. Made before an in-place parse, which changes the text.
class LineTable {
public:
    explicit LineTable(std::string_view text);
    Location at(const std::string& file, std::ptrdiff_t offset) const;

private:
    std::vector<std::uint32_t> starts_;
};

/// A document with the means to say where things are in it.
struct XmlSource {
    std::string file;
    std::string text;  ///< owned by the parse: pugixml works in it
    LineTable lines;
    pugi::xml_document document;

    XmlSource(std::string name, std::string content) : file(std::move(name)), text(std::move(content)), lines(text) {}
    /// Parses; the error names the place and what is wrong. Refused are texts that are not UTF-8 or could not be
    /// written back.
    Result<void> parse();
    /// All text in the element, pieces and CDATA sections joined; fails where there are other elements in it.
    std::string textOf(const pugi::xml_node& node) const;
    Location where(const pugi::xml_node& node) const { return lines.at(file, node.offset_debug()); }
    /// What is wrong with the bytes, before they are parsed.
    Result<void> checkBytes() const;
    /// Throws Failure at the node's place.
    [[noreturn]] void fail(const pugi::xml_node& node, std::string message) const;
    /// For a node that has no meaning where it stands: white space is fine, all else fails, saying what belongs there
    /// instead.
    void unexpected(const pugi::xml_node& node, const char* instead) const;
    /// The attribute's text; fails where it is missing.
    std::string_view required(const pugi::xml_node& node, const char* attribute) const;
    void onlyAttributes(const pugi::xml_node& node, std::initializer_list<std::string_view> known) const;
    bool boolean(const pugi::xml_node& node, const char* attribute, bool fallback) const;
};

}  // namespace jet
