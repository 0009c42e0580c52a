#include "guarded.hpp"

namespace jet::host {

namespace {

/// What every guarded object has.
template <class T>
struct Guarded {
    Guard& guard;
    Plugin& plugin;
    T inner;
};

class GuardedTool final : public Tool {
public:
    GuardedTool(Guard& guard, Plugin& plugin, std::unique_ptr<Tool> tool, ToolHost& host)
        : Tool(host), g_{guard, plugin, std::move(tool)}
    {
    }
    ~GuardedTool() override
    {
        g_.guard.run(g_.plugin, "Tool::~Tool", [&] { g_.inner.reset(); });
    }

    void activate() override { run("Tool::activate", [&] { g_.inner->activate(); }); }
    void deactivate() override
    {
        run("Tool::deactivate", [&] { g_.inner->deactivate(); });
        host().items().abandon();  // a tool that is put away holds no transaction
    }
    void press(const PointerEvent& e) override { run("Tool::press", [&] { g_.inner->press(e); }); }
    void drag(const PointerEvent& e) override { run("Tool::drag", [&] { g_.inner->drag(e); }); }
    void release(const PointerEvent& e) override { run("Tool::release", [&] { g_.inner->release(e); }); }
    void move(const PointerEvent& e) override { run("Tool::move", [&] { g_.inner->move(e); }); }
    void doubleClick(const PointerEvent& e) override { run("Tool::doubleClick", [&] { g_.inner->doubleClick(e); }); }
    bool wheel(const WheelEvent& e) override { return ask("Tool::wheel", [&] { return g_.inner->wheel(e); }); }
    bool keyPress(const KeyEvent& e) override { return ask("Tool::keyPress", [&] { return g_.inner->keyPress(e); }); }
    bool keyRelease(const KeyEvent& e) override { return ask("Tool::keyRelease", [&] { return g_.inner->keyRelease(e); }); }
    bool cancel() override { return ask("Tool::cancel", [&] { return g_.inner->cancel(); }); }
    void paint(Painter& painter) const override
    {
        g_.guard.run(g_.plugin, "Tool::paint", [&] { g_.inner->paint(painter); });
    }
    const PropertyTable& options() const override { return g_.inner->options(); }

private:
    // A tool that failed half-way leaves no half-done edit.
    template <class Fn>
    bool ask(const char* callback, Fn&& fn)
    {
        const bool used = g_.guard.call(g_.plugin, callback, std::forward<Fn>(fn), false);
        if (!g_.plugin.usable()) host().items().abandon();
        return used;
    }
    template <class Fn>
    void run(const char* callback, Fn&& fn)
    {
        ask(callback, [&] {
            fn();
            return true;
        });
    }

    Guarded<std::unique_ptr<Tool>> g_;
};

class GuardedEffect final : public Effect {
public:
    GuardedEffect(Guard& guard, Plugin& plugin, std::shared_ptr<Effect> effect) : g_{guard, plugin, std::move(effect)} {}
    const PropertyTable& properties() const override { return g_.inner->properties(); }
    std::string rejects(const Item& item) const override
    {
        return g_.guard.call(
            g_.plugin, "Effect::rejects", [&] { return g_.inner->rejects(item); },
            std::string("the plugin " + g_.plugin.manifest.name + " failed"));
    }
    // A Failure here is the transaction's: it takes the effect back and tells why. Anything else is the plugin's fault, too.
    void applied(Transaction& edit, const Item& item) const override
    {
        try {
            g_.inner->applied(edit, item);
        } catch (const Failure&) {
            throw;
        } catch (...) {
            g_.guard.fault(g_.plugin, "Effect::applied", std::current_exception());
            throw Failure(Error("the plugin " + g_.plugin.title() + " failed; the effect was not applied"));
        }
    }
    std::unique_ptr<EffectState> update(const EffectInput& input) const override
    {
        return g_.guard.call(
            g_.plugin, "Effect::update", [&] { return g_.inner->update(input); }, std::unique_ptr<EffectState>());
    }
    void paint(const EffectInput& input, const EffectState* state, PaintPurpose purpose, Painter& painter) const override
    {
        g_.guard.run(g_.plugin, "Effect::paint", [&] { g_.inner->paint(input, state, purpose, painter); });
    }
    // A Failure is a word about this item (a path without an inside), not a fault of the plugin.
    std::optional<BodyDef> buildBody(const EffectInput& input, const BodyCommon& common) const override
    {
        std::optional<Error> refusal;
        std::optional<BodyDef> built;
        g_.guard.run(g_.plugin, "Effect::buildBody", [&] {
            try {
                built = g_.inner->buildBody(input, common);
            } catch (const Failure& failure) {
                refusal = failure.error();
            }
        });
        if (refusal) throw Failure(*refusal);
        return built;
    }

private:
    Guarded<std::shared_ptr<Effect>> g_;
};

class GuardedItemType final : public ItemType {
public:
    GuardedItemType(Guard& guard, Plugin& plugin, std::shared_ptr<ItemType> type) : g_{guard, plugin, std::move(type)} {}
    const PropertyTable& properties() const override { return g_.inner->properties(); }
    std::string label() const override { return g_.inner->label(); }
    void paint(const Item& item, const Path& path, PaintPurpose purpose, Painter& painter) const override
    {
        g_.guard.run(g_.plugin, "ItemType::paint", [&] { g_.inner->paint(item, path, purpose, painter); });
    }
    void build(const Item& item, WorldBuilder& builder) const override
    {
        g_.guard.run(g_.plugin, "ItemType::build", [&] { g_.inner->build(item, builder); });
    }

private:
    Guarded<std::shared_ptr<ItemType>> g_;
};

// Formats: a Failure tells of the file; any other exception is the plugin's fault.
template <class R, class Fn>
R guardedFormat(Guard& guard, Plugin& plugin, const char* callback, Fn&& fn)
{
    return guard.call(
        plugin, callback,
        [&]() -> R {
            try {
                return fn();
            } catch (const Failure& failure) {
                return failure.error();
            }
        },
        R(Error("the plugin " + plugin.title() + " failed while working on this file")));
}

class GuardedImporter final : public Importer {
public:
    GuardedImporter(Guard& guard, Plugin& plugin, std::shared_ptr<Importer> importer)
        : g_{guard, plugin, std::move(importer)}
    {
    }
    Result<void> read(ImportRequest& request) override
    {
        return guardedFormat<Result<void>>(g_.guard, g_.plugin, "Importer::read", [&] { return g_.inner->read(request); });
    }

private:
    Guarded<std::shared_ptr<Importer>> g_;
};

class GuardedExporter final : public Exporter {
public:
    GuardedExporter(Guard& guard, Plugin& plugin, std::shared_ptr<Exporter> exporter)
        : g_{guard, plugin, std::move(exporter)}
    {
    }
    Result<std::vector<std::byte>> write(const ExportRequest& request) override
    {
        return guardedFormat<Result<std::vector<std::byte>>>(g_.guard, g_.plugin, "Exporter::write",
                                                             [&] { return g_.inner->write(request); });
    }

private:
    Guarded<std::shared_ptr<Exporter>> g_;
};

// A world's calls are too many and too small to wrap one by one: the simulation catches what they throw (see Simulation).
class GuardedPhysicsEngine final : public PhysicsEngine {
public:
    GuardedPhysicsEngine(Guard& guard, Plugin& plugin, std::shared_ptr<PhysicsEngine> engine)
        : g_{guard, plugin, std::move(engine)}
    {
    }
    std::unique_ptr<PhysicsWorld> createWorld(const WorldSettings& settings) override
    {
        return g_.guard.call(
            g_.plugin, "PhysicsEngine::createWorld", [&] { return g_.inner->createWorld(settings); },
            std::unique_ptr<PhysicsWorld>());
    }

private:
    Guarded<std::shared_ptr<PhysicsEngine>> g_;
};

class GuardedRuntime final : public ScriptRuntime {
public:
    GuardedRuntime(Guard& guard, Plugin& plugin, std::unique_ptr<ScriptRuntime> runtime)
        : g_{guard, plugin, std::move(runtime)}
    {
    }
    Result<void> run(const Item& script) override
    {
        return guardedFormat<Result<void>>(g_.guard, g_.plugin, "ScriptRuntime::run", [&] { return g_.inner->run(script); });
    }
    void dispatch(const ScriptEvent& event) override
    {
        g_.guard.run(g_.plugin, "ScriptRuntime::dispatch", [&] { g_.inner->dispatch(event); });
    }
    bool listensTo(ScriptEventKind kind) const override
    {
        return g_.guard.call(
            g_.plugin, "ScriptRuntime::listensTo", [&] { return g_.inner->listensTo(kind); }, false);
    }

private:
    Guarded<std::unique_ptr<ScriptRuntime>> g_;
};

class GuardedScriptEngine final : public ScriptEngine {
public:
    GuardedScriptEngine(Guard& guard, Plugin& plugin, std::shared_ptr<ScriptEngine> engine)
        : g_{guard, plugin, std::move(engine)}
    {
    }
    std::unique_ptr<ScriptRuntime> createRuntime(Simulation& simulation) override
    {
        auto runtime = g_.guard.call(
            g_.plugin, "ScriptEngine::createRuntime", [&] { return g_.inner->createRuntime(simulation); },
            std::unique_ptr<ScriptRuntime>());
        if (!runtime) return nullptr;
        return std::make_unique<GuardedRuntime>(g_.guard, g_.plugin, std::move(runtime));
    }

private:
    Guarded<std::shared_ptr<ScriptEngine>> g_;
};

class GuardedCommand final : public Command {
public:
    GuardedCommand(Guard& guard, Plugin& plugin, std::shared_ptr<Command> command) : g_{guard, plugin, std::move(command)} {}
    void run(Editor& editor) override
    {
        const bool fine = g_.guard.run(g_.plugin, "Command::run", [&] { g_.inner->run(editor); });
        Scene* scene = editor.activeScene();
        if (!fine && scene) scene->items().abandon();
    }
    bool isEnabled(Editor& editor) const override
    {
        return g_.guard.call(
            g_.plugin, "Command::isEnabled", [&] { return g_.inner->isEnabled(editor); }, false);
    }

private:
    Guarded<std::shared_ptr<Command>> g_;
};

}  // namespace

std::unique_ptr<Tool> guarded(Guard& guard, Plugin& plugin, std::unique_ptr<Tool> tool, ToolHost& host)
{
    return std::make_unique<GuardedTool>(guard, plugin, std::move(tool), host);
}
std::shared_ptr<Effect> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Effect> effect)
{
    return std::make_shared<GuardedEffect>(guard, plugin, std::move(effect));
}
std::shared_ptr<ItemType> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<ItemType> type)
{
    return std::make_shared<GuardedItemType>(guard, plugin, std::move(type));
}
std::shared_ptr<Importer> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Importer> importer)
{
    return std::make_shared<GuardedImporter>(guard, plugin, std::move(importer));
}
std::shared_ptr<Exporter> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Exporter> exporter)
{
    return std::make_shared<GuardedExporter>(guard, plugin, std::move(exporter));
}
std::shared_ptr<PhysicsEngine> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<PhysicsEngine> engine)
{
    return std::make_shared<GuardedPhysicsEngine>(guard, plugin, std::move(engine));
}
std::shared_ptr<ScriptEngine> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<ScriptEngine> engine)
{
    return std::make_shared<GuardedScriptEngine>(guard, plugin, std::move(engine));
}
std::shared_ptr<Command> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Command> command)
{
    return std::make_shared<GuardedCommand>(guard, plugin, std::move(command));
}

}  // namespace jet::host
