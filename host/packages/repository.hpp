// A static repository: packages in a folder with an index.json, on a disk or behind any web server (docs/packages.md).
#pragma once

#include "installer.hpp"
#include "source.hpp"

#include <string>
#include <vector>

namespace jet::host {

/// One package as the index tells of it.
struct IndexEntry {
    std::string id, name, description, license;
    Version version;
    Version jet;           ///< SDK it was written for
    std::string sdk, abi;  ///< what it was built with
    std::vector<Dependency> needs;
    std::vector<std::string> contributions;  ///< "tool star", for people who search
    std::string file;                        ///< relative to the index
    std::uint64_t size = 0;
    std::string sha256;

    /// Can this JET load it? The error says why not.
    Result<void> fits() const;
};

struct Index {
    std::vector<IndexEntry> entries;  ///< by id, the newest version first

    std::string text() const;
    /// The error names file and line, or the entry and its field.
    static Result<Index> parse(const std::string& text, const std::string& file);
};

/// Reads all packages in the folder (not below it) and makes the index of them; it is not written. Packages that cannot
/// be read are named in `problems`, and left out.
Result<Index> indexFolder(const std::filesystem::path& folder, std::vector<Error>& problems);

class Repository {
public:
    static Result<Repository> open(const Source& source);

    const Index& index() const { return index_; }
    /// The newest version of each plugin whose id, name, description or contributions have the word in them, whatever
    /// the case; all if the word is empty. Those that do not fit this JET, too: see IndexEntry::fits().
    std::vector<const IndexEntry*> search(const std::string& word) const;

    /// The plugin and what it requires beyond `installed`, dependencies first: of each the newest version that fits
    /// this JET. The error names the chain of who requires what.
    Result<std::vector<const IndexEntry*>> resolve(const std::string& id,
                                                   const std::vector<InstalledPlugin>& installed) const;
    /// The package, its size and SHA-256 compared with the index.
    Result<std::string> fetch(const IndexEntry& entry, const ArchiveLimits& limits = {}) const;
    std::string address(const IndexEntry& entry) const { return source_.address(entry.file); }

private:
    explicit Repository(Source source) : source_(std::move(source)) {}
    class Resolver;

    Source source_;
    Index index_;
};

/// Installs a plugin and what it requires from a repository: all of them or none.
Result<std::vector<InstallOutcome>> installFrom(const Repository& repository, const std::string& id,
                                                InstallOptions options);

}  // namespace jet::host
