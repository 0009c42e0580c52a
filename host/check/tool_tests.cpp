// Tools under random gestures.
#include "checked_painter.hpp"
#include "tests.hpp"

#include <array>

namespace jet::host::check {

namespace {

constexpr int kEdits = 1000;

class Gestures {
public:
    explicit Gestures(Stage& stage) : stage_(stage), context_(stage.context), random_(stage.context.random)
    {
        listeners_ = stage.events.listenerCount();
        stage.host.scale = std::array{0.05, 1.0, 1.0, 20.0}[random_.below(4)];
        tool_ = context_.call("factory", [&] { return stage.catalog.createTool(context_.contribution, stage.host); });
        if (!tool_) context_.fail("the tool cannot be made");
        call("Tool::activate", [&] { tool_->activate(); });
    }

    /// One gesture, or one thing between gestures.
    void edit(int number)
    {
        context_.activity("edit " + std::to_string(number) + ", seed " + std::to_string(context_.seed));
        position_ = somewhere();
        hold();
        switch (random_.below(12)) {
        case 0: key(); break;
        case 1:
            call("Tool::wheel", [&] { return tool_->wheel({position_, random_.between(-3, 3), modifiers_}); });
            break;
        case 2: call("Tool::doubleClick", [&] { tool_->doubleClick(event(PointerButton::Left)); }); break;
        case 3: call("Tool::move", [&] { tool_->move(event(PointerButton::None)); }); break;
        case 4: option(); break;
        case 5:
            if (random_.chance(0.2)) putAway();
            break;
        default: drag();
        }
    }

    void paint(CheckedPainter& painter)
    {
        call("Tool::paint", [&] { tool_->paint(painter); });
    }
    void checkPaint()
    {
        CheckedPainter painter(stage_.host.scale);
        paint(painter);
        if (const std::string problem = painter.problem(); !problem.empty())
            context_.fail(context_.where("Tool::paint " + problem));
    }
    bool paintWithin = false;  ///< paint after each event of a gesture

    /// Between edits no gesture is under way. A tool may wait for further clicks with a transaction open; given up, it
    /// must close it.
    void settle()
    {
        if (!stage_.items().inTransaction()) return stage_.checkClosed("the tool");
        call("Tool::cancel", [&] { return tool_->cancel(); });
        stage_.checkClosed("Tool::cancel");
    }
    void putAway()
    {
        call("Tool::deactivate", [&] { tool_->deactivate(); });
        stage_.checkClosed("Tool::deactivate");
        call("Tool::activate", [&] { tool_->activate(); });
    }
    void finish()
    {
        call("Tool::deactivate", [&] { tool_->deactivate(); });
        stage_.checkClosed("Tool::deactivate");
        call("Tool::~Tool", [&] { tool_.reset(); });
        if (stage_.events.listenerCount() != listeners_)
            context_.fail("the tool, destroyed, leaves a listener of events behind");
    }

private:
    template <class Fn>
    void call(const char* callback, Fn&& fn)
    {
        context_.call(callback, [&] { (void)fn(); });
        if (paintWithin && tool_) {
            paintWithin = false;
            checkPaint();
            paintWithin = true;
        }
    }

    Vec2 somewhere()
    {
        const Item* item = random_.chance(0.5) ? random_.item(stage_.scene) : nullptr;
        if (!item || item->bounds().isNull()) return random_.point();
        const Box box = item->bounds();
        switch (random_.below(3)) {
        case 0: return box.center();
        case 1: return box.min;
        default:
            return {random_.between(box.min.x() - 5, box.max.x() + 5),
                    random_.between(box.min.y() - 5, box.max.y() + 5)};
        }
    }
    void hold() { modifiers_ = {random_.chance(0.2), random_.chance(0.2), random_.chance(0.2)}; }
    PointerEvent event(PointerButton button) const
    {
        return {position_, position_ * stage_.host.scale, button, modifiers_};
    }

    void key()
    {
        static constexpr std::array keys = {"Escape", "Enter", "Backspace", "Delete", "Left",    "Right",
                                            "Up",     "Down",  "Shift",     "Alt",    "Control", "Tab",
                                            "Space",  "A",     "Z",         "1",      "+",       "é"};
        const KeyEvent event{keys[random_.below(keys.size())], random_.chance(0.2) ? random_.text() : "", modifiers_,
                             random_.chance(0.1)};
        // As the view delivers it: Escape gives up a gesture first.
        bool used = false;
        if (event.key == "Escape") call("Tool::cancel", [&] { used = tool_->cancel(); });
        if (!used) call("Tool::keyPress", [&] { return tool_->keyPress(event); });
        call("Tool::keyRelease", [&] { return tool_->keyRelease(event); });
    }

    void option()
    {
        const PropertyTable* table = nullptr;
        call("Tool::options", [&] { table = &tool_->options(); });
        if (table->specs().empty()) return;
        const PropertySpec& spec = table->specs()[random_.below(table->specs().size())];
        stage_.host.values.set(spec.id, random_.value(spec, stage_.scene));
    }

    void drag()
    {
        call("Tool::press", [&] { tool_->press(event(PointerButton::Left)); });
        for (std::size_t n = random_.below(5); n > 0; --n) {
            if (random_.chance(0.1)) key();
            if (random_.chance(0.05)) hold();
            position_ = random_.chance(0.9) ? somewhere() : Vec2(position_ + Vec2(1e7, -1e7));
            call("Tool::drag", [&] { tool_->drag(event(PointerButton::Left)); });
        }
        if (random_.chance(0.1)) {
            call("Tool::cancel", [&] { return tool_->cancel(); });
            stage_.checkClosed("Tool::cancel, in the middle of a gesture,");
        } else if (random_.chance(0.03)) {
            return putAway();
        }
        call("Tool::release", [&] { tool_->release(event(PointerButton::Left)); });
    }

    Stage& stage_;
    Context& context_;
    Random& random_;
    std::unique_ptr<Tool> tool_;
    Vec2 position_;
    Modifiers modifiers_;
    std::size_t listeners_ = 0;
};

}  // namespace

void testToolEdits(Context& context)
{
    Stage stage(context);
    stage.fill();
    UndoModel model(stage);
    Gestures gestures(stage);
    for (int i = 1; i <= kEdits; ++i) {
        gestures.edit(i);
        gestures.settle();
        model.record();
        if (context.random.chance(0.1)) {
            model.wander();
            model.record();
        }
        if (context.random.chance(0.1)) {
            stage.editElsewhere();
            model.record();
        }
        if (i % 25 == 0) gestures.checkPaint();
        if (stage.items().itemCount() > 80) {
            stage.thin(30);
            model.record();
        }
    }
    gestures.finish();
    model.record();
    model.sweep();
}

void testToolSaving(Context& context)
{
    Stage stage(context);
    stage.fill();
    Gestures gestures(stage);
    for (int i = 1; i <= 300; ++i) {
        gestures.edit(i);
        gestures.settle();
        if (i % 6 == 0) stage.checkSaving();
        stage.thin(60);
    }
    gestures.finish();
}

void testToolPainting(Context& context)
{
    Stage stage(context);
    stage.fill();
    Gestures gestures(stage);
    gestures.paintWithin = true;
    for (int i = 1; i <= 300; ++i) {
        gestures.edit(i);
        gestures.settle();
        if (i % 20 == 0) stage.host.scale = std::array{1e-3, 0.1, 1.0, 10.0, 1e3}[context.random.below(5)];
        if (i % 30 == 0) stage.checkPainting();
        stage.thin(60);
    }
    gestures.finish();
}

void testToolAlone(Context& context)
{
    for (const char* what : {"an empty scene", "nothing that can be edited"}) {
        Stage stage(context, Stage::With::RequiredOnly);
        if (std::string_view(what) != "an empty scene") {
            stage.fill();
            auto edit = stage.items().begin("Lock");
            for (const auto& child : stage.scene.root().children()) edit.set(*child, "locked", true);
            edit.commit();
            stage.items().setSelection({});
        }
        UndoModel model(stage);
        Gestures gestures(stage);
        for (int i = 1; i <= 100; ++i) {
            gestures.edit(i);
            context.activity("edit " + std::to_string(i) + " of " + what);
            gestures.settle();
            model.record();
            if (i % 10 == 0) gestures.checkPaint();
            if (i % 25 != 0) continue;
            // Everything goes while the tool is active.
            while (!stage.scene.root().children().empty()) {
                auto edit = stage.items().begin("Clear");
                edit.remove(*stage.scene.root().children().front());
                edit.commit();
            }
            model.record();
            model.wander();
            model.record();
        }
        gestures.finish();
        model.record();
        model.sweep();
    }
}

}  // namespace jet::host::check
