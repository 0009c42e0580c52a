#include "project_tree_files.hpp"

#include <jet/assets.hpp>
#include <jet/format.hpp>

#include <algorithm>
#include <map>

namespace jet {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRemoved = ".jet-removed";

[[noreturn]] void fail(std::string message, const fs::path& file = {})
{
    throw Failure(Error(std::move(message), Location{file.string(), 0, 0}));
}

fs::path folderOf(const Project& project)
{
    if (project.file().empty()) fail("the project has no folder yet; save it before working with its files");
    return fs::absolute(project.folder().empty() ? fs::path(".") : project.folder()).lexically_normal();
}

fs::path existing(const Project& project, const std::string& path)
{
    const fs::path folder = folderOf(project);
    const fs::path file = (folder / path).lexically_normal();
    const auto assets = assetFiles(project);
    if (std::ranges::find(assets, path) == assets.end())
        fail("this is not a file of the project, or not any more", file);
    return file;
}

void makeFolder(const fs::path& folder)
{
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem) fail("this folder cannot be made: " + problem.message() + "; check the permissions", folder);
}

/// A place in .jet-removed that is free.
fs::path shelf(const fs::path& folder, const fs::path& name)
{
    std::error_code ignored;
    const fs::path removed = folder / kRemoved;
    if (!fs::exists(removed, ignored)) {
        makeFolder(removed);
        writeFileAtomically(removed / ".gitignore", "*\n").orThrow();
    }
    for (int i = 1;; ++i) {
        fs::path place = removed / (std::to_string(i) + " " + name.string());
        if (!fs::exists(place, ignored)) return place;
    }
}

std::vector<AssetReference> referencesTo(const Project& project, const fs::path& file)
{
    std::vector<AssetReference> all = findAssets(project);
    std::erase_if(all, [&](const AssetReference& reference) { return reference.file != file; });
    return all;
}

void checkChangeable(const AssetReference& reference)
{
    const Item* item = reference.scene->items().find(reference.item);
    if (!item || !isChangeable(reference))
        fail("'" + (item ? item->name() : std::string()) + "' in the scene '" + reference.scene->name() +
             "' refers to this file and cannot be changed without its plugin; install that first");
    if (reference.scene->items().inTransaction())
        fail("finish or cancel '" + reference.scene->items().transactionLabel() + "' in the scene '" +
             reference.scene->name() + "' first");
}

}  // namespace

void moveFile(const FileMove& move, Project& project)
{
    std::error_code problem;
    if (!fs::exists(move.from, problem))
        fail("this file is not there any more; it was moved or deleted outside of JET", move.from);
    if (fs::exists(move.to, problem)) fail("there is a file of this name already; choose another name", move.to);
    std::map<Scene*, std::vector<AssetReference>> references;
    if (!move.oldReference.empty()) {
        for (AssetReference& reference : referencesTo(project, move.from)) {
            checkChangeable(reference);
            references[reference.scene].push_back(std::move(reference));
        }
    }
    makeFolder(move.to.parent_path());
    fs::rename(move.from, move.to, problem);
    if (problem) fail("this file cannot be moved: " + problem.message() + "; check the permissions", move.from);
    for (const auto& [scene, list] : references) {
        auto edit = scene->items().begin("Rename file");
        for (const AssetReference& reference : list) rewrite(edit, reference, move.newReference);
        edit.commit();
    }
}

RemovedFiles removedFiles(const fs::path& projectFolder) { return removedFiles(projectFolder, {}); }

RemovedFiles removedFiles(const fs::path& projectFolder, const std::set<fs::path>& but)
{
    RemovedFiles found;
    std::error_code problem;
    const fs::path folder = fs::absolute(projectFolder.empty() ? fs::path(".") : projectFolder).lexically_normal();
    for (fs::directory_iterator at(folder / kRemoved, problem), end; !problem && at != end; at.increment(problem)) {
        std::error_code none;
        if (at->path().filename() == ".gitignore" || !at->is_regular_file(none) || but.contains(at->path())) continue;
        const std::uintmax_t size = at->file_size(none);
        found.files.push_back(at->path());
        found.bytes += none ? 0 : size;
    }
    std::ranges::sort(found.files);
    return found;
}

bool isShelf(const fs::path& file) { return file.parent_path().filename() == kRemoved; }

FileMove prepareNewFile(const Project& project, const fs::path& source)
{
    const fs::path folder = folderOf(project);
    std::error_code ignored;
    if (!fs::is_regular_file(source, ignored))
        fail("this file is not there, or is no file; choose another one", source);
    if (liesIn(fs::absolute(source), folder) && !source.filename().string().starts_with('.'))
        return {{}, {}, {}, fs::absolute(source).lexically_normal().lexically_relative(folder).generic_string()};
    const std::string content = readFile(source).orThrow();
    const auto before = assetFiles(project);
    const std::string place = storeAsset(folder, source.filename().string(), content).orThrow();
    if (std::ranges::find(before, place) != before.end()) return {{}, {}, {}, place};
    const fs::path waiting = shelf(folder, source.filename());
    std::error_code problem;
    fs::rename(folder / place, waiting, problem);
    if (problem) fail("this file cannot be moved: " + problem.message() + "; check the permissions", folder / place);
    return {waiting, folder / place, {}, place};
}

FileMove prepareRemoval(const Project& project, const std::string& path)
{
    const fs::path file = existing(project, path);
    if (const auto users = referencesTo(project, file); !users.empty()) {
        const Item* item = users.front().scene->items().find(users.front().item);
        fail("'" + (item ? item->name() : std::string()) + "' in the scene '" + users.front().scene->name() +
                 "' uses this file; delete it there, or let it use another one, first",
             file);
    }
    return {file, shelf(folderOf(project), file.filename()), {}, {}};
}

FileMove prepareRename(const Project& project, const std::string& path, const std::string& name)
{
    const fs::path file = existing(project, path);
    if (name.empty() || name.starts_with('.') || name.find('/') != std::string::npos ||
        name.find('\0') != std::string::npos)
        fail("'" + name + "' cannot be the name of a file: it is empty, starts with a point or has a '/' in it");
    const fs::path to = file.parent_path() / name;
    const std::string newPath = to.lexically_relative(folderOf(project)).generic_string();
    return {file, to, path, newPath};
}

std::string freeCopyName(const Project& project, const std::string& name)
{
    std::size_t digits = name.size();
    while (digits > 0 && name[digits - 1] >= '0' && name[digits - 1] <= '9' && name.size() - digits < 6) --digits;
    const bool numbered = digits > 0 && digits < name.size() && name[digits - 1] == ' ';
    const std::string stem = numbered ? name.substr(0, digits) : name + " ";
    for (int i = numbered ? std::stoi(name.substr(digits)) + 1 : 2;; ++i) {
        std::string free = stem + std::to_string(i);
        if (!project.scene(free)) return free;
    }
}

}  // namespace jet
