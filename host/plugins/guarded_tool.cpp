// Tools and panels under guard: one object for one user of it, not renewed but made again when a plugin is reloaded.
#include "guarded_object.hpp"

namespace jet::host {

namespace {

class GuardedTool final : public Tool, GuardedObject<Tool, Callback::ToolDestroy> {
public:
    GuardedTool(Guard& guard, Plugin& plugin, std::unique_ptr<Tool> tool, ToolHost& host)
        : Tool(host), GuardedObject(guard, plugin, std::move(tool))
    {
        options_.keep(ask(
            Callback::ToolOptions, [](Tool& t) { return &t.options(); }, static_cast<const PropertyTable*>(nullptr)));
    }

    void activate() override
    {
        run(Callback::ToolActivate, [](Tool& t) { t.activate(); });
    }
    void deactivate() override
    {
        run(Callback::ToolDeactivate, [](Tool& t) { t.deactivate(); });
        endedWithOpen(Callback::ToolDeactivate);  // a tool that is put away holds no transaction
    }
    void press(const PointerEvent& e) override
    {
        run(Callback::ToolPress, [&](Tool& t) { t.press(e); });
    }
    void drag(const PointerEvent& e) override
    {
        run(Callback::ToolDrag, [&](Tool& t) { t.drag(e); });
    }
    void release(const PointerEvent& e) override
    {
        run(Callback::ToolRelease, [&](Tool& t) { t.release(e); });
    }
    void move(const PointerEvent& e) override
    {
        run(Callback::ToolMove, [&](Tool& t) { t.move(e); });
    }
    void doubleClick(const PointerEvent& e) override
    {
        run(Callback::ToolDoubleClick, [&](Tool& t) { t.doubleClick(e); });
    }
    bool wheel(const WheelEvent& e) override
    {
        return used(Callback::ToolWheel, [&](Tool& t) { return t.wheel(e); });
    }
    bool keyPress(const KeyEvent& e) override
    {
        return used(Callback::ToolKeyPress, [&](Tool& t) { return t.keyPress(e); });
    }
    bool keyRelease(const KeyEvent& e) override
    {
        return used(Callback::ToolKeyRelease, [&](Tool& t) { return t.keyRelease(e); });
    }
    bool cancel() override
    {
        const bool given = used(Callback::ToolCancel, [](Tool& t) { return t.cancel(); });
        endedWithOpen(Callback::ToolCancel);
        return given;
    }
    void paint(Painter& painter) const override
    {
        tell(Callback::ToolPaint, [&](Tool& t) { t.paint(painter); });
    }
    const PropertyTable& options() const override { return options_.table(); }

private:
    // A tool that failed half-way leaves no half-done edit, not that of its gesture either.
    template <class Fn>
    bool used(Callback callback, Fn&& fn)
    {
        const bool used = ask(callback, std::forward<Fn>(fn), false);
        if (!plugin_.usable()) [[unlikely]]
            host().items().abandon();
        return used;
    }
    template <class Fn>
    void run(Callback callback, Fn&& fn)
    {
        used(callback, [&](Tool& tool) {
            fn(tool);
            return true;
        });
    }
    // After cancel() and deactivate() the gesture is over, whatever callback began it.
    void endedWithOpen(Callback callback)
    {
        ItemsCenter& items = host().items();
        if (!items.inTransaction()) return;
        const std::string label = openTransactionLabel(items);
        items.abandon();
        guard_.fault(
            plugin_, callback,
            std::string(nameOf(callback)) + " left the change '" + label +
                "' of its gesture open, which was rolled back; a gesture that is given up ends its transaction");
    }

    KeptTable options_;
};

class GuardedPanel final : public Panel, GuardedObject<Panel, Callback::PanelDestroy> {
public:
    GuardedPanel(Guard& guard, Plugin& plugin, std::unique_ptr<Panel> panel, Editor& editor)
        : Panel(editor), GuardedObject(guard, plugin, std::move(panel))
    {
    }
    /// The events its widget gets are guarded by the window, which delivers them.
    QWidget* createWidget() override
    {
        return ask(
            Callback::PanelCreateWidget, [](Panel& p) { return p.createWidget(); }, static_cast<QWidget*>(nullptr));
    }
};

}  // namespace

std::unique_ptr<Tool> guarded(Guard& guard, Plugin& plugin, std::unique_ptr<Tool> tool, ToolHost& host)
{
    return std::make_unique<GuardedTool>(guard, plugin, std::move(tool), host);
}
std::unique_ptr<Panel> guarded(Guard& guard, Plugin& plugin, std::unique_ptr<Panel> panel, Editor& editor)
{
    return std::make_unique<GuardedPanel>(guard, plugin, std::move(panel), editor);
}

}  // namespace jet::host
