// Effects and item types under random edits.
#include "tests.hpp"

#include <jet/effect.hpp>
#include <jet/item_type.hpp>
#include <jet/project.hpp>
#include <jet/scene_painter.hpp>
#include <jet/simulation.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace jet::host::check {

namespace {

constexpr int kEdits = 1000;

/// Random edits of items that have the effect, or are of the type, under test.
class Edits {
public:
    Edits(Stage& stage, ContributionKind kind)
        : stage_(stage), context_(stage.context), random_(stage.context.random),
          isEffect_(kind == ContributionKind::Effect)
    {
        if (isEffect_) {
            effect_ = context_.call("factory", [&] { return stage.catalog.effect(id()); });
            if (!effect_) context_.fail("the effect cannot be made");
            table_ =
                &context_.call("Effect::properties", [&]() -> const PropertyTable& { return effect_->properties(); });
        } else {
            const ItemType* type = context_.call("factory", [&] { return stage.catalog.itemType(id()); });
            if (!type) context_.fail("the item type cannot be made");
            table_ =
                &context_.call("ItemType::properties", [&]() -> const PropertyTable& { return type->properties(); });
        }
    }

    void edit(int number)
    {
        context_.activity("edit " + std::to_string(number) + ", seed " + std::to_string(context_.seed));
        const Item* item = random_.item(stage_.scene, [&](const Item& one) { return hasIt(one); });
        if (!item || random_.chance(0.2))
            return attempt(isEffect_ ? "Effect::rejects or Effect::applied" : "adding an item", [&] { return add(); });
        switch (random_.below(8)) {
        case 0: return attempt("setting a path", [&] { return setPath(*item); });
        case 1: return attempt("a transformation", [&] { return transform(*item); });
        case 2: return attempt("moving an item", [&] { return move(*item); });
        case 3: return attempt("removing it", [&] { return remove(*item); });
        case 4: return attempt("copying an item", [&] { return copy(*item); });
        default: return attempt("setting a property", [&] { return setProperty(*item); });
        }
    }

    /// Items that have it now.
    std::size_t count() const
    {
        std::size_t n = 0;
        stage_.scene.root().walk([&](const Item& item) { n += hasIt(item); });
        return n;
    }
    std::size_t added() const { return added_; }
    const std::string& refusal() const { return refusal_; }
    const Effect& effect() const { return *effect_; }
    const PropertyTable& table() const { return *table_; }
    const std::string& id() const { return context_.contribution; }

private:
    bool hasIt(const Item& item) const { return isEffect_ ? item.effect(id()) != nullptr : item.type() == id(); }

    /// A Failure is a refusal, after which the scene is as before; anything else is a fault.
    template <class Fn>
    void attempt(const char* what, Fn&& fn)
    {
        const std::uint64_t before = stage_.scene.hash();
        bool refused = false;
        context_.call(what, [&] {
            try {
                fn();
            } catch (const Failure& failure) {
                refused = true;
                refusal_ = failure.error().message;
            }
        });
        stage_.checkClosed(what);
        if (refused && stage_.scene.hash() != before)
            context_.fail(context_.where(what + (" was refused (" + refusal_) + "), but the scene has changed"));
    }

    void add()
    {
        auto edit = stage_.items().begin("Add");
        if (!isEffect_) {
            const Item* parent = random_.item(stage_.scene, [](const Item& one) { return one.isContainer(); });
            const Item& item = edit.add(id(), parent ? *parent : stage_.items().root(), random_.path());
            const Properties values = random_.properties(*table_, stage_.scene);
            for (const auto& [property, value] : values.entries()) edit.set(item, property, value);
        } else {
            const Item* item = random_.item(stage_.scene, [](const Item& one) { return !one.isContainer(); });
            if (!item) item = &edit.add<ShapeItem>(stage_.items().root(), random_.path());
            if (std::string reason = effect_->rejects(*item); !reason.empty()) {
                refusal_ = reason;
                return;
            }
            edit.addEffect(*item, id(), random_.properties(*table_, stage_.scene));
        }
        edit.commit();
        ++added_;
    }

    std::size_t indexIn(const Item& item) const
    {
        const auto effects = item.effects();
        const auto found =
            std::find_if(effects.begin(), effects.end(), [&](const EffectInstance& e) { return e.type == id(); });
        return static_cast<std::size_t>(found - effects.begin());
    }

    void setProperty(const Item& item)
    {
        auto edit = stage_.items().begin("Property");
        if (table_->specs().empty() || random_.chance(0.1)) {
            if (isEffect_)
                edit.setEffect(item, indexIn(item), "visible", random_.chance(0.5));
            else
                edit.set(item, "visible", random_.chance(0.5));
        } else {
            const PropertySpec& spec = table_->specs()[random_.below(table_->specs().size())];
            const Value value = random_.value(spec, stage_.scene);
            if (isEffect_)
                edit.setEffect(item, indexIn(item), spec.id, value);
            else
                edit.set(item, spec.id, value);
        }
        // A slider: steps of it join.
        edit.commit(random_.chance(0.3) ? "slider" : "");
    }
    void setPath(const Item& item)
    {
        auto edit = stage_.items().begin("Path");
        edit.setPath(item, random_.path());
        edit.commit();
    }
    void transform(const Item& item)
    {
        auto edit = stage_.items().begin("Transform");
        edit.transform(item, random_.map());
        if (random_.chance(0.2)) {
            edit.restart();
            edit.transform(item, random_.map());
        }
        edit.commit();
    }
    void move(const Item& item)
    {
        auto edit = stage_.items().begin("Move");
        const auto last = isEffect_ && !item.effects().empty() ? item.effects().size() - 1 : 0;
        if (last > 0 && random_.chance(0.5))
            edit.moveEffect(item, random_.below(last + 1), random_.below(last + 1));
        else
            edit.move(item, stage_.items().root(), 0);
        edit.commit();
    }
    void remove(const Item& item)
    {
        auto edit = stage_.items().begin("Remove");
        if (isEffect_ && random_.chance(0.7))
            edit.removeEffect(item, indexIn(item));
        else
            edit.remove(item);
        if (random_.chance(0.2)) return;  // leaving without commit
        edit.commit();
    }
    void copy(const Item& item)
    {
        auto edit = stage_.items().begin("Copy");
        edit.addCopy(item, stage_.items().root());
        edit.commit();
    }

    Stage& stage_;
    Context& context_;
    Random& random_;
    bool isEffect_;
    const Effect* effect_ = nullptr;
    const PropertyTable* table_ = nullptr;
    std::size_t added_ = 0;
    std::string refusal_;
};

void runEdits(Context& context, ContributionKind kind)
{
    Stage stage(context);
    stage.fill();
    UndoModel model(stage);
    Edits edits(stage, kind);
    for (int i = 1; i <= kEdits; ++i) {
        edits.edit(i);
        model.record();
        if (context.random.chance(0.1)) {
            model.wander();
            model.record();
        }
        if (stage.items().itemCount() > 40) {
            stage.thin(20);
            model.record();
        }
    }
    model.sweep();
    if (edits.added() == 0) context.fail("it could not be added to any item: " + edits.refusal());
}

void runSaving(Context& context, ContributionKind kind)
{
    Stage stage(context);
    stage.fill();
    Edits edits(stage, kind);
    for (int i = 1; i <= 300; ++i) {
        edits.edit(i);
        if (i % 6 == 0) stage.checkSaving();
        stage.thin(30);
    }
}

void runPainting(Context& context, ContributionKind kind)
{
    Stage stage(context);
    stage.fill();
    Edits edits(stage, kind);
    for (int i = 1; i <= 150; ++i) {
        edits.edit(i);
        if (i % 10 == 0) stage.host.scale = std::array{1e-3, 0.1, 1.0, 10.0, 1e3}[context.random.below(5)];
        if (i % 3 == 0) stage.checkPainting();
        stage.thin(20);
    }
}

bool finite(const std::vector<Vec2>& points)
{
    return std::all_of(points.begin(), points.end(), [](const Vec2& p) { return isFinite(p); });
}

std::string problemOf(const RigidBodyDef& def)
{
    if (!(def.mass > 0) || !std::isfinite(def.mass)) return "a rigid body's mass is not a positive number";
    if (def.borders.empty()) return "a rigid body has no border";
    for (const auto& border : def.borders) {
        if (border.size() < 3) return "a border has fewer than three points";
        if (!finite(border)) return "a border has NaN or infinity";
    }
    return {};
}

std::string problemOf(const SoftBodyDef& def)
{
    const std::size_t n = def.particles.size();
    if (n == 0) return "a soft body has no particles";
    if (!finite(def.particles)) return "a particle is at NaN or infinity";
    if (def.masses.size() != n) return "the number of masses is not that of the particles";
    if (!def.movable.empty() && def.movable.size() != n)
        return "the number of movable flags is not that of the particles";
    for (const double mass : def.masses)
        if (!(mass > 0) || !std::isfinite(mass)) return "a particle's mass is not a positive number";
    for (const auto& border : def.borders)
        for (const std::uint32_t index : border)
            if (index >= n) return "a border names a particle that is not there";
    for (const SpringDef& spring : def.springs) {
        if (spring.a >= n || spring.b >= n || spring.a == spring.b)
            return "a spring names particles that are not there, or one twice";
        if (!std::isfinite(spring.restLength) || !std::isfinite(spring.ks) || !std::isfinite(spring.kd))
            return "a spring has NaN or infinity";
    }
    for (const AngularSpringDef& spring : def.angularSprings)
        if (spring.a >= n || spring.b >= n || spring.centre >= n)
            return "an angular spring names particles that are not there";
    return {};
}

/// Plays the scene for a moment; what cannot be built is a warning of the simulation, not a failure.
void play(Stage& stage, int steps)
{
    Context& context = stage.context;
    auto started = context.call("starting a simulation", [&] { return Simulation::start(stage.scene, {}); });
    if (!started) context.fail(context.where("the scene does not play: " + started.error().message));
    // How long a step takes is the engine's affair, not the plugin's; the time of the whole test is limited.
    context.board.callback("a step of a simulation");
    try {
        for (int i = 0; i < steps; ++i) (*started)->step();
    } catch (const std::exception& e) {
        context.fail(context.where(std::string("a step of a simulation failed with an exception: ") + e.what()));
    }
    const BodyStates bodies = (*started)->world().bodies();
    for (const Vec2& point : bodies.points)
        if (!isFinite(point)) context.fail(context.where("a body of the simulation is at NaN or infinity"));
}

void expectRefusal(Stage& stage)
{
    const auto started =
        stage.context.call("starting a simulation", [&] { return Simulation::start(stage.scene, {}); });
    if (!started && started.error().message.empty()) stage.context.fail("a scene that cannot play gives no reason");
}

}  // namespace

void testEffectEdits(Context& context) { runEdits(context, ContributionKind::Effect); }
void testEffectSaving(Context& context) { runSaving(context, ContributionKind::Effect); }
void testEffectPainting(Context& context) { runPainting(context, ContributionKind::Effect); }

void testEffectAlone(Context& context)
{
    Stage stage(context, Stage::With::RequiredOnly);
    UndoModel model(stage);
    Edits edits(stage, ContributionKind::Effect);
    for (int i = 1; i <= 100; ++i) {
        edits.edit(i);
        model.record();
        if (i % 10 != 0) continue;
        stage.checkPainting();
        expectRefusal(stage);
        model.wander();
        model.record();
        stage.thin(15);
        model.record();
    }
    model.sweep();
}

void testEffectBodies(Context& context)
{
    Stage stage(context);
    stage.fill();
    Edits edits(stage, ContributionKind::Effect);
    bool builds = false;
    for (int i = 1; i <= 150; ++i) {
        edits.edit(i);
        const Item* item =
            context.random.item(stage.scene, [&](const Item& one) { return one.effect(edits.id()) != nullptr; });
        if (!item) continue;
        const EffectInput input{*item, item->path(), item->effect(edits.id())->properties, edits.table()};
        const auto def = context.call("Effect::buildBody", [&]() -> std::optional<BodyDef> {
            try {
                return edits.effect().buildBody(input, BodyCommon{});
            } catch (const Failure&) {
                return std::nullopt;  // a word about this item
            }
        });
        if (!def) continue;
        builds = true;
        const std::string problem = std::visit([](const auto& body) { return problemOf(body); }, *def);
        if (!problem.empty()) context.fail(context.where("Effect::buildBody: " + problem));
        stage.thin(15);
    }
    if (!builds || !stage.loadPhysicsEngine()) return;
    for (int i = 151; i <= 158; ++i) {
        stage.thin(6);
        for (int n = 0; n < 10; ++n) edits.edit(i);
        play(stage, 5);
    }
}

void testItemTypeEdits(Context& context) { runEdits(context, ContributionKind::ItemType); }
void testItemTypeSaving(Context& context) { runSaving(context, ContributionKind::ItemType); }
void testItemTypePainting(Context& context) { runPainting(context, ContributionKind::ItemType); }

void testItemTypePlaying(Context& context)
{
    Stage stage(context, Stage::With::RequiredOnly);
    Edits edits(stage, ContributionKind::ItemType);
    for (int i = 1; i <= 40; ++i) edits.edit(i);
    expectRefusal(stage);
    if (!stage.loadPhysicsEngine()) return;
    for (int i = 41; i <= 60; ++i) {
        edits.edit(i);
        play(stage, 5);
        stage.thin(15);
    }
}

}  // namespace jet::host::check
