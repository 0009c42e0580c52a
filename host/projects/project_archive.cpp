#include "project_archive.hpp"

#include "host/archive/archive.hpp"
#include "host/archive/disk.hpp"
#include "host/archive/entry_name.hpp"

#include <jet/assets.hpp>
#include <jet/format.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <sys/stat.h>
#include <unistd.h>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

Error at(const fs::path& file, const std::string& message) { return Error(message, Location{file.string(), 0, 0}); }

// Scenes are text that repeats itself, so they may shrink more than what a package holds.
ArchiveLimits limits()
{
    ArchiveLimits limits;
    limits.packageBytes = std::size_t{1} << 30;
    limits.unpackedBytes = std::size_t{4} << 30;
    limits.files = 100'000;
    limits.ratioFrom = 64U << 20;
    limits.unicodeNames = true;
    limits.what = "packed project";
    limits.maker = "jet project pack";
    return limits;
}

class FolderReader {
public:
    explicit FolderReader(const Project& project) : folder_(project.folder()), file_(project.file().filename()) {}

    Result<std::vector<ArchiveFile>> read()
    {
        std::error_code problem;
        const fs::path folder = folder_.empty() ? fs::path(".") : folder_;
        for (fs::recursive_directory_iterator entry(folder, problem), end; !problem && entry != end;
             entry.increment(problem)) {
            std::error_code ignored;
            const bool isFolder = entry->is_directory(ignored) && !entry->is_symlink(ignored);
            if (isLeftOut(entry->path(), entry.depth())) {
                if (isFolder) entry.disable_recursion_pending();
            } else if (!isFolder) {
                if (const auto taken = take(*entry, folder); !taken) return taken.error();
            }
        }
        if (problem) return at(folder, "cannot be read: " + problem.message() + "; check its permissions");
        return std::move(files_);
    }

private:
    bool isLeftOut(const fs::path& path, int depth) const
    {
        if (path.filename().string().starts_with('.')) return true;
        const std::string extension = depth == 0 ? extensionOf(path) : "";
        return extension == kPackedProjectExtension || (extension == "jet" && path.filename() != file_);
    }

    Result<void> take(const fs::directory_entry& entry, const fs::path& folder)
    {
        std::error_code problem;
        ArchiveFile file;
        file.name = entry.path().lexically_relative(folder).generic_string();
        if (entry.is_symlink(problem))
            return at(entry.path(), "is a symbolic link, which a packed project does not hold; put the file itself in "
                                    "its place");
        if (!entry.is_regular_file(problem)) return at(entry.path(), "is neither a file nor a folder; remove it");
        auto fine = checkEntryName(file.name, true);
        if (fine) fine = names_.add(file.name, false);
        if (!fine) return at(entry.path(), "cannot be packed: " + fine.error().message + "; rename it");
        auto content = readFile(entry.path());
        if (!content) return content.error();
        file.content = std::move(*content);
        file.executable = (entry.status(problem).permissions() & fs::perms::owner_exec) != fs::perms::none;
        files_.push_back(std::move(file));
        return {};
    }

    fs::path folder_, file_;
    EntryNames names_;
    std::vector<ArchiveFile> files_;
};

/// A folder with a name nobody else has, that goes unless it is kept.
class NewFolder {
public:
    static Result<NewFolder> make(const fs::path& pattern)
    {
        std::string name = pattern.string();
        if (!::mkdtemp(name.data())) return diskError(pattern.parent_path(), "no folder can be made here", errno);
        return NewFolder(name);
    }
    NewFolder(NewFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    NewFolder& operator=(NewFolder&&) = delete;
    ~NewFolder()
    {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }
    fs::path keep() { return std::exchange(path_, {}); }

private:
    explicit NewFolder(fs::path path) : path_(std::move(path)) {}
    fs::path path_;
};

Result<void> unpackInto(const fs::path& packed, const fs::path& folder)
{
    std::error_code ignored;
    const ArchiveLimits most = limits();
    if (fs::exists(packed, ignored) && !fs::is_regular_file(packed, ignored))
        return at(packed, "is not a file; a packed project is a file *.jetz, made with 'jet project pack'");
    if (fs::is_regular_file(packed, ignored) && fs::file_size(packed, ignored) > most.packageBytes)
        return at(packed, "this packed project is larger than 1024 MB; it is refused");
    const auto bytes = readFile(packed);
    if (!bytes) return bytes.error();
    if (auto unpacked = unpackZip(*bytes, folder, packed, most); !unpacked) return unpacked;
    if (findProjectFile(folder)) return {};
    return at(packed, "this file holds no project: project.jet is missing in it; make it with 'jet project pack'");
}

}  // namespace

bool isPackedProject(const fs::path& path)
{
    std::error_code ignored;
    return extensionOf(path) == kPackedProjectExtension && !fs::is_directory(path, ignored);
}

Result<PackedProject> packProject(const Project& project)
{
    auto files = FolderReader(project).read();
    if (!files) return files.error();
    PackedProject packed;
    packed.files = files->size();
    for (const AssetReference& asset : findAssets(project)) {
        std::error_code ignored;
        auto& list = !fs::exists(asset.file, ignored) ? packed.missing : packed.outside;
        if (&list == &packed.outside && liesIn(asset.file, project.folder()) && !fs::path(asset.text).is_absolute())
            continue;
        if (std::ranges::find(list, asset.file) == list.end()) list.push_back(asset.file);
    }
    auto bytes = writeZip(std::move(*files));
    if (!bytes) return bytes.error();
    if (const auto fine = checkZip(*bytes, project.file(), limits()); !fine) return fine.error();
    packed.bytes = std::move(*bytes);
    return packed;
}

Result<fs::path> unpackProject(const fs::path& packed, const fs::path& folder)
{
    std::error_code problem;
    fs::path target = fs::absolute(folder, problem).lexically_normal();
    if (!target.has_filename()) target = target.parent_path();
    const bool exists = fs::exists(fs::symlink_status(target, problem));
    if (exists && (!fs::is_directory(target, problem) || !fs::is_empty(target, problem)))
        return at(folder, "is not an empty folder; name one that is empty or does not exist yet");
    fs::create_directories(target.parent_path(), problem);
    auto made = NewFolder::make(target.parent_path() / ("." + target.filename().string() + ".XXXXXX"));
    if (!made) return made.error();
    if (const auto unpacked = unpackInto(packed, made->path()); !unpacked) return unpacked.error();
    const mode_t mask = ::umask(0);
    ::umask(mask);
    fs::permissions(made->path(), static_cast<fs::perms>(0777U & ~mask), problem);
    if (::rename(made->path().c_str(), target.c_str()) != 0) return diskError(folder, "cannot be written", errno);
    made->keep();
    if (const auto synced = host::syncFolder(target.parent_path()); !synced) return synced.error();
    return findProjectFile(folder);
}

Result<UnpackedProject> UnpackedProject::make(const fs::path& packed)
{
    std::error_code ignored;
    auto made = NewFolder::make(fs::temp_directory_path(ignored) / "jet-project-XXXXXX");
    if (!made) return made.error();
    if (const auto unpacked = unpackInto(packed, made->path()); !unpacked) return unpacked.error();
    return UnpackedProject(made->keep());
}

UnpackedProject::UnpackedProject(UnpackedProject&& other) noexcept : folder_(std::exchange(other.folder_, {})) {}

UnpackedProject::~UnpackedProject()
{
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

}  // namespace jet::host
