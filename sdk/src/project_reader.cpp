#include "migration.hpp"
#include "project_files.hpp"
#include "xml_text.hpp"

#include <jet/catalog.hpp>
#include <jet/project.hpp>

#include <algorithm>
#include <set>

namespace jet {

namespace fs = std::filesystem;

class ProjectReader {
public:
    ProjectReader(XmlSource& source, Project& project, const Progress& progress)
        : source_(source), project_(project), progress_(progress)
    {
    }

    void read()
    {
        const pugi::xml_node root = source_.document.document_element();
        if (std::string_view(root.name()) != "jet-project")
            source_.fail(root,
                         "a project file starts with <jet-project>, this one with <" + std::string(root.name()) + ">");
        const int version = migrate(source_);
        if (version != kFormatVersion) noteMigration(project_.file_.filename().string(), version);
        source_.onlyAttributes(root, {"version", "name", "start"});
        project_.name_ = source_.required(root, "name");
        bool found = false;
        for (const pugi::xml_node child : root.children()) {
            const std::string_view name = child.name();
            if (name == "plugins") {
                readPlugins(child);
            } else if (name == "filter") {
                if (found) source_.fail(child, "a project has one top <filter>; put this one inside it");
                readFilter(child, project_.root_, 0);
                found = true;
            } else {
                source_.unexpected(child, "a project holds <plugins> and <filter>");
            }
        }
        if (!found) source_.fail(root, "the project has no <filter>; add <filter name=\"Filter0\"> with its scenes");
        readStart(root);
    }

    static StartChoice& startOf(const Project& project) { return project.files_->start; }

    /// Tells the user, once, when files are of an older version of the format.
    void tellMigration()
    {
        auto& files = *project_.files_;
        if (files.migrated.empty()) return;
        project_.notes_.push_back({"this project is of format version " + std::to_string(files.oldestVersion) +
                                       "; saving writes it as version " + std::to_string(kFormatVersion) +
                                       " and keeps the original among the backups",
                                   Location{project_.file_.string(), 0, 0}});
    }

private:
    void readStart(const pugi::xml_node& root)
    {
        startOf(project_) = startCalled(project_, root.attribute("start").value());
        if (const std::string& missing = startOf(project_).missing; !missing.empty())
            project_.notes_.push_back(
                {"there is no scene '" + missing + "' to start with; the first one starts until another is chosen",
                 source_.where(root)});
    }

    void noteMigration(const std::string& file, int version)
    {
        auto& files = *project_.files_;
        files.oldestVersion = files.migrated.empty() ? version : std::min(files.oldestVersion, version);
        files.migrated.insert(file);
    }

    void readPlugins(const pugi::xml_node& node)
    {
        for (const pugi::xml_node child : node.children()) {
            if (std::string_view(child.name()) != "plugin") {
                source_.unexpected(child, "<plugins> holds <plugin>");
                continue;
            }
            PluginUse use{std::string(source_.required(child, "id")), std::string(source_.required(child, "version")),
                          child.attribute("uses").as_int()};
            use.provides = readProvided(child.attribute("provides").value());
            project_.catalog_.recall(use);
            project_.recordedUses_.push_back(std::move(use));
        }
    }

    // "effects/hemp itemTypes/rope", by the keys of manifests; what is not understood is left out.
    static std::vector<std::pair<ContributionKind, std::string>> readProvided(std::string_view text)
    {
        std::vector<std::pair<ContributionKind, std::string>> list;
        while (!text.empty()) {
            const std::string_view word = text.substr(0, text.find(' '));
            text.remove_prefix(std::min(word.size() + 1, text.size()));
            const std::size_t slash = word.find('/');
            if (slash == std::string_view::npos) continue;
            for (int k = 0; k < kContributionKinds; ++k)
                if (const auto kind = static_cast<ContributionKind>(k); manifestKey(kind) == word.substr(0, slash))
                    list.emplace_back(kind, word.substr(slash + 1));
        }
        return list;
    }

    void readFilter(const pugi::xml_node& node, Filter& filter, int depth)
    {
        if (depth > kMaximumFilterDepth) source_.fail(node, "filters are nested more than 100 deep; flatten them");
        source_.onlyAttributes(node, {"name"});
        filter.name = source_.required(node, "name");
        for (const pugi::xml_node child : node.children()) {
            const std::string_view name = child.name();
            if (name == "scene") {
                readScene(child, filter);
            } else if (name == "filter") {
                filter.filters.push_back(std::make_unique<Filter>());
                readFilter(child, *filter.filters.back(), depth + 1);
            } else {
                source_.unexpected(child, "a filter holds <scene> and <filter>");
            }
        }
    }

    void readScene(const pugi::xml_node& node, Filter& filter)
    {
        source_.onlyAttributes(node, {"name", "file"});
        const std::string name(source_.required(node, "name"));
        const std::string relative(source_.required(node, "file"));
        const fs::path inside = fs::path(relative).lexically_normal();
        if (inside.is_absolute() || inside.begin() == inside.end() || *inside.begin() == "..")
            source_.fail(node,
                         "the scene file '" + relative + "' lies outside the project's folder; keep scenes inside it");
        if (!names_.insert(name).second) source_.fail(node, "there are two scenes called '" + name + "'; rename one");
        if (!files_.insert(inside).second) source_.fail(node, "two scenes share the file '" + relative + "'");
        const fs::path file = project_.folder() / inside;
        std::error_code ignored;
        if (!fs::exists(file, ignored))
            source_.fail(node, "the scene file '" + relative +
                                   "' is missing; restore it, or remove this line to go on without '" + name + "'");
        auto text = readKnown(file, relative);
        int version = kFormatVersion;
        auto scene = readSceneText(std::move(text), file.string(), project_.events_, project_.catalog_, project_.notes_,
                                   version);
        if (!scene) throw Failure(scene.error());
        if (version != kFormatVersion) noteMigration(relative, version);
        (*scene)->setName(name);
        (*scene)->setAssetFolder(project_.folder().string());
        (*scene)->undoRedo().markClean();
        project_.sceneFiles_[scene->get()] = relative;
        filter.scenes.push_back(std::move(*scene));
        if (!progress_(0.0)) throw Failure(Error("opening the project was cancelled"));
    }

    // State before content: what changes in between is noticed at the next save.
    std::string readKnown(const fs::path& file, const std::string& relative)
    {
        const auto state = statFile(file);
        auto text = readFile(file).orThrow();
        FileState known = state.value_or(FileState());
        known.hash = contentHash(text);
        project_.files_->known[relative] = known;
        return text;
    }

    XmlSource& source_;
    Project& project_;
    const Progress& progress_;
    std::set<std::string> names_;
    std::set<fs::path> files_;
};

StartChoice& startChoice(const Project& project) { return ProjectReader::startOf(project); }

Result<fs::path> findProjectFile(const fs::path& path)
{
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) {
        if (extensionOf(path) != "jetz") return path;
        return Error("this is a project packed into one file, for sending; unpack it with 'jet project unpack', then "
                     "use the folder",
                     Location{path.string(), 0, 0});
    }
    if (fs::exists(path / "project.jet", ignored)) return path / "project.jet";
    std::vector<fs::path> candidates;
    for (const auto& entry : fs::directory_iterator(path, ignored))
        if (entry.path().extension() == ".jet") candidates.push_back(entry.path());
    if (candidates.size() == 1) return candidates.front();
    return Error(candidates.empty() ? "there is no project in this folder: project.jet is missing"
                                    : "there are several projects in this folder; name one of its .jet files",
                 Location{path.string(), 0, 0});
}

Result<std::unique_ptr<Project>> Project::load(const fs::path& path, EventsCenter& events, Catalog& catalog,
                                               const Progress& progress)
{
    const auto file = findProjectFile(path);
    if (!file) return file.error();
    const auto state = statFile(*file);
    auto text = readFile(*file);
    if (!text) return text.error();
    FileState known = state.value_or(FileState());
    known.hash = contentHash(*text);
    XmlSource source(file->string(), std::move(*text));
    if (const auto parsed = source.parse(); !parsed) return parsed.error();
    std::unique_ptr<Project> project(new Project(events, catalog));
    project->file_ = *file;
    project->files_->known[file->filename().string()] = known;
    try {
        ProjectReader reader(source, *project, progress);
        reader.read();
        reader.tellMigration();
    } catch (const Failure& failure) {
        return failure.error();
    }
    project->savedStructure_ = project->structure();
    return project;
}

}  // namespace jet
