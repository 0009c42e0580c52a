// Catalog: what the installed plugins offer. Known from manifests; a library is loaded when one of its contributions is
// used.
#pragma once

#include <jet/result.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace jet {

class Command;
class Editor;
class Effect;
class Exporter;
class Importer;
class ItemType;
class Panel;
class PhysicsEngine;
class ScriptEngine;
class Tool;
class ToolHost;
struct PluginUse;

enum class ContributionKind {
    Tool,
    Effect,
    ItemType,
    Importer,
    Exporter,
    PhysicsEngine,
    ScriptEngine,
    Panel,
    Command,
    SettingsPage
};
inline constexpr int kContributionKinds = 10;

/// The key of the kind under "contributes" in a manifest ("tools", "effects", ...), and a word for people ("tool").
JET_API std::string_view manifestKey(ContributionKind kind);
JET_API std::string_view kindName(ContributionKind kind);

/// One contribution as its manifest declares it.
struct Contribution {
    ContributionKind kind;
    std::string id;
    std::string label;
    std::string plugin;                   ///< id of the plugin
    std::string icon;                     ///< absolute path of the icon file; may be empty
    std::string shortcut;                 ///< e.g. "M", "Ctrl+Shift+X"; may be empty
    std::string menu;                     ///< commands: menu path, e.g. "Edit/Arrange"
    std::string area;                     ///< panels: "left", "right", "bottom"
    std::vector<std::string> extensions;  ///< formats: lower case, without dot
    int order = 100;                      ///< place among its kind, ascending
    std::vector<std::string> mimeTypes;   ///< formats: e.g. "image/svg+xml"
};

/// What plugins offer, by kind and id. Look-ups load the plugin on first use and return null when there is no such
/// contribution or its plugin failed; explain() says why. Returned objects stay valid while the Catalog lives and are
/// guarded: an exception inside a plugin is turned into a message and a neutral result. [owner's thread, except where
/// said]
class JET_API Catalog {
public:
    virtual ~Catalog();

    /// All declared contributions of the kind from plugins that are not disabled, by `order`, then id. Loads nothing.
    virtual std::vector<Contribution> contributions(ContributionKind kind) const = 0;

    virtual const ItemType* itemType(std::string_view id) = 0;
    virtual const Effect* effect(std::string_view id) = 0;
    virtual Importer* importer(std::string_view extension) = 0;
    virtual Exporter* exporter(std::string_view extension) = 0;
    /// An empty id: the first declared.
    virtual PhysicsEngine* physicsEngine(std::string_view id) = 0;
    virtual ScriptEngine* scriptEngine(std::string_view id) = 0;
    virtual std::unique_ptr<Tool> createTool(std::string_view id, ToolHost& host) = 0;
    virtual std::unique_ptr<Panel> createPanel(std::string_view id, Editor& editor) = 0;
    virtual Command* command(std::string_view id) = 0;

    /// One sentence on why the look-up of (kind, id) gives nothing and what to do: which plugin provides it and its
    /// state, or that no known plugin does. For formats `id` is an extension.
    virtual std::string explain(ContributionKind kind, std::string_view id) const = 0;
    /// Version of the plugin that provides (kind, id) as "id version"; empty if none.
    virtual std::string provider(ContributionKind kind, std::string_view id) const = 0;
    /// Told by Project::load what the project's file says of a plugin, so that explain() can name one that is not
    /// installed. The default forgets it.
    virtual void recall(const PluginUse& use);
};

/// The item types every scene knows (SPEC IT1-IT9, images and text), by id; null for others. They are part of the SDK,
/// not of a plugin.
JET_API const ItemType* builtInItemType(std::string_view id);
JET_API std::vector<std::string_view> builtInItemTypeIds();

}  // namespace jet
