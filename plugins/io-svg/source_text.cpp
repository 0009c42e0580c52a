#include "source_text.hpp"

#include "entities.hpp"

#include <algorithm>

namespace jet::svg {

namespace {

void appendUtf8(std::string& out, char32_t c)
{
    if (c < 0x80) {
        out += char(c);
    } else if (c < 0x800) {
        out += char(0xc0 | (c >> 6));
        out += char(0x80 | (c & 0x3f));
    } else if (c < 0x10000) {
        out += char(0xe0 | (c >> 12));
        out += char(0x80 | ((c >> 6) & 0x3f));
        out += char(0x80 | (c & 0x3f));
    } else {
        out += char(0xf0 | (c >> 18));
        out += char(0x80 | ((c >> 12) & 0x3f));
        out += char(0x80 | ((c >> 6) & 0x3f));
        out += char(0x80 | (c & 0x3f));
    }
}

std::string fromUtf16(std::span<const std::byte> data, bool bigEndian)
{
    const auto unit = [&](std::size_t i) {
        const auto a = std::to_integer<char32_t>(data[i]), b = std::to_integer<char32_t>(data[i + 1]);
        return bigEndian ? (a << 8 | b) : (b << 8 | a);
    };
    std::string out;
    for (std::size_t i = 2; i + 1 < data.size(); i += 2) {
        char32_t c = unit(i);
        const bool high = c >= 0xd800 && c < 0xdc00;
        if (high && i + 3 < data.size() && unit(i + 2) >= 0xdc00 && unit(i + 2) < 0xe000) {
            c = 0x10000 + ((c - 0xd800) << 10) + (unit(i + 2) - 0xdc00);
            i += 2;
        } else if (c >= 0xd800 && c < 0xe000) {
            c = 0xfffd;
        }
        appendUtf8(out, c);
    }
    return out;
}

std::string fromLatin1(std::string_view bytes)
{
    std::string out;
    out.reserve(bytes.size());
    for (char c : bytes) appendUtf8(out, static_cast<unsigned char>(c));
    return out;
}

bool declaresLatin1(std::string_view text)
{
    if (!text.starts_with("<?xml")) return false;
    std::string head(text.substr(0, std::min(text.find("?>"), std::size_t(200))));
    std::transform(head.begin(), head.end(), head.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return head.find("iso-8859-1") != head.npos || head.find("latin1") != head.npos ||
           head.find("windows-1252") != head.npos;
}

std::string decoded(std::span<const std::byte> data)
{
    const std::string_view bytes(reinterpret_cast<const char*>(data.data()), data.size());
    if (bytes.starts_with("\xff\xfe")) return fromUtf16(data, false);
    if (bytes.starts_with("\xfe\xff")) return fromUtf16(data, true);
    if (bytes.starts_with("\xef\xbb\xbf")) return std::string(bytes.substr(3));
    return declaresLatin1(bytes) ? fromLatin1(bytes) : std::string(bytes);
}

// Length of the UTF-8 character at `i`; 0 where there is none.
std::size_t characterLength(std::string_view s, std::size_t i)
{
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(s[k]); };
    const unsigned char c = byte(i);
    if (c < 0x80) return c >= 0x20 || c == '\t' || c == '\n' || c == '\r' ? 1 : 0;
    const std::size_t length = c >= 0xc2 && c < 0xe0 ? 2 : c >= 0xe0 && c < 0xf0 ? 3 : c >= 0xf0 && c < 0xf5 ? 4 : 0;
    if (length == 0 || i + length > s.size()) return 0;
    for (std::size_t k = 1; k < length; ++k) {
        if ((byte(i + k) & 0xc0) != 0x80) return 0;
    }
    return length;
}

// Bad bytes become '?', one for one, so that offsets stay.
std::optional<std::size_t> clean(std::string& text)
{
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = characterLength(text, i);
        if (length == 0) {
            if (!first) first = i;
            text[i] = '?';
        }
        i += std::max<std::size_t>(length, 1);
    }
    return first;
}

}  // namespace

SourceText::SourceText(std::span<const std::byte> data, std::string file)
    : file_(std::move(file)), original_(decoded(data))
{
    firstBadByte_ = clean(original_);
    findLines();
    Expansion expansion = expandEntities(original_);
    text_ = std::move(expansion.text);
    expansions_ = std::move(expansion.places);
    refusedEntities_ = std::move(expansion.refused);
}

void SourceText::findLines()
{
    lines_.push_back(0);
    for (std::size_t i = 0; i < original_.size(); ++i) {
        if (original_[i] == '\n') lines_.push_back(i + 1);
    }
}

Location SourceText::locate(std::size_t offset) const
{
    const auto place = std::upper_bound(expansions_.begin(), expansions_.end(), offset,
                                        [](std::size_t o, const auto& entry) { return o < entry.first; });
    if (place != expansions_.begin()) {
        const auto& [from, original] = *std::prev(place);
        const std::size_t limit = place == expansions_.end() ? original_.size() : place->second;
        offset = std::min(original + (offset - from), limit);
    }
    offset = std::min(offset, original_.size());
    const auto line = std::prev(std::upper_bound(lines_.begin(), lines_.end(), offset));
    const auto characters =
        std::count_if(original_.begin() + std::ptrdiff_t(*line), original_.begin() + std::ptrdiff_t(offset),
                      [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
    return {file_, int(line - lines_.begin()) + 1, int(characters) + 1};
}

}  // namespace jet::svg
