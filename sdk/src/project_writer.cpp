#include "project_files.hpp"
#include "utf8.hpp"
#include "xml_text.hpp"

#include <jet/catalog.hpp>
#include <jet/project.hpp>

#include <set>

namespace jet {

namespace fs = std::filesystem;

class ProjectWriter {
public:
    ProjectWriter(Project& project, Overwrite overwrite)
        : project_(project), files_(*project.files_), folder_(project.folder()), overwrite_(overwrite)
    {
    }

    /// Scenes first, project.jet next, then what nobody refers to any more: a crash between leaves a project that
    /// opens.
    Result<void> write(bool everything)
    {
        files_.notes.clear();
        if (const auto fine = check(); !fine) return fine;
        assignFiles();
        auto written = writeFiles(everything);
        // A scene without a file on disk must be written next time, even if nobody changes it before.
        if (!written)
            for (const Scene* scene : fresh_) project_.sceneFiles_.erase(scene);
        return written;
    }

private:
    Result<void> writeFiles(bool everything)
    {
        const std::string structure = project_.structure();
        std::vector<FileToWrite> files = filesToWrite(everything, structure);
        if (const auto free = checkForeign(files); !free) return free;
        if (!files_.migrated.empty()) {
            if (const auto kept = keepOriginal(); !kept) return kept;
        } else if (!files.empty()) {
            backUpOld(files);
        }
        if (files_.watcher) files_.watcher->aboutToSave(files, everything);
        for (FileToWrite& file : files) {
            const fs::path path = folder_ / file.path;
            if (const auto made = makeFolder(path.parent_path()); !made) return made;
            const auto written = writeFileAtomically(path, file.content);
            remember(file, static_cast<bool>(written));
            if (!written) return written;
        }
        project_.recordedUses_ = project_.pluginsUsed();
        project_.savedStructure_ = structure;
        for (Scene* scene : project_.scenes()) scene->undoRedo().markClean();
        files_.unsaved.clear();
        files_.migrated.clear();
        files_.structureUnsaved = false;
        removeObsolete();
        if (files_.watcher) files_.watcher->saved();
        return {};
    }

    // Also a write that failed may have replaced the file, when only the folder could not be synced after.
    void remember(const FileToWrite& file, bool written)
    {
        const fs::path path = folder_ / file.path;
        auto state = statFile(path);
        if (!state) return;
        if (!written) {
            const auto content = readFile(path);
            if (!content || contentHash(*content) != file.hash) return;
        }
        state->hash = file.hash;
        files_.known[file.path] = *state;
    }

    std::vector<FileToWrite> filesToWrite(bool everything, const std::string& structure)
    {
        std::vector<FileToWrite> files;
        const auto add = [&](std::string path, const Scene* scene, std::string content) {
            const std::uint64_t hash = contentHash(content);
            files.push_back({std::move(path), scene, std::move(content), hash});
        };
        std::error_code ignored;
        for (const Scene* scene : project_.scenes()) {
            const std::string& path = project_.sceneFiles_[scene];
            const bool same = scene->undoRedo().isClean() && !fresh_.contains(scene) && !files_.unsaved.contains(scene);
            // A file that has gone is written again: the project in memory may be all there is of it.
            if (everything || !same || files_.migrated.contains(path) || !fs::exists(folder_ / path, ignored) ||
                isReplaced(path))
                add(path, scene, writeSceneText(*scene));
        }
        const std::string name = project_.file_.filename().string();
        if (everything || files_.structureUnsaved || files_.migrated.contains(name) ||
            structure != project_.savedStructure_ || usesChanged() || !fs::exists(folder_ / name, ignored) ||
            isReplaced(name))
            add(name, nullptr, text(structure));
        return files;
    }

    /// Another program's version, that the user wants to replace by this one although nothing was changed here.
    bool isReplaced(const std::string& path) const
    {
        const auto known = files_.known.find(path);
        return overwrite_ == Overwrite::Allow && known != files_.known.end() &&
               differsOnDisk(folder_ / path, known->second);
    }

    Result<void> checkForeign(const std::vector<FileToWrite>& files) const
    {
        if (overwrite_ == Overwrite::Allow) return {};
        for (const FileToWrite& file : files) {
            const auto known = files_.known.find(file.path);
            if (known == files_.known.end() || !differsOnDisk(folder_ / file.path, known->second)) continue;
            return Error("another program changed this file since it was read, so it was not replaced; open the "
                         "project again, save it elsewhere, or replace the file on purpose",
                         Location{(folder_ / file.path).string(), 0, 0});
        }
        return {};
    }

    /// A project of an older format, before it is written in this one for the first time.
    Result<void> keepOriginal()
    {
        std::set<std::string> paths;
        for (const auto& [path, state] : files_.known) paths.insert(path);
        auto kept = backUp(folder_, project_.file_.filename().string(), paths, files_.backups, files_.oldestVersion);
        if (kept) return kept;
        return Error("the project was not saved, since the original of format version " +
                         std::to_string(files_.oldestVersion) + " cannot be kept: " + kept.error().message +
                         "; or save it in another place",
                     kept.error().where);
    }

    void backUpOld(const std::vector<FileToWrite>& files)
    {
        if (files_.backups == 0) return;
        std::set<std::string> paths;
        for (const FileToWrite& file : files) paths.insert(file.path);
        for (const auto& [path, state] : files_.known) paths.insert(path);
        for (const fs::path& path : project_.obsoleteFiles_) paths.insert(path.string());
        const auto kept = backUp(folder_, project_.file_.filename().string(), paths, files_.backups);
        if (!kept) files_.notes.push_back("the former state could not be kept as a backup: " + kept.error().text());
    }

    // What could be written but not opened again is refused before anything is written.
    Result<void> check() const
    {
        std::set<std::string> names;
        for (const Scene* scene : project_.scenes()) {
            if (!names.insert(scene->name()).second)
                return Error("there are two scenes called '" + scene->name() + "'; rename one, then save again");
            if (firstUnstorable(scene->name()) != std::string::npos)
                return Error("the name of a scene is not UTF-8 or has a NUL in it; rename it, then save again");
        }
        if (firstUnstorable(project_.name_) != std::string::npos)
            return Error("the project's name is not UTF-8 or has a NUL in it; rename it, then save again");
        return check(project_.root_, 0);
    }

    static Result<void> check(const Filter& filter, int depth)
    {
        if (depth > kMaximumFilterDepth)
            return Error("filters are nested more than 100 deep; flatten them, then save again");
        if (firstUnstorable(filter.name) != std::string::npos)
            return Error("the name of a filter is not UTF-8 or has a NUL in it; rename it, then save again");
        for (const auto& child : filter.filters)
            if (const auto fine = check(*child, depth + 1); !fine) return fine;
        return {};
    }

    static Result<void> makeFolder(const fs::path& folder)
    {
        std::error_code problem;
        if (!folder.empty()) fs::create_directories(folder, problem);
        if (!problem) return {};
        return Error("this folder cannot be made: " + problem.message() + "; choose another place",
                     Location{folder.string(), 0, 0});
    }

    void removeObsolete()
    {
        std::error_code ignored;
        std::set<std::string> used;
        for (const auto& [scene, file] : project_.sceneFiles_) used.insert(file);
        for (const fs::path& file : project_.obsoleteFiles_) {
            if (used.contains(file.string())) continue;
            const auto known = files_.known.find(file.string());
            const bool foreign = known != files_.known.end() && differsOnDisk(folder_ / file, known->second);
            if (!foreign) fs::remove(folder_ / file, ignored);  // what somebody else changed stays
            files_.known.erase(file.string());
        }
        project_.obsoleteFiles_.clear();
    }

    static std::string safeName(const std::string& name)
    {
        std::string safe;
        for (const char c : name) {
            const bool bad = static_cast<unsigned char>(c) < 0x20 ||
                             std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos;
            safe += bad ? '_' : c;
        }
        while (!safe.empty() && (safe.front() == '.' || safe.front() == ' ')) safe.erase(0, 1);
        std::size_t length = std::min<std::size_t>(safe.size(), 100);
        while (length > 0 && length < safe.size() && (static_cast<unsigned char>(safe[length]) & 0xc0U) == 0x80U)
            --length;
        safe.resize(length);  // whole characters only
        return safe.empty() ? "scene" : safe;
    }

    // Two projects may share a folder; their scenes may not share files.
    void assignFiles()
    {
        const bool shares = project_.file_.filename() != "project.jet";
        const std::string prefix = shares ? safeName(project_.file_.stem().string()) + "-" : "";
        std::set<std::string> taken;
        for (const auto& [scene, file] : project_.sceneFiles_) taken.insert(file);
        for (const Scene* scene : project_.scenes()) {
            if (project_.sceneFiles_.contains(scene)) continue;
            const std::string base = "scenes/" + prefix + safeName(scene->name());
            std::string file = base + ".scene";
            for (int i = 2; taken.contains(file); ++i) file = base + " " + std::to_string(i) + ".scene";
            taken.insert(file);
            project_.sceneFiles_[scene] = file;
            fresh_.insert(scene);
        }
    }

    bool usesChanged() const
    {
        const auto uses = project_.pluginsUsed();
        const auto& recorded = project_.recordedUses_;
        if (uses.size() != recorded.size()) return true;
        for (std::size_t i = 0; i < uses.size(); ++i)
            if (uses[i].id != recorded[i].id || uses[i].version != recorded[i].version ||
                uses[i].count != recorded[i].count || uses[i].provides != recorded[i].provides)
                return true;
        return false;
    }

    std::string text(std::string structure) const
    {
        std::string plugins;
        for (const PluginUse& use : project_.pluginsUsed()) {
            std::string provides;
            for (const auto& [kind, id] : use.provides)
                provides += (provides.empty() ? "" : " ") + std::string(manifestKey(kind)) + "/" + id;
            plugins += "    <plugin" + xmlAttribute("id", use.id) + xmlAttribute("version", use.version) +
                       xmlAttribute("uses", std::to_string(use.count)) +
                       (provides.empty() ? "" : xmlAttribute("provides", provides)) + "/>\n";
        }
        if (!plugins.empty()) structure.insert(structure.find('\n') + 1, "  <plugins>\n" + plugins + "  </plugins>\n");
        return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + structure;
    }

    Project& project_;
    Project::Files& files_;
    fs::path folder_;
    Overwrite overwrite_;
    std::set<const Scene*> fresh_;
};

Result<void> Project::save(Overwrite overwrite)
{
    if (file_.empty()) return Error("the project has no file yet; choose where to save it");
    if (overwrite == Overwrite::Refuse && !isModified() && files_->migrated.empty() && !savedStructure_.empty())
        return {};
    return ProjectWriter(*this, overwrite).write(false);
}

Result<void> Project::saveAs(const fs::path& folderOrFile)
{
    if (extensionOf(folderOrFile) == "jetz")
        return Error("a packed project is not worked on; save in a folder, then pack that with 'jet project pack'",
                     Location{folderOrFile.string(), 0, 0});
    const fs::path old = file_;
    const auto oldScenes = sceneFiles_;
    const auto oldObsolete = obsoleteFiles_;
    const auto oldKnown = files_->known;
    const auto oldMigrated = files_->migrated;
    file_ = folderOrFile.extension() == ".jet" ? folderOrFile : folderOrFile / "project.jet";
    std::error_code ignored;
    if (!fs::equivalent(old, file_, ignored)) {
        sceneFiles_.clear();
        obsoleteFiles_.clear();  // they belong to the project left behind
        files_->known.clear();
        files_->migrated.clear();  // the original stays where it is
    }
    auto written = ProjectWriter(*this, Overwrite::Allow).write(true);
    if (!written) {
        file_ = old;
        sceneFiles_ = oldScenes;
        obsoleteFiles_ = oldObsolete;
        files_->known = oldKnown;
        files_->migrated = oldMigrated;
    }
    for (Scene* scene : scenes()) scene->setAssetFolder(folder().string());
    return written;
}

}  // namespace jet
