// Layers panel (thesis §3.4.2): the tree of the front scene's items, with buttons to add and remove layers and a
// context menu.
#include "layer_tree.hpp"

#include <jet/plugin.hpp>
#include <jet/ui/command_bar.hpp>
#include <jet/ui/panel.hpp>

#include <QCoreApplication>
#include <QVBoxLayout>

#include <unordered_set>

namespace jet::layers {

namespace {

QString translated(const char* text) { return QCoreApplication::translate("LayersPanel", text); }

class LayersWidget final : public QWidget {
public:
    explicit LayersWidget(Editor& editor)
        : editor_(editor), model_(editor, this), tree_(new LayerTree(model_, editor, this))
    {
        auto* layout = new QVBoxLayout(this);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setSpacing(0);
        layout->addWidget(tree_);
        layout->addWidget(makeBar());
        front_ = editor.events().subscribe<ActiveSceneChanged>(
            nullptr, [this](const ActiveSceneChanged& event) { tree_->showScene(event.scene); });
        tree_->showScene(editor.activeScene());
    }

private:
    struct Command {
        const char* icon;
        const char* text;
        void (LayersWidget::*run)();
        bool (LayersWidget::*enabled)() const;
        bool onBar;  ///< also a button below the tree
    };
    static std::span<const Command> commands();

    ui::CommandBar* makeBar()
    {
        std::vector<ui::PanelCommand> all;
        for (const Command& command : commands())
            all.push_back({command.icon, command.text, translated(command.text), [this, &command] { run(command); },
                           [this, &command] { return (this->*command.enabled)(); }, "", command.onBar});
        return new ui::CommandBar(*tree_, std::move(all), this);
    }

    void run(const Command& command)
    {
        if (!hasScene() || scene().items().inTransaction()) return;
        try {
            (this->*command.run)();
        } catch (const std::exception& problem) {
            editor_.showMessage(problem.what());
        }
    }

    // --- what the commands work on

    Scene& scene() const { return *model_.scene(); }
    bool hasScene() const { return model_.scene() != nullptr; }
    bool hasSelection() const { return hasScene() && !scene().items().selection().empty(); }
    bool isScript() const
    {
        const Item* item = model_.itemOf(tree_->currentIndex());
        return item && item->is<ScriptItem>();
    }

    /// Selected items in tree order, without those inside a selected group.
    std::vector<const Item*> selected() const
    {
        std::unordered_set<std::uint64_t> ids;
        for (const ItemId id : scene().items().selection()) ids.insert(id.value);
        std::vector<const Item*> items;
        scene().root().walk([&](const Item& item) {
            if (!ids.contains(item.id().value)) return true;
            items.push_back(&item);
            return false;
        });
        return items;
    }

    // --- commands

    void addLayer()
    {
        auto edit = scene().items().begin("Add layer");
        edit.select(edit.add<LayerItem>(scene().root()));
        edit.commit();
    }

    void addScript()
    {
        auto edit = scene().items().begin("Add script");
        const Item* container = tree_->currentContainer();
        const Item& script = edit.add<ScriptItem>(container ? *container : scene().root());
        edit.select(script);
        edit.commit();
        editor_.openScript(scene(), script.id());
    }

    void openScript() { editor_.openScript(scene(), model_.idOf(tree_->currentIndex())); }
    void rename() { tree_->renameCurrent(); }

    void remove()
    {
        auto edit = scene().items().begin("Delete");
        for (const Item* item : selected()) edit.remove(*item);
        edit.commit();
    }

    void duplicate()
    {
        auto edit = scene().items().begin("Duplicate");
        std::vector<ItemId> copies;
        for (const Item* item : selected())
            copies.push_back(edit.addCopy(*item, *item->parent(), item->index() + 1).id());
        edit.setSelection(std::move(copies));
        edit.commit();
    }

    void group()
    {
        const std::vector<const Item*> members = selected();
        auto edit = scene().items().begin("Group");
        const Item& made = edit.add(GroupItem::type, *members.back()->parent(), {}, members.back()->index() + 1);
        for (const Item* member : members) edit.move(*member, made, made.children().size());
        edit.select(made);
        edit.commit();
    }

    Editor& editor_;
    LayerModel model_;
    LayerTree* tree_;
    Subscription front_;
};

std::span<const LayersWidget::Command> LayersWidget::commands()
{
    static const Command all[] = {
        {"plus", QT_TRANSLATE_NOOP("LayersPanel", "Add layer"), &LayersWidget::addLayer, &LayersWidget::hasScene, true},
        {"close", QT_TRANSLATE_NOOP("LayersPanel", "Delete"), &LayersWidget::remove, &LayersWidget::hasSelection, true},
        {"script", QT_TRANSLATE_NOOP("LayersPanel", "Add script"), &LayersWidget::addScript, &LayersWidget::hasScene,
         true},
        {"edit", QT_TRANSLATE_NOOP("LayersPanel", "Open script tab"), &LayersWidget::openScript,
         &LayersWidget::isScript, false},
        {"item", QT_TRANSLATE_NOOP("LayersPanel", "Rename"), &LayersWidget::rename, &LayersWidget::hasSelection, false},
        {"duplicate", QT_TRANSLATE_NOOP("LayersPanel", "Duplicate"), &LayersWidget::duplicate,
         &LayersWidget::hasSelection, true},
        {"group", QT_TRANSLATE_NOOP("LayersPanel", "Group"), &LayersWidget::group, &LayersWidget::hasSelection, true},
    };
    return all;
}

class LayersPanel final : public Panel {
public:
    using Panel::Panel;
    QWidget* createWidget() override { return new LayersWidget(editor()); }
};

}  // namespace

}  // namespace jet::layers

JET_PLUGIN(plugin) { plugin.panel<jet::layers::LayersPanel>("layers"); }
