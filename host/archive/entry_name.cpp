#include "entry_name.hpp"

#include <algorithm>

namespace jet::host {

namespace {

constexpr std::size_t kLongestName = 1024, kLongestPart = 200, kDeepest = 16;

std::string lowerCase(std::string_view text)
{
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

bool isUtf8(std::string_view text)
{
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80   ? 1
                                   : lead < 0xc2 ? 0
                                   : lead < 0xe0 ? 2
                                   : lead < 0xf0 ? 3
                                   : lead < 0xf5 ? 4
                                                 : 0;
        if (length == 0 || i + length > text.size()) return false;
        for (std::size_t k = 1; k < length; ++k)
            if ((static_cast<unsigned char>(text[i + k]) & 0xc0U) != 0x80U) return false;
        const auto second = length > 1 ? static_cast<unsigned char>(text[i + 1]) : 0U;
        // Longer than needed, halves of pairs, beyond the last character.
        if ((lead == 0xe0 && second < 0xa0) || (lead == 0xed && second > 0x9f) || (lead == 0xf0 && second < 0x90) ||
            (lead == 0xf4 && second > 0x8f))
            return false;
        i += length;
    }
    return true;
}

Result<void> checkPart(std::string_view part)
{
    if (part.empty()) return Error("its name has an empty part");
    if (part == "." || part == "..") return Error("its name leads out of the package with '" + std::string(part) + "'");
    if (part.size() > kLongestPart)
        return Error("its name is longer than " + std::to_string(kLongestPart) + " characters");
    if (part.front() == ' ' || part.back() == ' ' || part.back() == '.')
        return Error("a part of its name begins or ends with a space or ends with a dot");
    return {};
}

}  // namespace

Result<void> checkEntryName(std::string_view name, bool unicode)
{
    if (name.empty()) return Error("its name is empty");
    if (name.size() > kLongestName)
        return Error("its name is longer than " + std::to_string(kLongestName) + " characters");
    for (const char c : name) {
        const bool beyond = static_cast<unsigned char>(c) >= 0x80;
        if (beyond ? !unicode : c < ' ' || c > '~')
            return Error(unicode ? "its name has a control character"
                                 : "its name has a character other than printable ASCII");
        if (c == '\\' || c == ':') return Error(std::string("its name has a '") + c + "'");
    }
    if (!isUtf8(name)) return Error("its name is not UTF-8");
    if (name.front() == '/') return Error("its name is an absolute path");
    if (static_cast<std::size_t>(std::count(name.begin(), name.end(), '/')) >= kDeepest)
        return Error("it lies more than " + std::to_string(kDeepest) + " folders deep");
    for (std::string_view rest = name;;) {
        const std::size_t slash = rest.find('/');
        if (const auto fine = checkPart(rest.substr(0, slash)); !fine) return fine;
        if (slash == std::string_view::npos) return {};
        rest.remove_prefix(slash + 1);
    }
}

std::string shownName(std::string_view name)
{
    std::string text = "'";
    for (const char c : name.substr(0, 80)) {
        if (c >= ' ' && c <= '~') {
            text += c;
            continue;
        }
        const auto byte = static_cast<unsigned char>(c);
        text += "\\x";
        text += "0123456789abcdef"[byte >> 4];
        text += "0123456789abcdef"[byte & 15];
    }
    return text + (name.size() > 80 ? "…'" : "'");
}

Result<void> EntryNames::add(std::string_view name, bool folder)
{
    for (std::size_t slash = name.find('/'); slash != std::string_view::npos; slash = name.find('/', slash + 1))
        if (const auto fine = addPart(std::string(name.substr(0, slash)), true, true); !fine) return fine;
    return addPart(std::string(name), folder, false);
}

Result<void> EntryNames::addPart(const std::string& name, bool folder, bool implied)
{
    const auto [place, isNew] = places_.emplace(lowerCase(name), Place{name, folder});
    if (isNew) return {};
    const Place& other = place->second;
    if (other.name != name)
        return Error("its name differs from " + shownName(other.name) + " in upper and lower case only");
    if (other.folder != folder) return Error(shownName(name) + " is a file and a folder at once");
    if (!implied && !folder) return Error("it is in the package twice");
    return {};
}

}  // namespace jet::host
