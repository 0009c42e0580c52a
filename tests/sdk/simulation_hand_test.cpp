// The hand that drags bodies while a scene plays: what it takes hold of, how it pulls, and going back past it.
#include "fixtures/fakes.hpp"
#include "support/test_catalog.hpp"

#include <jet/physics_view.hpp>
#include <jet/rewind.hpp>
#include <jet/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>

namespace jet {

namespace {

constexpr double kOmega = 2 * 3.14159265358979 * 5;  // rad / s, of the hand's spring
constexpr double kGravity = 98.1;

class HandTest : public testing::Test {
protected:
    HandTest() : scene_("Scene", events_, catalog_) {}

    ItemId body(Path path, const char* effect = "in-path-rigid-body", bool fixed = false)
    {
        auto edit = scene_.items().begin("Add a body");
        const Item& item = edit.add<ShapeItem>(scene_.root(), std::move(path));
        edit.addEffect(item, effect);
        edit.set(item, "fixed", fixed);
        edit.commit();
        return item.id();
    }
    void set(ItemId item, const char* property, Value value)
    {
        auto edit = scene_.items().begin("Set");
        edit.set(*scene_.items().find(item), property, std::move(value));
        edit.commit();
    }
    void weightless()
    {
        auto edit = scene_.items().begin("No gravity");
        edit.setScene("gravity", Vec2(0, 0));
        edit.commit();
    }
    ItemId ground() { return body(Path::rectangle({{-400, 200}, {400, 260}}), "in-path-rigid-body", true); }
    static Path disc(const Vec2& at, double radius)
    {
        return Path::ellipse({at - Vec2(radius, radius), at + Vec2(radius, radius)});
    }
    std::unique_ptr<Simulation> start(std::string engine = "jet-physics", int threads = 1)
    {
        SimulationOptions options;
        options.physics = std::move(engine), options.threads = threads;
        return Simulation::start(scene_, options).orThrow();
    }
    static void run(Simulation& simulation, double seconds)
    {
        for (const double end = simulation.time() + seconds - 1e-9; simulation.time() < end;) simulation.step();
    }
    static Vec2 at(const Simulation& simulation, ItemId item)
    {
        return simulation.world().bodies().position[simulation.bodyOf(item)];
    }
    static Vec2 velocity(const Simulation& simulation, ItemId item)
    {
        return simulation.world().bodies().velocity[simulation.bodyOf(item)];
    }

    test::TestCatalog catalog_{"org.jet.physics", "org.jet.effect.in-path-body", "org.jet.effect.in-path-rigid-body"};
    EventsCenter events_;
    Scene scene_;
};

}  // namespace

// --- what it takes hold of

TEST_F(HandTest, TheTopmostBodyThatMayMoveIsTaken)
{
    weightless();
    const ItemId below = body(disc({0, 0}, 20)), above = body(disc({15, 0}, 20));
    const auto simulation = start();
    EXPECT_EQ(simulation->grab({8, 0}), above) << "where both are";
    EXPECT_EQ(simulation->grab({-15, 0}), below);
    EXPECT_EQ(simulation->held()->item, below);
    EXPECT_FALSE(simulation->grab({60, 0}));
    EXPECT_FALSE(simulation->held()) << "a grab into nothing lets go";
}

TEST_F(HandTest, WhatCannotMoveOrIsNotShownIsLookedThrough)
{
    weightless();
    const ItemId free = body(disc({0, 0}, 10));
    body(disc({0, 0}, 30), "in-path-rigid-body", true);
    const ItemId driven = body(disc({0, 0}, 30)), hidden = body(disc({0, 0}, 30));
    set(driven, "kinematic", true);
    set(hidden, "visible", false);
    const auto simulation = start();
    EXPECT_EQ(simulation->grab({0, 0}), free);
    EXPECT_FALSE(simulation->grab({20, 0}, 5)) << "only what stands is there";
}

TEST_F(HandTest, WithinReachTheNearestIsTakenWhereItIsNearest)
{
    weightless();
    const ItemId left = body(Path::rectangle({{-40, -10}, {-10, 10}})),
                 right = body(Path::rectangle({{8, -10}, {40, 10}}));
    const auto simulation = start();
    EXPECT_FALSE(simulation->grab({0, 0}));
    EXPECT_FALSE(simulation->grab({0, 0}, 7.9));
    EXPECT_EQ(simulation->grab({0, 0}, 20), right);
    EXPECT_NEAR(simulation->held()->at.x(), 8, 1e-6);
    EXPECT_EQ(simulation->held()->hand, Vec2(0, 0));
    EXPECT_EQ(simulation->grab({-4, 0}, 20), left);
    EXPECT_FALSE(simulation->grab({std::nan(""), 0}, 20));
}

TEST_F(HandTest, AnEngineWithoutJointsIsToldOfOnce)
{
    catalog_.inCode().physicsEngine<test::FallingEngine>("falling");
    body(Path::rectangle({{-20, -20}, {20, 20}}));
    const auto simulation = start("falling");
    EXPECT_FALSE(simulation->grab({0, 0}));
    EXPECT_FALSE(simulation->grab({0, 0}));
    simulation->drag({5, 5});
    simulation->letGo();
    ASSERT_EQ(simulation->output().size(), 1u);
    EXPECT_EQ(simulation->output()[0].text.rfind("bodies cannot be dragged: ", 0), 0u) << simulation->output()[0].text;
    EXPECT_EQ(simulation->output()[0].text.find('\n'), std::string::npos);
}

// --- how it pulls

/// At rest the spring bears the weight: m g = k x, with k = m w², whatever the mass.
TEST_F(HandTest, AHangingBodyRestsBelowTheHandAsFarAsItsWeightOverTheStiffness)
{
    const ItemId light = body(disc({0, 0}, 10)), heavy = body(Path::rectangle({{60, -20}, {100, 20}}));
    auto edit = scene_.items().begin("Mass");
    edit.setEffect(*scene_.items().find(heavy), 0, "mass", 50.0);
    edit.commit();
    for (const auto& [item, place] : {std::pair(light, Vec2(0, 0)), std::pair(heavy, Vec2(80, 0))}) {
        const auto simulation = start();
        ASSERT_EQ(simulation->grab(place), item);
        run(*simulation, 4);
        EXPECT_NEAR(at(*simulation, item).y(), kGravity / (kOmega * kOmega), 1e-4);
        EXPECT_NEAR(simulation->held()->at.y(), kGravity / (kOmega * kOmega), 1e-4);
    }
}

/// Held at a corner it turns until its centre is below, and hangs as far below the hand.
TEST_F(HandTest, HeldAtItsEndABodyHangsDown)
{
    auto edit = scene_.items().begin("Damping");
    edit.setScene("angular-damping", 8.0);
    edit.commit();
    const ItemId rod = body(Path::rectangle({{-40, -4}, {40, 4}}));
    const auto simulation = start();
    ASSERT_EQ(simulation->grab({38, 0}), rod);
    run(*simulation, 15);
    EXPECT_NEAR(at(*simulation, rod).x(), 38, 0.1);
    EXPECT_NEAR(at(*simulation, rod).y(), 38 + kGravity / (kOmega * kOmega), 0.1);
}

/// At an even speed nothing accelerates: the spring balances the damping, and the lag is 2 zeta v / w.
TEST_F(HandTest, ABodyFollowsTheHandAtTheDistanceTheDampingSays)
{
    weightless();
    const ItemId ball = body(disc({0, 0}, 10));
    const auto simulation = start();
    simulation->grab({0, 0});
    const double speed = 300, step = speed / 60;
    double hand = 0;
    for (int i = 0; i < 120; ++i) simulation->drag({hand += step, 0}), simulation->step();
    EXPECT_NEAR(velocity(*simulation, ball).x(), speed, 0.05 * speed);
    EXPECT_NEAR(hand - at(*simulation, ball).x(), 2 * 0.9 * speed / kOmega, step);
    simulation->letGo();
    const Vec2 place = at(*simulation, ball), fast = velocity(*simulation, ball);
    run(*simulation, 1);
    EXPECT_NEAR(at(*simulation, ball).x(), place.x() + fast.x(), 1e-6) << "it flies on";
}

TEST_F(HandTest, ASleepingBodyWakesAndSleepsAgain)
{
    ground();
    const ItemId box = body(Path::rectangle({{-10, 170}, {10, 200}}));
    const auto simulation = start();
    run(*simulation, 5);
    ASSERT_FALSE(simulation->world().awake(simulation->bodyOf(box)));
    simulation->grab({0, 180});
    EXPECT_TRUE(simulation->world().awake(simulation->bodyOf(box)));
    simulation->drag({0, 150});
    run(*simulation, 2);
    EXPECT_NEAR(at(*simulation, box).y(), 155, 1);
    simulation->letGo();
    run(*simulation, 5);
    EXPECT_NEAR(at(*simulation, box).y(), 185, 0.1);
    EXPECT_FALSE(simulation->world().awake(simulation->bodyOf(box)));
}

/// It bears two hundred times the weight of what it holds, and no more.
TEST_F(HandTest, ItLiftsWhatLiesOnABodyUpToItsStrength)
{
    for (const auto& [load, lifts] : {std::pair(120.0, true), std::pair(300.0, false)}) {
        Scene scene("Scene", events_, catalog_);
        auto edit = scene.items().begin("Bodies");
        const Item& plate = edit.add<ShapeItem>(scene.root(), Path::rectangle({{-60, 0}, {60, 10}}));
        const Item& crate = edit.add<ShapeItem>(scene.root(), Path::rectangle({{-15, -30}, {15, 0}}));
        const Item& floor = edit.add<ShapeItem>(scene.root(), Path::rectangle({{-200, 10}, {200, 50}}));
        for (const Item* item : {&plate, &crate, &floor}) edit.addEffect(*item, "in-path-rigid-body");
        edit.set(floor, "fixed", true);
        edit.set(plate, "fixed-rotation", true);
        edit.setEffect(crate, 0, "mass", load);
        edit.commit();
        SimulationOptions options;
        const auto simulation = Simulation::start(scene, options).orThrow();
        simulation->grab({0, 5});
        for (int i = 0; i < 120; ++i) simulation->drag({0, 5 - 0.5 * i}), simulation->step();
        if (lifts) {
            EXPECT_LT(at(*simulation, plate.id()).y(), -30) << load;
        } else {
            EXPECT_GT(at(*simulation, plate.id()).y(), 4) << load;
        }
    }
}

TEST_F(HandTest, TheBitsDoNotDependOnThreads)
{
    ground();
    for (int i = 0; i < 30; ++i)
        body(Path::rectangle({{-60.0 + 25 * (i % 5), -30.0 * (i / 5)}, {-38.0 + 25 * (i % 5), 20 - 30.0 * (i / 5)}}));
    const ItemId ball = body(disc({-120, 150}, 30), "in-path-body");
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 4}) {
        const auto simulation = start("jet-physics", threads);
        EXPECT_EQ(simulation->grab({-120, 150}), ball);
        for (int i = 0; i < 120; ++i) simulation->drag({-120 + 3.0 * i, 150.0 - i}), simulation->step();
        simulation->letGo();
        run(*simulation, 1);
        hashes.push_back(simulation->hash());
    }
    EXPECT_EQ(hashes[1], hashes[0]);
    EXPECT_EQ(hashes[2], hashes[0]);
}

// --- states

TEST_F(HandTest, ASavedStateHasTheHandAndGoesOnBitEqual)
{
    ground();
    const ItemId box = body(Path::rectangle({{-10, 170}, {10, 200}})), ball = body(disc({60, 150}, 25), "in-path-body");
    for (const ItemId item : {box, ball}) {
        const auto simulation = start();
        std::vector<std::vector<std::byte>> states;
        std::vector<std::uint64_t> hashes;
        const auto act = [&](Simulation& s) {
            const auto step = static_cast<double>(s.stepCount());
            if (s.stepCount() == 20) {
                EXPECT_EQ(s.grab(at(s, item)), item);
            }
            if (s.stepCount() > 20 && s.stepCount() < 60) s.drag({4 * step, 150 - step});
            if (s.stepCount() == 60) s.letGo();
        };
        for (int i = 0; i < 90; ++i) {
            states.push_back(simulation->save()), hashes.push_back(simulation->hash());
            act(*simulation);
            simulation->step();
        }
        for (const std::size_t from : {40U, 10U, 70U, 20U, 21U, 60U}) {
            const auto fresh = start();
            for (Simulation* one : {simulation.get(), fresh.get()}) {
                one->restore(states[from]);
                EXPECT_EQ(one->held().has_value(), from > 20 && from <= 60);
                for (std::size_t i = from; i < 90; ++i) {
                    ASSERT_EQ(one->hash(), hashes[i]) << "from " << from << ", step " << i;
                    act(*one);
                    one->step();
                }
                EXPECT_FALSE(one->held());
            }
        }
    }
}

TEST_F(HandTest, ThePictureOfTheWorldHasNoJointThatIsGone)
{
    weightless();
    body(disc({0, 0}, 20));
    const auto simulation = start();
    simulation->grab({0, 0});
    EXPECT_EQ(simulation->physicsPicture().joints.size(), 1u);
    simulation->letGo();
    EXPECT_TRUE(simulation->physicsPicture().joints.empty());
}

// --- soft bodies

/// Of the outline, units²; negative where it is turned inside out.
double areaOf(const Simulation& simulation, ItemId item)
{
    return simulation.pose(*simulation.scene().items().find(item))->area();
}

/// Do two sides of the outline cross each other?
bool crossesItself(const Simulation& simulation, ItemId item)
{
    const Path& path = *simulation.pose(*simulation.scene().items().find(item));
    const std::vector<Vec2> ring = path.polygonized().front().points;
    const auto side = [](const Vec2& a, const Vec2& b, const Vec2& p) { return cross(b - a, p - a); };
    for (std::size_t i = 0; i < ring.size(); ++i)
        for (std::size_t k = i + 2; k < ring.size(); ++k) {
            const Vec2 &a = ring[i], &b = ring[i + 1], &c = ring[k], &d = ring[(k + 1) % ring.size()];
            if ((k + 1) % ring.size() == i) continue;
            if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
        }
    return false;
}

TEST_F(HandTest, ASoftBallFollowsAFastHandWithoutTurningInsideOut)
{
    for (const double gravity : {0.0, kGravity})
        for (const double speed : {500.0, 2000.0})
            for (const Vec2& grip : {Vec2(0, 0), Vec2(25, 0), Vec2(0, -25), Vec2(-20, 15)}) {
                Scene scene("Scene", events_, catalog_);
                auto edit = scene.items().begin("Ball");
                const Item& ball = edit.add<ShapeItem>(scene.root(), disc({0, 0}, 30));
                edit.addEffect(ball, "in-path-body");
                edit.setScene("gravity", Vec2(0, gravity));
                edit.commit();
                const auto simulation = Simulation::start(scene, {}).orThrow();
                ASSERT_EQ(simulation->grab(grip), ball.id());
                const double whole = areaOf(*simulation, ball.id());
                // There and back, with a stop.
                double x = grip.x();
                for (int i = 0; i < 180; ++i) {
                    const double direction = i < 60 ? 1 : i < 120 ? -1 : 0;
                    simulation->drag({x += direction * speed / 60, grip.y()});
                    simulation->step();
                    ASSERT_GT(areaOf(*simulation, ball.id()) / whole, 0.6)
                        << speed << " from " << grip.transpose() << ", step " << i;
                    ASSERT_FALSE(crossesItself(*simulation, ball.id()))
                        << speed << " from " << grip.transpose() << ", step " << i;
                }
                EXPECT_LT((simulation->held()->at - simulation->held()->hand).norm(), 6)
                    << speed << " from " << grip.transpose() << " at " << gravity;
            }
}

/// A strip that is drawn away by one end, faster than the rest of it can follow.
TEST_F(HandTest, WhatTearsWhileItIsHeldLeavesAPieceInTheHandAndEveryStateGoesOnBitEqual)
{
    weightless();
    const ItemId strip = body(Path::rectangle({{0, 0}, {240, 40}}), "in-path-body");
    auto edit = scene_.items().begin("Tears");
    edit.setEffect(*scene_.items().find(strip), 0, "tear-ratio", 1.3);
    edit.commit();
    const auto act = [&](Simulation& s) {
        const auto step = static_cast<double>(s.stepCount());
        if (s.stepCount() == 10) {
            EXPECT_EQ(s.grab({10, 20}), strip);
        }
        if (s.stepCount() > 10 && s.stepCount() < 60) s.drag({10 - 15 * (step - 10), 20});
        if (s.stepCount() == 60) s.letGo();
        s.step();
    };
    const auto torn = [&](const Simulation& s) {
        const auto pieces = s.world().pieces(s.bodyOf(strip));
        return std::any_of(pieces.begin(), pieces.end(), [](std::uint32_t piece) { return piece > 0; });
    };
    const auto simulation = start();
    std::vector<std::vector<std::byte>> states;
    std::vector<std::uint64_t> hashes;
    std::size_t tear = 0;
    for (std::size_t i = 0; i < 90; ++i) {
        states.push_back(simulation->save()), hashes.push_back(simulation->hash());
        if (tear == 0 && torn(*simulation)) tear = i;
        if (simulation->held()) {
            EXPECT_EQ(simulation->held()->item, strip);
            EXPECT_LT((simulation->held()->at - simulation->held()->hand).norm(), 80) << i;
        }
        act(*simulation);
    }
    ASSERT_GT(tear, 11U);
    ASSERT_LT(tear, 60U) << "it was to tear while it is held";
    for (const std::size_t from : {tear + 3, tear - 1, tear, std::size_t{70}, std::size_t{5}}) {
        const auto fresh = start();
        for (Simulation* one : {simulation.get(), fresh.get()}) {
            one->restore(states[from]);
            EXPECT_EQ(torn(*one), from >= tear);
            EXPECT_EQ(one->held().has_value(), from > 10 && from <= 60);
            for (std::size_t i = from; i < 90; ++i) {
                ASSERT_EQ(one->hash(), hashes[i]) << "from " << from << ", step " << i;
                act(*one);
            }
        }
    }
}

// --- the center

class HandCenterTest : public HandTest {
protected:
    HandCenterTest()
    {
        ground();
        ball_ = body(disc({0, 120}, 20));
        for (int i = 0; i < 8; ++i)
            body(Path::rectangle({{60.0 + 2 * i, 175.0 - 26 * i}, {90.0 + 2 * i, 200.0 - 26 * i}}));
    }
    ~HandCenterTest() override { center_.stop(); }
    template <class Done>
    bool until(Done&& done)
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (!done()) {
            if (std::chrono::steady_clock::now() > end) return false;
            events_.dispatchQueued();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }
    void begin()
    {
        center_.play(scene_, {}).orThrow();
        center_.rewindTo(0);  // pauses
        ASSERT_TRUE(until([&] { return step() == 0; }));
    }
    std::uint64_t step() const { return center_.frame() ? center_.frame()->step : ~std::uint64_t{0}; }
    /// One step, and the poses after it.
    void goOn()
    {
        const std::uint64_t next = step() + 1;
        center_.singleStep();
        ASSERT_TRUE(until([&] { return step() == next; }));
    }
    void goTo(std::uint64_t wanted)
    {
        center_.rewindTo(wanted);
        ASSERT_TRUE(until([&] { return step() == wanted; }));
    }
    Box ball() const
    {
        for (const auto& [item, path] : center_.frame()->poses)
            if (item == ball_) return path.bounds();
        return {};
    }
    /// Grabs the ball before step 10, throws it into the stack, lets it go before step 40; up to step 60.
    std::map<std::uint64_t, Box> drag()
    {
        std::map<std::uint64_t, Box> boxes{{0, ball()}};
        while (step() < 60 && !HasFatalFailure()) {
            if (step() == 10) center_.grab(ball().center(), 0);
            if (step() > 10 && step() < 40) center_.drag({6.0 * static_cast<double>(step() - 10), 60});
            if (step() == 40) center_.letGo();
            goOn();
            boxes[step()] = ball();
            EXPECT_EQ(center_.held().has_value(), step() > 10 && step() <= 40) << step();
        }
        return boxes;
    }

    SimulationCenter center_{events_};
    ItemId ball_;
};

TEST_F(HandCenterTest, OneGoesBackToBeforeADragAndPlaysAgain)
{
    begin();
    const auto boxes = drag();
    for (const std::uint64_t to : {30U, 5U, 50U, 11U, 40U, 0U}) {
        goTo(to);
        EXPECT_EQ(ball(), boxes.at(to)) << to;
    }
    EXPECT_EQ(drag(), boxes) << "the same hand does the same again";
    goTo(5);
    for (int i = 0; i < 30; ++i) goOn();
    EXPECT_FALSE(ball() == boxes.at(35)) << "nobody grabbed it this time";
}

TEST_F(HandCenterTest, WhatIsGoneBackToInTheMidstOfADragIsShownHeldAndLetGoWhenItGoesOn)
{
    begin();
    const auto boxes = drag();
    goTo(30);
    EXPECT_EQ(ball(), boxes.at(30));
    ASSERT_TRUE(center_.held());
    EXPECT_EQ(center_.held()->item, ball_);
    center_.drag({500, 500});  // of a hand that has let go
    goOn();
    EXPECT_FALSE(center_.held());
    EXPECT_FALSE(ball() == boxes.at(31));
    EXPECT_EQ(center_.rewindState().newest, 31u);
    goTo(20);
    EXPECT_EQ(ball(), boxes.at(20));
    goTo(31);
    EXPECT_FALSE(center_.held());
}

/// With little memory most states are computed again from those kept, with what the hand did.
TEST_F(HandCenterTest, StepsThatWereNotKeptComeOutAsTheyWere)
{
    center_.setRewindLimits({10, 180'000});
    begin();
    const auto boxes = drag();
    ASSERT_GT(center_.rewindState().interval, 1u);
    ASSERT_GE(center_.rewindState().newest, 42u);
    for (std::uint64_t to = center_.rewindState().newest - 1; to > center_.rewindState().oldest; --to) {
        goTo(to);
        if (HasFatalFailure()) return;
        EXPECT_EQ(ball(), boxes.at(to)) << to;
        EXPECT_EQ(center_.held().has_value(), to > 10 && to <= 40) << to;
    }
}

TEST_F(HandCenterTest, PausedItHoldsAndTheBodyMovesOnSingleSteps)
{
    begin();
    const Box before = ball();
    center_.grab(before.center(), 0);
    ASSERT_TRUE(until([&] { return center_.held().has_value(); })) << "a frame shows it";
    center_.drag({-200, 0});
    ASSERT_TRUE(until([&] { return center_.held()->hand == Vec2(-200, 0); }));
    EXPECT_EQ(ball(), before);
    EXPECT_EQ(step(), 0u);
    for (int i = 0; i < 20; ++i) goOn();
    EXPECT_LT(ball().center().x(), -50);
    center_.letGo();
    ASSERT_TRUE(until([&] { return !center_.held(); }));
}

TEST_F(HandCenterTest, AnotherRunHoldsNothing)
{
    begin();
    center_.grab(ball().center(), 0);
    ASSERT_TRUE(until([&] { return center_.held().has_value(); }));
    center_.stop();
    EXPECT_FALSE(center_.held());
    begin();
    EXPECT_FALSE(center_.held());
    center_.drag({0, 0});
    goOn();
    EXPECT_FALSE(center_.held());
    EXPECT_FALSE(center_.listensToPointer()) << "there is no script";
}

}  // namespace jet
