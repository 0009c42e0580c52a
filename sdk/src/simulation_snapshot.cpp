// Saving and restoring a simulation, and the picture of its world.
#include "hasher.hpp"
#include "simulation_state.hpp"

#include <jet/physics_removal.hpp>
#include <jet/physics_view.hpp>

#include <cstring>
#include <map>

namespace jet {

namespace {

struct Head {
    std::uint64_t seal = 0;  // of what follows, up to the world's state, which has one of its own
    std::uint64_t steps = 0, random = 0, printed = 0, torques = 0;
    double anchorX = 0, anchorY = 0, scale = 1;
    std::uint64_t held = 0, joint = 0;  // item; 0: none
    double handX = 0, handY = 0;
};
struct SavedTorque {
    std::uint64_t item = 0;
    double value = 0;
};

std::uint64_t sealOf(const Head& head, const std::map<ItemId, double>& torques)
{
    Hasher h;
    for (const std::uint64_t word : {head.steps, head.random, head.printed, head.torques, head.held, head.joint})
        h.add(word);
    for (const double number : {head.anchorX, head.anchorY, head.scale, head.handX, head.handY}) h.add(number);
    for (const auto& [item, value] : torques) h.add(item.value), h.add(value);
    return h.value();
}

[[noreturn]] void failDamaged()
{
    throw Failure(Error("the saved state of the simulation is damaged: its bytes are not as they were saved"));
}

template <class T>
void put(std::vector<std::byte>& out, const T& value)
{
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    out.insert(out.end(), bytes, bytes + sizeof value);
}

template <class T>
T take(std::span<const std::byte>& from)
{
    if (from.size() < sizeof(T)) failDamaged();
    T value;
    std::memcpy(&value, from.data(), sizeof value);
    from = from.subspan(sizeof value);
    return value;
}

}  // namespace

std::vector<std::byte> Simulation::save() const
{
    std::vector<std::byte> out;
    const View& view = d_->view.view;
    const Hand hand = d_->hand.value_or(Hand{});
    Head head{
        0,          d_->steps,       d_->random, d_->printed,    d_->torques.size(), view.anchor.x(), view.anchor.y(),
        view.scale, hand.item.value, hand.joint, hand.place.x(), hand.place.y()};
    head.seal = sealOf(head, d_->torques);
    put(out, head);
    for (const auto& [item, value] : d_->torques) put(out, SavedTorque{item.value, value});
    const std::vector<std::byte> world = d_->world->save();
    out.insert(out.end(), world.begin(), world.end());
    return out;
}

void Simulation::restore(std::span<const std::byte> state)
{
    const auto head = take<Head>(state);
    if (head.torques > state.size() / sizeof(SavedTorque)) failDamaged();
    std::map<ItemId, double> torques;
    for (std::uint64_t i = 0; i < head.torques; ++i) {
        const auto saved = take<SavedTorque>(state);
        torques[ItemId{saved.item}] = saved.value;
    }
    if (sealOf(head, torques) != head.seal) failDamaged();
    d_->world->restore(state);  // refuses what does not fit, and changes nothing then
    d_->torques = std::move(torques);
    d_->steps = head.steps, d_->random = head.random, d_->printed = head.printed;
    d_->view.view.anchor = Vec2(head.anchorX, head.anchorY);
    d_->view.view.scale = head.scale;
    d_->hand.reset();
    if (head.held != 0)
        d_->hand = Hand{{head.held}, static_cast<JointHandle>(head.joint), Vec2(head.handX, head.handY)};
    // What was worked out for this step belongs to another past.
    d_->eventsFollow = false;
    std::fill(d_->posedAt.begin(), d_->posedAt.end(), 0);
    for (BodyBinding& binding : d_->bodies) binding.liveAt = 0;
}

bool Simulation::hasScripts() const { return d_->scripts != nullptr; }

void Simulation::stepPhysics()
{
    d_->world->step(d_->timeStep);
    ++d_->steps;
}

namespace {

/// Engines that cannot tell the tension of a spring have it from its length.
class Stress {
public:
    explicit Stress(const PhysicsWorld& world) : world_(world) {}

    double of(const LiveBody& live, BodyHandle body, std::uint32_t index)
    {
        const LiveSpring& spring = live.springs[index];
        if (told_ && spring.stiffness > 0 && spring.restLength > 0) {
            try {
                const double stress = world_.springTension(body, index) / spring.stiffness / spring.restLength;
                if (std::isfinite(stress)) return stress;  // not where stiffness is next to nothing
            } catch (const Failure&) {
                told_ = false;
            }
        }
        return live.strain(spring);
    }

private:
    const PhysicsWorld& world_;
    bool told_ = true;
};

/// A joint may have been removed: by a script, by a hand that let go.
bool exists(const PhysicsWorld& world, JointHandle joint)
{
    try {
        return removal(world).hasJoint(joint);
    } catch (const Failure&) {  // nothing of it is removed by an engine that cannot tell
        return true;
    }
}

}  // namespace

PhysicsPicture Simulation::physicsPicture() const
{
    const PhysicsWorld& world = *d_->world;
    PhysicsPicture picture;
    const BodyStates states = world.bodies();
    picture.points.assign(states.points.begin(), states.points.end());
    picture.bodies.resize(world.bodyCount());
    for (BodyHandle body = 0; body < picture.bodies.size(); ++body) {
        PhysicsPicture::Body& shown = picture.bodies[body];
        shown.bounds = states.bounds[body], shown.centre = states.position[body], shown.angle = states.angle[body];
        shown.firstPoint = states.firstPoint[body];
        shown.pointCount = states.firstPoint[body + 1] - states.firstPoint[body];
    }
    for (BodyHandle body = 0; body < picture.bodies.size(); ++body)
        picture.bodies[body].awake = world.awake(body), picture.bodies[body].island = world.island(body);
    Stress stress(world);
    for (BodyBinding& binding : d_->bodies) {
        PhysicsPicture::Body& shown = picture.bodies[binding.body];
        shown.item = binding.item, shown.soft = binding.soft, shown.moves = !binding.fixed;
        if (!binding.live) continue;
        d_->refresh(binding);
        const LiveBody& live = *binding.live;
        for (std::uint32_t i = 0; i < live.springs.size(); ++i) {
            const LiveSpring& spring = live.springs[i];
            if (!spring.whole) continue;
            picture.springs.push_back(
                {live.particles[spring.a], live.particles[spring.b], stress.of(live, binding.body, i)});
        }
    }
    const auto contacts = world.contacts();
    picture.contacts.assign(contacts.begin(), contacts.end());
    for (JointHandle joint = 0; joint < world.jointCount(); ++joint)
        if (exists(world, joint)) picture.joints.push_back(world.joint(joint));
    picture.stats = world.stats();
    return picture;
}

}  // namespace jet
