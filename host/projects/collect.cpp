#include "collect.hpp"

#include <jet/catalog.hpp>
#include <jet/format.hpp>

#include <algorithm>
#include <map>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

class Collector {
public:
    explicit Collector(Project& project) : project_(project), folder_(project.folder()) {}

    Collection run()
    {
        struct Rewrite {
            AssetReference reference;
            std::string text;
        };
        // All copies first: when one fails, the scenes are as before.
        std::map<Scene*, std::vector<Rewrite>> rewrites;
        for (AssetReference& reference : findAssets(project_)) {
            if (liesIn(reference.file, folder_) && !fs::path(reference.text).is_absolute() && exists(reference.file))
                continue;
            if (!exists(reference.file)) {
                made_.missing.push_back(std::move(reference));
            } else if (!isChangeable(reference)) {
                made_.kept.push_back(std::move(reference));
            } else {
                std::string text = placeFor(reference.file);
                std::vector<Rewrite>& ofScene = rewrites[reference.scene];
                ofScene.push_back({std::move(reference), std::move(text)});
            }
        }
        for (auto& [scene, list] : rewrites) {
            auto edit = scene->items().begin("Collect into project");
            for (const auto& [reference, text] : list) rewrite(edit, reference, text);
            edit.commit();
            made_.references += list.size();
        }
        return std::move(made_);
    }

private:
    static bool exists(const fs::path& file)
    {
        std::error_code ignored;
        return fs::is_regular_file(file, ignored);
    }

    /// Where the file is in the project: there already, or copied now.
    std::string placeFor(const fs::path& file)
    {
        if (const auto known = places_.find(file); known != places_.end()) return known->second;
        std::string place = liesIn(file, folder_) ? file.lexically_relative(absoluteFolder()).generic_string()
                                                  : copy(file, readFile(file).orThrow());
        places_.emplace(file, place);
        return place;
    }

    fs::path absoluteFolder() const
    {
        std::error_code ignored;
        return fs::absolute(folder_.empty() ? fs::path(".") : folder_, ignored).lexically_normal();
    }

    std::string copy(const fs::path& file, const std::string& content)
    {
        std::error_code ignored;
        const auto before = std::distance(fs::directory_iterator(folder_ / "assets", ignored), {});
        std::string place = storeAsset(folder_, file.filename().string(), content).orThrow();
        const auto after = std::distance(fs::directory_iterator(folder_ / "assets", ignored), {});
        if (after > before) made_.copies.push_back({file, place});
        return place;
    }

    Project& project_;
    fs::path folder_;
    Collection made_;
    std::map<fs::path, std::string> places_;
};

std::string placeOf(const AssetReference& reference)
{
    const Item* item = reference.scene->items().find(reference.item);
    return "'" + (item ? item->name() : std::string()) + "' in the scene '" + reference.scene->name() + "'";
}

}  // namespace

Result<Collection> collectAssets(Project& project)
{
    if (project.file().empty()) return Error("the project has no folder yet; save it, then collect its assets");
    try {
        return Collector(project).run();
    } catch (const Failure& failure) {
        return failure.error();
    }
}

std::vector<std::string> describe(const Collection& collection)
{
    std::vector<std::string> sentences;
    for (const AssetReference& reference : collection.missing)
        sentences.push_back(placeOf(reference) + " refers to the file '" + reference.text +
                            "', which is not there; find it, or choose another one");
    for (const AssetReference& reference : collection.kept)
        sentences.push_back(placeOf(reference) + " refers to the file '" + reference.text +
                            "', and cannot be changed without its plugin; install that, then collect again");
    return sentences;
}

}  // namespace jet::host
