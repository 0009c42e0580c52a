#include "hasher.hpp"
#include "physics_ranges.hpp"
#include "scene_state.hpp"
#include "simulation_state.hpp"

#include <jet/catalog.hpp>
#include <jet/simulation.hpp>

#include <nlohmann/json.hpp>

#include <set>

namespace jet {

namespace {

constexpr std::size_t kMaximumOutput = 10'000;

/// For whoever asked for one that is not there.
std::string installedEngines(const Catalog& catalog)
{
    std::string list;
    for (const Contribution& one : catalog.contributions(ContributionKind::PhysicsEngine))
        list += (list.empty() ? " Installed: " : ", ") + one.id + " (" + one.label + ")";
    return list.empty() ? list : list + ".";
}

/// An engine that lacks the method the scene asks for plays it with its own, and that is said: it is a way to compute
/// the same motion, so the scene makes sense without.
std::unique_ptr<PhysicsWorld> createWorld(PhysicsEngine& engine, WorldSettings settings,
                                          std::vector<OutputLine>& messages)
{
    if (settings.method == Method::Automatic) return engine.createWorld(settings);
    try {
        return engine.createWorld(settings);
    } catch (const Failure& failure) {
        settings.method = Method::Automatic;
        auto world = engine.createWorld(settings);  // refuses, too, where it is something else that is wrong
        messages.push_back({OutputLine::Kind::Warning,
                            "the scene's setting 'method' counts for nothing: " + failure.error().message,
                            {},
                            0});
        return world;
    }
}

}  // namespace

Simulation::Simulation() : d_(std::make_unique<Private>()) {}
Simulation::~Simulation() { d_->scripts.reset(); }

Result<std::unique_ptr<Simulation>> Simulation::start(const Scene& scene, SimulationOptions options)
{
    try {
        return prepare(scene, std::move(options));
    } catch (const Failure& failure) {
        return failure.error();
    } catch (const std::exception& e) {
        return Error(std::string("the scene cannot be played: starting it failed: ") + e.what());
    } catch (...) {
        return Error("the scene cannot be played: starting it failed with an unknown exception");
    }
}

Result<std::unique_ptr<Simulation>> Simulation::prepare(const Scene& scene, SimulationOptions options)
{
    Catalog& catalog = scene.catalog();
    std::string engineId = options.physics;
    if (engineId.empty()) engineId = scene.setting("physics").as<std::string>();
    PhysicsEngine* engine = catalog.physicsEngine(engineId);
    if (!engine)
        return Error("the scene cannot be played: " + catalog.explain(ContributionKind::PhysicsEngine, engineId) +
                     installedEngines(catalog));

    std::unique_ptr<Simulation> simulation(new Simulation);
    auto& d = *simulation->d_;
    d.options = std::move(options);
    d.timeStep = d.options.timeStep.value_or(scene.setting("time-step").as<double>());
    if (const auto fits = Scene::settingsTable().find("time-step")->check(d.timeStep); !fits) return fits.error();
    d.random = d.options.seed;
    d.view.size = d.options.viewSize;
    // Until a script moves the camera, it stands as if the page's (or world's) origin were in the corner.
    d.view.view = View{};
    d.scene = scene.clone(d.events);
    std::vector<OutputLine> messages;
    if (const auto fits = checkMaterials(d.scene->materials()); !fits)
        return Error("the scene cannot be played: " + fits.error().message);
    try {
        d.world = createWorld(*engine, worldSettings(*d.scene, d.options.threads), messages);
    } catch (const Failure& failure) {
        return Error("the scene cannot be played: " + failure.error().message);
    }
    if (!d.world) return Error("the physics engine could not make a world for this scene");
    SceneWorldBuilder builder(*d.scene, *d.world, messages);
    builder.build();
    d.bodies = std::move(builder.bodies);
    d.actuators = std::move(builder.actuators);
    d.parts = std::move(builder.parts);
    for (std::size_t i = 0; i < d.bodies.size(); ++i) d.bodyByItem[d.bodies[i].item.value] = i;
    d.poses.resize(d.bodies.size());
    d.posedAt.resize(d.bodies.size());
    for (const auto& [item, parts] : d.parts)
        if (auto path = CarriedPath::of(*d.scene->items().find(item), parts, d.bodies))
            d.carried.emplace(item, std::move(*path));
    for (OutputLine& message : messages) simulation->print(std::move(message));

    bool hasScripts = false;
    d.scene->root().walk([&](const Item& item) {
        hasScripts = hasScripts || item.is<ScriptItem>();
        d.keepTables(item);
    });
    if (!hasScripts) return simulation;
    ScriptEngine* scripts = catalog.scriptEngine("");
    if (!scripts) {
        simulation->print({OutputLine::Kind::Error,
                           "the scripts do not run: " + catalog.explain(ContributionKind::ScriptEngine, ""),
                           {},
                           0});
        return simulation;
    }
    d.scripts = scripts->createRuntime(*simulation);
    if (!d.scripts) return simulation;
    d.contactListening = dynamic_cast<const ContactListening*>(d.scripts.get());
    d.scene->root().walk([&](const Item& item) {
        if (!item.is<ScriptItem>()) return;
        if (const auto ran = d.scripts->run(item); !ran)
            simulation->print({OutputLine::Kind::Error, ran.error().message, item.id(), ran.error().where.line});
    });
    return simulation;
}

void Simulation::step()
{
    auto& d = *d_;
    if (d.scripts) d.scripts->dispatch(ScriptEvent{ScriptEventKind::Step, {}, {}, {}, {}, {}});
    d.world->step(d.timeStep);
    ++d.steps;
    if (!d.scripts) return;
    d.dispatchTouches();
    // Once a step, not once a painted frame: what a listener does must not depend on a window and its refresh rate.
    d.scripts->dispatch(ScriptEvent{ScriptEventKind::PrePaint, {}, {}, {}, {}, {}});
    d.scripts->dispatch(ScriptEvent{ScriptEventKind::PostPaint, {}, {}, {}, {}, {}});
}

std::uint64_t Simulation::stepCount() const { return d_->steps; }
double Simulation::time() const { return static_cast<double>(d_->steps) * d_->timeStep; }
double Simulation::timeStep() const { return d_->timeStep; }
const Scene& Simulation::scene() const { return *d_->scene; }
PhysicsWorld& Simulation::world() { return *d_->world; }
const PhysicsWorld& Simulation::world() const { return *d_->world; }

BodyHandle Simulation::bodyOf(ItemId item) const
{
    const std::size_t i = d_->bindingOf(item);
    return i < d_->bodies.size() ? d_->bodies[i].body : kNoHandle;
}

ItemId Simulation::itemOf(BodyHandle body) const
{
    // Bodies of items come first, in the order of their handles.
    if (body < d_->bodies.size() && d_->bodies[body].body == body) return d_->bodies[body].item;
    for (const BodyBinding& binding : d_->bodies)
        if (binding.body == body) return binding.item;
    return {};
}

ActuatorHandle Simulation::actuatorOf(ItemId item) const
{
    const auto found = d_->actuators.find(item);
    return found == d_->actuators.end() ? kNoHandle : found->second;
}

const Path* Simulation::pose(const Item& item) const
{
    const std::size_t i = d_->bindingOf(item.id());
    if (i >= d_->bodies.size()) {
        const auto held = d_->carried.find(item.id());
        return held == d_->carried.end() ? nullptr : &held->second.at(*d_->world, d_->bodies);
    }
    if (d_->bodies[i].fixed) return nullptr;
    if (d_->posedAt[i] != d_->steps + 1) {
        d_->poses[i] = d_->posed(d_->bodies[i]);
        d_->posedAt[i] = d_->steps + 1;
    }
    return &d_->poses[i];
}

const LiveBody* Simulation::liveBody(const Item& item) const
{
    const std::size_t i = d_->bindingOf(item.id());
    if (i >= d_->bodies.size() || !d_->bodies[i].wantsLive) return nullptr;
    d_->refresh(d_->bodies[i]);
    return &*d_->bodies[i].live;
}

void Simulation::setTorque(ItemId item, double value)
{
    d_->torques[item] = value;
    const Item* found = d_->scene->items().find(item);
    if (found && found->is<TorqueItem>() && actuatorOf(item) != kNoHandle)
        d_->world->setTorque(actuatorOf(item), -value);
}

double Simulation::torque(ItemId item) const
{
    if (const auto found = d_->torques.find(item); found != d_->torques.end()) return found->second;
    const Item* torque = d_->scene->items().find(item);
    const Value* value = torque ? torque->properties().find("value") : nullptr;
    return value ? value->as<double>() : 0;
}

void Simulation::key(const KeyEvent& event, bool down)
{
    setKey(event.key, down);
    if (!d_->scripts) return;
    d_->scripts->dispatch(ScriptEvent{down ? ScriptEventKind::KeyDown : ScriptEventKind::KeyUp, event, {}, {}, {}, {}});
    if (down && !event.text.empty())
        d_->scripts->dispatch(ScriptEvent{ScriptEventKind::KeyTyped, event, {}, {}, {}, {}});
}

void Simulation::setKey(std::string_view key, bool down)
{
    if (down) {
        d_->keys.emplace(key);
    } else if (const auto found = d_->keys.find(key); found != d_->keys.end()) {
        d_->keys.erase(found);
    }
}

bool Simulation::isPressed(std::string_view key) const { return d_->keys.contains(key); }

void Simulation::pointer(ScriptEventKind kind, const PointerEvent& event)
{
    if (d_->scripts) d_->scripts->dispatch(ScriptEvent{kind, {}, event, {}, {}, {}});
}

bool Simulation::listensToPointer() const
{
    using Kind = ScriptEventKind;
    const auto heard = {Kind::PointerDown, Kind::PointerMove, Kind::PointerUp};
    return d_->scripts &&
           std::any_of(heard.begin(), heard.end(), [this](Kind kind) { return d_->scripts->listensTo(kind); });
}

GameView& Simulation::view() { return d_->view; }
const GameView& Simulation::view() const { return d_->view; }

void Simulation::print(OutputLine line)
{
    ++d_->printed;
    if (d_->onOutput) d_->onOutput(line);
    d_->output.push_back(std::move(line));
    if (d_->output.size() > kMaximumOutput) d_->output.pop_front();
}

const std::deque<OutputLine>& Simulation::output() const { return d_->output; }
void Simulation::setOutputHandler(std::function<void(const OutputLine&)> handler) { d_->onOutput = std::move(handler); }
void Simulation::requestScene(std::string name) { d_->requestedScene = std::move(name); }
const std::optional<std::string>& Simulation::requestedScene() const { return d_->requestedScene; }

const Scene* Simulation::sceneByName(std::string_view name) const
{
    if (name == d_->scene->name()) return d_->scene.get();
    return d_->options.sceneByName ? d_->options.sceneByName(name) : nullptr;
}

double Simulation::random()
{
    // splitmix64: a full-period generator with one word of state (Steele, Lea, Flood 2014)
    std::uint64_t z = (d_->random += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
}

void Simulation::setPropertyHandler(std::function<void(ItemId, std::string_view, const Value&)> handler)
{
    d_->onProperty = std::move(handler);
}

std::uint64_t Simulation::hash() const
{
    Hasher h;
    h.add(d_->world->hash());
    h.add(d_->steps);
    h.add(d_->view.view.anchor);
    h.add(d_->view.view.scale);
    h.add(d_->random);
    h.add(d_->printed);
    for (const auto& [item, value] : d_->torques) h.add(item.value), h.add(value);
    return h.value();
}

std::string Simulation::stateJson() const
{
    using Json = nlohmann::ordered_json;
    const auto pair = [](const Vec2& v) { return Json::array({v.x(), v.y()}); };
    char hashText[17];
    std::snprintf(hashText, sizeof hashText, "%016llx", static_cast<unsigned long long>(hash()));
    Json state{
        {"step", d_->steps}, {"time", time()}, {"hash", hashText}, {"items", Json::array()}, {"output", Json::array()}};
    const BodyStates bodies = d_->world->bodies();
    d_->scene->root().walk([&](const Item& item) {
        const BodyHandle body = bodyOf(item.id());
        const Box box = body != kNoHandle ? bodies.bounds[body] : item.bounds();
        if (box.isNull() || item.isContainer()) return;
        const bool moves = body != kNoHandle;
        state["items"].push_back(Json{{"id", item.id().value},
                                      {"name", item.name()},
                                      {"type", item.type()},
                                      {"position", pair(moves ? bodies.position[body] : box.center())},
                                      {"angle", moves ? bodies.angle[body] : 0.0},
                                      {"velocity", pair(moves ? bodies.velocity[body] : Vec2(0, 0))},
                                      {"omega", moves ? bodies.omega[body] : 0.0},
                                      {"bounds", Json::array({box.min.x(), box.min.y(), box.max.x(), box.max.y()})}});
        if (moves) state["items"].back()["awake"] = d_->world->awake(body);
    });
    state["view"] =
        Json{{"anchor", pair(d_->view.view.anchor)}, {"scale", d_->view.view.scale}, {"size", pair(d_->view.size)}};
    for (const OutputLine& line : d_->output) state["output"].push_back(line.text);
    return state.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace jet
