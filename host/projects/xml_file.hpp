// An XML file as a tree that can be mended, with the places of its nodes in the text as it was read.
#pragma once

#include "findings.hpp"

#include <pugixml.hpp>

#include <string>
#include <string_view>

namespace jet::host {

class XmlFile {
public:
    XmlFile(std::string name, std::string text);

    /// Why it cannot be parsed; empty if it could.
    const std::string& problem() const { return problem_; }
    Location problemPlace() const { return at(problemOffset_); }
    pugi::xml_node root() const { return document_.document_element(); }
    const std::string& text() const { return text_; }
    Location where(const pugi::xml_node& node) const { return at(node.offset_debug()); }
    /// As text, one element a line.
    std::string written() const;

private:
    Location at(std::ptrdiff_t offset) const;

    std::string name_, text_, problem_;
    std::ptrdiff_t problemOffset_ = 0;
    pugi::xml_document document_;
};

/// Is this UTF-8 XML without NUL characters?
bool isXml(std::string_view text);

}  // namespace jet::host
