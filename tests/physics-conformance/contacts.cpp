// Bodies that meet: momentum, restitution, friction, stacks, bullets, filters, platforms, sensors, events, sleep.
#include "lab.hpp"

#include <set>

namespace jet::conformance {

namespace {

/// Two discs head on; answers their velocities afterwards.
std::pair<double, double> collide(const Lab& lab, double restitution, double massA, double massB)
{
    const auto world = lab.world({0, 0}, 0, restitution);
    const BodyHandle a = world->addRigidBody(moving(disc({-30, 0}, 5, massA), {60, 0}));
    const BodyHandle b = world->addRigidBody(moving(disc({30, 0}, 5, massB), {-40, 0}));
    run(*world, 1.5);
    return {velocity(*world, a).x(), velocity(*world, b).x()};
}

Outcome momentum(const Lab& lab)
{
    double worst = 0;
    for (const double e : {0.0, 0.5, 1.0}) {
        const auto [a, b] = collide(lab, e, 2, 3);
        worst = std::max(worst, std::abs(2 * a + 3 * b - (2 * 60 - 3 * 40)) / (2 * 60 + 3 * 40));
    }
    return measured(worst, "of the momentum", 1e-6);
}

Outcome restitutionEnergy(const Lab& lab)
{
    double worst = 0;
    for (const double e : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const auto [a, b] = collide(lab, e, 2, 3);
        worst = std::max(worst, 100 * std::abs((b - a) / 100 - e));
    }
    return measured(worst, "% of the approach", 1, "e = 0 … 1, 100 units/s");
}

Outcome bounce(const Lab& lab)
{
    const auto world = lab.world({0, 100}, 0.5, 0.8);
    world->addRigidBody(ground(0));
    const BodyHandle ball = world->addRigidBody(disc({0, -105}, 5));
    double highest = 0;
    bool down = false;
    for (int i = 0; i < 300 && (!down || velocity(*world, ball).y() < 0); ++i) {
        world->step(kStep);
        if (velocity(*world, ball).y() < 0) down = true, highest = std::min(highest, at(*world, ball).y() + 5);
    }
    return measured(percentOff(-highest, 64), "% of e² h", 4, "dropped 100 units, e = 0.8");
}

/// How far a box slides down a slope in two seconds, gravity turned instead of the ground.
double slide(const Lab& lab, double mu, double angle, bool asDrawn)
{
    const auto world = lab.world(100 * Vec2(std::sin(angle), std::cos(angle)), mu);
    world->addRigidBody(ground(0));
    const BodyHandle body = world->addRigidBody(asDrawn ? drawn({boxRing({0, -5}, 20, 10)}) : box({0, -5}, 20, 10));
    run(*world, 2);
    return at(*world, body).x();
}

Outcome frictionAngle(const Lab& lab)
{
    double worst = 0;
    for (const bool asDrawn : {false, true})
        for (const double mu : {0.2, 0.6}) {
            double low = 0.8 * std::atan(mu), high = 1.2 * std::atan(mu);
            for (int i = 0; i < 7; ++i) {
                const double middle = 0.5 * (low + high);
                (slide(lab, mu, middle, asDrawn) > 0.5 ? high : low) = middle;
            }
            worst = std::max(worst, percentOff(0.5 * (low + high), std::atan(mu)));
        }
    return measured(worst, "% of atan μ", 2, "the slope where a box begins to slide, μ = 0.2 and 0.6");
}

Outcome slidingAcceleration(const Lab& lab)
{
    const double angle = 0.6, mu = 0.3, a = 100 * (std::sin(angle) - mu * std::cos(angle));
    return measured(percentOff(slide(lab, mu, angle, false), 0.5 * a * 4), "% of ½ g (sin α - μ cos α) t²", 3);
}

Outcome stack(const Lab& lab)
{
    const auto world = lab.world({0, 98.1});
    world->addRigidBody(ground(0));
    std::vector<BodyHandle> boxes;
    for (int i = 0; i < 10; ++i) boxes.push_back(world->addRigidBody(box({0, -10.0 - 20 * i}, 20, 20)));
    run(*world, 10);
    double worst = 0;
    for (int i = 0; i < 10; ++i)
        worst = std::max(worst, (at(*world, boxes[static_cast<std::size_t>(i)]) - Vec2(0, -10.0 - 20 * i)).norm());
    return measured(worst, "units", 4, "ten boxes of 20 units, 10 s");
}

Outcome drawnStack(const Lab& lab)
{
    const auto world = lab.world({0, 98.1});
    world->addRigidBody(fixed(drawn({boxRing({0, 50}, 4000, 100)})));
    std::vector<BodyHandle> boxes;
    for (int i = 0; i < 5; ++i) boxes.push_back(world->addRigidBody(drawn({boxRing({0, -10.0 - 20 * i}, 20, 20)})));
    run(*world, 5);
    double worst = 0;
    for (int i = 0; i < 5; ++i)
        worst = std::max(worst, (at(*world, boxes[static_cast<std::size_t>(i)]) - Vec2(0, -10.0 - 20 * i)).norm());
    return measured(worst, "units", 2, "five boxes of 20 units as drawings make them, 5 s");
}

Outcome concave(const Lab& lab)
{
    // A U as a cup, with a ball in it.
    const std::vector<Vec2> cup{{-30, -40}, {-20, -40}, {-20, 0}, {20, 0}, {20, -40}, {30, -40}, {30, 10}, {-30, 10}};
    const auto world = lab.world({0, 100});
    world->addRigidBody(ground(10.0));
    const BodyHandle body = world->addRigidBody(drawn({cup}, 2)), ball = world->addRigidBody(disc({0, -60}, 8));
    run(*world, 4);
    const Vec2 in = at(*world, ball) - at(*world, body);
    const double depth = at(*world, ball).y() + 8;
    return measured(std::abs(in.x()) < 13 ? std::abs(depth) : 1e3, "units", 0.5, "a ball rests in a drawn cup");
}

Outcome bullets(const Lab& lab, bool fixedWall)
{
    int passed = 0;
    for (int i = 0; i < 60; ++i) {
        const auto world = lab.world({0, 0}, 0.5, 0.2);
        RigidBodyDef wall = box({0, 0}, 1, 200, 100);
        const BodyHandle plate = world->addRigidBody(fixedWall ? fixed(wall) : moving(wall, {-50, 0}));
        const BodyHandle ball = world->addRigidBody(moving(disc({-90 - 2.3 * i, 0.4 * i}, 0.5), {20000, 0}));
        run(*world, 0.5);
        passed += at(*world, ball).x() > at(*world, plate).x() + 0.25;
    }
    return measured(passed, "of 60", 0,
                    fixedWall ? "1-unit ball, 20,000 units/s, 1-unit wall" : "the plate moves, too");
}

Outcome filters(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    RigidBodyDef floor = ground(20);
    floor.common.layer = 2;
    world->addRigidBody(floor);
    RigidBodyDef ghost = disc({0, 0}, 5), grouped = disc({100, 0}, 5), on1 = disc({200, 0}, 5);
    ghost.common.mask = ~2U;
    grouped.common.group = 7;
    const BodyHandle a = world->addRigidBody(ghost), b = world->addRigidBody(grouped), c = world->addRigidBody(on1);
    RigidBodyDef shelf = fixed(box({100, 12}, 20, 4));
    shelf.common.group = 7;
    world->addRigidBody(shelf);
    run(*world, 2);
    return holds(at(*world, a).y() > 100 && std::abs(at(*world, b).y() - 15) < 0.5 &&
                     std::abs(at(*world, c).y() - 15) < 0.5,
                 "layers, masks or groups are not heeded");
}

Outcome materials(const Lab& lab)
{
    WorldSettings settings;
    settings.gravity = {0, 100};
    settings.materialCount = 2;
    settings.materials = {{0.6, 0, true}, {0.6, 0, false}, {0.6, 0, false}, {0.6, 0, true}};
    const auto world = lab.world(settings);
    world->addRigidBody(ground(20));
    RigidBodyDef other = disc({0, 0}, 5);
    other.common.material = 1;
    const BodyHandle passes = world->addRigidBody(other), stays = world->addRigidBody(disc({50, 0}, 5));
    run(*world, 2);
    return holds(at(*world, passes).y() > 100 && std::abs(at(*world, stays).y() - 15) < 0.5,
                 "the table of materials is not heeded");
}

Outcome sensors(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    RigidBodyDef gate = fixed(box({0, 100}, 100, 20));
    gate.common.sensor = true;
    const BodyHandle sensor = world->addRigidBody(gate), ball = world->addRigidBody(disc({0, 0}, 5));
    int touched = 0, begun = 0, ended = 0;
    for (int i = 0; i < 120; ++i) {
        world->step(kStep);
        touched += world->touching(ball, sensor);
        for (const ContactEvent& event : world->contactEvents()) (event.begins ? begun : ended) += 1;
    }
    const double fall = percentOff(at(*world, ball).y(), 200);
    if (touched == 0) return holds(false, "a sensor does not report");
    if (begun != 1 || ended != 1)
        return holds(false, "a pass gave " + std::to_string(begun) + " begins and " + std::to_string(ended) + " ends");
    return measured(fall, "% of the fall", 1.7);
}

Outcome oneSided(const Lab& lab)
{
    const auto world = lab.world({0, 100}, 0.6, 0);
    RigidBodyDef platform = fixed(box({0, 0}, 100, 4));
    platform.common.oneSided = {0, -1};
    world->addRigidBody(platform);
    const BodyHandle above = world->addRigidBody(box({-20, -40}, 10, 10));
    const BodyHandle below = world->addRigidBody(moving(box({20, 30}, 10, 10), {0, -120}));
    run(*world, 4);
    return measured(std::max(std::abs(at(*world, above).y() + 7), std::abs(at(*world, below).y() + 7)), "units", 0.5,
                    "one lands, one jumps up through it and lands");
}

/// Balls that bounce, rigid ones, or soft and rigid ones by turns, three of them onto each other.
Outcome events(const Lab& lab, bool soft)
{
    const auto world = lab.world({0, 100}, 0.6, 0.5);
    world->addRigidBody(ground(0));
    for (int i = 0; i < 5; ++i) {
        const Vec2 place(i < 3 ? 30.0 * i : 2.0, -20.0 - 15 * i);
        if (soft && i % 2 == 0)
            world->addSoftBody(softBall(place, 5, 400, 0.1, 16, 2));
        else
            world->addRigidBody(disc(place, 5));
    }
    std::set<std::pair<BodyHandle, BodyHandle>> together;
    int begun = 0;
    for (int i = 0; i < 300; ++i) {
        world->step(kStep);
        std::pair<BodyHandle, BodyHandle> last{0, 0};
        for (const ContactEvent& event : world->contactEvents()) {
            const std::pair pair{event.bodyA, event.bodyB};
            if (event.bodyA >= event.bodyB || pair < last) return holds(false, "events are not in ascending order");
            if (event.begins == together.contains(pair))
                return holds(false, "a touch began twice, or ended before it began");
            event.begins ? void(together.insert(pair)) : void(together.erase(pair));
            begun += event.begins;
            last = pair;
        }
    }
    if (begun < 10) return holds(false, "bouncing balls began only " + std::to_string(begun) + " touches");
    for (BodyHandle ball = 1; ball <= 5; ++ball)
        if (world->touching(0, ball) != together.contains({0, ball}))
            return holds(false, "events and touching() disagree");
    return holds(true, {});
}

Outcome contactRecords(const Lab& lab)
{
    WorldSettings settings;
    settings.gravity = {0, 100};
    settings.allowSleep = false;  // what sleeps is not pushed
    const auto world = lab.world(settings);
    const BodyHandle floor = world->addRigidBody(ground(0)), body = world->addRigidBody(box({0, -10}, 20, 20, 3));
    run(*world, 3);
    double impulse = 0;
    for (const Contact& c : world->contacts()) {
        const bool bodyIsA = c.bodyA == body && c.bodyB == floor, floorIsA = c.bodyA == floor && c.bodyB == body;
        if (!bodyIsA && !floorIsA) return holds(false, "a contact names other bodies");
        if ((c.normal - Vec2(0, bodyIsA ? -1 : 1)).norm() > 1e-3) return holds(false, "a normal does not point to A");
        if (std::abs(c.point.y()) > 0.5 || std::abs(std::abs(c.point.x()) - 10) > 0.5)
            return holds(false, "a contact is not at a corner");
        impulse += c.impulse;
    }
    return measured(percentOff(impulse, 300 * kStep), "% of m g dt", 2, "impulses of a box at rest");
}

Outcome hitImpulses(const Lab& lab)
{
    // m (v - v before - g dt) is what the contacts gave, in the steps of hits, too.
    const auto world = lab.world({0, 100}, 0, 0.7);
    world->addRigidBody(ground(0));
    const BodyHandle ball = world->addRigidBody(disc({0, -60}, 10, 2));
    double worst = 0, hits = 0;
    for (int i = 0; i < 240; ++i) {
        const double before = world->bodies().velocity[ball].y();
        world->step(kStep);
        const double change = 2 * (world->bodies().velocity[ball].y() - before - 100 * kStep);
        if (change > -20) continue;
        double given = 0;
        for (const Contact& c : world->contacts()) given += c.impulse * c.normal.y() * (c.bodyA == ball ? 1 : -1);
        worst = std::max(worst, percentOff(given, change));
        ++hits;
    }
    if (hits < 3) return holds(false, "a ball does not bounce");
    return measured(worst, "%", 2, "impulses of a ball's hits against its change of momentum");
}

Outcome ghosts(const Lab& lab)
{
    const auto world = lab.world({0, 100}, 0);
    RigidBodyDef floor;
    ShapeDef chain{ShapeDef::Kind::Chain, {}, 0};
    for (int i = 0; i <= 200; ++i) chain.points.push_back({5.0 * i, 0});
    floor.shapes = {chain};
    floor.common.fixed = true;
    world->addRigidBody(floor);
    const BodyHandle sled = world->addRigidBody(moving(box({30, -5}, 20, 10), {100, 0}));
    double hop = 0;
    for (int i = 0; i < 480; ++i) world->step(kStep), hop = std::max(hop, std::abs(velocity(*world, sled).y()));
    return measured(percentOff(at(*world, sled).x(), 830) + hop, "% and units/s", 2,
                    "a chain of 200 edges, no friction");
}

Outcome sleeping(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    world->addRigidBody(ground(0));
    const BodyHandle body = world->addRigidBody(box({0, -10}, 20, 20));
    double slept = -1;
    for (int i = 0; i < 600 && slept < 0; ++i) {
        world->step(kStep);
        if (!world->awake(body)) slept = i * kStep;
    }
    if (slept < 0) return {Outcome::Verdict::Missing, 0, 0, {}, "nothing falls asleep in 10 s"};
    world->applyImpulse(body, {50, 0});
    run(*world, 0.1);
    if (!(at(*world, body).x() > 0.5)) return holds(false, "an impulse does not wake it");
    return measured(slept, "s until it sleeps", 5);
}

/// Two soft balls: they rest, are left out, stay to the bit, and wake when they are hit.
Outcome softSleeping(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    world->addRigidBody(ground(0));
    const BodyHandle first = world->addSoftBody(softBall({0, -11}, 10, 400, 10, 16, 2));
    const BodyHandle second = world->addSoftBody(softBall({60, -11}, 10, 400, 10, 16, 2));
    double slept = -1;
    for (int i = 0; i < 1800 && slept < 0; ++i) {
        world->step(kStep);
        if (!world->awake(first) && !world->awake(second)) slept = i * kStep;
    }
    if (slept < 0) return {Outcome::Verdict::Missing, 0, 0, {}, "no soft body falls asleep in 30 s"};
    const Vec2 place = at(*world, first);
    run(*world, 5);
    if (at(*world, first) != place) return holds(false, "it moves while it sleeps");
    world->applyImpulse(second, {-100, -20});
    bool woken = false;
    for (int i = 0; i < 300 && !woken; ++i) world->step(kStep), woken = world->awake(first);
    if (!woken) return holds(false, "what is hit does not wake");
    return measured(slept, "s until they sleep", 20);
}

Outcome overlap(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    world->addRigidBody(ground(0));
    const BodyHandle a = world->addRigidBody(box({0, -10}, 20, 20)), b = world->addRigidBody(box({2, -22}, 20, 20));
    double fastest = 0;
    for (int i = 0; i < 300; ++i)
        world->step(kStep),
            fastest = std::max(fastest, std::max(velocity(*world, a).norm(), velocity(*world, b).norm()));
    return measured(fastest, "units/s", 120, "two boxes 8 units into each other part without a pop");
}

}  // namespace

std::vector<Check> contactChecks()
{
    return {{"contacts", "momentum", momentum},
            {"contacts", "restitution", restitutionEnergy},
            {"contacts", "height of a bounce", bounce},
            {"contacts", "friction angle", frictionAngle},
            {"contacts", "sliding acceleration", slidingAcceleration},
            {"contacts", "stack of ten", stack},
            {"contacts", "stack of drawn boxes", drawnStack},
            {"contacts", "concave outlines", concave},
            {"contacts", "bullets, fixed wall", [](const Lab& lab) { return bullets(lab, true); }},
            {"contacts", "bullets, moving plate", [](const Lab& lab) { return bullets(lab, false); }},
            {"contacts", "overlaps part calmly", overlap},
            {"contacts", "chains without ghost hits", ghosts},
            {"contacts", "layers, masks, groups", filters},
            {"contacts", "table of materials", materials},
            {"contacts", "sensors", sensors},
            {"contacts", "one-sided platforms", oneSided},
            {"contacts", "order of contact events", [](const Lab& lab) { return events(lab, false); }},
            {"contacts", "order of contact events, soft bodies", [](const Lab& lab) { return events(lab, true); }},
            {"contacts", "contact records", contactRecords},
            {"contacts", "impulses of hits", hitImpulses},
            {"contacts", "sleeping and waking", sleeping},
            {"contacts", "soft bodies sleep", softSleeping}};
}

}  // namespace jet::conformance
