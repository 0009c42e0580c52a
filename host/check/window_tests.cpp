// Panels and commands, on the offscreen platform.
#include "tests.hpp"

#include "ui/check_window.hpp"

#include "host/plugins/plugin_manager.hpp"

#include <jet/testing/test_editor.hpp>
#include <jet/ui/panel.hpp>

#include <dlfcn.h>

namespace jet::host::check {

namespace {

const JetCheckWindow& window(const Context& context)
{
    const auto file = builtInPluginFolder().parent_path().parent_path() / "libjet-check-ui.so";
    void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    const void* symbol = library ? ::dlsym(library, kJetCheckWindowSymbol) : nullptr;
    if (!symbol)
        context.fail(std::string("the window part of this test cannot be loaded: ") + ::dlerror() +
                     "; install JET again");
    return *static_cast<const JetCheckWindow*>(symbol);
}

/// Runs the body inside an application; what it throws arrives here.
template <class Body>
void inWindow(const Context& context, Body body)
{
    const JetCheckWindow& with = window(context);
    std::exception_ptr problem;
    auto whole = [&] {
        try {
            body(with);
        } catch (...) {
            problem = std::current_exception();
        }
    };
    with.run([](void* data) { (*static_cast<decltype(whole)*>(data))(); }, &whole);
    if (problem) std::rethrow_exception(problem);
}

}  // namespace

void testPanel(Context& context)
{
    inWindow(context, [&](const JetCheckWindow& with) {
        Stage stage(context);
        test::TestEditor editor(stage.events, stage.catalog);
        const std::size_t listeners = stage.events.listenerCount();
        auto panel = context.call("factory", [&] { return stage.catalog.createPanel(context.contribution, editor); });
        if (!panel) context.fail("the panel cannot be made");
        context.activity("an empty project without a scene in front");
        if (const char* problem = context.call("Panel::createWidget", [&] { return with.show(*panel); }))
            context.fail(problem);
        context.activity("a scene in front");
        context.call("ActiveSceneChanged", [&] { editor.openScene(stage.scene); });
        context.call("showing the scene", with.settle);
        stage.fill();
        for (int i = 1; i <= 60; ++i) {
            context.activity("change " + std::to_string(i) + " of the scene, seed " + std::to_string(context.seed));
            context.call("ItemsChanged", [&] { stage.editElsewhere(); });
            stage.checkClosed("the panel");
            if (context.random.chance(0.2)) context.call("undo", [&] { stage.scene.undoRedo().undo(); });
            if (i % 10 == 0) context.call("showing the scene", with.settle);
        }
        context.activity("another scene, another project state");
        Scene& other = editor.project().addScene("Other");
        context.call("ProjectChanged", [&] { stage.events.post(static_cast<Editor*>(&editor), ProjectChanged{}); });
        context.call("ActiveSceneChanged", [&] { editor.openScene(other); });
        context.call("showing the scene", with.settle);
        context.activity("closing it");
        context.call("destroying the widget", with.close);
        context.call("Panel::~Panel", [&] { panel.reset(); });
        context.call("events after it is gone", [&] { editor.openScene(stage.scene); });
        if (stage.events.listenerCount() != listeners)
            context.fail("the panel, destroyed, leaves a listener of events behind");
    });
}

void testCommand(Context& context)
{
    inWindow(context, [&](const JetCheckWindow& with) {
        Stage stage(context);
        test::TestEditor editor(stage.events, stage.catalog);
        Command* command = context.call("factory", [&] { return stage.catalog.command(context.contribution); });
        if (!command) context.fail("the command cannot be made");
        const auto run = [&](const std::string& on) {
            context.activity("on " + on);
            if (!context.call("Command::isEnabled", [&] { return command->isEnabled(editor); })) return;
            context.call("Command::run", [&] { command->run(editor); });
            context.call("events after it", with.settle);
            stage.checkClosed("Command::run");
            if (const Scene* front = editor.activeScene(); front && front->items().inTransaction())
                context.fail("Command::run leaves a transaction open (on " + on + ")");
        };
        run("an empty project without a scene in front");
        editor.openScene(*editor.project().scenes().front());
        run("an empty scene");
        editor.openScene(stage.scene);
        stage.fill();
        UndoModel model(stage);
        for (int i = 1; i <= 30; ++i) {
            stage.editElsewhere();
            model.record();
            run("a scene of random items, run " + std::to_string(i));
            model.record();
            model.wander();
            model.record();
            stage.thin(40);
            model.record();
        }
        model.sweep();
    });
}

}  // namespace jet::host::check
