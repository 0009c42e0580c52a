// Auto layout: a menu command that moves the selected items apart until none covers another. The work is done before
// the scene is touched; it reports its progress and can be cancelled.
#include "layout.hpp"

#include <jet/editor.hpp>
#include <jet/plugin.hpp>

namespace {

constexpr double kGap = 4;  // scene units between items

class AutoLayout final : public jet::Command {
public:
    bool isEnabled(jet::Editor& editor) const override
    {
        return editor.activeScene() && editor.activeScene()->items().selection().size() > 1;
    }

    void run(jet::Editor& editor) override
    {
        jet::ItemsCenter& items = editor.activeScene()->items();
        std::vector<jet::ItemId> moved;
        std::vector<jet::Box> boxes;
        for (const jet::ItemId id : items.selection()) {
            const jet::Item& item = *items.find(id);
            if (item.bounds().isNull() || !item.editable() || insideAnother(items, item)) continue;
            moved.push_back(id);
            boxes.push_back(item.bounds());
        }
        const Layout layout = layOut(boxes, kGap, editor.progress("Arranging items"));
        if (layout.cancelled) return editor.showStatus("Auto layout was cancelled; nothing was moved.");

        auto edit = items.begin("Auto layout");
        for (std::size_t i = 0; i < moved.size(); ++i)
            if (!layout.shifts[i].isZero())
                edit.transform(*items.find(moved[i]), jet::Affine::translation(layout.shifts[i]));
        edit.commit();
        if (!layout.apart) editor.showMessage("Some items still overlap a little; run Auto layout once more.");
    }

private:
    /// In a selected group, which takes it along.
    static bool insideAnother(const jet::ItemsCenter& items, const jet::Item& item)
    {
        for (const jet::Item* above = item.parent(); above; above = above->parent())
            if (items.isSelected(above->id())) return true;
        return false;
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.command<AutoLayout>("auto-layout"); }
