// Physics engines: determinism and snapshots. Script engines: errors and limits.
#include "tests.hpp"

#include <jet/physics.hpp>
#include <jet/script.hpp>
#include <jet/simulation.hpp>

#include <fstream>
#include <sstream>

namespace jet::host::check {

namespace {

constexpr double kStep = 1.0 / 60;

RigidBodyDef box(const Vec2& at, const Vec2& size, bool fixed)
{
    RigidBodyDef def;
    def.common.fixed = fixed;
    def.borders = {{at, at + Vec2(size.x(), 0), at + size, at + Vec2(0, size.y())}};
    return def;
}

/// A square of four particles, sprung along its sides and diagonals.
SoftBodyDef jelly(const Vec2& at, double size)
{
    SoftBodyDef def;
    def.particles = {at, at + Vec2(size, 0), at + Vec2(size, size), at + Vec2(0, size)};
    def.masses = {1, 1, 1, 1};
    def.borders = {{0, 1, 2, 3}};
    for (std::uint32_t a = 0; a < 4; ++a)
        for (std::uint32_t b = a + 1; b < 4; ++b)
            def.springs.push_back({a, b, (def.particles[b] - def.particles[a]).norm(), 500, 5, 0});
    return def;
}

class World {
public:
    World(Context& context, PhysicsEngine& engine, int threads) : context_(context)
    {
        WorldSettings settings;
        settings.threads = threads;
        world_ = context.call("PhysicsEngine::createWorld", [&] { return engine.createWorld(settings); });
        if (!world_) context.fail("PhysicsEngine::createWorld made nothing");
        context.call("PhysicsWorld::addRigidBody", [&] { world_->addRigidBody(box({-500, 300}, {1000, 50}, true)); });
        for (int i = 0; i < 4; ++i)
            context.call("PhysicsWorld::addRigidBody", [&] {
                world_->addRigidBody(box({i * 5.0, 200 - i * 30.0}, {25, 25}, false));
            });
        // An engine may be of rigid bodies only: it says so with a Failure.
        context.call("PhysicsWorld::addSoftBody", [&] {
            try {
                world_->addSoftBody(jelly({100, 100}, 30));
                world_->addSoftBody(jelly({110, 50}, 20));
            } catch (const Failure&) {
                return;
            }
        });
    }

    void step(int count)
    {
        for (int i = 0; i < count; ++i) context_.call("PhysicsWorld::step", [&] { world_->step(kStep); });
        checkFinite();
    }
    std::uint64_t hash() const
    {
        return context_.call("PhysicsWorld::hash", [&] { return world_->hash(); });
    }
    std::vector<std::byte> save() const
    {
        return context_.call("PhysicsWorld::save", [&] { return world_->save(); });
    }
    void restore(const std::vector<std::byte>& state)
    {
        context_.call("PhysicsWorld::restore", [&] { world_->restore(state); });
    }
    double lowest() const
    {
        double y = -1e300;
        for (const Vec2& p : world_->bodies().position) y = std::max(y, p.y());
        return y;
    }

private:
    void checkFinite()
    {
        const BodyStates bodies = context_.call("PhysicsWorld::bodies", [&] { return world_->bodies(); });
        if (bodies.position.size() != world_->bodyCount())
            context_.fail("PhysicsWorld::bodies does not tell of every body");
        for (std::size_t i = 0; i < bodies.position.size(); ++i)
            if (!isFinite(bodies.position[i]) || !isFinite(bodies.velocity[i]) || !std::isfinite(bodies.angle[i]))
                context_.fail(context_.where("body " + std::to_string(i) + " is at NaN or infinity"));
        for (const Vec2& point : bodies.points)
            if (!isFinite(point)) context_.fail(context_.where("a point of a body is at NaN or infinity"));
    }

    Context& context_;
    std::unique_ptr<PhysicsWorld> world_;
};

}  // namespace

void testPhysicsEngine(Context& context)
{
    Stage stage(context);
    PhysicsEngine* engine = context.call("factory", [&] { return stage.catalog.physicsEngine(context.contribution); });
    if (!engine) context.fail("the physics engine cannot be made");
    context.activity("120 steps of falling boxes");
    World first(context, *engine, 1), second(context, *engine, 1);
    const std::uint64_t atStart = first.hash();
    if (atStart != second.hash()) context.fail("two equal worlds have different hashes before any step");
    first.step(60);
    const auto half = first.save();
    const std::uint64_t halfHash = first.hash();
    first.step(60);
    second.step(120);
    if (first.hash() == atStart) context.fail("after 120 steps of falling bodies the hash is what it was at the start");
    if (first.hash() != second.hash()) context.fail("two equal worlds have different hashes after 120 equal steps");
    context.activity("going on from a state saved after 60 steps");
    const std::uint64_t end = first.hash();
    first.restore(half);
    if (first.hash() != halfHash) context.fail("a restored state has another hash than it had when it was saved");
    first.step(60);
    if (first.hash() != end) context.fail("60 steps from a restored state lead elsewhere than they did before");
    context.activity("120 steps with two threads");
    World threads(context, *engine, 2);
    threads.step(120);
    if (threads.hash() != end) context.fail("with two threads the world moves otherwise than with one");
}

namespace {

/// The plugin's own samples/NAME.*, for a language other than JavaScript; else `otherwise`.
std::string script(const Context& context, const std::string& name, const std::string& otherwise)
{
    for (const auto& folder : {context.samples, context.folder / "samples"}) {
        std::error_code ignored;
        if (folder.empty()) continue;
        for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
            if (entry.path().stem() != name) continue;
            std::stringstream text;
            text << std::ifstream(entry.path()).rdbuf();
            return text.str();
        }
    }
    return otherwise;
}

struct Run {
    bool started = false;
    std::string problem;  // the first error printed
};

Run runScript(Stage& stage, const std::string& code, int steps)
{
    Context& context = stage.context;
    auto edit = stage.items().begin("Script");
    while (!stage.scene.root().children().empty()) edit.remove(*stage.scene.root().children().front());
    const Item& item = edit.add<ScriptItem>(stage.items().root());
    edit.set(item, "code", code);
    edit.commit();
    Run run;
    auto started =
        context.call("starting a simulation with the script", [&] { return Simulation::start(stage.scene, {}); });
    if (!started) {
        run.problem = started.error().message;
        return run;
    }
    run.started = true;
    for (int i = 0; i < steps; ++i) context.call("a step of a simulation with the script", [&] { (*started)->step(); });
    for (const OutputLine& line : (*started)->output())
        if (line.kind == OutputLine::Kind::Error && run.problem.empty()) run.problem = line.text;
    return run;
}

}  // namespace

void testScriptEngine(Context& context)
{
    Stage stage(context);
    if (!stage.loadPhysicsEngine())
        context.fail("scripts run in a simulation, and no physics engine is installed; install one");
    ScriptEngine* engine = context.call("factory", [&] { return stage.catalog.scriptEngine(context.contribution); });
    if (!engine) context.fail("the script engine cannot be made");
    context.activity("an empty script");
    if (const Run run = runScript(stage, "", 3); !run.problem.empty())
        context.fail("an empty script fails: " + run.problem);
    context.activity("a syntax error");
    const std::string broken = script(context, "syntax-error", "var a = ;\nthis is ( not ] a program }{ \"\n");
    if (runScript(stage, broken, 1).problem.empty()) context.fail("a syntax error is not reported");
    context.activity("a runaway script");
    // That it ends at all, within the time a call may take, is what is asked.
    (void)runScript(stage, script(context, "runaway", "while (true) {}"), 1);
    context.activity("a script after a runaway one");
    if (const Run run = runScript(stage, "", 3); !run.problem.empty())
        context.fail("after a runaway script an empty one fails: " + run.problem);
    for (int i = 0; i < 50; ++i) {
        context.activity("random text " + std::to_string(i));
        std::string text;
        for (int n = 0; n < 20; ++n) text += context.random.text();
        (void)runScript(stage, text, 1);
    }
}

}  // namespace jet::host::check
