// Soft bodies: springs and their damping, tearing, area, gas, plasticity, pins, fields of force.
#include "lab.hpp"

namespace jet::conformance {

namespace {

/// Two particles and a spring between them.
SoftBodyDef dumbbell(const Vec2& a, const Vec2& b, double ks, double kd, double massA = 1, double massB = 1)
{
    SoftBodyDef def;
    def.particles = {a, b};
    def.masses = {massA, massB};
    def.springs = {{0, 1, (b - a).norm(), ks, kd, 0}};
    return def;
}

double area(std::span<const Vec2> p, std::span<const std::uint32_t> ring)
{
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) sum += 0.5 * cross(p[ring[i]], p[ring[(i + 1) % ring.size()]]);
    return sum;
}
double areaRatio(const PhysicsWorld& world, BodyHandle body, const SoftBodyDef& def)
{
    return area(points(world, body), def.borders[0]) / area(def.particles, def.borders[0]);
}

Outcome springPeriod(const Lab& lab)
{
    // Reduced mass 1/2. At 60 Hz an oscillation of 1 s and more can be followed at all.
    double worst = 0;
    for (const double ks : {1.0, 4.0, 16.0}) {
        const auto world = lab.world({0, 0});
        SoftBodyDef def = dumbbell({0, 0}, {20, 0}, ks, 0);
        def.springs[0].restLength = 18;
        const BodyHandle body = world->addSoftBody(def);
        const double should = 2 * kPi * std::sqrt(0.5 / ks);
        Period period;
        for (int i = 1; i * kStep < 8 * should; ++i) {
            world->step(kStep);
            const auto p = points(*world, body);
            period.add((p[1] - p[0]).norm() - 18, i * kStep);
        }
        worst = std::max(worst, percentOff(period.seconds(), should));
    }
    return measured(worst, "% of 2 π √(m / ks)", 1, "ks 1 … 16");
}

Outcome springDamping(const Lab& lab)
{
    // x(t) = exp(-d t): d = kd / (2 m), m = 1/2.
    const auto world = lab.world({0, 0});
    SoftBodyDef def = dumbbell({0, 0}, {20, 0}, 20, 0.5);
    def.springs[0].restLength = 18;
    const BodyHandle body = world->addSoftBody(def);
    std::vector<std::pair<double, double>> peaks;
    double before = 0, last = 0;
    for (int i = 1; i < 300; ++i) {
        world->step(kStep);
        const auto p = points(*world, body);
        const double x = (p[1] - p[0]).norm() - 18;
        if (i > 2 && last > before && last > x && last > 1e-3) peaks.emplace_back((i - 1) * kStep, last);
        before = last, last = x;
    }
    if (peaks.size() < 3) return holds(false, "it does not swing");
    const double rate =
        std::log(peaks.front().second / peaks.back().second) / (peaks.back().first - peaks.front().first);
    return measured(percentOff(rate, 0.5), "% of kd / 2 m", 3);
}

Outcome stiffness(const Lab& lab)
{
    double worst = 0;
    for (double ks = 1e-3; ks < 2e9; ks *= 100)
        for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 1000}) {
            const auto world = lab.world({0, 0});
            SoftBodyDef def = dumbbell({0, 0}, {20, 0}, ks, 0, 0.01, 100);
            def.springs[0].restLength = 18;
            const BodyHandle body = world->addSoftBody(def);
            for (int i = 0; i < 200; ++i) {
                world->step(dt);
                const auto p = points(*world, body);
                worst = std::max(worst, std::abs((p[1] - p[0]).norm() - 18) / 2);
                if (!isFinite(p[0])) return holds(false, "not a number at ks " + std::to_string(ks));
            }
        }
    return measured(worst, "of the first stretch", 1.05, "ks 10⁻³ … 10⁹, masses 1 : 10,000, 30 … 1000 Hz");
}

Outcome tearing(const Lab& lab)
{
    const auto pull = [&](double ratio) {
        const auto world = lab.world({0, 0});
        SoftBodyDef def = dumbbell({0, 0}, {20, 0}, 100, 20);
        def.springs[0].tearRatio = ratio;
        def.movable = {0, 1};
        const BodyHandle body = world->addSoftBody(def);
        world->addForce({on(body, {20, 0}), {500, 0}});  // stretches to 25 at rest
        run(*world, 5);
        return world->springAlive(body, 0);
    };
    double low = 1, high = 2;
    for (int i = 0; i < 12; ++i) {
        const double middle = 0.5 * (low + high);
        (pull(middle) ? high : low) = middle;
    }
    return measured(percentOff(0.5 * (low + high), 1.25), "% of kt", 2, "pulled slowly to 1.25 of its length");
}

Outcome pieces(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    SoftBodyDef def = dumbbell({0, 0}, {20, 0}, 100, 5);
    def.springs[0].tearRatio = 1.1;
    const BodyHandle body = world->addSoftBody(def);
    world->addForce({on(body, {0, 0}), {-900, 0}});
    world->addForce({on(body, {20, 0}), {900, 0}});
    run(*world, 1);
    const auto of = world->pieces(body);
    if (of.empty()) return {Outcome::Verdict::Missing, 0, 0, {}, "a torn body is told as one"};
    return holds(of.size() == 2 && of[0] != of[1], "the halves are told as one piece");
}

Outcome momentum(const Lab& lab)
{
    const auto world = lab.world({0, 0}, 0.5, 0.3);
    std::vector<BodyHandle> bodies{world->addSoftBody(softBall({-40, 0}, 20)),
                                   world->addSoftBody(softBall({40, 5}, 20))};
    world->setVelocity(bodies[0], {80, 0});
    run(*world, 2);
    const Vec2 sum = velocity(*world, bodies[0]) + velocity(*world, bodies[1]);
    if (velocity(*world, bodies[1]).x() < 5) return holds(false, "two soft balls pass each other");
    return measured((sum - Vec2(80, 0)).norm() / 80, "of the momentum", 1e-9);
}

Outcome angular(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    SoftBodyDef def;
    def.particles = {{20, 0}, {0, 0}, {0, 20}};
    def.masses = {1, 2, 3};
    def.springs = {{0, 1, 20, 500, 1, 0}, {1, 2, 20, 500, 1, 0}};
    def.angularSprings = {{0, 1, 2, kPi / 3, 5000, 2000}};  // near critical
    const BodyHandle body = world->addSoftBody(def);
    run(*world, 10);
    const auto p = points(*world, body);
    const Vec2 a = p[0] - p[1], b = p[2] - p[1];
    const double off = std::abs(std::atan2(cross(a, b), a.dot(b)) - kPi / 3);
    const double drift = velocity(*world, body).norm() + std::abs(omega(*world, body));
    return measured(std::max(off, drift), "rad; units/s of drift", 1e-3);
}

Outcome ballRests(const Lab& lab)
{
    const auto world = lab.world({0, 98.1});
    world->addRigidBody(ground(0));
    const SoftBodyDef def = softBall({0, -40}, 20);
    const BodyHandle body = world->addSoftBody(def);
    run(*world, 8);
    double lowest = -1e9;
    for (const Vec2& p : points(*world, body)) lowest = std::max(lowest, p.y());
    if (areaRatio(*world, body, def) < 0.5) return holds(false, "it collapses");
    return measured(std::abs(lowest), "units", 0.5, "a soft ball on the ground");
}

Outcome softOnSoft(const Lab& lab)
{
    const auto world = lab.world({0, 98.1});
    world->addRigidBody(
        fixed(drawn({{{-34, -160}, {-24, -160}, {-24, 0}, {24, 0}, {24, -160}, {34, -160}, {34, 10}, {-34, 10}}})));
    const SoftBodyDef low = softBall({0, -22}, 20), high = softBall({3, -65}, 20);
    const BodyHandle a = world->addSoftBody(low), b = world->addSoftBody(high);
    const BodyHandle lid = world->addRigidBody(box({0, -100}, 44, 6, 0.3));
    run(*world, 6);
    const bool order = at(*world, a).y() > at(*world, b).y() + 15 && at(*world, b).y() > at(*world, lid).y() + 10;
    return holds(order && areaRatio(*world, a, low) > 0.4 && areaRatio(*world, b, high) > 0.4,
                 "two soft balls and a rigid lid in a pit do not lie on each other");
}

Outcome composite(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const SoftBodyDef def = softBall({0, 0}, 20, 100, 0.5);
    const BodyHandle body = world->addSoftBody(def);
    for (int i = 0; i < 30; ++i) {
        world->applyForce(body, {0, 0});
        world->step(kStep);
    }
    const auto force = world->addForce({on(body, {20, 0}), {-3000, 0}});
    world->addForce({on(body, {-20, 0}), {3000, 0}});
    run(*world, 0.4);  // not longer: like a pencil on its tip, it would turn
    const double pressed = areaRatio(*world, body, def);
    world->setForce(force, {0, 0});
    world->setForce(force + 1, {0, 0});
    run(*world, 8);
    return measured(percentOff(areaRatio(*world, body, def), 1), "% of its area", 2,
                    "pressed to " + std::to_string(100 * pressed).substr(0, 4) + " %, let go");
}

/// No springs but those to the rigid twin: pulled at both ends each gives way by F / ks, let go it is as it was.
Outcome rigidTwin(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    SoftBodyDef def = softBall({0, 0}, 20, 100, 0.5);
    def.springs.clear();
    def.matter.shapeStiffness = 50, def.matter.shapeDamping = 1;
    const BodyHandle body = world->addSoftBody(def);
    const auto force = world->addForce({on(body, {20, 0}), {200, 0}});
    world->addForce({on(body, {-20, 0}), {-200, 0}});
    const auto width = [&] {
        const auto p = points(*world, body);
        double least = 0, most = 0;
        for (const Vec2& at : p) least = std::min(least, at.x()), most = std::max(most, at.x());
        return most - least;
    };
    run(*world, 3);
    const double stretch = (width() - 40) / 2;
    if (stretch > 40) return {Outcome::Verdict::Missing, 0, 0, {}, "nothing draws its particles back"};
    world->setForce(force, {0, 0});
    world->setForce(force + 1, {0, 0});
    run(*world, 3);
    return measured(std::max(percentOff(stretch, 4), percentOff(width(), 40)), "% of F / ks", 1);
}

SoftBodyDef ringBody(double ks)
{
    SoftBodyDef def;
    def.particles = circleRing({0, 0}, 20, 32);
    def.masses.assign(32, 1.0 / 32);
    auto& border = def.borders.emplace_back();
    for (std::uint32_t i = 0; i < 32; ++i) {
        border.push_back(i);
        def.springs.push_back({i, (i + 1) % 32, (def.particles[i] - def.particles[(i + 1) % 32]).norm(), ks, 0.5, 0});
    }
    return def;
}

Outcome gas(const Lab& lab)
{
    // At rest the tension T of a ring of radius R under the pressure p is p R; it is ks times the stretch of a side.
    const auto world = lab.world({0, 0});
    SoftBodyDef def = ringBody(200);
    def.matter.pressure = 2;
    const BodyHandle body = world->addSoftBody(def);
    run(*world, 10);
    const auto p = points(*world, body);
    double radius = 0;
    for (const Vec2& q : p) radius += (q - at(*world, body)).norm() / 32;
    if (radius < 20.01) return {Outcome::Verdict::Missing, 0, 0, {}, "gas does not blow a ring up"};
    // The chord's force balance: 2 T sin(pi / n) = p side; p A = p0 A0.
    const double side = 2 * radius * std::sin(kPi / 32), rest = def.springs[0].restLength;
    const double tension = 200 * (side - rest);
    const double now = 2 * area(def.particles, def.borders[0]) / area(p, def.borders[0]);
    const double absolute = percentOff(tension * 2 * std::sin(kPi / 32), now * side);
    return measured(absolute, "% of p side = 2 T sin(π/n)", 5, "radius 20 → " + std::to_string(radius).substr(0, 5));
}

Outcome areaKept(const Lab& lab)
{
    const auto flattened = [&](double stiffness) {
        const auto world = lab.world({0, 98.1});
        world->addRigidBody(ground(20));
        SoftBodyDef def = softBall({0, 0}, 20, 60, 1);
        def.matter.areaStiffness = stiffness;
        const BodyHandle body = world->addSoftBody(def);
        world->addRigidBody(box({0, -30}, 60, 8, 6));
        run(*world, 5);
        return areaRatio(*world, body, def);
    };
    const double without = flattened(0), with = flattened(2000);
    if (with <= without + 0.005) return {Outcome::Verdict::Missing, 0, 0, {}, "its area changes as without"};
    return measured(100 * std::abs(1 - with), "% of its area", 5,
                    "under six times its weight; without: " + std::to_string(100 * without).substr(0, 4) + " %");
}

Outcome plastic(const Lab& lab)
{
    const auto stretched = [&](double yield) {
        const auto world = lab.world({0, 0});
        SoftBodyDef def = dumbbell({0, 0}, {20, 0}, 100, 20);
        def.movable = {0, 1};
        def.matter.yield = yield, def.matter.creep = 10, def.matter.mostFlow = 0.5;
        const BodyHandle body = world->addSoftBody(def);
        const auto force = world->addForce({on(body, {20, 0}), {600, 0}});
        run(*world, 3);
        world->setForce(force, {0, 0});
        run(*world, 5);
        const auto p = points(*world, body);
        return (p[1] - p[0]).norm();
    };
    const double elastic = stretched(0), flowed = stretched(0.1);
    if (std::abs(flowed - 20) < 0.05) return {Outcome::Verdict::Missing, 0, 0, {}, "springs do not flow"};
    // Force 600 keeps the strain force / ks: it flows until that is the yield, or the most is reached.
    return measured(std::max(std::abs(elastic - 20), std::max(0.0, 22 - flowed)), "units", 0.3,
                    "20 units stay " + std::to_string(flowed).substr(0, 5));
}

Outcome pins(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle body = world->addSoftBody(dumbbell({0, 0}, {20, 0}, 100, 1));
    world->setPinned(body, 0, true);
    run(*world, 3);
    const double held = points(*world, body)[0].norm();
    world->setPinned(body, 0, false);
    run(*world, 1);
    return measured(points(*world, body)[0].y() > 30 ? held : 1e3, "units", 1e-9, "held, then let go");
}

Outcome liveSprings(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    SoftBodyDef def = dumbbell({0, 0}, {0, 20}, 10, 2);
    def.movable = {0, 1};
    const BodyHandle body = world->addSoftBody(def);
    run(*world, 10);
    const double before = points(*world, body)[1].y(), tension = world->springTension(body, 0);
    world->setSprings(body, 50, 4, 0);
    run(*world, 10);
    return measured(
        std::max({std::abs(before - 30), std::abs(points(*world, body)[1].y() - 22), std::abs(tension - 100)}),
        "units; force", 0.1, "a weight on a spring that gets stiffer; its tension");
}

Outcome joints(const Lab& lab)
{
    const auto world = lab.world({0, 98.1});
    const BodyHandle body = world->addSoftBody(softBall({0, 0}, 20));
    JointDef def = joint(JointDef::Kind::Revolute, background({0, 0}), on(body, {0, 0}));
    const JointHandle pin = world->addJoint(def);
    run(*world, 3);
    const JointState state = world->joint(pin);
    return measured((state.pointA - state.pointB).norm(), "units apart", 1, "a soft ball hangs at its hub");
}

Outcome selfCollision(const Lab& lab)
{
    // A thin tongue folds over its own end and must not pass through it.
    const auto world = lab.world({0, 98.1});
    world->addRigidBody(ground(40));
    SoftBodyDef def;
    for (int i = 0; i <= 20; ++i) def.particles.push_back({-50.0 + 5 * i, 0});
    for (int i = 20; i >= 0; --i) def.particles.push_back({-50.0 + 5 * i, 4});
    def.masses.assign(42, 1.0 / 42);
    auto& border = def.borders.emplace_back();
    for (std::uint32_t i = 0; i < 42; ++i) border.push_back(i);
    const auto link = [&](std::uint32_t a, std::uint32_t b) {
        def.springs.push_back({a, b, (def.particles[a] - def.particles[b]).norm(), 60, 0.5, 0});
    };
    for (std::uint32_t i = 0; i < 20; ++i)
        link(i, i + 1), link(41 - i, 40 - i), link(i, 41 - i), link(i, 40 - i), link(i + 1, 41 - i);
    link(20, 21);
    def.matter.selfCollision = true;
    const BodyHandle body = world->addSoftBody(def);
    world->addForce({on(body, {-50, 2}), {40, 0}});
    world->addForce({on(body, {50, 2}), {-40, 0}});
    run(*world, 4);
    const auto p = points(*world, body);
    int crossings = 0;
    for (std::size_t i = 0; i < 42; ++i)
        for (std::size_t k = i + 2; k < 42; ++k) {
            if (i == 0 && k == 41) continue;
            const Vec2 &a = p[i], &b = p[i + 1], &c = p[k], &d = p[(k + 1) % 42];
            crossings += cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
        }
    return measured(crossings, "crossings of its border", 0);
}

Outcome field(const Lab& lab, ForceFieldDef::Kind kind, bool soft)
{
    const auto world = lab.world(kind == ForceFieldDef::Kind::Buoyancy ? Vec2(0, 100) : Vec2(0, 0));
    ForceFieldDef def;
    def.kind = kind;
    def.vector = {40, 0}, def.strength = 2;
    double should = 0;
    const BodyHandle body = soft ? world->addSoftBody(softBall({30, 0}, 4)) : world->addRigidBody(disc({30, 0}, 4));
    switch (kind) {
    case ForceFieldDef::Kind::Directional: should = 40; break;
    case ForceFieldDef::Kind::Radial: should = 2; break;
    case ForceFieldDef::Kind::Vortex: should = 2; break;
    case ForceFieldDef::Kind::Drag: should = 40 * (1 - std::exp(-2.0)); break;
    case ForceFieldDef::Kind::Buoyancy: should = -100; break;
    }
    world->addForceField(def);
    run(*world, 1);
    const Vec2 v = velocity(*world, body);
    const bool down = kind == ForceFieldDef::Kind::Vortex || kind == ForceFieldDef::Kind::Buoyancy;
    return measured(percentOff(down ? v.y() : v.x(), should), "% of a t", 2, soft ? "a soft ball" : "a rigid disc");
}

Outcome fieldRegion(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle in = world->addRigidBody(disc({0, 0}, 2)), out = world->addRigidBody(disc({100, 0}, 2));
    ForceFieldDef def;
    def.vector = {0, -50};
    def.region = {boxRing({0, 0}, 40, 40)};
    world->addForceField(def);
    run(*world, 0.5);
    return measured(std::max(percentOff(velocity(*world, in).y(), -25), 100 * velocity(*world, out).norm()), "%", 2,
                    "one inside, one outside");
}

}  // namespace

std::vector<Check> softChecks()
{
    using Kind = ForceFieldDef::Kind;
    const auto fields = [](Kind kind) {
        return [kind](const Lab& lab) {
            const Outcome rigid = field(lab, kind, false);
            if (rigid.verdict != Outcome::Verdict::Supported) return rigid;
            return field(lab, kind, true);
        };
    };
    return {{"soft bodies", "period of a spring", springPeriod},
            {"soft bodies", "damping of a spring", springDamping},
            {"soft bodies", "any stiffness, mass, step", stiffness},
            {"soft bodies", "tearing at kt", tearing},
            {"soft bodies", "pieces of a torn body", pieces},
            {"soft bodies", "momentum of two balls", momentum},
            {"soft bodies", "angular spring", angular},
            {"soft bodies", "rests on the ground", ballRests},
            {"soft bodies", "soft on soft, rigid on soft", softOnSoft},
            {"soft bodies", "regains its shape", composite},
            {"soft bodies", "composite body", rigidTwin},
            {"soft bodies", "gas pressure", gas},
            {"soft bodies", "area preservation", areaKept},
            {"soft bodies", "plasticity", plastic},
            {"soft bodies", "self-collision", selfCollision},
            {"soft bodies", "pinned particles", pins},
            {"soft bodies", "live springs, tension", liveSprings},
            {"soft bodies", "joints", joints},
            {"fields of force", "directional", fields(Kind::Directional)},
            {"fields of force", "radial", fields(Kind::Radial)},
            {"fields of force", "vortex", fields(Kind::Vortex)},
            {"fields of force", "drag", fields(Kind::Drag)},
            {"fields of force", "buoyancy", fields(Kind::Buoyancy)},
            {"fields of force", "region", fieldRegion}};
}

}  // namespace jet::conformance
