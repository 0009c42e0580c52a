#include "versions.hpp"

#include <algorithm>
#include <charconv>

namespace jet::host {

namespace {

constexpr int kMostDigits = 9;  // of a part: the next one still fits into an int

/// The version and how many of its parts were written.
struct Written {
    Version version;
    int parts = 0;
};

std::optional<Written> readVersion(std::string_view text)
{
    Written written;
    int* const parts[] = {&written.version.major, &written.version.minor, &written.version.patch};
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    for (int* part : parts) {
        const auto [next, problem] = std::from_chars(at, end, *part);
        if (problem != std::errc() || *part < 0 || next - at > kMostDigits) return std::nullopt;
        ++written.parts;
        if (next == end) return written;
        if (*next != '.') return std::nullopt;
        at = next + 1;
    }
    return std::nullopt;
}

Version nextPatch(Version v) { return {v.major, v.minor, v.patch + 1}; }
Version nextMinor(Version v) { return {v.major, v.minor + 1, 0}; }
Version nextMajor(Version v) { return {v.major + 1, 0, 0}; }

/// The first version that `^v` does not admit: where the first part that is not 0 grows.
Version endOfCaret(const Written& w)
{
    if (w.version.major > 0 || w.parts == 1) return nextMajor(w.version);
    if (w.version.minor > 0 || w.parts == 2) return nextMinor(w.version);
    return nextPatch(w.version);
}

bool isLowerWord(std::string_view text)
{
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    });
}

}  // namespace

bool isPluginId(std::string_view id)
{
    int parts = 0;
    for (;; ++parts) {
        const std::size_t dot = std::min(id.find('.'), id.size());
        if (!isLowerWord(id.substr(0, dot))) return false;
        if (dot == id.size()) return parts > 0;
        id.remove_prefix(dot + 1);
    }
}

Result<Dependency> Dependency::parse(std::string_view text)
{
    const std::size_t space = std::min(text.find(' '), text.size());
    Dependency dependency{std::string(text.substr(0, space)), {}};
    if (!isPluginId(dependency.id))
        return Error("'" + dependency.id +
                     "' is not an id; write it as org.example.name: lower-case letters, digits, '-', '_' and dots");
    if (space == text.size()) return dependency;
    const auto range = VersionRange::parse(text.substr(space + 1));
    if (!range) return range.error();
    dependency.range = *range;
    return dependency;
}

std::string Version::text() const
{
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

Result<Version> Version::parse(std::string_view text)
{
    if (const auto written = readVersion(text)) return written->version;
    return Error("'" + std::string(text) + "' is not a version; write it as 1.2.3");
}

VersionRange VersionRange::exactly(const Version& version)
{
    VersionRange range;
    range.from_ = version;
    range.before_ = nextPatch(version);
    range.text_ = "=" + version.text();
    return range;
}

Result<VersionRange> VersionRange::parse(std::string_view text)
{
    VersionRange range;
    std::string_view rest = text;
    bool any = false;
    while (!rest.empty()) {
        const std::size_t space = std::min(rest.find(' '), rest.size());
        if (space > 0) {
            if (const auto fine = range.narrow(rest.substr(0, space)); !fine) return fine.error();
            any = true;
        }
        rest.remove_prefix(std::min(space + 1, rest.size()));
    }
    if (!any) return Error("a range of versions is missing; write it as >=1.2 <3, ^1.2, ~1.2 or 1.2");
    if (range.before_ && range.from_ >= *range.before_)
        return Error("no version is in the range '" + std::string(text) + "'; turn its ends round");
    range.text_ = text;
    return range;
}

Result<void> VersionRange::narrow(std::string_view comparator)
{
    if (comparator == "*") return {};
    const std::size_t digits = std::min(comparator.find_first_of("0123456789"), comparator.size());
    const std::string_view sign = comparator.substr(0, digits);
    const auto written = readVersion(comparator.substr(digits));
    if (!written)
        return Error("'" + std::string(comparator) +
                     "' is not a version or a range of versions; write it as >=1.2 <3, ^1.2, ~1.2 or 1.2");
    const Version version = written->version;
    Version from;
    std::optional<Version> before;
    if (sign.empty()) {
        from = version, before = nextMajor(version);
    } else if (sign == ">=") {
        from = version;
    } else if (sign == ">") {
        from = nextPatch(version);
    } else if (sign == "<") {
        before = version;
    } else if (sign == "<=") {
        before = nextPatch(version);
    } else if (sign == "=") {
        from = version, before = nextPatch(version);
    } else if (sign == "^") {
        from = version, before = endOfCaret(*written);
    } else if (sign == "~") {
        from = version, before = written->parts == 1 ? nextMajor(version) : nextMinor(version);
    } else {
        return Error("'" + std::string(sign) + "' is not a comparison of versions; known are >= > < <= = ^ ~");
    }
    from_ = std::max(from_, from);
    if (before) before_ = before_ ? std::min(*before_, *before) : *before;
    return {};
}

bool VersionRange::isExact() const { return before_ && *before_ == nextPatch(from_); }

std::string VersionRange::inWords() const
{
    if (isAny()) return "any version";
    if (isExact()) return "version " + from_.text();
    if (!before_) return "version " + from_.text() + " or a later one";
    if (from_ == Version{}) return "a version before " + before_->text();
    return "version " + from_.text() + " or a later one before " + before_->text();
}

}  // namespace jet::host
