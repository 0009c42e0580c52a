// Backups: .jet-backups/<project>/<time>/ holds project.jet and the scenes as they were before a save. Copies, not
// links to the project's files: another program may write into those in place. A file that did not change since the
// backup before is a link to the copy there, which nobody writes to.
#include "project_files.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace jet {

namespace fs = std::filesystem;

namespace {

constexpr const char* kVersionMark = "-version-";

// "project.jet" -> ".jet-backups/project"
fs::path backupsOf(const fs::path& folder, const std::string& project)
{
    return folder / ".jet-backups" / fs::path(project).stem();
}

std::string timeName()
{
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
    const auto seconds = static_cast<std::time_t>(ms / 1000);
    std::tm utc{};
    ::gmtime_r(&seconds, &utc);
    char text[32];
    const std::size_t n = std::strftime(text, sizeof text, "%Y-%m-%dT%H-%M-%S", &utc);
    std::snprintf(text + n, sizeof text - n, ".%03d", static_cast<int>(ms % 1000));
    return text;
}

std::vector<Backup> backupsIn(const fs::path& folder)
{
    std::vector<Backup> all;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (entry.is_directory(ignored) && !name.starts_with('.')) all.push_back({name, entry.path()});
    }
    std::ranges::sort(all, std::greater(), &Backup::name);
    return all;
}

bool sameFile(const fs::path& a, const fs::path& b)
{
    const auto x = statFile(a), y = statFile(b);
    return x && y && x->size == y->size && x->modified == y->modified;
}

void copyTime(const fs::path& from, const fs::path& to)
{
    struct stat info {};
    if (::stat(from.c_str(), &info) != 0) return;
    const timespec times[2] = {info.st_atim, info.st_mtim};
    ::utimensat(AT_FDCWD, to.c_str(), times, 0);
}

Error failed(const fs::path& where, const std::error_code& problem)
{
    return Error("the backup cannot be written: " + problem.message() + "; free some space or check the permissions",
                 Location{where.string(), 0, 0});
}

// What version control should not see.
void ignoreFolder(const fs::path& folder)
{
    std::error_code ignored;
    if (!fs::exists(folder / ".gitignore", ignored))
        (void)writeFileAtomically(folder / ".gitignore", std::string_view("*\n"));
}

// Originals of older formats stay.
void removeOldest(std::vector<Backup>& backups, std::size_t kept)
{
    std::erase_if(backups, [](const Backup& backup) { return backup.name.find(kVersionMark) != std::string::npos; });
    std::error_code ignored;
    for (std::size_t i = kept; i < backups.size(); ++i) fs::remove_all(backups[i].folder, ignored);
}

Result<void> fillBackup(const fs::path& folder, const fs::path& target, const fs::path& previous,
                        const std::set<std::string>& files)
{
    std::error_code problem;
    for (const std::string& file : files) {
        const fs::path from = folder / file, to = target / file;
        if (!fs::exists(from, problem)) continue;
        fs::create_directories(to.parent_path(), problem);
        if (problem) return failed(to, problem);
        if (!previous.empty() && sameFile(previous / file, from)) {
            fs::create_hard_link(previous / file, to, problem);
            if (!problem) continue;
        }
        fs::copy_file(from, to, problem);
        if (problem) return failed(to, problem);
        copyTime(from, to);
    }
    return {};
}

// The scene files of all projects in the folder.
std::set<std::string> scenesIn(const fs::path& folder)
{
    std::set<std::string> scenes;
    std::error_code problem;
    fs::recursive_directory_iterator at(folder.empty() ? fs::path(".") : folder, problem);
    for (; !problem && at != fs::recursive_directory_iterator(); at.increment(problem)) {
        if (at->path().filename() == ".jet-backups") at.disable_recursion_pending();
        if (at->path().extension() == ".scene")
            scenes.insert(at->path().lexically_relative(folder.empty() ? fs::path(".") : folder).string());
    }
    return scenes;
}

}  // namespace

Result<void> backUp(const fs::path& folder, const std::string& project, const std::set<std::string>& files,
                    std::size_t count, std::optional<int> formatVersion)
{
    std::error_code problem;
    const bool any = std::ranges::any_of(files, [&](const std::string& f) { return fs::exists(folder / f, problem); });
    if (!any) return {};
    const fs::path all = backupsOf(folder, project);
    fs::create_directories(all, problem);
    if (problem) return failed(all, problem);
    ignoreFolder(folder / ".jet-backups");
    auto before = backupsIn(all);
    std::string name = timeName();
    if (!before.empty()) {  // the clock may have gone back
        const std::string newest = before.front().name.substr(0, before.front().name.find(kVersionMark));
        if (name <= newest) name = newest + "a";
    }
    if (formatVersion) name += kVersionMark + std::to_string(*formatVersion);
    const fs::path unfinished = all / ("." + name + ".part");
    auto filled = fillBackup(folder, unfinished, before.empty() ? fs::path() : before.front().folder, files);
    if (filled) {
        fs::rename(unfinished, all / name, problem);
        if (problem) filled = failed(all / name, problem);
    }
    if (!filled) {
        fs::remove_all(unfinished, problem);
        return filled;
    }
    if (!formatVersion) removeOldest(before, count > 0 ? count - 1 : 0);
    return {};
}

std::vector<Backup> findBackups(const fs::path& projectFile)
{
    const auto file = findProjectFile(projectFile);
    return backupsIn(
        backupsOf((file ? *file : projectFile).parent_path(), (file ? *file : projectFile).filename().string()));
}

Result<void> backUpProject(const fs::path& projectFile)
{
    std::set<std::string> files = scenesIn(projectFile.parent_path());
    files.insert(projectFile.filename().string());
    return backUp(projectFile.parent_path(), projectFile.filename().string(), files, Project::kDefaultBackups);
}

Result<void> restoreBackup(const fs::path& projectFile, const std::string& name)
{
    const auto all = findBackups(projectFile);
    const auto chosen = std::ranges::find(all, name, &Backup::name);
    if (chosen == all.end())
        return Error("there is no backup '" + name + "'; 'jet project backups' lists them",
                     Location{projectFile.string(), 0, 0});
    const fs::path folder = projectFile.parent_path();
    const std::string project = projectFile.filename().string();
    std::set<std::string> files;
    std::error_code problem;
    for (const auto& entry : fs::recursive_directory_iterator(chosen->folder, problem))
        if (entry.is_regular_file(problem)) files.insert(fs::relative(entry.path(), chosen->folder, problem).string());
    // Read before the present state becomes a backup: that may push the chosen one out.
    std::map<std::string, std::string> contents;
    for (const std::string& file : files) {
        auto content = readFile(chosen->folder / file);
        if (!content) return content.error();
        contents.emplace(file, std::move(*content));
    }
    std::set<std::string> present = scenesIn(folder);
    present.insert(files.begin(), files.end());
    if (const auto kept = backUp(folder, project, present, Project::kDefaultBackups + 1); !kept) return kept;
    // project.jet last, as when saving.
    const auto put = [&](const std::string& file) -> Result<void> {
        fs::create_directories((folder / file).parent_path(), problem);
        return writeFileAtomically(folder / file, contents.at(file));
    };
    for (const auto& [file, content] : contents)
        if (file != project)
            if (const auto written = put(file); !written) return written;
    return contents.contains(project) ? put(project) : Result<void>();
}

}  // namespace jet
