// Scene: a tree of items with its materials, settings, selection and undo history.
#pragma once

#include <jet/items_center.hpp>

#include <memory>
#include <string>

namespace jet {

class EffectStates;

/// One scene of a project (thesis §3.4). Owned by its Project or, during play, by the Simulation.
class JET_API Scene {
public:
    Scene(std::string name, EventsCenter& events, Catalog& catalog);
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    const std::string& name() const { return name_; }
    void setName(std::string name) { name_ = std::move(name); }

    /// Where relative names of asset files (pictures, sounds) start: the folder of the project's file.
    const std::string& assetFolder() const { return assetFolder_; }
    void setAssetFolder(std::string folder) { assetFolder_ = std::move(folder); }

    ItemsCenter& items() { return *items_; }
    const ItemsCenter& items() const { return *items_; }
    UndoRedoCenter& undoRedo() { return *undo_; }
    const UndoRedoCenter& undoRedo() const { return *undo_; }
    const Item& root() const { return items_->root(); }
    const MaterialTable& materials() const { return materials_; }
    EventsCenter& events() const { return events_; }
    Catalog& catalog() const { return catalog_; }

    /// Settings of the scene: gravity, damping, time step, background, view (see settingsTable()).
    const Properties& settings() const { return settings_; }
    Value setting(std::string_view id) const;
    static const PropertyTable& settingsTable();

    /// Deep copy: same ids, names, structure, effects, materials and settings; no history, no selection.
    std::unique_ptr<Scene> clone(EventsCenter& events) const;
    /// Hash of everything that is saved. Equal content, equal hash, in every process.
    std::uint64_t hash() const;

    /// What effects keep between paints, by item and revision: update() is called once for each change of an item.
    EffectStates& effectStates() const { return *effectStates_; }
    /// Forgets what was kept for an item, or for all (0): their effects will be asked again.
    void dropEffectStates(ItemId item = {}) const;

private:
    friend class ItemsCenter;
    friend class SceneBuilder;

    std::string name_;
    std::string assetFolder_;
    EventsCenter& events_;
    Catalog& catalog_;
    Properties settings_;
    MaterialTable materials_;
    std::unique_ptr<ItemsCenter> items_;
    std::unique_ptr<UndoRedoCenter> undo_;
    std::unique_ptr<EffectStates> effectStates_;
};

/// Fills a scene that nobody watches yet: for project loading and deep copies. No events, no undo.
class JET_API SceneBuilder {
public:
    explicit SceneBuilder(Scene& scene) : scene_(scene) {}

    /// Appends an item with a given id (0: the next free one). Throws Failure when the id is taken.
    Item& add(Item& parent, ItemId id, std::string_view type);
    Item& root();
    void setName(Item& item, std::string name);
    void setFlags(Item& item, bool visible, bool locked);
    void setPath(Item& item, Path path);
    void setProperties(Item& item, Properties properties);
    void addEffect(Item& item, EffectInstance effect);
    void setSetting(std::string_view id, Value value);
    void setMaterials(MaterialTable materials);

private:
    Scene& scene_;
};

}  // namespace jet
