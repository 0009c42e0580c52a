#include "package.hpp"

#include "host/archive/entry_name.hpp"

#include <jet/format.hpp>

#include <algorithm>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

Error at(const fs::path& file, const std::string& message) { return Error(message, Location{file.string(), 0, 0}); }

bool isHidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

Result<ArchiveFile> readEntry(const fs::directory_entry& entry, const fs::path& folder)
{
    std::error_code problem;
    ArchiveFile file;
    file.name = entry.path().lexically_relative(folder).generic_string();
    if (entry.is_symlink(problem))
        return at(entry.path(), "is a symbolic link, which packages do not hold; put the file itself in its place");
    if (!entry.is_regular_file(problem)) return at(entry.path(), "is neither a file nor a folder; remove it");
    if (const auto fine = checkEntryName(file.name); !fine)
        return at(entry.path(), "cannot be packed: " + fine.error().message + "; rename it");
    auto content = readFile(entry.path());
    if (!content) return content.error();
    file.content = std::move(*content);
    file.executable = (entry.status(problem).permissions() & fs::perms::owner_exec) != fs::perms::none;
    return file;
}

Result<std::vector<ArchiveFile>> readFolder(const fs::path& folder)
{
    std::vector<ArchiveFile> files;
    EntryNames names;
    std::error_code problem;
    for (fs::recursive_directory_iterator entry(folder, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        std::error_code ignored;
        const bool isFolder = entry->is_directory(ignored) && !entry->is_symlink(ignored);
        if (isHidden(entry->path())) {
            if (isFolder) entry.disable_recursion_pending();
            continue;
        }
        if (isFolder || entry->path().extension() == ".jetplugin") continue;
        auto file = readEntry(*entry, folder);
        if (!file) return file.error();
        if (const auto fine = names.add(file->name, false); !fine)
            return at(entry->path(), "cannot be packed: " + fine.error().message + "; rename it");
        files.push_back(std::move(*file));
    }
    if (problem) return at(folder, "cannot be read: " + problem.message() + "; check its permissions");
    return files;
}

}  // namespace

std::string packageFileName(const Manifest& manifest)
{
    return manifest.id + "-" + manifest.version.text() + "." + std::string(kPackageExtension);
}

Result<void> checkContents(const Manifest& manifest, const fs::path& folder)
{
    std::error_code ignored;
    const std::string library = manifest.library + ".so";
    if (!fs::is_regular_file(folder / library, ignored))
        return at(folder, "has no built library " + library +
                              ": this is a source folder. Build it (cmake -B build && cmake --build build), then take "
                              "build/lib/jet/plugins/" +
                              manifest.id);
    if (manifest.sdk.empty() || manifest.abi.empty())
        return at(folder / "plugin.json",
                  "does not say what the library was built with; take the folder that jet_add_plugin() made, "
                  "build/lib/jet/plugins/" +
                      manifest.id);
    for (const Contribution& one : manifest.contributions) {
        if (one.icon.empty()) continue;
        const auto fine = checkEntryName(one.icon);
        if (!fine)
            return at(folder / "plugin.json",
                      "names the icon " + shownName(one.icon) + ", but " + fine.error().message);
        if (!fs::is_regular_file(folder / one.icon, ignored))
            return at(folder / "plugin.json", "names the icon " + shownName(one.icon) + " of the " +
                                                  std::string(kindName(one.kind)) + " '" + one.id +
                                                  "', which is not in the folder; add it");
    }
    return {};
}

Result<PackedPlugin> packFolder(const fs::path& folder)
{
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored)) return at(folder, "is no folder; name the folder of a built plugin");
    if (!fs::exists(folder / "plugin.json", ignored))
        return at(folder, "has no plugin.json, so it is no plugin; name the folder of a built plugin");
    auto manifest = Manifest::read(folder / "plugin.json");
    if (!manifest) return manifest.error();
    if (const auto complete = checkContents(*manifest, folder); !complete) return complete.error();
    auto files = readFolder(folder);
    if (!files) return files.error();
    PackedPlugin packed{std::move(*manifest), {}, files->size()};
    auto bytes = writeZip(std::move(*files));
    if (!bytes) return bytes.error();
    packed.bytes = std::move(*bytes);
    return packed;
}

Result<std::string> readPackage(const fs::path& file, const ArchiveLimits& limits)
{
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored) && fs::file_size(file, ignored) > limits.packageBytes)
        return at(file,
                  "this package is larger than " + std::to_string(limits.packageBytes >> 20) + " MB; it is refused");
    if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored))
        return at(file, "is not a file; a package is a file *.jetplugin, made with 'jet plugins pack'");
    return readFile(file);
}

Result<Manifest> manifestOf(std::string_view bytes, const fs::path& package, const ArchiveLimits& limits)
{
    const auto text = readFromZip(bytes, "plugin.json", package, limits);
    if (!text) return text.error();
    return Manifest::parse(*text, package / "plugin.json");
}

}  // namespace jet::host
