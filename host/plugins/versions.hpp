// Versions of plugins and of the SDK, ranges of them, and what a plugin says about another one.
#pragma once

#include <jet/result.hpp>

#include <compare>
#include <optional>
#include <string>
#include <string_view>

namespace jet::host {

/// major.minor.patch; missing parts are 0.
struct Version {
    int major = 0, minor = 0, patch = 0;
    auto operator<=>(const Version&) const = default;
    std::string text() const;
    static Result<Version> parse(std::string_view text);
};

/// Which versions will do. Written as comparators separated by spaces, all of which must hold:
/// `>=1.2`, `>1.2`, `<3`, `<=3`, `=1.2.3`, `^1.2` (up to the next major version, or of 0.x to the next minor),
/// `~1.2` (up to the next minor), `1.2` (that or a later one of the same major), `*` (any).
class VersionRange {
public:
    /// Any version.
    VersionRange() = default;
    static Result<VersionRange> parse(std::string_view text);
    static VersionRange exactly(const Version& version);

    bool admits(const Version& version) const { return version >= from_ && (!before_ || version < *before_); }
    bool isAny() const { return from_ == Version{} && !before_; }
    /// One version only?
    bool isExact() const;
    /// As it was written.
    const std::string& text() const { return text_; }
    /// For people: "1.2.0 or later, below 3.0.0".
    std::string inWords() const;

private:
    Result<void> narrow(std::string_view comparator);

    Version from_;
    std::optional<Version> before_;
    std::string text_;
};

/// Parts of lower-case letters, digits, '-' and '_', at least two, with dots between.
bool isPluginId(std::string_view id);

/// Another plugin and the versions of it that are meant: "org.acme.rope" or "org.acme.rope >=1.2 <3".
struct Dependency {
    std::string id;
    VersionRange range;
    /// An id, and a range if wanted, with a space between.
    static Result<Dependency> parse(std::string_view text);
    bool admits(const Version& version) const { return range.admits(version); }
    std::string text() const { return range.isAny() ? id : id + " " + range.text(); }
};

}  // namespace jet::host
