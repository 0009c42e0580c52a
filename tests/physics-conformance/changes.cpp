// What changes while bodies touch: masses, friction, places; bodies that go; and what events tell of all that.
#include "lab.hpp"

#include <set>

namespace jet::conformance {

namespace {

/// Keeps account of events, and tells what does not fit together.
class Touches {
public:
    explicit Touches(PhysicsWorld& world) : world_(world) {}

    void step()
    {
        world_.step(kStep);
        for (const ContactEvent& event : world_.contactEvents()) {
            const std::pair pair{event.bodyA, event.bodyB};
            wrong += event.begins == together_.contains(pair);
            event.begins ? void(together_.insert(pair)) : void(together_.erase(pair));
            begun += event.begins;
        }
        for (BodyHandle a = 0; a < world_.bodyCount(); ++a)
            for (BodyHandle b = a + 1; b < world_.bodyCount(); ++b)
                wrong += world_.touching(a, b) != together_.contains({a, b});
    }
    void run(double seconds)
    {
        for (int i = 0; i < static_cast<int>(std::lround(seconds / kStep)); ++i) step();
    }
    bool any(BodyHandle body) const
    {
        return std::any_of(together_.begin(), together_.end(),
                           [=](const auto& pair) { return pair.first == body || pair.second == body; });
    }
    bool touch(BodyHandle a, BodyHandle b) const { return together_.contains(std::minmax(a, b)); }

    int wrong = 0, begun = 0;

private:
    PhysicsWorld& world_;
    std::set<std::pair<BodyHandle, BodyHandle>> together_;
};

Outcome pairsOfEvents(const Lab& lab)
{
    const auto world = lab.world({0, 100}, 0.4, 0.3);
    world->addRigidBody(ground(0, 300));
    world->addRigidBody(fixed(box({-150, -100}, 20, 400))), world->addRigidBody(fixed(box({150, -100}, 20, 400)));
    Numbers number;
    for (int i = 0; i < 40; ++i) {
        const Vec2 place(number(-120, 120), number(-250, -20));
        RigidBodyDef def = i % 2 == 0 ? disc(place, number(4, 9)) : box(place, number(8, 18), number(8, 18));
        if (i % 4 == 0) def.common.layer = 2, def.common.mask = ~2U;  // do not meet each other
        if (i % 10 == 1) def.common.sensor = true, def.common.gravityScale = 0;
        world->addRigidBody(def);
    }
    Touches touches(*world);
    int filtered = 0;
    for (int i = 0; i < 400; ++i) {
        touches.step();
        for (BodyHandle a = 3; a < 43; a += 4)
            for (BodyHandle b = a + 4; b < 43; b += 4) filtered += touches.touch(a, b);
    }
    if (touches.begun < 60) return holds(false, "only " + std::to_string(touches.begun) + " touches began");
    return measured(touches.wrong + filtered, "contradictions", 0,
                    "begins without an end, ends without a begin, touches of pairs that do not meet");
}

Outcome teleport(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle floor = world->addRigidBody(ground(0, 200)),
                     shelf = world->addRigidBody(fixed(box({500, 5}, 100, 10)));
    const BodyHandle under = world->addRigidBody(box({0, -10}, 20, 20)),
                     top = world->addRigidBody(box({0, -30}, 20, 20));
    Touches touches(*world);
    touches.run(1.5);
    if (!touches.touch(floor, under) || !touches.touch(under, top))
        return holds(false, "a stack of two does not touch");
    world->setPosition(under, {500, -10});
    touches.step();
    if (touches.touch(floor, under) || touches.touch(under, top))
        return holds(false, "what was moved away touches still");
    touches.run(0.1);
    if (!touches.touch(shelf, under)) return holds(false, "where it came to it touches nothing");
    const double kick = velocity(*world, under).norm();
    touches.run(1.5);
    if (touches.wrong > 0) return holds(false, "events do not fit what touches");
    return measured(std::max(std::abs(at(*world, top).y() + 10), std::max(kick, velocity(*world, under).norm())),
                    "units, units/s", 0.5, "what lay on it falls, and nothing kicks it");
}

Outcome removal(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    world->addRigidBody(ground(0));
    const BodyHandle under = world->addRigidBody(box({0, -10}, 20, 20)),
                     top = world->addRigidBody(box({0, -30}, 20, 20));
    Touches touches(*world);
    touches.run(2);  // long enough to fall asleep
    world->setEnabled(under, false);
    touches.step();
    if (touches.any(under)) return holds(false, "what was switched off touches still");
    for (const Contact& c : world->contacts())
        if (c.bodyA == under || c.bodyB == under) return holds(false, "what was switched off has contacts");
    touches.run(0.3);
    const double fallen = at(*world, top).y() + 30;
    if (std::abs(fallen - 50 * 0.1) > 1) return holds(false, "what lay on it does not fall freely");
    touches.run(1.5);
    if (std::abs(at(*world, top).y() + 10) > 0.5) return holds(false, "what lay on it does not come to the ground");
    world->setPosition(under, {200, -10});
    world->setEnabled(under, true);
    touches.run(0.5);
    return holds(touches.wrong == 0 && touches.touch(0, under), "switched on again it does not touch the ground");
}

Outcome mass(const Lab& lab)
{
    WorldSettings settings;
    settings.gravity = {0, 100};
    settings.allowSleep = false;  // what sleeps is not pushed
    const auto world = lab.world(settings);
    world->addRigidBody(ground(0));
    const BodyHandle under = world->addRigidBody(box({0, -10}, 20, 20)),
                     top = world->addRigidBody(box({0, -30}, 20, 20));
    run(*world, 1.5);
    double worst = 0;
    for (const double heavier : {5.0, 0.5, 1.0}) {
        world->setMass(top, heavier);
        run(*world, 1.5);
        double onGround = 0, between = 0;
        for (const Contact& c : world->contacts()) {
            const bool ofTop = c.bodyA == top || c.bodyB == top;
            (ofTop ? between : onGround) += c.impulse;
        }
        worst = std::max(
            {worst, percentOff(onGround, (1 + heavier) * 100 * kStep), percentOff(between, heavier * 100 * kStep)});
    }
    return measured(std::max(worst, 10 * std::abs(at(*world, under).y() + 10)), "% of m g dt", 3,
                    "a box on a box that becomes heavier, lighter");
}

Outcome friction(const Lab& lab)
{
    WorldSettings settings;
    settings.gravity = {0, 100};
    settings.materials = {MaterialPair{0.9, 0, true}};
    const auto world = lab.world(settings);
    const double angle = 0.5;
    world->addRigidBody(fixed(box({0, 0}, 4000, 20, 1, angle)));
    const Vec2 along(std::cos(angle), std::sin(angle)), out(std::sin(angle), -std::cos(angle));
    const BodyHandle body = world->addRigidBody(box(20 * out, 20, 20, 1, angle));
    run(*world, 2);
    const double crept = std::abs(at(*world, body).dot(along));
    if (crept > 0.5) return holds(false, "it slides with friction 0.9 on a slope of 0.5");
    settings.materials = {MaterialPair{0.2, 0, true}};
    world->setSettings(settings);
    run(*world, 1);
    const double speed = velocity(*world, body).dot(along), should = 100 * (std::sin(angle) - 0.2 * std::cos(angle));
    settings.materials = {MaterialPair{0.9, 0, true}};
    world->setSettings(settings);
    run(*world, 1.5);
    const double left = velocity(*world, body).norm();
    if (left > 0.1) return holds(false, "with friction again it does not come to rest");
    return measured(percentOff(speed, should), "% of g (sin α - μ cos α) t", 3, "0.9, then 0.2, then 0.9 under a box");
}

Outcome filterUnderIt(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    world->addRigidBody(ground(60));
    const BodyHandle shelf = world->addRigidBody(fixed(box({0, 10}, 100, 20)));
    const BodyHandle body = world->addRigidBody(box({0, -10}, 20, 20));
    Touches touches(*world);
    touches.run(2);
    if (!touches.touch(shelf, body)) return holds(false, "a box on a shelf does not touch it");
    BodyCommon common;
    common.mask = 1, common.layer = 4;
    BodyCommon ofShelf;
    ofShelf.fixed = true, ofShelf.mask = 1;
    world->setBody(shelf, ofShelf);
    world->setBody(body, common);
    touches.step();
    if (touches.touch(shelf, body)) return holds(false, "a pair whose layers do not meet any more touches still");
    touches.run(0.5);
    return holds(touches.wrong == 0 && at(*world, body).y() > 0, "it does not fall through what it does not meet");
}

}  // namespace

std::vector<Check> changeChecks()
{
    return {{"changes and events", "begins and ends are pairs", pairsOfEvents},
            {"changes and events", "moved while it touches", teleport},
            {"changes and events", "switched off while it touches", removal},
            {"changes and events", "mass while it touches", mass},
            {"changes and events", "friction while it touches", friction},
            {"changes and events", "layers while it touches", filterUnderIt}};
}

}  // namespace jet::conformance
