#include "repository.hpp"

#include "package.hpp"
#include "sha256.hpp"

#include "host/archive/entry_name.hpp"
#include "host/plugins/plugin_library.hpp"

#include <jet/format.hpp>

#include <algorithm>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLargestIndex = 64U << 20;

std::string lowerCase(std::string text)
{
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

IndexEntry entryOf(const Manifest& manifest, const std::string& file, const std::string& bytes)
{
    IndexEntry entry{manifest.id,  manifest.name, manifest.description, manifest.license,   manifest.version,
                     manifest.jet, manifest.sdk,  manifest.abi,         manifest.requires_, {},
                     file,         bytes.size(),  sha256(bytes)};
    for (const Contribution& one : manifest.contributions)
        entry.contributions.push_back(std::string(kindName(one.kind)) + " " + one.id);
    return entry;
}

}  // namespace

Result<void> IndexEntry::fits() const
{
    Manifest manifest;
    manifest.id = id;
    manifest.jet = jet;
    manifest.sdk = sdk;
    manifest.abi = abi;
    return checkBuild(manifest);
}

Result<Index> indexFolder(const fs::path& folder, std::vector<Error>& problems)
{
    std::error_code problem;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, problem))
        if (entry.path().extension() == ".jetplugin") files.push_back(entry.path());
    if (problem)
        return Error("cannot be read: " + problem.message() + "; name a folder of packages",
                     Location{folder.string(), 0, 0});
    std::sort(files.begin(), files.end());
    Index index;
    for (const fs::path& file : files) {
        const std::string name = file.filename().string();
        const auto plain = checkEntryName(name);
        const auto bytes = readPackage(file);
        const auto manifest = bytes ? manifestOf(*bytes, file) : Result<Manifest>(bytes.error());
        if (!plain) {
            problems.push_back(Error(plain.error().message + "; rename it", Location{file.string(), 0, 0}));
        } else if (!manifest) {
            problems.push_back(manifest.error());
        } else {
            index.entries.push_back(entryOf(*manifest, name, *bytes));
        }
    }
    std::stable_sort(index.entries.begin(), index.entries.end(),
                     [](const auto& a, const auto& b) { return a.id != b.id ? a.id < b.id : a.version > b.version; });
    return index;
}

Result<Repository> Repository::open(const Source& source)
{
    Repository repository(source);
    const auto text = source.read("index.json", kLargestIndex);
    if (!text)
        return Error(text.error().message + "; a repository has an index.json, which 'jet plugins index DIR' makes",
                     text.error().where);
    auto index = Index::parse(*text, source.address("index.json"));
    if (!index) return index.error();
    repository.index_ = std::move(*index);
    return repository;
}

std::vector<const IndexEntry*> Repository::search(const std::string& word) const
{
    const std::string wanted = lowerCase(word);
    std::vector<const IndexEntry*> found;
    for (const IndexEntry& entry : index_.entries) {
        std::string words = entry.id + "\n" + entry.name + "\n" + entry.description;
        for (const std::string& one : entry.contributions) words += "\n" + one;
        if (lowerCase(words).find(wanted) == std::string::npos) continue;
        if (found.empty() || found.back()->id != entry.id)
            found.push_back(&entry);
        else if (!found.back()->fits() && entry.fits())
            found.back() = &entry;  // an older version that can be used tells more than a newer one that cannot
    }
    return found;
}

/// Depth first, so that what is required comes before who requires it.
class Repository::Resolver {
public:
    Resolver(const Repository& repository, const std::vector<InstalledPlugin>& installed)
        : repository_(repository), installed_(installed)
    {
    }

    Result<void> add(const std::string& id, const Dependency* need)
    {
        if (std::find(chain_.begin(), chain_.end(), id) != chain_.end())
            return Error("the plugins of the repository require each other in a circle: " + chain(id) +
                         "; tell its keeper");
        const auto chosen =
            std::find_if(chosen_.begin(), chosen_.end(), [&](const IndexEntry* e) { return e->id == id; });
        if (chosen != chosen_.end()) {
            if (admits(need, (*chosen)->version)) return {};
            return Error("no versions fit together: " + chain(id) + " requires " + need->text() +
                         ", but another one takes " + (*chosen)->version.text());
        }
        const auto entry = newest(id, need);
        if (!entry) return entry.error();
        chain_.push_back(id);
        for (const Dependency& next : (*entry)->needs) {
            if (isInstalled(next)) continue;
            if (const auto added = add(next.id, &next); !added) return added;
        }
        chain_.pop_back();
        chosen_.push_back(*entry);
        return {};
    }

    std::vector<const IndexEntry*> chosen() && { return std::move(chosen_); }

private:
    static bool admits(const Dependency* need, const Version& version) { return !need || need->admits(version); }
    std::string chain(const std::string& last) const
    {
        std::string text;
        for (const std::string& link : chain_) text += link + " → ";
        return text + last;
    }
    bool isInstalled(const Dependency& need) const
    {
        return std::any_of(installed_.begin(), installed_.end(), [&](const InstalledPlugin& one) {
            return one.works && one.id == need.id && admits(&need, one.version);
        });
    }

    Result<const IndexEntry*> newest(const std::string& id, const Dependency* need) const
    {
        std::string why = "the repository does not have it";
        for (const IndexEntry& entry : repository_.index_.entries) {
            if (entry.id != id) continue;
            if (!admits(need, entry.version)) {
                why = "the repository has version " + entry.version.text() + " and not " + need->range.inWords();
                continue;
            }
            const auto fits = entry.fits();
            if (fits) return &entry;
            why = "version " + entry.version.text() + " does not fit this JET: " + fits.error().message;
        }
        return Error("the plugin " + chain(id) + " cannot be installed: " + why +
                     (chain_.empty() ? "; 'jet plugins search --from ...' shows what there is" : ""));
    }

    const Repository& repository_;
    const std::vector<InstalledPlugin>& installed_;
    std::vector<std::string> chain_;
    std::vector<const IndexEntry*> chosen_;
};

Result<std::vector<const IndexEntry*>> Repository::resolve(const std::string& id,
                                                           const std::vector<InstalledPlugin>& installed) const
{
    Resolver resolver(*this, installed);
    if (const auto added = resolver.add(id, nullptr); !added) return added.error();
    return std::move(resolver).chosen();
}

Result<std::string> Repository::fetch(const IndexEntry& entry, const ArchiveLimits& limits) const
{
    const Location where{address(entry), 0, 0};
    if (entry.size > limits.packageBytes)
        return Error("this package is larger than " + std::to_string(limits.packageBytes >> 20) + " MB; it is refused",
                     where);
    auto bytes = source_.read(entry.file, limits.packageBytes);
    if (!bytes) return bytes.error();
    if (bytes->size() != entry.size)
        return Error("the package has " + std::to_string(bytes->size()) + " bytes, the index says " +
                         std::to_string(entry.size) +
                         ": the download is not complete, or the index is old; nothing was installed",
                     where);
    if (const std::string hash = sha256(*bytes); hash != entry.sha256)
        return Error("the package is not the one of the index: its SHA-256 is " + hash + ", the index says " +
                         entry.sha256 + "; nothing was installed",
                     where);
    return bytes;
}

Result<std::vector<InstallOutcome>> installFrom(const Repository& repository, const std::string& id,
                                                InstallOptions options)
{
    const auto chosen = repository.resolve(id, options.installed);
    if (!chosen) return chosen.error();
    const ArchiveLimits limits = options.limits;
    auto installer = Installer::open(std::move(options));
    if (!installer) return installer.error();
    for (const IndexEntry* entry : *chosen) {
        const auto bytes = repository.fetch(*entry, limits);
        if (!bytes) return bytes.error();
        const fs::path name = repository.address(*entry);
        const auto manifest = manifestOf(*bytes, name, limits);
        if (!manifest) return manifest.error();
        if (manifest->id != entry->id || manifest->version != entry->version)
            return Error("the index says " + entry->id + " " + entry->version.text() + ", but the package holds " +
                             manifest->id + " " + manifest->version.text() + "; tell the keeper of the repository",
                         Location{name.string(), 0, 0});
        if (const auto staged = (*installer)->stage(*bytes, name); !staged) return staged.error();
    }
    return (*installer)->commit();
}

}  // namespace jet::host
