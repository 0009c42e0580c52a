#include "xml_text.hpp"

#include <jet/catalog.hpp>
#include <jet/project.hpp>

#include <set>

namespace jet {

namespace fs = std::filesystem;

class ProjectWriter {
public:
    explicit ProjectWriter(Project& project) : project_(project), folder_(project.file_.parent_path()) {}

    /// Scenes first, project.jet next, then what nobody refers to any more: a crash between leaves a project that opens.
    Result<void> write(bool everything)
    {
        std::error_code problem;
        fs::create_directories(folder_ / "scenes", problem);
        if (problem)
            return Error("the folder for scenes cannot be made: " + problem.message() + "; choose another place",
                         Location{(folder_ / "scenes").string(), 0, 0});
        assignFiles();
        for (Scene* scene : project_.scenes()) {
            const fs::path file = folder_ / project_.sceneFiles_[scene];
            if (!everything && scene->undoRedo().isClean() && !fresh_.contains(scene)) continue;
            if (const auto written = writeFileAtomically(file, writeSceneText(*scene)); !written) return written;
        }
        if (everything || project_.structureChanged_ || !fresh_.empty() || usesChanged()) {
            if (const auto written = writeFileAtomically(project_.file_, text()); !written) return written;
            project_.recordedUses_ = project_.pluginsUsed();
        }
        for (Scene* scene : project_.scenes()) scene->undoRedo().markClean();
        for (const fs::path& file : project_.obsoleteFiles_) fs::remove(folder_ / file, problem);
        project_.obsoleteFiles_.clear();
        project_.structureChanged_ = false;
        return {};
    }

private:
    static std::string safeName(const std::string& name)
    {
        std::string safe;
        for (const char c : name) {
            const bool bad = static_cast<unsigned char>(c) < 0x20 || std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos;
            safe += bad ? '_' : c;
        }
        while (!safe.empty() && (safe.front() == '.' || safe.front() == ' ')) safe.erase(0, 1);
        if (safe.size() > 100) safe.resize(100);
        return safe.empty() ? "scene" : safe;
    }

    void assignFiles()
    {
        std::set<std::string> taken;
        for (const auto& [scene, file] : project_.sceneFiles_) taken.insert(file);
        for (Scene* scene : project_.scenes()) {
            if (project_.sceneFiles_.contains(scene)) continue;
            const std::string base = "scenes/" + safeName(scene->name());
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
            if (uses[i].id != recorded[i].id || uses[i].version != recorded[i].version || uses[i].count != recorded[i].count)
                return true;
        return false;
    }

    std::string text() const
    {
        std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<jet-project version=\"1\"" +
                          xmlAttribute("name", project_.name_) + ">\n";
        const auto uses = project_.pluginsUsed();
        if (!uses.empty()) out += "  <plugins>\n";
        for (const PluginUse& use : uses)
            out += "    <plugin" + xmlAttribute("id", use.id) + xmlAttribute("version", use.version) +
                   xmlAttribute("uses", std::to_string(use.count)) + "/>\n";
        if (!uses.empty()) out += "  </plugins>\n";
        appendFilter(out, project_.root_, 1);
        return out + "</jet-project>\n";
    }

    void appendFilter(std::string& out, const Filter& filter, int depth) const
    {
        const std::string indent(static_cast<std::size_t>(depth) * 2, ' ');
        out += indent + "<filter" + xmlAttribute("name", filter.name) + ">\n";
        for (const auto& scene : filter.scenes)
            out += indent + "  <scene" + xmlAttribute("name", scene->name()) +
                   xmlAttribute("file", project_.sceneFiles_.at(scene.get())) + "/>\n";
        for (const auto& child : filter.filters) appendFilter(out, *child, depth + 1);
        out += indent + "</filter>\n";
    }

    Project& project_;
    fs::path folder_;
    std::set<const Scene*> fresh_;
};

Result<void> Project::save()
{
    if (file_.empty()) return Error("the project has no file yet; choose where to save it");
    if (!isModified() && !sceneFiles_.empty()) return {};
    return ProjectWriter(*this).write(false);
}

Result<void> Project::saveAs(const fs::path& folderOrFile)
{
    const fs::path old = file_;
    const auto oldScenes = sceneFiles_;
    const auto oldObsolete = std::exchange(obsoleteFiles_, {});
    file_ = folderOrFile.extension() == ".jet" ? folderOrFile : folderOrFile / "project.jet";
    if (file_.has_parent_path()) {
        std::error_code problem;
        fs::create_directories(file_.parent_path(), problem);
    }
    // Two projects may share a folder; their scenes may not share files.
    sceneFiles_.clear();
    if (file_.filename() != "project.jet")
        for (Scene* scene : scenes()) {
            std::string base = file_.stem().string() + "-" + scene->name();
            for (char& c : base)
                if (c == '/' || c == '\\') c = '_';
            sceneFiles_[scene] = "scenes/" + base + ".scene";
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
