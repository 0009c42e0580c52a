#include "project_mender.hpp"

#include "scene_repair.hpp"

#include <jet/format.hpp>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <unistd.h>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

using Weight = Finding::Weight;

// ".Scene 0.scene.1234.part", as JET names a file it is writing: of a process that is no more?
bool isLeftover(const fs::path& file)
{
    const std::string name = file.filename().string();
    if (!name.starts_with('.') || file.extension() != ".part") return false;
    const std::string process = file.stem().extension().string();
    const long pid = process.size() > 1 ? std::strtol(process.c_str() + 1, nullptr, 10) : 0;
    return pid > 0 ? ::kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH
                   : file.string().find("/.jet-backups/") != std::string::npos;
}

/// A folder in the temporary one that goes with this.
struct Workshop {
    Workshop()
    {
        std::string name = (fs::temp_directory_path() / "jet-check-XXXXXX").string();
        if (::mkdtemp(name.data())) folder = name;
    }
    ~Workshop()
    {
        std::error_code ignored;
        if (!folder.empty()) fs::remove_all(folder, ignored);
    }
    Workshop(const Workshop&) = delete;
    Workshop& operator=(const Workshop&) = delete;
    fs::path folder;
};

}  // namespace

ProjectMender::ProjectMender(fs::path file, EventsCenter& events, Catalog& catalog)
    : file_(std::move(file)), folder_(file_.parent_path()), name_(file_.filename().string()), events_(events),
      catalog_(catalog)
{
}

void ProjectMender::tell(Weight weight, Location where, std::string problem, std::string repair)
{
    findings_.push_back({weight, std::move(where), std::move(problem), std::move(repair), false});
}

Result<void> ProjectMender::run()
{
    if (const auto read = readProject(); !read) return read;
    findLeftovers();
    if (!project_) return {};
    const pugi::xml_node root = project_->root();
    if (std::string_view(root.attribute("version").value()) != "1") {
        older_.insert(name_);
    } else if (std::string_view(root.name()) == "jet-project") {
        const std::string before = project_->written();
        mendTree(root);
        addUnlisted(root);
        mendStart(root);
        if (project_->written() != before) mended_[name_] = project_->written();
        for (const std::string& scene : scenes_) mendScene(scene);
    }
    tryToOpen();
    return {};
}

// --- project.jet

Result<void> ProjectMender::readProject()
{
    std::error_code ignored;
    auto text = fs::exists(file_, ignored) ? readFile(file_) : Result<std::string>(std::string());
    if (!text) return text.error();
    const bool isMissing = text->empty() && !fs::exists(file_, ignored);
    if (!isMissing) originals_[name_] = *text;
    project_ = std::make_unique<XmlFile>(file_.string(), std::move(*text));
    if (project_->problem().empty()) return {};
    const std::string problem =
        isMissing ? "the project file is missing" : "this is not well-formed XML: " + project_->problem();
    const Location where = isMissing ? Location{file_.string(), 0, 0} : project_->problemPlace();
    const auto kept = fromBackups(name_);
    tell(Weight::Error, where, problem, kept ? "the newest backup is put in its place" : "");
    project_ = kept ? std::make_unique<XmlFile>(file_.string(), *kept) : nullptr;
    if (kept) mended_[name_] = *kept;
    return {};
}

void ProjectMender::mendTree(pugi::xml_node root)
{
    std::vector<pugi::xml_node> entries;
    const auto collect = [&](const auto& self, const pugi::xml_node& filter, int depth) -> void {
        for (const pugi::xml_node child : filter.children()) {
            const std::string_view name = child.name();
            if (name == "scene") entries.push_back(child);
            if (name == "filter" && depth < 200) self(self, child, depth + 1);
        }
    };
    collect(collect, root, 0);
    for (const pugi::xml_node& entry : entries) mendEntry(entry);
}

void ProjectMender::mendEntry(pugi::xml_node entry)
{
    const std::string file = fs::path(entry.attribute("file").value()).lexically_normal().string();
    if (file.empty() || file.starts_with('/') || file.starts_with("..")) return;  // the reader tells
    if (!sceneFiles_.insert(file).second) {
        tell(Weight::Error, project_->where(entry), "another scene has the file '" + file + "' already",
             "this entry is left out");
        entry.parent().remove_child(entry);
        return;
    }
    std::error_code ignored;
    if (!fs::is_regular_file(folder_ / file, ignored)) {
        const auto kept = fromBackups(file);
        tell(Weight::Error, project_->where(entry), "the scene file '" + file + "' is missing",
             kept ? "the newest backup of it is put there" : "the entry is left out");
        if (!kept) {
            entry.parent().remove_child(entry);
            return;
        }
        mended_[file] = *kept;
    }
    const std::string name = entry.attribute("name").value();
    if (!sceneNames_.insert(name).second) {
        const std::string other = freeName(name);
        tell(Weight::Error, project_->where(entry), "there is another scene called '" + name + "'",
             "it is called '" + other + "'");
        entry.attribute("name").set_value(other.c_str());
        sceneNames_.insert(other);
    }
    scenes_.push_back(file);
}

std::string ProjectMender::freeName(const std::string& name) const
{
    std::string free = name;
    for (int i = 2; sceneNames_.contains(free); ++i) free = name + " " + std::to_string(i);
    return free;
}

// Scenes nobody lists: left by a crash, or taken out of project.jet by hand. Of folders with several projects it cannot
// be told whose they are.
void ProjectMender::addUnlisted(pugi::xml_node root)
{
    std::error_code ignored;
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_.empty() ? fs::path(".") : folder_, ignored))
        if (entry.path().extension() == ".jet" && entry.path().filename() != name_) return;
    for (fs::recursive_directory_iterator at(folder_.empty() ? fs::path(".") : folder_, ignored), end; at != end;
         at.increment(ignored)) {
        if (ignored) break;
        if (at->path().filename().string().starts_with('.') || at->path().filename() == "plugins")
            at.disable_recursion_pending();
        const std::string name = at->path().lexically_relative(folder_.empty() ? fs::path(".") : folder_).string();
        if (at->path().extension() == ".scene" && !sceneFiles_.contains(name)) found.push_back(name);
    }
    std::ranges::sort(found);
    pugi::xml_node filter = root.child("filter");
    for (const std::string& file : found) {
        const auto text = readFile(folder_ / file);
        std::vector<FormatNote> notes;
        const bool opens = text && readSceneText(*text, file, events_, catalog_, notes);
        const std::string name = freeName(fs::path(file).stem().string());
        tell(Weight::Warning, Location{(folder_ / file).string(), 0, 0}, "the project does not list this scene",
             opens && filter ? "it is added as '" + name + "'" : "");
        if (!opens || !filter) continue;
        pugi::xml_node entry = filter.append_child("scene");
        entry.append_attribute("name") = name.c_str();
        entry.append_attribute("file") = file.c_str();
        sceneNames_.insert(name), sceneFiles_.insert(file);
    }
}

void ProjectMender::mendStart(pugi::xml_node root)
{
    const pugi::xml_attribute start = root.attribute("start");
    if (!start || sceneNames_.contains(start.value())) return;
    tell(Weight::Warning, project_->where(root), "there is no scene '" + std::string(start.value()) + "' to start with",
         "the first scene starts until another is chosen");
    root.remove_attribute(start);
}

// --- scenes

void ProjectMender::mendScene(const std::string& name)
{
    const fs::path file = folder_ / name;
    std::string text;
    if (const auto mended = mended_.find(name); mended != mended_.end()) {
        text = mended->second;
    } else {
        auto read = readFile(file);
        if (!read) return;  // the reader tells
        text = std::move(*read);
        originals_[name] = text;
    }
    std::vector<FormatNote> notes;
    auto opened = readSceneText(text, file.string(), events_, catalog_, notes);
    XmlFile scene(file.string(), text);
    if (!scene.problem().empty() && !opened) {
        const auto kept = fromBackups(name);
        tell(Weight::Error, scene.problemPlace(), "this is not well-formed XML: " + scene.problem(),
             kept ? "the newest backup is put in its place" : "");
        if (kept) mended_[name] = *kept;
        return;
    }
    if (std::string_view(scene.root().attribute("version").value()) != "1") older_.insert(name);
    Findings found = older_.contains(name) ? Findings() : host::mendScene(scene, catalog_);
    if (opened && found.empty()) return;
    auto mended = readSceneText(scene.written(), file.string(), events_, catalog_, notes);
    if (mended) mended_[name] = writeSceneText(**mended);
    if (!mended && found.empty()) tell(Weight::Error, opened.error().where, opened.error().message, "");
    for (Finding& finding : found) {
        if (!mended) finding.repair.clear();
        findings_.push_back(std::move(finding));
    }
}

// --- backups, and what was left over

/// The newest former text of the file that is well-formed.
std::optional<std::string> ProjectMender::fromBackups(const std::string& name) const
{
    for (const Backup& backup : findBackups(file_)) {
        auto text = readFile(backup.folder / name);
        if (text && isXml(*text)) return std::move(*text);
    }
    return std::nullopt;
}

void ProjectMender::findLeftovers()
{
    std::error_code problem;
    fs::recursive_directory_iterator at(folder_.empty() ? fs::path(".") : folder_, problem), end;
    for (; !problem && at != end; at.increment(problem)) {
        if (!isLeftover(at->path())) continue;
        at.disable_recursion_pending();
        leftovers_.push_back(at->path());
    }
    std::ranges::sort(leftovers_);
    for (const fs::path& file : leftovers_)
        tell(Weight::Warning, Location{file.string(), 0, 0}, "a process that ended left this behind, half written",
             "it is removed");
}

// --- would it open?

// In a folder of its own, with the mended files; there JET also writes down which plugins provide what.
void ProjectMender::tryToOpen()
{
    const Workshop workshop;
    if (workshop.folder.empty()) return;
    std::error_code ignored;
    const auto put = [&](const std::string& name, const std::string& text) {
        fs::create_directories((workshop.folder / name).parent_path(), ignored);
        return static_cast<bool>(writeFileAtomically(workshop.folder / name, text));
    };
    for (const auto& [name, text] : originals_)
        if (!mended_.contains(name) && !put(name, text)) return;
    for (const auto& [name, text] : mended_)
        if (!put(name, text)) return;
    for (const std::string& name : sceneFiles_)
        if (!fs::exists(workshop.folder / name, ignored))
            if (const auto text = readFile(folder_ / name); text && !put(name, *text)) return;
    auto opened = Project::load(workshop.folder / name_, events_, catalog_);
    opens_ = static_cast<bool>(opened);
    if (!opens_ || !originals_.contains(name_) || !isCurrent(name_)) return;
    const auto before = readFile(workshop.folder / name_);
    (*opened)->setBackupCount(0);
    if (!before || !(*opened)->save(Overwrite::Allow)) return;
    const auto after = readFile(workshop.folder / name_);
    if (!after || *after == *before || !lacksProvides()) return;
    tell(Weight::Warning, Location{file_.string(), 0, 0},
         "it does not tell what the plugins it uses provide, so that nobody can tell which one is missing",
         "what the installed ones provide is written down");
    mended_[name_] = *after;
}

bool ProjectMender::lacksProvides() const
{
    const auto plugins = project_->root().child("plugins").children("plugin");
    return std::any_of(plugins.begin(), plugins.end(),
                       [](const pugi::xml_node& plugin) { return !plugin.attribute("provides"); });
}

std::vector<std::pair<std::string, std::string>> ProjectMender::changedFiles() const
{
    std::vector<std::pair<std::string, std::string>> changed;
    const auto take = [&](const std::string& name, const std::string& text) {
        const auto original = originals_.find(name);
        if (original == originals_.end() || original->second != text) changed.emplace_back(name, text);
    };
    for (const auto& [name, text] : mended_)
        if (name != name_) take(name, text);
    if (const auto project = mended_.find(name_); project != mended_.end()) take(name_, project->second);
    return changed;
}

}  // namespace jet::host
