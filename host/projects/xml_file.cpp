#include "xml_file.hpp"

#include <algorithm>
#include <sstream>

namespace jet::host {

namespace {

// White space of texts counts: scripts are text.
constexpr unsigned kOptions =
    pugi::parse_default | pugi::parse_ws_pcdata_single | pugi::parse_comments | pugi::parse_declaration;

constexpr int kDeepest = 1100;  // a scene's items may be nested 1000 deep

// Also because pugixml removes trees by recursion.
bool isTooDeep(const pugi::xml_document& document)
{
    int depth = 0;
    pugi::xml_node at = document.first_child();
    while (at) {
        pugi::xml_node next = at.first_child();
        if (next && ++depth > kDeepest) return true;
        while (!next && at.parent() && at != document) {
            next = at.next_sibling();
            if (!next) at = at.parent(), --depth;
        }
        at = next;
    }
    return false;
}

}  // namespace

XmlFile::XmlFile(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text))
{
    const auto parsed = document_.load_buffer(text_.data(), text_.size(), kOptions, pugi::encoding_utf8);
    if (parsed && !root()) {
        problem_ = "there is no element in it";
    } else if (parsed && isTooDeep(document_)) {
        problem_ = "its elements are nested more than " + std::to_string(kDeepest) + " deep";
    } else if (!parsed) {
        problem_ = parsed.description();
        problemOffset_ = parsed.offset;
    }
}

Location XmlFile::at(std::ptrdiff_t offset) const
{
    if (offset < 0) return {name_, 0, 0};
    const auto end = text_.begin() + std::min(offset, static_cast<std::ptrdiff_t>(text_.size()));
    const auto line = std::count(text_.begin(), end, '\n') + 1;
    const std::size_t before =
        end == text_.begin() ? std::string::npos : text_.rfind('\n', static_cast<std::size_t>(end - text_.begin() - 1));
    const auto column =
        (end - text_.begin()) - (before == std::string::npos ? 0 : static_cast<std::ptrdiff_t>(before) + 1);
    return {name_, static_cast<int>(line), static_cast<int>(column) + 1};
}

std::string XmlFile::written() const
{
    std::ostringstream out;
    document_.save(out, "  ", pugi::format_indent, pugi::encoding_utf8);
    return out.str();
}

bool isXml(std::string_view text)
{
    pugi::xml_document document;
    return text.find('\0') == std::string_view::npos &&
           document.load_buffer(text.data(), text.size(), kOptions, pugi::encoding_utf8);
}

}  // namespace jet::host
