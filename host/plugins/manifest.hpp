// A plugin's manifest: what it is, what it needs and what it contributes, known without loading it.
#pragma once

#include <jet/catalog.hpp>
#include <jet/result.hpp>

#include <array>
#include <compare>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jet::host {

/// major.minor.patch; missing parts are 0.
struct Version {
    int major = 0, minor = 0, patch = 0;
    auto operator<=>(const Version&) const = default;
    std::string text() const;
    static Result<Version> parse(std::string_view text);
};

/// "org.acme.rope" or "org.acme.rope 1.2": that version or a later one of the same major.
struct Dependency {
    std::string id;
    Version minimum;
    bool admits(const Version& version) const { return version.major == minimum.major && version >= minimum; }
};

struct Manifest {
    std::string id, name, description, license, library;
    Version version;
    Version jet;           ///< SDK it was written for
    std::string sdk, abi;  ///< SDK version and compiler ABI it was built with; written by jet_add_plugin()
    std::vector<Dependency> requires_, optional;
    std::vector<Contribution> contributions;

    /// Reads plugin.json. The error names file, line and field.
    static Result<Manifest> read(const std::filesystem::path& file);
    static Result<Manifest> parse(const std::string& text, const std::filesystem::path& file);
};

}  // namespace jet::host
