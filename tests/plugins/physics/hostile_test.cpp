// What a hostile or careless caller gives a world: it is refused with a sentence, and the world is still as it was, or
// it is computed with, and everything that can be read is a number.
#include "doors.hpp"

#include <limits>
#include <random>

namespace jet::physics::test {

namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<Vec2> scribble(int corners, std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(-300, 300);
    std::vector<Vec2> ring;
    for (int i = 0; i < corners; ++i) {
        const double x = place(random);
        ring.push_back({x, place(random)});
    }
    return ring;
}

/// Cutting up a scribble takes time and memory by the cube of its corners; a ring of many corners, by their square.
TEST(Hostile, OutlinesThatTakeTooLongToDivideAreRefusedAndChangeNothing)
{
    auto world = makeWorld({0, 100});
    world->addRigidBody(box({0, 0}, 10, 10));
    const std::uint64_t before = world->hash();
    const auto refused = [&](const RigidBodyDef& def) { return refusalOf([&] { world->addRigidBody(def); }); };
    const std::string crossing = refused(rigid({scribble(1500, 1)}));
    EXPECT_TRUE(contains(crossing, "body 1: its outline crosses itself too often")) << crossing;
    EXPECT_FALSE(refused(fixed({scribble(1500, 2)})).empty());
    const std::string many = refused(rigid({circleRing({0, 0}, 300, 20'000)}));
    EXPECT_TRUE(contains(many, "body 1: its outline has 20000 corners, more than 10000")) << many;
    std::vector<Vec2> rake;
    for (int i = 0; i < 60'000; ++i) rake.push_back({i % 2 == 0 ? 0.0 : 500.0, i * 0.01});
    const std::string sides = refused(fixed({rake}));
    EXPECT_TRUE(contains(sides, "sides that reach across much of it")) << sides;
    ForceFieldDef field;
    field.region = {scribble(1500, 3)};
    const std::string region = refusalOf([&] { world->addForceField(field); });
    EXPECT_TRUE(contains(region, "force field 0: its region crosses itself too often")) << region;
    EXPECT_EQ(world->bodyCount(), 1U);
    EXPECT_EQ(world->hash(), before);
    world->restore(world->save());
    world->step(kStep);
    EXPECT_TRUE(allFinite(*world));
}

TEST(Hostile, AFixedOutlineMayHaveManyCorners)
{
    auto world = makeWorld({0, 100});
    world->addRigidBody(fixed({circleRing({0, 0}, 300, 50'000)}));
    world->addRigidBody(box({0, -305}, 10, 10));
    run(*world, 0.5);
    EXPECT_NEAR(world->bodies().position[1].y(), -305, 0.5);
}

/// Longer ones would be taken in parts too long to find contacts in, or in more parts than anybody waits for.
TEST(Hostile, AStepThatIsTooLongIsRefused)
{
    auto world = makeWorld({0, 100});
    world->addRigidBody(box({0, 0}, 10, 10));
    for (const double dt : {501.0, 1e29}) {
        const std::string told = refusalOf([&] { world->step(dt); });
        EXPECT_TRUE(contains(told, "the step: its time is")) << told;
    }
    EXPECT_EQ(world->bodies().position[0], Vec2(0, 0));
}

/// Blocks of walls are filled up with walls that are nowhere; however thick a skin, nothing comes to them.
TEST(Hostile, NoSkinIsSoThickThatItMeetsWallsThatAreNone)
{
    auto world = makeWorld({0, 0});
    for (const double x : {0.0, 25.0}) {
        SoftBodyDef def = softBall({x, 0}, 10, 200, 1, 21);  // 21 of 24 lanes
        def.matter.thickness = 1e20;
        world->addSoftBody(def);
    }
    for (int i = 0; i < 5; ++i) {
        world->step(kStep);
        for (const Contact& c : world->contacts()) {
            EXPECT_LT(c.wall, 64U);
            EXPECT_TRUE(isFinite(c.point) && isFinite(c.normal));
        }
        ASSERT_TRUE(allFinite(*world));
    }
}

/// The thesis's scheme tells of one body that explodes; others may in the same step.
TEST(Hostile, OfSeveralBodiesThatExplodeAtOnceNoneKeepsWhatIsNoNumber)
{
    WorldSettings settings;
    settings.method = Method::SemiImplicitEuler;
    settings.gravity = {0, 0};
    auto world = JetPhysics().createWorld(settings);
    for (int i = 0; i < 3; ++i) {
        world->addSoftBody(softBall({100.0 * i, 0}, 10, 1e29, 1e29, 8));
        world->setVelocity(static_cast<BodyHandle>(i), {1, 0});
        world->setOmega(static_cast<BodyHandle>(i), 1);
    }
    for (int i = 0; i < 60; ++i) {
        const std::string told = refusalOf([&] { world->step(kStep); });
        if (i == 0) {
            EXPECT_TRUE(contains(told, "body 0 explodes")) << told;
        }
        for (BodyHandle body = 0; body < 3; ++body) {
            world->setOmega(body, 0.1);
            EXPECT_TRUE(isFinite(world->bodies().velocity[body]) && std::isfinite(world->bodies().omega[body]))
                << "body " << body << " after step " << i;
        }
    }
}

/// What is joined in single precision bears forces that are numbers, however hard the bodies are pushed.
TEST(Hostile, AnAbsurdFieldMakesNoForceOfAJointThatIsNoNumber)
{
    WorldSettings settings;
    settings.precision = Precision::Single;
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(simple(box({0, 0}, 10, 10)));
    JointDef weld;
    weld.kind = JointDef::Kind::Weld;
    weld.a = {0, {3, 4}}, weld.b.point = {-80, 130}, weld.hertz = 5, weld.dampingRatio = 0.5;
    world->addJoint(weld);
    ForceFieldDef field;
    field.vector = {0, 1e29};
    world->addForceField(field);
    world->setVelocity(0, {1e29, -1e29});
    world->setOmega(0, 1e29);
    for (int i = 0; i < 10; ++i) {
        world->step(kStep);
        ASSERT_TRUE(isFinite(world->joint(0).force) && std::isfinite(world->joint(0).torque))
            << "step " << i << ": " << world->joint(0).force.transpose() << ", " << world->joint(0).torque;
    }
}

// --- Worlds of numbers that nobody would write, of a seed each.

class HostileWorld {
public:
    /// One number in `usually` is none that anybody would write.
    explicit HostileWorld(std::uint64_t seed, std::uint64_t usually = 12) : random_(seed), usually_(usually)
    {
        WorldSettings settings;
        settings.gravity = {number(0), number(98.1)};
        settings.substeps = below(4) == 0 ? static_cast<int>(below(12)) : 0;
        settings.method = below(10) == 0 ? Method::SemiImplicitEuler : Method::Automatic;
        attempt([&] { world_ = JetPhysics().createWorld(settings); });
        if (!world_) world_ = makeWorld({0, 98.1});
        world_->addRigidBody(ground(20));
        for (int i = 0; i < 8; ++i) addBody();
        for (int i = 0; i < 4; ++i) attempt([&] { world_->addJoint(joint()); });
        attempt([&] { world_->addSpring({anchor(), anchor(), number(5), number(100), number(1), number(2)}); });
        attempt([&] { world_->addForceField(field()); });
        attempt([&] { world_->addTorque({anchor(), number(100)}); });
    }

    void run(int steps)
    {
        for (int i = 0; i < steps; ++i) {
            attempt([&] { world_->step(below(8) == 0 ? number(1.0 / 30) : kStep); });
            requireNumbers();
            attempt([&] { change(); });
            requireNumbers();
        }
        const std::uint64_t hash = world_->hash();
        world_->restore(world_->save());
        EXPECT_EQ(world_->hash(), hash);
    }
    int refused() const { return refused_; }
    int taken() const { return taken_; }

private:
    std::uint64_t below(std::uint64_t end) { return random_() % end; }
    double real(double from, double to)
    {
        return from + (to - from) * static_cast<double>(random_() >> 11) * 0x1.0p-53;
    }
    /// Mostly the usual one.
    double number(double usual)
    {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        constexpr double kOdd[] = {
            0,     -0.0, -1,    1e-12, 1e-30,  1e-150,    1e-300,     5e-324,
            1e6,   1e9,  1e12,  1e15,  1e20,   1e29,      1e30,       -1e30,
            -1e12, 1e31, 1e308, -1e9,  -1e308, kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()};
        const std::uint64_t which = below(2 * usually_);
        if (which == 0) return kOdd[below(std::size(kOdd))];
        return which == 1 ? usual * std::pow(10, real(-14, 14)) : usual;
    }
    Vec2 vector(double x, double y)
    {
        const double first = number(x);
        return {first, number(y)};
    }
    std::vector<Vec2> ring(const Vec2& at, double size)
    {
        const std::uint64_t kind = below(10);
        std::vector<Vec2> points = circleRing(at, size, static_cast<int>(3 + below(7)));
        for (Vec2& p : points) {
            if (kind == 0) p.y() = at.y();                                       // flat
            if (kind == 1) p = at;                                               // a point
            if (kind == 2) p = at + Vec2(real(-size, size), real(-size, size));  // crosses itself
            if (kind == 3 && below(3) == 0) p = points[below(points.size())];    // comes back
            if (kind == 4 && below(3) == 0) p = vector(p.x(), p.y());
        }
        if (kind == 5) points.resize(below(3));
        if (kind == 6) std::reverse(points.begin(), points.end());
        return points;
    }
    BodyCommon common()
    {
        BodyCommon is;
        is.fixed = below(8) == 0, is.kinematic = below(10) == 0, is.fixedRotation = below(10) == 0;
        is.sensor = below(16) == 0;
        is.velocity = vector(real(-100, 100), 0), is.omega = number(real(-5, 5)), is.gravityScale = number(1);
        return is;
    }
    void addBody()
    {
        const Vec2 at(real(-60, 60), real(-80, 10));
        const double size = number(real(1, 12));
        if (below(2) == 0) {
            SoftBodyDef def = softBall(at, size, number(200), number(1), static_cast<int>(5 + below(9)), 1);
            def.common = common();
            def.matter.thickness = number(0), def.matter.pressure = number(20), def.matter.areaStiffness = number(10);
            def.matter.shapeStiffness = number(50), def.matter.yield = number(0.3);
            def.masses.assign(def.masses.size(), number(0.1));
            if (below(4) == 0) def.angularSprings.push_back({1, 0, 2, number(1), number(100), number(1)});
            attempt([&] { world_->addSoftBody(def); });
            return;
        }
        RigidBodyDef def;
        def.common = common();
        def.mass = number(real(0.1, 10));
        if (below(2) == 0) {
            def.borders = {ring(at, size), ring(at, size / 2)};
        } else {
            def.shapes.push_back({ShapeDef::Kind::Circle, {at}, size});
            def.shapes.push_back({ShapeDef::Kind::Capsule, {at, at + vector(3, 4)}, number(2)});
            def.shapes.push_back({ShapeDef::Kind::Polygon, ring(at, size), 0});
        }
        attempt([&] { world_->addRigidBody(def); });
    }
    Anchor anchor()
    {
        Anchor is;
        is.body = below(4) == 0 ? kNoHandle : static_cast<BodyHandle>(below(world_->bodyCount() + below(2)));
        is.point = vector(real(-60, 60), real(-60, 10));
        is.radius = below(5) == 0 ? number(3) : 0;
        return is;
    }
    JointDef joint()
    {
        JointDef def;
        def.kind = static_cast<JointDef::Kind>(below(9));
        def.a = anchor(), def.b = anchor(), def.axis = vector(1, 0.5);
        def.limited = below(3) == 0, def.lower = number(-1), def.upper = number(1);
        def.driven = below(3) == 0, def.motorSpeed = number(5), def.maxForce = number(1000);
        def.maxTorque = number(1000), def.hertz = below(2) == 0 ? number(5) : 0, def.dampingRatio = number(0.5);
        def.length = number(-1), def.ratio = number(1), def.breakForce = below(4) == 0 ? number(1e4) : 0;
        def.groundA = vector(-10, -100), def.groundB = vector(10, -100);
        return def;
    }
    ForceFieldDef field()
    {
        ForceFieldDef def;
        def.kind = static_cast<ForceFieldDef::Kind>(below(5));
        def.vector = vector(10, 0), def.strength = number(2), def.reach = number(20), def.drag = number(1);
        def.region = {ring({0, 0}, 80)};
        return def;
    }
    void change()
    {
        const auto body = static_cast<BodyHandle>(below(world_->bodyCount()));
        switch (below(14)) {
        case 0: return world_->setVelocity(body, vector(10, 10));
        case 1: return world_->setOmega(body, number(3));
        case 2: return world_->setPosition(body, vector(real(-50, 50), real(-50, 0)));
        case 3: return world_->applyImpulse(body, vector(100, 10));
        case 4: return world_->setMass(body, number(2));
        case 5: return world_->setEnabled(body, below(2) == 0);
        case 6: return world_->setSprings(body, number(100), number(1), 0);
        case 7: return world_->setPinned(body, static_cast<std::uint32_t>(below(12)), below(2) == 0);
        case 8: return world_->setForceField(0, field());
        case 9: return world_->setJoint(static_cast<JointHandle>(below(world_->jointCount() + 1)), joint());
        case 10: return addBody();
        case 11: return world_->applyForce(body, vector(100, 10));
        case 12: {
            const auto hit = world_->rayCast(vector(-100, 0), vector(100, 10));
            if (hit) {
                EXPECT_TRUE(isFinite(hit->point) && isFinite(hit->normal));
            }
            return;
        }
        default: world_->restore(world_->save());
        }
    }
    /// The sentence names what it is about; anything else that is thrown fails the test.
    template <class Act>
    void attempt(Act&& act)
    {
        try {
            act();
            ++taken_;
        } catch (const Failure& failure) {
            ++refused_;
            EXPECT_GT(failure.error().message.size(), 20U) << failure.error().message;
        }
    }
    void requireNumbers()
    {
        const std::string none = fieldWithoutNumber(*world_);
        ASSERT_TRUE(none.empty()) << none << " is no number";
    }

    std::mt19937_64 random_;
    std::uint64_t usually_;
    std::unique_ptr<PhysicsWorld> world_;
    int refused_ = 0, taken_ = 0;
};

TEST(Hostile, WhateverIsGivenIsRefusedOrStaysANumber)
{
    int refused = 0, taken = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        HostileWorld world(seed);
        world.run(12);
        refused += world.refused(), taken += world.taken();
        if (HasFatalFailure() || HasNonfatalFailure()) break;
    }
    EXPECT_GT(refused, 100);  // else it is not hostile
    EXPECT_GT(taken, 2 * refused);
}

/// Seeds of worlds that once told velocities, tensions and impulses that were none.
TEST(Hostile, WhatRunsAwayIsToldInNumbers)
{
    for (const std::uint64_t seed : {843, 1241, 1539, 1690, 2686, 3270}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        HostileWorld(seed, 4).run(12);
    }
}

}  // namespace

}  // namespace jet::physics::test
