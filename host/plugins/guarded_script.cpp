// Script engines and their runtimes under guard.
#include "guarded_object.hpp"

namespace jet::host {

namespace {

class GuardedRuntime final : public ScriptRuntime,
                             public ContactListening,
                             GuardedObject<ScriptRuntime, Callback::RuntimeDestroy> {
public:
    using GuardedObject::GuardedObject;

    Result<void> run(const Item& script) override
    {
        Result<void> result;
        const bool fine = tell(Callback::RuntimeRun, [&](ScriptRuntime& runtime) {
            result = resultOf<Result<void>>([&] { return runtime.run(script); });
        });
        return fine ? result : Result<void>(switchedOff().error());
    }
    void dispatch(const ScriptEvent& event) override
    {
        // What scripts do wrong the runtime reports itself; what comes here is the runtime's own failure, and ends the
        // run.
        if (!tell(Callback::RuntimeDispatch, [&](ScriptRuntime& runtime) { runtime.dispatch(event); }))
            throw switchedOff();
    }
    bool listensTo(ScriptEventKind kind) const override
    {
        return ask(
            Callback::RuntimeListensTo, [&](ScriptRuntime& runtime) { return runtime.listensTo(kind); }, false);
    }
    bool listensToContacts() const override
    {
        return ask(
            Callback::RuntimeListensTo,
            [&](ScriptRuntime& runtime) {
                const auto* contacts = dynamic_cast<const ContactListening*>(&runtime);
                return contacts && contacts->listensToContacts();
            },
            false);
    }
};

class GuardedScriptEngine final : public ScriptEngine, GuardedObject<ScriptEngine, Callback::ScriptsDestroy> {
public:
    using GuardedObject::GuardedObject;
    using GuardedObject::renewInner;

    std::unique_ptr<ScriptRuntime> createRuntime(Simulation& simulation) override
    {
        auto runtime = ask(
            Callback::ScriptsCreateRuntime, [&](ScriptEngine& engine) { return engine.createRuntime(simulation); },
            std::unique_ptr<ScriptRuntime>());
        if (!runtime) return nullptr;
        return std::make_unique<GuardedRuntime>(guard_, plugin_, std::move(runtime));
    }
};

}  // namespace

std::shared_ptr<ScriptEngine> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<ScriptEngine> engine)
{
    return std::make_shared<GuardedScriptEngine>(guard, plugin, std::move(engine));
}
void renew(ScriptEngine& guarded, std::shared_ptr<ScriptEngine> engine)
{
    static_cast<GuardedScriptEngine&>(guarded).renewInner(std::move(engine));
}

}  // namespace jet::host
