#include "effect_states.hpp"
#include "hasher.hpp"
#include "physics_ranges.hpp"
#include "scene_state.hpp"
#include "symbol_links.hpp"

namespace jet {

Scene::Scene(std::string name, EventsCenter& events, Catalog& catalog)
    : name_(std::move(name)), events_(events), catalog_(catalog),
      items_(std::make_unique<ItemsCenter>(*this, events, catalog)), undo_(std::make_unique<UndoRedoCenter>(*items_)),
      effectStates_(std::make_unique<EffectStates>())
{
}

Scene::~Scene() = default;

const PropertyTable& Scene::settingsTable()
{
    static const PropertyTable table{
        vector("gravity", "Gravity", {0, 98.1})
            .in("units/s²")
            .range(-kMostOfPhysics, kMostOfPhysics)
            .says("Acceleration of all bodies; y grows downwards."),
        real("linear-damping", "Linear damping", 0).in("1/s").range(0, 1e6),
        real("angular-damping", "Angular damping", 0).in("1/s").range(0, 1e6),
        flag("apply-gravity", "Apply gravity", true),
        flag("apply-damping", "Apply damping", true),
        flag("find-collisions", "Find collisions", true),
        flag("resolve-collisions", "Resolve collisions", true),
        real("time-step", "Time step", 1.0 / 60).in("s").range(1e-5, 1).says("Simulated seconds a step."),
        choice("method", "Method", {"automatic", "semi-implicit-euler"})
            .says("Automatic: whatever holds best; semi-implicit Euler: one substep, forces alone, for teaching. It "
                  "may explode."),
        integer("substeps", "Substeps", 0)
            .range(0, 4096)
            .says("Of the rigid solver a step; more are stiffer and slower. 0: as the engine sees fit."),
        flag("allow-sleep", "May sleep", true).says("May what rests be left out of the computation?"),
        text("physics", "Physics engine", "").says("Empty: the first one installed."),
        color("background", "Background", Color{255, 255, 255, 255}),
        real("page-width", "Page width", 0).in("units").range(0, 1e7).says("0: no page; pictures show all items."),
        real("page-height", "Page height", 0).in("units").range(0, 1e7),
    };
    return table;
}

void Scene::dropEffectStates(ItemId item) const { item ? effectStates_->drop(item) : effectStates_->clear(); }

Value Scene::setting(std::string_view id) const { return settings_.get(id, settingsTable()); }

namespace {

void copyChildren(const Item& from, Item& to, SceneBuilder& builder)
{
    for (const auto& child : from.children()) {
        Item& copy = builder.add(to, child->id(), child->type());
        builder.setName(copy, child->name());
        builder.setFlags(copy, child->visible(), child->locked());
        builder.setPath(copy, child->path());
        builder.setProperties(copy, child->properties());
        for (const EffectInstance& effect : child->effects()) builder.addEffect(copy, effect);
        copyChildren(*child, copy, builder);
    }
}

}  // namespace

std::unique_ptr<Scene> Scene::clone(EventsCenter& events) const
{
    auto copy = std::make_unique<Scene>(name_, events, catalog_);
    SceneBuilder builder(*copy);
    copyChildren(*items_->d_->symbols, *copy->items_->d_->symbols, builder);
    copyChildren(root(), builder.root(), builder);
    copy->settings_ = settings_;
    copy->materials_ = materials_;
    copy->assetFolder_ = assetFolder_;
    return copy;
}

std::uint64_t Scene::hash() const
{
    Hasher h;
    const auto addProperties = [&h](const Properties& properties) {
        h.add(static_cast<std::uint64_t>(properties.entries().size()));
        for (const auto& [id, value] : properties.entries()) h.add(std::string_view(id)), h.add(value);
    };
    addProperties(settings_);
    for (const std::string& name : materials_.names()) h.add(std::string_view(name));
    for (const MaterialPair& pair : materials_.pairs())
        h.add(pair.friction), h.add(pair.restitution), h.add(static_cast<std::uint64_t>(pair.collides));
    const auto addItem = [&](const Item& item) {
        h.add(item.id().value);
        h.add(std::string_view(item.type()));
        h.add(std::string_view(item.name()));
        h.add(static_cast<std::uint64_t>(item.visible() * 2 + item.locked()));
        h.add(item.path());
        addProperties(item.properties());
        h.add(static_cast<std::uint64_t>(item.effects().size()));
        for (const EffectInstance& effect : item.effects()) {
            h.add(std::string_view(effect.type));
            h.add(static_cast<std::uint64_t>(effect.visible));
            addProperties(effect.properties);
        }
        h.add(static_cast<std::uint64_t>(item.children().size()));
    };
    root().walk(addItem);
    if (const Item& symbols = *items_->d_->symbols; !symbols.children().empty()) symbols.walk(addItem);
    return h.value();
}

Item& SceneBuilder::add(Item& parent, ItemId id, std::string_view type)
{
    auto& d = *scene_.items().d_;
    if (id && d.byId.find(id.value))
        throw Failure(
            Error("the id " + std::to_string(id.value) + " is used by another item, '" + d.get(id).name() + "'"));
    auto item = std::make_unique<Item>(id ? id : ItemId{d.nextId}, type);
    Item& added = *item;
    d.enlist(added, d.isOfSymbols(parent) || &parent == d.symbols.get());
    Item::Mutator::insert(parent, parent.children().size(), std::move(item));
    return added;
}

Item& SceneBuilder::root() { return *scene_.items().d_->root; }
void SceneBuilder::setName(Item& item, std::string name) { Item::Mutator::setName(item, std::move(name)); }
void SceneBuilder::setFlags(Item& item, bool visible, bool locked) { Item::Mutator::setFlags(item, visible, locked); }
void SceneBuilder::setPath(Item& item, Path path) { scene_.items().d_->setPath(item, path); }
void SceneBuilder::setProperties(Item& item, Properties properties)
{
    auto& links = *scene_.items().d_->links;
    links.delisted(item);
    Item::Mutator::setProperties(item, std::move(properties));
    links.enlisted(item);
}
void SceneBuilder::addEffect(Item& item, EffectInstance effect)
{
    Item::Mutator::effects(item).push_back(std::move(effect));
}
void SceneBuilder::setSetting(std::string_view id, Value value) { scene_.settings_.set(id, std::move(value)); }
void SceneBuilder::setMaterials(MaterialTable materials) { scene_.materials_ = std::move(materials); }

}  // namespace jet
