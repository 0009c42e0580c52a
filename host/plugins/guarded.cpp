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

const PropertyTable& emptyTable()
{
    static const PropertyTable none;
    return none;
}

/// A table is the same for the life of its object, so it is asked for once.
template <class Fn>
const PropertyTable& tableOf(Guard& guard, Plugin& plugin, const char* callback, Fn&& fn)
{
    return *guard.call(
        plugin, callback, [&] { return &fn(); }, &emptyTable());
}

class GuardedTool final : public Tool {
public:
    GuardedTool(Guard& guard, Plugin& plugin, std::unique_ptr<Tool> tool, ToolHost& host)
        : Tool(host), g_{guard, plugin, std::move(tool)},
          options_(
              tableOf(guard, plugin, "Tool::options", [&]() -> const PropertyTable& { return g_.inner->options(); }))
    {
    }
    ~GuardedTool() override
    {
        g_.guard.run(g_.plugin, "Tool::~Tool", [&] { g_.inner.reset(); });
    }

    void activate() override
    {
        run("Tool::activate", [&] { g_.inner->activate(); });
    }
    void deactivate() override
    {
        run("Tool::deactivate", [&] { g_.inner->deactivate(); });
        host().items().abandon();  // a tool that is put away holds no transaction
    }
    void press(const PointerEvent& e) override
    {
        run("Tool::press", [&] { g_.inner->press(e); });
    }
    void drag(const PointerEvent& e) override
    {
        run("Tool::drag", [&] { g_.inner->drag(e); });
    }
    void release(const PointerEvent& e) override
    {
        run("Tool::release", [&] { g_.inner->release(e); });
    }
    void move(const PointerEvent& e) override
    {
        run("Tool::move", [&] { g_.inner->move(e); });
    }
    void doubleClick(const PointerEvent& e) override
    {
        run("Tool::doubleClick", [&] { g_.inner->doubleClick(e); });
    }
    bool wheel(const WheelEvent& e) override
    {
        return ask("Tool::wheel", [&] { return g_.inner->wheel(e); });
    }
    bool keyPress(const KeyEvent& e) override
    {
        return ask("Tool::keyPress", [&] { return g_.inner->keyPress(e); });
    }
    bool keyRelease(const KeyEvent& e) override
    {
        return ask("Tool::keyRelease", [&] { return g_.inner->keyRelease(e); });
    }
    bool cancel() override
    {
        return ask("Tool::cancel", [&] { return g_.inner->cancel(); });
    }
    void paint(Painter& painter) const override
    {
        g_.guard.run(g_.plugin, "Tool::paint", [&] { g_.inner->paint(painter); });
    }
    const PropertyTable& options() const override { return options_; }

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
    const PropertyTable& options_;
};

class GuardedEffect final : public Effect {
public:
    GuardedEffect(Guard& guard, Plugin& plugin, std::shared_ptr<Effect> effect)
        : g_{guard, plugin, std::move(effect)},
          table_(tableOf(guard, plugin, "Effect::properties",
                         [&]() -> const PropertyTable& { return g_.inner->properties(); }))
    {
    }
    const PropertyTable& properties() const override { return table_; }
    std::string rejects(const Item& item) const override
    {
        return g_.guard.call(
            g_.plugin, "Effect::rejects", [&] { return g_.inner->rejects(item); },
            std::string("the plugin " + g_.plugin.manifest.name + " failed"));
    }
    // A Failure here is the transaction's: it takes the effect back and tells why. Anything else is the plugin's fault,
    // too.
    void applied(Transaction& edit, const Item& item) const override
    {
        if (!g_.plugin.usable())
            throw Failure(Error("the plugin " + g_.plugin.title() + " is switched off: " + g_.plugin.reason));
        try {
            g_.inner->applied(edit, item);
        } catch (const Failure&) {
            throw;
        } catch (...) {
            g_.guard.fault(g_.plugin, "Effect::applied", std::current_exception());
            throw Failure(Error("the plugin " + g_.plugin.title() + " failed; the effect was not applied"));
        }
    }
    bool wantsLiveBody() const override
    {
        return g_.guard.call(
            g_.plugin, "Effect::wantsLiveBody", [&] { return g_.inner->wantsLiveBody(); }, false);
    }
    std::unique_ptr<EffectState> update(const EffectInput& input) const override
    {
        return g_.guard.call(
            g_.plugin, "Effect::update", [&] { return g_.inner->update(input); }, std::unique_ptr<EffectState>());
    }
    void paint(const EffectInput& input, const EffectState* state, PaintPurpose purpose,
               Painter& painter) const override
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
    const PropertyTable& table_;
};

class GuardedItemType final : public ItemType {
public:
    GuardedItemType(Guard& guard, Plugin& plugin, std::shared_ptr<ItemType> type)
        : g_{guard, plugin, std::move(type)},
          table_(tableOf(guard, plugin, "ItemType::properties",
                         [&]() -> const PropertyTable& { return g_.inner->properties(); }))
    {
    }
    const PropertyTable& properties() const override { return table_; }
    std::string label() const override
    {
        return g_.guard.call(
            g_.plugin, "ItemType::label", [&] { return g_.inner->label(); }, std::string("Item"));
    }
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
    const PropertyTable& table_;
};

// Formats: a Failure tells of the file; any other exception is the plugin's fault.
template <class R, class Fn>
R guardedFormat(Guard& guard, Plugin& plugin, const char* callback, Fn&& fn)
{
    std::optional<R> result;
    guard.run(plugin, callback, [&] {
        try {
            result.emplace(fn());
        } catch (const Failure& failure) {
            result.emplace(failure.error());
        }
    });
    if (result) return *std::move(result);
    return Error("the plugin " + plugin.title() + " was switched off: " + plugin.reason);
}

class GuardedImporter final : public Importer {
public:
    GuardedImporter(Guard& guard, Plugin& plugin, std::shared_ptr<Importer> importer)
        : g_{guard, plugin, std::move(importer)}
    {
    }
    Result<void> read(ImportRequest& request) override
    {
        return guardedFormat<Result<void>>(g_.guard, g_.plugin, "Importer::read",
                                           [&] { return g_.inner->read(request); });
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

/// A world that failed in a step is in no state to go on: the run ends with the Failure. The other calls are too many
/// and too small for a guard of their own; what they throw ends the run, too (see Simulation).
class GuardedWorld final : public PhysicsWorld {
public:
    GuardedWorld(Guard& guard, Plugin& plugin, std::unique_ptr<PhysicsWorld> world)
        : g_{guard, plugin, std::move(world)}
    {
    }

    void step(double dt) override
    {
        if (!g_.guard.run(g_.plugin, "PhysicsWorld::step", [&] { g_.inner->step(dt); }))
            throw Failure(Error("the plugin " + g_.plugin.title() + " was switched off: " + g_.plugin.reason));
    }

    BodyHandle addSoftBody(const SoftBodyDef& def) override { return g_.inner->addSoftBody(def); }
    BodyHandle addRigidBody(const RigidBodyDef& def) override { return g_.inner->addRigidBody(def); }
    ActuatorHandle addSpring(const SpringActuatorDef& def) override { return g_.inner->addSpring(def); }
    ActuatorHandle addAngularSpring(const AngularSpringActuatorDef& def) override
    {
        return g_.inner->addAngularSpring(def);
    }
    ActuatorHandle addTorque(const TorqueActuatorDef& def) override { return g_.inner->addTorque(def); }
    ActuatorHandle addForce(const ForceActuatorDef& def) override { return g_.inner->addForce(def); }
    std::size_t bodyCount() const override { return g_.inner->bodyCount(); }
    BodyStates bodies() const override { return g_.inner->bodies(); }
    std::span<const Contact> contacts() const override { return g_.inner->contacts(); }
    StepStats stats() const override { return g_.inner->stats(); }
    bool touching(BodyHandle a, BodyHandle b) const override { return g_.inner->touching(a, b); }
    bool contains(BodyHandle body, const Vec2& point) const override { return g_.inner->contains(body, point); }
    void setTorque(ActuatorHandle torque, double value) override { g_.inner->setTorque(torque, value); }
    void setForce(ActuatorHandle force, const Vec2& value) override { g_.inner->setForce(force, value); }
    void applyForce(BodyHandle body, const Vec2& force) override { g_.inner->applyForce(body, force); }
    void applyImpulse(BodyHandle body, const Vec2& impulse) override { g_.inner->applyImpulse(body, impulse); }
    void setVelocity(BodyHandle body, const Vec2& velocity) override { g_.inner->setVelocity(body, velocity); }
    void setOmega(BodyHandle body, double omega) override { g_.inner->setOmega(body, omega); }
    void setPosition(BodyHandle body, const Vec2& centre) override { g_.inner->setPosition(body, centre); }
    void setGravity(const Vec2& gravity) override { g_.inner->setGravity(gravity); }
    bool springAlive(BodyHandle body, std::uint32_t index) const override { return g_.inner->springAlive(body, index); }
    JointHandle addJoint(const JointDef& def) override { return g_.inner->addJoint(def); }
    JointState joint(JointHandle handle) const override { return g_.inner->joint(handle); }
    void setMotor(JointHandle handle, bool driven, double speed) override { g_.inner->setMotor(handle, driven, speed); }
    void setJointTarget(JointHandle handle, const Vec2& target) override { g_.inner->setJointTarget(handle, target); }
    void removeJoint(JointHandle handle) override { g_.inner->removeJoint(handle); }
    bool awake(BodyHandle body) const override { return g_.inner->awake(body); }
    void wake(BodyHandle body) override { g_.inner->wake(body); }
    std::span<const ContactEvent> contactEvents() const override { return g_.inner->contactEvents(); }
    std::optional<CastHit> rayCast(const Vec2& from, const Vec2& to, const QueryFilter& filter) const override
    {
        return g_.inner->rayCast(from, to, filter);
    }
    std::optional<CastHit> shapeCast(const ShapeDef& shape, const Vec2& way, const QueryFilter& filter) const override
    {
        return g_.inner->shapeCast(shape, way, filter);
    }
    std::vector<BodyHandle> overlapping(const Box& box, const QueryFilter& filter) const override
    {
        return g_.inner->overlapping(box, filter);
    }
    std::optional<CastHit> nearest(const Vec2& point, double reach, const QueryFilter& filter) const override
    {
        return g_.inner->nearest(point, reach, filter);
    }
    std::uint64_t hash() const override { return g_.inner->hash(); }
    std::vector<std::byte> save() const override { return g_.inner->save(); }
    void restore(std::span<const std::byte> state) override { g_.inner->restore(state); }

private:
    Guarded<std::unique_ptr<PhysicsWorld>> g_;
};

class GuardedPhysicsEngine final : public PhysicsEngine {
public:
    GuardedPhysicsEngine(Guard& guard, Plugin& plugin, std::shared_ptr<PhysicsEngine> engine)
        : g_{guard, plugin, std::move(engine)}
    {
    }
    std::unique_ptr<PhysicsWorld> createWorld(const WorldSettings& settings) override
    {
        auto world = g_.guard.call(
            g_.plugin, "PhysicsEngine::createWorld", [&] { return g_.inner->createWorld(settings); },
            std::unique_ptr<PhysicsWorld>());
        if (!world) return nullptr;
        return std::make_unique<GuardedWorld>(g_.guard, g_.plugin, std::move(world));
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
        return guardedFormat<Result<void>>(g_.guard, g_.plugin, "ScriptRuntime::run",
                                           [&] { return g_.inner->run(script); });
    }
    void dispatch(const ScriptEvent& event) override
    {
        // What scripts do wrong the runtime reports itself; what comes here is the runtime's own failure, and ends the
        // run.
        if (!g_.guard.run(g_.plugin, "ScriptRuntime::dispatch", [&] { g_.inner->dispatch(event); }))
            throw Failure(Error("the plugin " + g_.plugin.title() + " was switched off: " + g_.plugin.reason));
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
    GuardedCommand(Guard& guard, Plugin& plugin, std::shared_ptr<Command> command)
        : g_{guard, plugin, std::move(command)}
    {
    }
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

/// The widget itself is Qt's and the plugin's; what can be guarded is its making.
class GuardedPanel final : public Panel {
public:
    GuardedPanel(Guard& guard, Plugin& plugin, std::unique_ptr<Panel> panel, Editor& editor)
        : Panel(editor), g_{guard, plugin, std::move(panel)}
    {
    }
    QWidget* createWidget() override
    {
        return g_.guard.call(
            g_.plugin, "Panel::createWidget", [&] { return g_.inner->createWidget(); }, static_cast<QWidget*>(nullptr));
    }

private:
    Guarded<std::unique_ptr<Panel>> g_;
};

}  // namespace

std::unique_ptr<Panel> guarded(Guard& guard, Plugin& plugin, std::unique_ptr<Panel> panel, Editor& editor)
{
    return std::make_unique<GuardedPanel>(guard, plugin, std::move(panel), editor);
}
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
