// Arrange commands: align, distribute, flip and reorder the selection, and move it between layers. What they do is in
// jet/arrange.hpp; this is the table that makes commands of it. Each is one undo step.
#include <jet/arrange.hpp>
#include <jet/editor.hpp>
#include <jet/plugin.hpp>

#include <functional>

namespace {

struct Arrangement {
    const char* id;
    const char* label;  ///< of the undo step
    std::size_t needs;  ///< selected items it makes sense for
    std::function<void(jet::Transaction& edit, const jet::ItemList& items)> run;
};

class ArrangeCommand final : public jet::Command {
public:
    explicit ArrangeCommand(Arrangement arrangement) : arrangement_(std::move(arrangement)) {}

    bool isEnabled(jet::Editor& editor) const override
    {
        const jet::Scene* scene = jet::editableScene(editor);
        return scene && jet::topSelection(*scene).size() >= arrangement_.needs;
    }
    void run(jet::Editor& editor) override
    {
        jet::Scene* scene = jet::editableScene(editor);
        if (!scene) return;
        auto edit = scene->items().begin(arrangement_.label);
        arrangement_.run(edit, jet::topSelection(*scene));
        edit.commit();
    }

private:
    Arrangement arrangement_;
};

Arrangement align(const char* id, const char* label, jet::Alignment to)
{
    return {id, label, 2, [to](jet::Transaction& edit, const jet::ItemList& items) { alignItems(edit, items, to); }};
}

Arrangement distribute(const char* id, const char* label, jet::Distribution by)
{
    return {id, label, 3,
            [by](jet::Transaction& edit, const jet::ItemList& items) { distributeItems(edit, items, by); }};
}

Arrangement flip(const char* id, const char* label, jet::FlipAxis axis)
{
    return {id, label, 1, [axis](jet::Transaction& edit, const jet::ItemList& items) { flipItems(edit, items, axis); }};
}

Arrangement reorder(const char* id, const char* label, jet::StackOrder order)
{
    return {id, label, 1,
            [order](jet::Transaction& edit, const jet::ItemList& items) { reorderItems(edit, items, order); }};
}

Arrangement toLayer(const char* id, const char* label, bool up)
{
    return {id, label, 1,
            [up](jet::Transaction& edit, const jet::ItemList& items) { moveToNextLayer(edit, items, up); }};
}

std::vector<Arrangement> arrangements()
{
    using enum jet::Alignment;
    using enum jet::Distribution;
    using enum jet::StackOrder;
    return {
        align("align-left", "Align left", Left),
        align("align-center-x", "Align centers horizontally", CenterX),
        align("align-right", "Align right", Right),
        align("align-top", "Align top", Top),
        align("align-center-y", "Align centers vertically", CenterY),
        align("align-bottom", "Align bottom", Bottom),
        distribute("distribute-centers-x", "Distribute centers horizontally", CentersX),
        distribute("distribute-centers-y", "Distribute centers vertically", CentersY),
        distribute("distribute-gaps-x", "Make horizontal gaps equal", GapsX),
        distribute("distribute-gaps-y", "Make vertical gaps equal", GapsY),
        flip("flip-horizontal", "Flip horizontally", jet::FlipAxis::Horizontal),
        flip("flip-vertical", "Flip vertically", jet::FlipAxis::Vertical),
        reorder("bring-to-front", "Bring to front", ToFront),
        reorder("bring-forward", "Bring forward", Forward),
        reorder("send-backward", "Send backward", Backward),
        reorder("send-to-back", "Send to back", ToBack),
        toLayer("to-layer-above", "Move to the layer above", true),
        toLayer("to-layer-below", "Move to the layer below", false),
    };
}

}  // namespace

JET_PLUGIN(plugin)
{
    for (const Arrangement& arrangement : arrangements()) {
        plugin.addCommand(arrangement.id, [arrangement] {
            return std::shared_ptr<jet::Command>(std::make_shared<ArrangeCommand>(arrangement));
        });
    }
}
