// Hostile files: what a person, a broken disk or a villain may give an importer.
#pragma once

#include "random.hpp"

#include <string>
#include <vector>

namespace jet::host::check {

struct HostileFile {
    std::string what;  ///< "truncated to 120 of 900 bytes"
    std::string bytes;
};

/// Files that need no sample: empty, random, deeply nested, very long.
std::vector<HostileFile> genericHostileFiles(Random& random);
/// Truncations, flips, repeated and missing parts, numbers made huge, of a file that is fine.
std::vector<HostileFile> damaged(const std::string& sample, Random& random);

}  // namespace jet::host::check
