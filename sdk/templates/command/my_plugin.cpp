// A menu command: mirrors the selected items about the middle of them all.
#include <jet/editor.hpp>
#include <jet/plugin.hpp>

namespace {

class MyPluginCommand final : public jet::Command {
public:
    bool isEnabled(jet::Editor& editor) const override
    {
        return editor.activeScene() && !editor.activeScene()->items().selection().empty();
    }

    void run(jet::Editor& editor) override
    {
        jet::ItemsCenter& items = editor.activeScene()->items();
        jet::Box all;
        for (const jet::ItemId id : items.selection()) all.extend(items.find(id)->bounds());
        if (all.isNull()) return editor.showMessage("There is nothing to mirror: the selected items have no path.");

        const auto mirror = jet::Affine::scaling({-1, 1}, all.center());
        auto edit = items.begin("Mirror");
        for (const jet::ItemId id : items.selection()) {
            const jet::Item& item = *items.find(id);
            if (!insideAnother(items, item)) edit.transform(item, mirror);
        }
        edit.commit();
    }

private:
    /// Is it in a selected group, which takes it along?
    static bool insideAnother(const jet::ItemsCenter& items, const jet::Item& item)
    {
        for (const jet::Item* above = item.parent(); above; above = above->parent())
            if (items.isSelected(above->id())) return true;
        return false;
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.command<MyPluginCommand>("my-plugin"); }
