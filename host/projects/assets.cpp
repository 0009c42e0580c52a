#include "assets.hpp"

#include <algorithm>

namespace jet::host {

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
            if (text.empty() || text.find("://") != std::string::npos) continue;
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

}  // namespace jet::host
