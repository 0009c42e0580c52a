#include <jet/assets.hpp>
#include <jet/catalog.hpp>
#include <jet/format.hpp>

#include <algorithm>
#include <set>

namespace jet {

namespace fs = std::filesystem;

namespace {

bool namesFile(std::string_view property) { return property == "file" || property.ends_with("-file"); }

fs::path absoluteFolder(const fs::path& folder)
{
    std::error_code ignored;
    return fs::absolute(folder.empty() ? fs::path(".") : folder, ignored).lexically_normal();
}

class Finder {
public:
    explicit Finder(const Project& project) : folder_(absoluteFolder(project.folder()))
    {
        for (Scene* scene : project.scenes()) {
            scene_ = scene;
            scene->root().walk([this](const Item& item) { visit(item); });
        }
    }

    std::vector<AssetReference> found;

private:
    void visit(const Item& item)
    {
        take(item, -1, item.properties());
        for (std::size_t i = 0; i < item.effects().size(); ++i)
            take(item, static_cast<int>(i), item.effects()[i].properties);
    }

    void take(const Item& item, int effect, const Properties& properties)
    {
        for (const auto& [id, value] : properties.entries()) {
            const bool isText = value.kind() == ValueKind::Text || value.isRaw();
            if (!isText || !namesFile(id)) continue;
            const std::string text = value.text();
            if (text.empty() || text.find("://") != std::string::npos || text.starts_with("data:")) continue;
            found.push_back({scene_, item.id(), effect, id, text, (folder_ / text).lexically_normal()});
        }
    }

    fs::path folder_;
    Scene* scene_ = nullptr;
};

}  // namespace

std::vector<AssetReference> findAssets(const Project& project) { return std::move(Finder(project).found); }

bool liesIn(const fs::path& file, const fs::path& folder)
{
    const fs::path relative = file.lexically_normal().lexically_relative(absoluteFolder(folder));
    return !relative.empty() && *relative.begin() != ".." && relative != ".";
}

bool isChangeable(const AssetReference& reference)
{
    const Item* item = reference.scene->items().find(reference.item);
    if (!item) return false;
    Catalog& catalog = reference.scene->catalog();
    if (reference.effect < 0) return builtInItemType(item->type()) || catalog.itemType(item->type());
    return catalog.effect(item->effects()[static_cast<std::size_t>(reference.effect)].type) != nullptr;
}

void rewrite(Transaction& edit, const AssetReference& reference, const std::string& text)
{
    const Item& item = *reference.scene->items().find(reference.item);
    if (reference.effect < 0) {
        edit.set(item, reference.property, text);
    } else {
        edit.setEffect(item, static_cast<std::size_t>(reference.effect), reference.property, text);
    }
}

// --- files

namespace {

constexpr const char* kFolder = "assets";
constexpr std::size_t kMostListed = 10'000;  // a project in a folder of everything lists no more

std::vector<fs::path> filesIn(const fs::path& folder)
{
    std::vector<fs::path> files;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.is_regular_file(ignored)) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

/// The place of a file of this content in assets/, if there is one.
std::string sameIn(const fs::path& folder, std::string_view content)
{
    std::error_code ignored;
    for (const fs::path& file : filesIn(folder / kFolder)) {
        if (fs::file_size(file, ignored) != content.size()) continue;
        if (const auto other = readFile(file); other && *other == content)
            return std::string(kFolder) + "/" + file.filename().string();
    }
    return {};
}

// Also names that differ in case only are taken: the project may go to a disk that does not tell them apart.
std::string freeName(const fs::path& folder, const fs::path& file)
{
    const auto lower = [](std::string name) {
        for (char& c : name)
            if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        return name;
    };
    std::set<std::string> taken;
    for (const fs::path& other : filesIn(folder / kFolder)) taken.insert(lower(other.filename().string()));
    std::string stem = file.stem().string();
    while (stem.starts_with('.')) stem.erase(0, 1);  // hidden files are not packed
    if (stem.empty()) stem = "asset";
    const std::string extension = file.extension().string();
    std::string name = stem + extension;
    for (int i = 2; taken.contains(lower(name)); ++i) name = stem + " " + std::to_string(i) + extension;
    return name;
}

bool isAsset(const fs::directory_entry& entry)
{
    std::error_code ignored;
    const std::string extension = entry.path().extension().string();
    return entry.is_regular_file(ignored) && extension != ".jet" && extension != ".jetz" && extension != ".scene";
}

}  // namespace

std::vector<std::string> assetFiles(const Project& project)
{
    std::vector<std::string> files;
    if (project.file().empty()) return files;
    const fs::path folder = absoluteFolder(project.folder());
    std::error_code problem;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, problem);
    while (!problem && entry != fs::recursive_directory_iterator() && files.size() < kMostListed) {
        const std::string name = entry->path().filename().string();
        const bool ours = name.starts_with('.') || (entry.depth() == 0 && name == "plugins");
        if (ours && entry->is_directory(problem)) entry.disable_recursion_pending();
        if (!ours && isAsset(*entry)) files.push_back(entry->path().lexically_relative(folder).generic_string());
        entry.increment(problem);
    }
    std::ranges::sort(files);
    return files;
}

Result<std::string> storeAsset(const fs::path& folder, const std::string& name, std::string_view content)
{
    if (folder.empty()) return Error("the project has no folder yet; save it, then add '" + name + "' again");
    std::error_code problem;
    fs::create_directories(folder / kFolder, problem);
    if (problem)
        return Error("this folder cannot be made: " + problem.message() + "; check the permissions",
                     Location{(folder / kFolder).string(), 0, 0});
    if (std::string same = sameIn(folder, content); !same.empty()) return same;
    const std::string place = std::string(kFolder) + "/" + freeName(folder, fs::path(name).filename());
    if (auto written = writeFileAtomically(folder / place, content); !written) return written.error();
    return place;
}

}  // namespace jet
