// A plugin's manifest: what it is, what it needs and what it contributes, known without loading it
// (docs/plugin-manifest.md). sdk/share/plugin.schema.json says the same for editors of JSON.
#pragma once

#include "versions.hpp"

#include <jet/catalog.hpp>
#include <jet/result.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace jet::host {

struct Manifest {
    std::string id, name, description, license, author, homepage, library;
    Version version;
    Version jet;           ///< SDK it was written for
    std::string sdk, abi;  ///< SDK version and compiler ABI it was built with; written by jet_add_plugin()
    std::vector<Dependency> requires_, optional, conflicts;
    std::vector<Contribution> contributions;
    std::vector<Error> warnings;  ///< with their places: fields and kinds that mean nothing to this JET

    /// Reads plugin.json. The error names file, line, column and field.
    static Result<Manifest> read(const std::filesystem::path& file);
    static Result<Manifest> parse(const std::string& text, const std::filesystem::path& file);
    /// Of a file that read() refuses: what it says of id and name, or else the folder's name. To list it by.
    static Manifest unreadable(const std::filesystem::path& file);
};

}  // namespace jet::host
