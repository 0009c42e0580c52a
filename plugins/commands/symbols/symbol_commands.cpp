// Symbol commands: what they do is in jet/symbols.hpp; this is the table that makes commands of it. Each is one undo
// step.
#include "symbol_chooser.hpp"

#include <jet/arrange.hpp>
#include <jet/editor.hpp>
#include <jet/plugin.hpp>
#include <jet/symbols.hpp>

namespace {

using namespace jet;

struct SymbolAction {
    const char* id;
    const char* label;  ///< of the undo step, and the title of what is asked
    bool (*makesSense)(const Scene& scene);
    void (*run)(Editor& editor, Scene& scene, const char* label);
};

ItemList selectedInstances(const Scene& scene)
{
    ItemList instances = topSelection(scene);
    std::erase_if(instances, [](const Item* item) { return !isInstance(*item) || !item->editable(); });
    return instances;
}

bool hasSelection(const Scene& scene) { return !scene.items().selection().empty(); }
bool hasSymbols(const Scene& scene) { return !symbolsOf(scene).empty(); }
bool hasInstances(const Scene& scene) { return !selectedInstances(scene).empty(); }

const Item* selectedSymbol(const Scene& scene)
{
    const ItemList instances = selectedInstances(scene);
    return instances.empty() ? nullptr : symbolOf(scene, *instances.front());
}

void create(Editor& editor, Scene& scene, const char* label)
{
    auto edit = scene.items().begin(label);
    const Item* instance = createSymbol(edit, scene, topSelection(scene));
    if (!instance) return editor.showMessage("Layers cannot become a symbol. Select items inside of them.");
    edit.select(*instance);
    edit.commit();
}

/// Where new things go: the active layer, else the top-most one that is not locked.
const Item& placeFor(Editor& editor, const Scene& scene)
{
    const Item* active = scene.items().find(editor.activeLayer());
    const auto fits = [](const Item& item) { return item.is<LayerItem>() && item.editable() && item.shown(); };
    if (active && fits(*active)) return *active;
    const auto layers = scene.root().children();
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer)
        if (fits(**layer)) return **layer;
    return scene.root();
}

void place(Editor& editor, Scene& scene, const char* label)
{
    const Item* symbol = jet::symbols::chooseSymbol(scene, label, selectedSymbol(scene));
    if (!symbol) return;
    constexpr double kAside = 20;  // so that it does not hide the one before
    const auto others = instancesOf(scene, *symbol);
    Affine placement = others.empty() ? Affine() : placementOf(*others.back());
    if (!others.empty()) placement = Affine::translation({kAside, kAside}) * placement;
    auto edit = scene.items().begin(label);
    edit.select(placeSymbol(edit, *symbol, placeFor(editor, scene), placement));
    edit.commit();
}

void swap(Editor&, Scene& scene, const char* label)
{
    const Item* symbol = jet::symbols::chooseSymbol(scene, label, selectedSymbol(scene));
    if (!symbol) return;
    auto edit = scene.items().begin(label);
    for (const Item* instance : selectedInstances(scene)) swapSymbol(edit, *instance, *symbol);
    edit.commit();
}

void detach(Editor&, Scene& scene, const char* label)
{
    auto edit = scene.items().begin(label);
    for (const Item* instance : selectedInstances(scene)) detachInstance(edit, *instance);
    edit.commit();
}

/// Those that are parts of other instances are changed there, and stay unselected.
void selectAll(Editor& editor, Scene& scene, const char*)
{
    std::vector<ItemId> ids;
    for (const Item* instance : instancesOf(scene, *selectedSymbol(scene)))
        if (!holderOf(*instance)) ids.push_back(instance->id());
    editor.showStatus(std::to_string(ids.size()) + " instances");
    scene.items().setSelection(std::move(ids));
}

void rename(Editor& editor, Scene& scene, const char* label)
{
    const Item* symbol = jet::symbols::chooseSymbol(scene, label, selectedSymbol(scene));
    const auto name = symbol ? jet::symbols::askName(label, symbol->name()) : std::nullopt;
    if (!name) return;
    if (const Item* other = findSymbol(scene, *name); other && other != symbol)
        return editor.showMessage("There is a symbol called '" + *name + "' already; choose another name.");
    auto edit = scene.items().begin(label);
    edit.set(*symbol, "name", *name);
    edit.commit();
}

void remove(Editor&, Scene& scene, const char* label)
{
    const Item* symbol = jet::symbols::chooseSymbol(scene, label, selectedSymbol(scene));
    if (!symbol) return;
    auto edit = scene.items().begin(label);
    removeSymbol(edit, *symbol);
    edit.commit();
}

constexpr SymbolAction kActions[] = {
    {"create-symbol", "Create symbol", hasSelection, create},
    {"place-symbol", "Place symbol", hasSymbols, place},
    {"swap-symbol", "Swap symbol", hasInstances, swap},
    {"detach-instance", "Detach instance", hasInstances, detach},
    {"select-instances", "Select all instances", hasInstances, selectAll},
    {"rename-symbol", "Rename symbol", hasSymbols, rename},
    {"delete-symbol", "Delete symbol", hasSymbols, remove},
};

class SymbolCommand final : public Command {
public:
    explicit SymbolCommand(const SymbolAction& action) : action_(action) {}

    bool isEnabled(Editor& editor) const override
    {
        const Scene* scene = editableScene(editor);
        return scene && action_.makesSense(*scene);
    }
    void run(Editor& editor) override
    {
        Scene* scene = editableScene(editor);
        if (!scene) return;
        try {
            action_.run(editor, *scene, action_.label);
        } catch (const Failure& refused) {
            std::string why = refused.what();
            why.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(why.front())));
            editor.showMessage(why + '.');
        }
    }

private:
    const SymbolAction& action_;
};

}  // namespace

JET_PLUGIN(plugin)
{
    for (const SymbolAction& action : kActions)
        plugin.addCommand(action.id,
                          [&action] { return std::shared_ptr<Command>(std::make_shared<SymbolCommand>(action)); });
}
