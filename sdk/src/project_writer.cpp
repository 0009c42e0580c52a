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
    explicit ProjectWriter(Project& project) : project_(project), folder_(project.file_.parent_path()) {}

    /// Scenes first, project.jet next, then what nobody refers to any more: a crash between leaves a project that
    /// opens.
    Result<void> write(bool everything)
    {
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
        for (const Scene* scene : project_.scenes()) {
            if (!everything && scene->undoRedo().isClean() && !fresh_.contains(scene)) continue;
            const fs::path file = folder_ / project_.sceneFiles_[scene];
            if (const auto made = makeFolder(file.parent_path()); !made) return made;
            if (const auto written = writeFileAtomically(file, writeSceneText(*scene)); !written) return written;
        }
        const std::string structure = project_.structure();
        if (everything || structure != project_.savedStructure_ || usesChanged()) {
            if (const auto made = makeFolder(folder_); !made) return made;
            if (const auto written = writeFileAtomically(project_.file_, text(structure)); !written) return written;
            project_.recordedUses_ = project_.pluginsUsed();
            project_.savedStructure_ = structure;
        }
        for (Scene* scene : project_.scenes()) scene->undoRedo().markClean();
        removeObsolete();
        return {};
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
        for (const fs::path& file : project_.obsoleteFiles_)
            if (!used.contains(file.string())) fs::remove(folder_ / file, ignored);
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
    fs::path folder_;
    std::set<const Scene*> fresh_;
};

Result<void> Project::save()
{
    if (file_.empty()) return Error("the project has no file yet; choose where to save it");
    if (!isModified() && !savedStructure_.empty()) return {};
    return ProjectWriter(*this).write(false);
}

Result<void> Project::saveAs(const fs::path& folderOrFile)
{
    const fs::path old = file_;
    const auto oldScenes = sceneFiles_;
    const auto oldObsolete = obsoleteFiles_;
    file_ = folderOrFile.extension() == ".jet" ? folderOrFile : folderOrFile / "project.jet";
    std::error_code ignored;
    if (!fs::equivalent(old, file_, ignored)) {
        sceneFiles_.clear();
        obsoleteFiles_.clear();  // they belong to the project left behind
    }
    auto written = ProjectWriter(*this).write(true);
    if (!written) {
        file_ = old;
        sceneFiles_ = oldScenes;
        obsoleteFiles_ = oldObsolete;
    }
    return written;
}

}  // namespace jet
