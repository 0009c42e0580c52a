#include "project_access.hpp"

#include <jet/start_scene.hpp>

#include <nlohmann/json.hpp>

#include <cstdio>

namespace jet::host {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::unique_ptr<Project> openProject(Session& session, const fs::path& path)
{
    session.useProjectPlugins(path);
    auto project = Project::load(session.readable(path), session.events(), session.plugins());
    if (!project) {
        session.error(project.error());
        return nullptr;
    }
    for (const FormatNote& note : (*project)->notes()) session.warning(note.message, note.where);
    session.comparePlugins(**project);
    return std::move(*project);
}

Scene& chooseScene(Project& project, const std::string& wanted)
{
    const auto scenes = project.scenes();
    const Location where{project.file().string(), 0, 0};
    if (scenes.empty()) throw Failure(Error("the project has no scene; add one in the editor", where));
    if (wanted.empty()) return *startScene(project);
    if (Scene* named = project.scene(wanted)) return *named;
    const bool number = wanted.find_first_not_of("0123456789") == std::string::npos && wanted.size() < 10;
    if (number && std::stoul(wanted) < scenes.size()) return *scenes[std::stoul(wanted)];
    std::string known;
    for (const Scene* scene : scenes) known += (known.empty() ? "'" : ", '") + scene->name() + "'";
    throw Failure(Error("there is no scene '" + wanted + "'; the project has " + known, where));
}

namespace {

// "games/ball/" -> "ball"
std::string projectName(const fs::path& folder)
{
    std::error_code ignored;
    fs::path whole = fs::weakly_canonical(fs::absolute(folder, ignored), ignored);
    if (!whole.has_filename()) whole = whole.parent_path();
    const std::string name = whole.extension() == ".jet" ? whole.stem().string() : whole.filename().string();
    return name.empty() ? "Project" : name;
}

// For a name that is not UTF-8, as file names may be.
std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace); }

}  // namespace

int newProject(Session& session, const fs::path& folder)
{
    std::error_code ignored;
    if (fs::exists(folder / "project.jet", ignored) || (folder.extension() == ".jet" && fs::exists(folder, ignored))) {
        session.error(Error("there is a project here already; choose another folder", Location{folder.string(), 0, 0}));
        return kFailed;
    }
    auto project = Project::create(projectName(folder), session.events(), session.plugins());
    if (const auto saved = project->saveAs(folder); !saved) {
        session.error(saved.error());
        return kFailed;
    }
    std::printf("made %s\n", project->file().c_str());
    return kOk;
}

int projectInfo(Session& session, const fs::path& path)
{
    const auto project = openProject(session, path);
    if (!project) return kFailed;
    Json json{{"name", project->name()},
              {"file", session.named(project->file().string())},
              {"hash", hashText(project->hash())},
              {"scenes", Json::array()},
              {"plugins", Json::array()}};
    if (const Scene* start = startScene(*project)) json["start"] = start->name();
    for (const Scene* scene : project->scenes()) {
        std::map<std::string, int> types;
        scene->root().walk([&](const Item& item) {
            if (item.parent()) ++types[item.type()];
        });
        const Box box = scene->root().bounds();
        Json entry{{"name", scene->name()},
                   {"items", scene->items().itemCount()},
                   {"types", types},
                   {"hash", hashText(scene->hash())}};
        if (!box.isNull()) entry["bounds"] = {box.min.x(), box.min.y(), box.max.x(), box.max.y()};
        json["scenes"].push_back(std::move(entry));
    }
    for (const PluginUse& use : project->pluginsUsed())
        json["plugins"].push_back({{"id", use.id}, {"version", use.version}, {"uses", use.count}});
    if (session.options().json) {
        std::printf("%s\n", dump(json).c_str());
        return kOk;
    }
    std::printf("%s (%s)\n  hash %s\n", project->name().c_str(), session.named(project->file().string()).c_str(),
                hashText(project->hash()).c_str());
    for (const Json& scene : json["scenes"]) {
        std::printf("  scene '%s': %d items%s\n", scene["name"].get<std::string>().c_str(), scene["items"].get<int>(),
                    scene["name"] == json["start"] ? ", plays first" : "");
        for (const auto& [type, count] : scene["types"].items())
            std::printf("    %6d %s\n", count.get<int>(), type.c_str());
    }
    for (const Json& use : json["plugins"])
        std::printf("  uses %s %s (%d)\n", use["id"].get<std::string>().c_str(),
                    use["version"].get<std::string>().c_str(), use["uses"].get<int>());
    return kOk;
}

}  // namespace jet::host
