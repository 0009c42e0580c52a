#include "collect.hpp"

#include <jet/catalog.hpp>
#include <jet/format.hpp>

#include <algorithm>
#include <map>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFolder = "assets";

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

    /// A transaction changes only what some plugin declares.
    static bool isChangeable(const AssetReference& reference)
    {
        const Item* item = reference.scene->items().find(reference.item);
        Catalog& catalog = reference.scene->catalog();
        if (reference.effect < 0) {
            const ItemType* type = catalog.itemType(item->type());
            return builtInItemType(item->type()) || type;
        }
        return catalog.effect(item->effects()[static_cast<std::size_t>(reference.effect)].type) != nullptr;
    }

    static void rewrite(Transaction& edit, const AssetReference& reference, const std::string& text)
    {
        const Item& item = *reference.scene->items().find(reference.item);
        if (reference.effect < 0) {
            edit.set(item, reference.property, text);
        } else {
            edit.setEffect(item, static_cast<std::size_t>(reference.effect), reference.property, text);
        }
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
        std::error_code problem;
        fs::create_directories(folder_ / kFolder, problem);
        if (problem)
            throw Failure(Error("this folder cannot be made: " + problem.message() + "; check the permissions",
                                Location{(folder_ / kFolder).string(), 0, 0}));
        if (const auto same = sameIn(content); !same.empty()) return same;
        const std::string name = freeName(file);
        writeFileAtomically(folder_ / kFolder / name, content).orThrow();
        std::string place = std::string(kFolder) + "/" + name;
        made_.copies.push_back({file, place});
        return place;
    }

    /// The place of a file of this content in assets/, if there is one.
    std::string sameIn(const std::string& content) const
    {
        std::vector<fs::path> files;
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(folder_ / kFolder, ignored))
            if (entry.is_regular_file(ignored) && entry.file_size(ignored) == content.size())
                files.push_back(entry.path());
        std::ranges::sort(files);
        for (const fs::path& file : files)
            if (const auto other = readFile(file); other && *other == content)
                return std::string(kFolder) + "/" + file.filename().string();
        return {};
    }

    // Also names that differ in case only are taken: the project may go to a disk that does not tell them apart.
    std::string freeName(const fs::path& file) const
    {
        const auto lower = [](std::string name) {
            for (char& c : name)
                if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
            return name;
        };
        std::vector<std::string> taken;
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(folder_ / kFolder, ignored))
            taken.push_back(lower(entry.path().filename().string()));
        std::string stem = file.stem().string();
        while (stem.starts_with('.')) stem.erase(0, 1);  // hidden files are not packed
        if (stem.empty()) stem = "asset";
        const std::string extension = file.extension().string();
        std::string name = stem + extension;
        for (int i = 2; std::ranges::find(taken, lower(name)) != taken.end(); ++i)
            name = stem + " " + std::to_string(i) + extension;
        return name;
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
