#include "hasher.hpp"
#include "project_files.hpp"
#include "xml_text.hpp"

#include <jet/catalog.hpp>
#include <jet/project.hpp>
#include <jet/start_scene.hpp>
#include <jet/symbols.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace jet {

namespace {

void collectScenes(const Filter& filter, std::vector<Scene*>& scenes)
{
    for (const auto& scene : filter.scenes) scenes.push_back(scene.get());
    for (const auto& child : filter.filters) collectScenes(*child, scenes);
}

bool eraseScene(Filter& filter, const Scene& scene)
{
    if (std::erase_if(filter.scenes, [&](const auto& s) { return s.get() == &scene; }) > 0) return true;
    return std::any_of(filter.filters.begin(), filter.filters.end(),
                       [&](auto& child) { return eraseScene(*child, scene); });
}

}  // namespace

Project::Project(EventsCenter& events, Catalog& catalog)
    : events_(events), catalog_(catalog), files_(std::make_unique<Files>())
{
}
Project::~Project() = default;

std::unique_ptr<Project> Project::create(std::string name, EventsCenter& events, Catalog& catalog)
{
    std::unique_ptr<Project> project(new Project(events, catalog));
    project->name_ = std::move(name);
    project->root_.name = "Filter0";
    Scene& scene = project->addScene("Scene 0");
    SceneBuilder builder(scene);
    builder.setName(builder.add(builder.root(), {}, LayerItem::type), "Layer");
    project->savedStructure_ = project->structure();  // an untouched new project may be closed without a question
    return project;
}

std::vector<Scene*> Project::scenes() const
{
    std::vector<Scene*> all;
    collectScenes(root_, all);
    return all;
}

Scene* Project::scene(std::string_view name) const
{
    for (Scene* scene : scenes())
        if (scene->name() == name) return scene;
    return nullptr;
}

Scene& Project::addScene(std::string name, Filter* filter)
{
    auto& scenes = (filter ? *filter : root_).scenes;
    scenes.push_back(std::make_unique<Scene>(std::move(name), events_, catalog_));
    scenes.back()->setAssetFolder(folder().string());
    if (files_->watcher) files_->watcher->sceneAdded(*scenes.back());
    return *scenes.back();
}

void Project::removeScene(const Scene& scene)
{
    if (const auto file = sceneFiles_.find(&scene); file != sceneFiles_.end()) {
        obsoleteFiles_.push_back(file->second);
        sceneFiles_.erase(file);
    }
    files_->unsaved.erase(&scene);
    if (files_->start.scene == &scene) files_->start = {};
    eraseScene(root_, scene);
}

std::string Project::freeSceneName() const
{
    for (int i = 0;; ++i) {
        std::string name = "Scene " + std::to_string(i);
        if (!scene(name)) return name;
    }
}

std::string Project::structure() const
{
    const std::string start = files_->start.name();
    std::string out = "<jet-project version=\"1\"" + xmlAttribute("name", name_) +
                      (start.empty() ? "" : xmlAttribute("start", start)) + ">\n";
    const auto append = [&](const auto& self, const Filter& filter, std::size_t depth) -> void {
        const std::string indent(depth * 2, ' ');
        out += indent + "<filter" + xmlAttribute("name", filter.name) + ">\n";
        for (const auto& scene : filter.scenes) {
            const auto file = sceneFiles_.find(scene.get());
            out += indent + "  <scene" + xmlAttribute("name", scene->name()) +
                   xmlAttribute("file", file == sceneFiles_.end() ? "" : file->second) + "/>\n";
        }
        for (const auto& child : filter.filters) self(self, *child, depth + 1);
        out += indent + "</filter>\n";
    };
    append(append, root_, 1);
    return out + "</jet-project>\n";
}

bool Project::isModified() const
{
    if (files_->structureUnsaved || structure() != savedStructure_) return true;
    const auto all = scenes();
    return std::any_of(all.begin(), all.end(), [this](const Scene* scene) {
        return files_->unsaved.contains(scene) || !scene->undoRedo().isClean();
    });
}

std::filesystem::path Project::folder() const { return file_.parent_path(); }

std::vector<std::filesystem::path> Project::changedOnDisk() const
{
    std::vector<std::filesystem::path> changed;
    for (const auto& [path, state] : files_->known)
        if (differsOnDisk(folder() / path, state)) changed.push_back(folder() / path);
    return changed;
}

const std::vector<std::string>& Project::saveNotes() const { return files_->notes; }
void Project::setBackupCount(std::size_t count) { files_->backups = count; }
std::vector<Backup> Project::backups() const { return file_.empty() ? std::vector<Backup>() : findBackups(file_); }

std::vector<PluginUse> Project::pluginsUsed() const
{
    std::map<std::string, PluginUse> uses;
    std::map<std::pair<ContributionKind, std::string>, std::string> providers;  // asked once a type, not once an item
    const auto count = [&](ContributionKind kind, const std::string& type) {
        auto [known, isNew] = providers.try_emplace({kind, type});
        if (isNew) known->second = catalog_.provider(kind, type);
        const std::string& provider = known->second;
        const std::size_t space = provider.find(' ');
        if (space == std::string::npos) return;
        PluginUse& use = uses[provider.substr(0, space)];
        use.id = provider.substr(0, space), use.version = provider.substr(space + 1);
        if (isNew) use.provides.emplace_back(kind, type);
        ++use.count;
    };
    for (const Scene* scene : scenes()) {
        if (const auto engine = scene->setting("physics").as<std::string>(); !engine.empty())
            count(ContributionKind::PhysicsEngine, engine);
        const auto countItem = [&](const Item& item) {
            if (!builtInItemType(item.type())) count(ContributionKind::ItemType, item.type());
            for (const EffectInstance& effect : item.effects()) count(ContributionKind::Effect, effect.type);
        };
        scene->root().walk(countItem);
        for (const Item* symbol : symbolsOf(*scene)) symbol->walk(countItem);
    }
    // What no installed plugin provides cannot be counted: then what the file said of the others stays.
    const bool allKnown = std::ranges::none_of(providers, [](const auto& known) { return known.second.empty(); });
    for (const PluginUse& recorded : recordedUses_)
        if (!allKnown && !uses.contains(recorded.id)) uses.emplace(recorded.id, recorded);
    std::vector<PluginUse> list;
    list.reserve(uses.size());
    for (auto& [id, use] : uses) {
        std::ranges::sort(use.provides);
        list.push_back(std::move(use));
    }
    return list;
}

std::uint64_t Project::hash() const
{
    Hasher h;
    h.add(std::string_view(name_));
    const auto add = [&h](const auto& self, const Filter& filter) -> void {
        h.add(std::string_view(filter.name));
        for (const auto& scene : filter.scenes) h.add(std::string_view(scene->name())), h.add(scene->hash());
        for (const auto& child : filter.filters) self(self, *child);
    };
    add(add, root_);
    if (const std::string start = files_->start.name(); !start.empty()) h.add(std::string_view(start));
    return h.value();
}

Scene* startScene(const Project& project)
{
    const StartChoice& choice = startChoice(project);
    const std::vector<Scene*> all = project.scenes();
    const auto chosen = std::ranges::find_if(
        all, [&](const Scene* scene) { return scene == choice.scene || scene->name() == choice.missing; });
    if (chosen != all.end()) return *chosen;
    return all.empty() ? nullptr : all.front();
}

StartChoice startCalled(const Project& project, const std::string& name)
{
    const Scene* scene = name.empty() ? nullptr : project.scene(name);
    return scene ? StartChoice{scene, {}} : StartChoice{nullptr, name};
}

}  // namespace jet
