#include "setting_place.hpp"

#include "xml_file.hpp"

#include <jet/format.hpp>

namespace jet::host {

namespace fs = std::filesystem;

Location placeOfSetting(const fs::path& project, std::string_view scene, std::string_view setting)
{
    const Location whole{project.string(), 0, 0};
    auto text = readFile(project);
    if (!text) return whole;
    const XmlFile tree(project.string(), std::move(*text));
    const pugi::xml_node entry = tree.root().find_node([&](const pugi::xml_node& node) {
        return std::string_view(node.name()) == "scene" && scene == node.attribute("name").value();
    });
    const fs::path file = project.parent_path() / entry.attribute("file").value();
    auto content = entry ? readFile(file) : Result<std::string>(Error("none"));
    if (!content) return whole;
    const XmlFile settings(file.string(), std::move(*content));
    for (const pugi::xml_node& property : settings.root().child("settings").children("property"))
        if (setting == property.attribute("id").value()) return settings.where(property);
    return {file.string(), 0, 0};
}

}  // namespace jet::host
