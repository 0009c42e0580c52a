#include "migration.hpp"

#include <jet/version.hpp>

#include <charconv>

namespace jet {

namespace {

using Change = void (*)(pugi::xml_node root);

/// What one version of the format changed, for each kind of file.
struct MigrationStep {
    int from;
    Change project, scene;
};

void renameAttribute(pugi::xml_node node, const char* before, const char* after)
{
    if (pugi::xml_attribute attribute = node.attribute(before)) attribute.set_name(after);
}

/// Calls `change` for each element below `node`; without recursion, since files nest as deep as they like.
void forEachElement(pugi::xml_node root, Change change)
{
    pugi::xml_node node = root.first_child();
    while (node) {
        if (node.type() == pugi::node_element) change(node);
        pugi::xml_node next = node.first_child();
        while (!next && node != root) {
            next = node.next_sibling();
            if (!next) node = node.parent();
        }
        node = next;
    }
}

// --- 0: before the first release. Filters were called groups, the project's name its title; a hidden item said so, and
// properties had names.

void projectFrom0(pugi::xml_node root)
{
    renameAttribute(root, "title", "name");
    forEachElement(root, [](pugi::xml_node node) {
        if (std::string_view(node.name()) == "group") node.set_name("filter");
    });
}

void sceneFrom0(pugi::xml_node root)
{
    forEachElement(root, [](pugi::xml_node node) {
        const std::string_view name = node.name();
        if (name == "property") renameAttribute(node, "name", "id");
        pugi::xml_attribute hidden = node.attribute("hidden");
        if (name != "item" || !hidden) return;
        const bool isHidden = std::string_view(hidden.value()) == "true";
        hidden.set_name("visible");
        hidden.set_value(isHidden ? "false" : "true");
    });
}

constexpr MigrationStep kSteps[] = {
    {0, projectFrom0, sceneFrom0},
};
static_assert(std::size(kSteps) == kFormatVersion, "each former version has its step");

}  // namespace

int migrate(XmlSource& source)
{
    const pugi::xml_node root = source.document.document_element();
    const bool isScene = std::string_view(root.name()) == "scene";
    const std::string text(source.required(root, "version"));
    int version = -1;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), version);
    const bool isNumber = problem == std::errc() && end == text.data() + text.size() && version >= 0;
    const std::string what = isScene ? "this scene" : "this project";
    if (!isNumber)
        source.fail(root, what + " has the format version '" + text + "', which is none: it is a whole number");
    if (version > kFormatVersion)
        source.fail(root, what + " has format version " + text + ", written by a newer JET; this JET (" +
                              JET_SDK_VERSION + ") reads versions 0 to " + std::to_string(kFormatVersion) +
                              ": open it with a newer JET, or get it from who has one as a picture or drawing");
    for (int at = version; at < kFormatVersion; ++at) (isScene ? kSteps[at].scene : kSteps[at].project)(root);
    if (version != kFormatVersion) root.attribute("version").set_value(kFormatVersion);
    return version;
}

}  // namespace jet
