#include "world_builder.hpp"

#include "known_effect.hpp"
#include "scene_state.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

namespace jet {

WorldSettings worldSettings(const Scene& scene, int threads)
{
    WorldSettings settings;
    settings.gravity = scene.setting("gravity").as<Vec2>();
    settings.linearDamping = scene.setting("linear-damping").as<double>();
    settings.angularDamping = scene.setting("angular-damping").as<double>();
    settings.applyGravity = scene.setting("apply-gravity").as<bool>();
    settings.applyDamping = scene.setting("apply-damping").as<bool>();
    settings.findCollisions = scene.setting("find-collisions").as<bool>();
    settings.resolveCollisions = scene.setting("resolve-collisions").as<bool>();
    settings.substeps = static_cast<int>(scene.setting("substeps").as<std::int64_t>());
    settings.allowSleep = scene.setting("allow-sleep").as<bool>();
    if (scene.setting("method").as<std::string>() == "semi-implicit-euler") settings.method = Method::SemiImplicitEuler;
    settings.materialCount = static_cast<std::uint32_t>(scene.materials().size());
    settings.materials = scene.materials().pairs();
    settings.threads = threads;
    return settings;
}

namespace {

bool wantsLiveBody(const Scene& scene, const Item& item)
{
    return std::any_of(item.effects().begin(), item.effects().end(), [&](const EffectInstance& instance) {
        const Effect* effect = knownEffect(scene.catalog(), instance);
        return effect && effect->wantsLiveBody();
    });
}

LiveBody liveBodyOf(const SoftBodyDef& def)
{
    LiveBody live;
    live.particles = def.particles;
    live.springs.reserve(def.springs.size());
    for (const SpringDef& spring : def.springs)
        live.springs.push_back({spring.a, spring.b, spring.restLength, spring.ks, true});
    return live;
}

}  // namespace

BodyCommon commonOf(const Scene& scene, const Item& item, std::string& problem)
{
    const PropertyTable& table = builtInItemType(BodyItem::type)->properties();
    const Properties& own = item.properties();
    BodyCommon common;
    common.fixed = own.get("fixed", table).as<bool>();
    common.velocity = own.get("velocity", table).as<Vec2>();
    common.omega = own.get("omega", table).as<double>();
    common.gravityScale = own.get("gravity-scale", table).as<double>();
    common.sensor = own.get("sensor", table).as<bool>();
    common.kinematic = own.get("kinematic", table).as<bool>();
    common.fixedRotation = own.get("fixed-rotation", table).as<bool>();
    common.oneSided = own.get("one-sided", table).as<Vec2>();
    const auto bits = [&](const char* id) { return static_cast<std::uint32_t>(own.get(id, table).as<std::int64_t>()); };
    common.group = bits("group"), common.layer = bits("layer"), common.mask = bits("mask");
    common.allowSleep = own.get("allow-sleep", table).as<bool>();
    const auto material = own.get("material", table).as<std::string>();
    if (!material.empty()) {
        const int index = scene.materials().find(material);
        if (index < 0) {
            problem = "the scene has no material '" + material + "'";
        } else {
            common.material = static_cast<std::uint32_t>(index);
        }
    }
    return common;
}

namespace {

/// Without the engine's number of the body, where the item is named, and as a part of a sentence.
std::string reasonOf(const Failure& failure)
{
    std::string reason = failure.error().message;
    if (reason.starts_with("Physics: ")) reason.erase(0, 9);
    if (reason.starts_with("body ")) {
        const std::size_t end = reason.find_first_not_of("0123456789", 5);
        if (end != std::string::npos && reason.compare(end, 2, ": ") == 0) reason.erase(0, end + 2);
    }
    if (reason.ends_with('.')) reason.pop_back();
    return reason;
}

/// Why a joint is of no use, or nothing. A script may give it force, so this is said where there is none.
std::string uselessness(const JointDef& def)
{
    if (def.kind == JointDef::Kind::Mouse && def.maxForce == 0) return "its max-force is 0; it pulls nothing";
    if (def.kind == JointDef::Kind::Motor && def.maxForce == 0 && def.maxTorque == 0)
        return "its max-force and max-torque are 0; it drives nothing";
    if (def.driven && def.kind == JointDef::Kind::Prismatic && def.maxForce == 0)
        return "its max-force is 0; its motor does nothing";
    if (def.driven && (def.kind == JointDef::Kind::Revolute || def.kind == JointDef::Kind::Wheel) && def.maxTorque == 0)
        return "its max-torque is 0; its motor does nothing";
    return {};
}

}  // namespace

double massOf(const BodyDef& def)
{
    if (const auto* rigid = std::get_if<RigidBodyDef>(&def)) return rigid->mass;
    const std::vector<double>& masses = std::get<SoftBodyDef>(def).masses;
    return std::accumulate(masses.begin(), masses.end(), 0.0);
}

void SceneWorldBuilder::addBody(const Item& item)
{
    std::optional<BodyDef> def;
    std::string problem;
    const BodyCommon own = commonOf(scene_, item, problem);
    if (!problem.empty()) warn(item, problem + "; '" + scene_.materials().names().front() + "' is used");
    BodyBinding binding;
    for (const EffectInstance& instance : item.effects()) {
        const Effect* effect = scene_.catalog().effect(instance.type);
        if (!effect) {
            warn(item, scene_.catalog().explain(ContributionKind::Effect, instance.type));
            continue;
        }
        if (readWithoutPlugin(*effect, instance)) {
            warn(item, "its effect '" + instance.type +
                           "' was read while its plugin was switched off; save the project and open it again");
            continue;
        }
        const EffectInput input{item, item.path(), instance.properties, effect->properties()};
        std::optional<BodyDef> built;
        try {
            built = effect->buildBody(input, own);
        } catch (const Failure& failure) {
            return warn(item, "its body cannot be built: " + reasonOf(failure) + "; it stays as drawn");
        }
        if (!built) continue;
        if (def) {
            warn(item, "it has two effects that build a body; the first is used");
            break;
        }
        def = std::move(built);
        binding.effect = static_cast<std::size_t>(&instance - item.effects().data());
    }
    if (!def) return warn(item, "no effect builds its body; it stays as drawn");

    binding.item = item.id();
    binding.fixed = own.fixed;
    binding.mass = massOf(*def);
    binding.restPath = item.path();
    try {
        if (const auto* soft = std::get_if<SoftBodyDef>(&*def)) {
            binding.soft = true;
            binding.body = world_.addSoftBody(*soft);
            binding.skin = Skin(item.path(), *soft);
            binding.live = liveBodyOf(*soft);
            binding.wantsLive = wantsLiveBody(scene_, item);
        } else {
            binding.body = world_.addRigidBody(std::get<RigidBodyDef>(*def));
        }
    } catch (const Failure& failure) {
        return warn(item, "its body cannot be built: " + reasonOf(failure) + "; it stays as drawn");
    }
    bodies.push_back(std::move(binding));
}

void SceneWorldBuilder::warnOfUseless(const Item& item)
{
    for (const ItemPart& part : recording_.parts.parts) {
        const auto* joint = std::get_if<JointDef>(&part.def);
        const std::string useless = joint ? uselessness(*joint) : "";
        if (!useless.empty()) warn(item, useless);
    }
}

void SceneWorldBuilder::build()
{
    std::size_t place = 0;
    bool scripted = false;
    scene_.root().walk([&](const Item& item) {
        order_[item.id().value] = place++;
        scripted |= item.is<ScriptItem>();
        if (item.is<BodyItem>()) addBody(item);
    });
    const BodyStates states = world_.bodies();
    for (BodyBinding& binding : bodies) binding.restPosition = states.position[binding.body];
    scene_.root().walk([&](const Item& item) {
        const ItemType* type = itemTypeOf(scene_.catalog(), item.type());
        if (!type) return;
        recording_.parts = {};
        type->build(item, *this);
        if (!scripted) warnOfUseless(item);
        if (!recording_.parts.parts.empty()) parts.emplace(item.id(), std::move(recording_.parts));
    });
}

namespace {

// Steps between two items over their nearest common ancestor.
int treeDistance(const Item& a, const Item& b)
{
    int up = 0;
    for (const Item* from = &a; from; from = from->parent(), ++up) {
        int down = 0;
        for (const Item* to = &b; to; to = to->parent(), ++down)
            if (from == to) return up + down;
    }
    return std::numeric_limits<int>::max();
}

}  // namespace

Anchor SceneWorldBuilder::anchor(const Item& item, const Vec2& point) const
{
    return recording_.parts.anchors.emplace_back(anchorAt(item, point));
}

Anchor SceneWorldBuilder::anchorAt(const Item& item, const Vec2& point) const
{
    const std::size_t here = order_.at(item.id().value);
    Anchor anchor{kNoHandle, point};
    int best = std::numeric_limits<int>::max();
    std::size_t bestGap = 0;
    for (const BodyBinding& binding : bodies) {
        if (!world_.contains(binding.body, point)) continue;
        const Item& body = *scene_.items().find(binding.item);
        const int distance = treeDistance(item, body);
        const std::size_t there = order_.at(binding.item.value);
        // Among equally near ones the body before the item lies under it; the closest such wins, then what comes after.
        const std::size_t gap = there < here ? here - there : there - here + order_.size();
        if (distance > best || (distance == best && gap >= bestGap)) continue;
        best = distance, bestGap = gap;
        anchor.body = binding.body;
    }
    return anchor;
}

}  // namespace jet
