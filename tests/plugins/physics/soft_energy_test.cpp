// Soft bodies on joints come by no energy: whatever pushes strain or lift, motors drive and springs of joints hold,
// they have what they fell and were given.
#include "formulas.hpp"

namespace jet::physics::test {

namespace {

/// Kinetic energy and weight of the particles of a world, from where it tells that they are.
class Energy {
public:
    Energy(PhysicsWorld& world, double gravity) : world_(world), gravity_(gravity) {}

    void add(const SoftBodyDef& def)
    {
        masses_.insert(masses_.end(), def.masses.begin(), def.masses.end());
        for (std::size_t i = 0; i < def.masses.size(); ++i)
            weight_ += gravity_ * def.masses[i], start_ -= gravity_ * def.masses[i] * def.particles[i].y();
        places_.insert(places_.end(), def.particles.begin(), def.particles.end());
        world_.addSoftBody(def);
    }
    double weight() const { return weight_; }
    /// After a step: of the mean velocities over it, never more than there is; less what there was at the start.
    double step(double dt)
    {
        world_.step(dt);
        return look(dt);
    }
    /// As things move right now, fast swings too.
    double now()
    {
        constexpr double kGlimpse = 1e-7;
        const auto state = world_.save();
        look(1);
        world_.step(kGlimpse);
        const double energy = look(kGlimpse);
        world_.restore(state);
        look(1);
        return energy;
    }
    /// The most it gains in so many seconds, in falls by `size`; a tenth of what it fell is no gain.
    double mostGain(double seconds, double dt, double size)
    {
        double most = 0;
        for (int i = 0; i < static_cast<int>(std::lround(seconds / dt)); ++i) {
            const double gain = step(dt);
            most = std::max(most, gain / (weight_ * size + fell_));
        }
        return most;
    }

private:
    /// Of what moved over dt.
    double look(double dt)
    {
        const BodyStates now = world_.bodies();
        double kinetic = 0, held = -start_;
        for (std::size_t i = 0; i < masses_.size(); ++i) {
            kinetic += 0.5 * masses_[i] * ((now.points[i] - places_[i]) / dt).squaredNorm();
            held -= gravity_ * masses_[i] * now.points[i].y();
            places_[i] = now.points[i];
        }
        fell_ = std::max(fell_, -held);
        return kinetic + held;
    }

    PhysicsWorld& world_;
    double gravity_;
    std::vector<double> masses_;  // [particles]
    std::vector<Vec2> places_;
    double weight_ = 0, start_ = 0, fell_ = 0;
};

constexpr double kSize = 40;

SoftBodyDef unevenBall(const Vec2& centre, double ks, double ratio)
{
    SoftBodyDef def = softBall(centre, kSize / 2, ks, 0, 12, 2);
    for (std::size_t i = 0; i < def.masses.size(); ++i) def.masses[i] = i % 2 == 0 ? ratio : 1;
    return def;
}

JointDef hold(JointDef::Kind kind, const Vec2& at, BodyHandle a, double radiusA, BodyHandle b, double radiusB)
{
    JointDef def;
    def.kind = kind;
    def.a = {a, at, radiusA}, def.b = {b, at, radiusB};
    return def;
}

/// A push that lifts a weight, or strains springs, is owed for: what is in debt does not push on.
TEST(SoftEnergy, ARailThatCannotBeMetDoesNotLiftWhatHangsOnIt)
{
    for (const double ks : {1e3, 1e5}) {
        for (const double creep : {120.0, 1000.0}) {
            for (const double radius : {14.0, 23.0}) {
                for (const double angle : {0.2, 2.5}) {
                    auto world = makeWorld({0, 98.1});
                    Energy energy(*world, 98.1);
                    SoftBodyDef def = unevenBall({0, 0}, ks, 1e4);
                    def.matter.yield = 0.01, def.matter.creep = creep, def.matter.mostFlow = 0.9;
                    energy.add(def);
                    JointDef rail = hold(JointDef::Kind::Prismatic, {-8, 5}, kNoHandle, 0, 0, radius);
                    rail.axis = {std::cos(angle), std::sin(angle)};
                    rail.limited = true, rail.lower = -8, rail.upper = 5;
                    world->addJoint(rail);
                    EXPECT_LT(energy.mostGain(10, 1.0 / 30, kSize), 0.1)
                        << ks << " creep " << creep << " radius " << radius << " angle " << angle;
                }
            }
        }
    }
}

/// Pushes work against what keeps the area, too, which gives it back.
TEST(SoftEnergy, BodiesThatKeepTheirAreaGainNothingFromJointsThatPressThem)
{
    for (const double ks : {0.05, 0.5}) {
        for (const double ratio : {1.0, 12.0}) {
            for (const double area : {125.0, 1e4, 1e6}) {
                auto world = makeWorld({0, 300});
                Energy energy(*world, 300);
                for (int i = 0; i < 2; ++i) {
                    SoftBodyDef def = unevenBall({45.0 * i, 0}, ks, ratio);
                    for (SpringDef& spring : def.springs) spring.kd = 1;
                    def.matter.areaStiffness = area;
                    energy.add(def);
                }
                world->addJoint(hold(JointDef::Kind::Revolute, {22, 0}, 0, 19, 1, 23));
                world->addJoint(hold(JointDef::Kind::Weld, {-5, 8}, kNoHandle, 0, 0, 16));
                EXPECT_LT(energy.mostGain(5, 1.0 / 240, kSize), 0.1) << ks << " " << ratio << " " << area;
            }
        }
    }
}

/// A patch that is crushed turns over at once, and its best fit with it; no spring is wound by that.
TEST(SoftEnergy, AnElasticWeldToAPatchThatIsCrushedGainsNothing)
{
    for (const double hertz : {12.0, 60.0}) {
        for (const JointDef::Kind beside : {JointDef::Kind::Weld, JointDef::Kind::Revolute}) {
            auto world = makeWorld({0, 50});
            Energy energy(*world, 50);
            for (int i = 0; i < 2; ++i) {
                SoftBodyDef def = unevenBall({45.0 * i, 0}, 4e4, 1e4);
                def.matter.yield = 0.01, def.matter.creep = 500, def.matter.mostFlow = 0.5;
                energy.add(def);
            }
            JointDef weld = hold(JointDef::Kind::Weld, {22, 0}, 0, 25, 1, 25);
            weld.hertz = hertz, weld.dampingRatio = 0.05;
            world->addJoint(weld);
            world->addJoint(hold(beside, {-12, 3}, kNoHandle, 0, 0, 22));
            EXPECT_LT(energy.mostGain(6, 1.0 / 60, kSize), 0.1) << hertz << " beside " << static_cast<int>(beside);
        }
    }
}

/// Pushes work against the springs to a twin, too.
TEST(SoftEnergy, CompositeBodiesGainNothingFromJointsThatPressThem)
{
    struct Case {
        double ks, radius;
        bool heavyRing;  // else every other particle
    };
    for (const auto& [ks, radius, heavyRing] : {Case{1e4, 18, true}, {3e3, 25, false}}) {
        for (const double dt : {1.0 / 60, 1.0 / 240}) {
            auto world = makeWorld({0, 50});
            Energy energy(*world, 50);
            for (int i = 0; i < 2; ++i) {
                SoftBodyDef def = unevenBall({45.0 * i, 0}, ks, 100);
                for (std::size_t k = 0; heavyRing && k < def.masses.size(); ++k) def.masses[k] = k > 12 ? 100 : 1;
                for (SpringDef& spring : def.springs) spring.kd = 0;
                def.matter.shapeStiffness = ks, def.matter.shapeDamping = 0;
                energy.add(def);
            }
            world->addJoint(hold(JointDef::Kind::Weld, {-12, 3}, kNoHandle, 0, 0, radius));
            world->addJoint(hold(JointDef::Kind::Weld, {22, 0}, 0, radius, 1, radius));
            double most = 0;
            for (int i = 0; i < static_cast<int>(std::lround(4 / dt)); ++i) {
                energy.step(dt);
                if (i % 4 == 0) most = std::max(most, energy.now());
            }
            EXPECT_LT(most, 0.01 * energy.weight() * kSize) << ks << ", " << dt;
        }
    }
}

/// Springs flow by the strain half way along their last move: where they swing in a few substeps that before and that
/// after it have opposite signs, and what flows by either feeds the swing.
TEST(SoftEnergy, WhatFlowsWhileItSwingsInFewSubstepsGainsNothing)
{
    struct Case {
        double ks, ratio, dt;
    };
    for (const auto& [ks, ratio, dt] : {Case{3e4, 3e3, 1.0 / 120}, {1e5, 4e2, 1.0 / 240}}) {
        auto world = makeWorld({0, 50});
        Energy energy(*world, 50);
        SoftBodyDef def = unevenBall({0, 0}, ks, ratio);
        def.matter.yield = 0.01, def.matter.creep = 1000, def.matter.mostFlow = 0.7;
        energy.add(def);
        world->addJoint(hold(JointDef::Kind::Weld, {-12, 3}, kNoHandle, 0, 0, 18));
        double most = 0;
        for (int i = 0; i < static_cast<int>(std::lround(6 / dt)); ++i) {
            energy.step(dt);
            if (i % 10 == 0) most = std::max(most, energy.now());
        }
        EXPECT_LT(most, 0.01 * energy.weight() * kSize) << ks;
    }
}

/// An arm that passes the centre turns by half a turn at once. What its spring holds then, nobody gave.
TEST(SoftEnergy, AnAngularSpringWhoseArmPassesItsCentreGivesNoMoreThanItTook)
{
    constexpr double kArm = 10, kSpeed = 60;
    for (const double ks : {1e2, 1e4, 1e6}) {
        for (const double beside : {0.01, 0.3, 1.0}) {
            for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
                auto world = makeWorld({0, 0});
                SoftBodyDef def;
                def.particles = {{kArm, 0}, {0, 0}, {beside, kArm}};
                def.masses = {1, 1, 1};
                def.movable = {0, 0, 1};
                def.angularSprings = {{0, 1, 2, std::atan2(kArm, beside), ks, 0}};
                def.common.velocity = {0, -kSpeed};
                world->addSoftBody(def);
                Vec2 before = def.particles[2];
                double fastest = 0;
                for (int i = 0; i < static_cast<int>(std::lround(2 / dt)); ++i) {
                    world->step(dt);
                    const Vec2 now = pointsOf(*world, 0)[2];
                    fastest = std::max(fastest, (now - before).norm() / dt);
                    before = now;
                }
                EXPECT_LT(fastest, 1.05 * kSpeed) << ks << ", " << beside << " beside it, " << dt;
            }
        }
    }
}

/// A motor gives force times way, and joints beside it do not multiply that.
TEST(SoftEnergy, WhatAMotorDrivesHasNoMoreThanItGave)
{
    for (const double ks : {0.01, 0.1}) {
        for (const double ratio : {1e2, 1e4}) {
            constexpr double kForce = 3, kSpeed = 8, kSeconds = 6;
            auto world = makeWorld({0, 13});
            Energy energy(*world, 13);
            energy.add(unevenBall({0, 0}, ks, ratio));
            JointDef rail = hold(JointDef::Kind::Prismatic, {5, 2}, kNoHandle, 0, 0, 14);
            rail.axis = {0.6, 0.8}, rail.driven = true, rail.motorSpeed = kSpeed, rail.maxForce = kForce;
            world->addJoint(rail);
            world->addJoint(hold(JointDef::Kind::Revolute, {-12, -2}, kNoHandle, 0, 0, 10));
            EXPECT_LT(energy.mostGain(kSeconds, 1.0 / 120, kSize),
                      0.1 + kForce * kSpeed * kSeconds / (energy.weight() * kSize))
                << ks << " " << ratio;
        }
    }
}

/// Points that are far apart when they are joined would turn the whole if the impulses acted at each.
TEST(SoftEnergy, AWeldOfPointsFarApartKeepsTheAngularMomentum)
{
    for (const double apart : {5.0, 25.0}) {
        auto world = makeWorld({0, 0});
        const SoftBodyDef ball = softBall({0, 0}, 20, 2000, 4);
        world->addSoftBody(ball);
        world->addRigidBody(box({45 + apart / 2, 0}, 20, 20, 1));
        JointDef weld = hold(JointDef::Kind::Weld, {15, 0}, 0, 10, 1, 0);
        weld.b.point = {15 + apart, 0};
        world->addJoint(weld);
        world->setVelocity(1, {0, 40});
        const double start = 0.5 * (45 + apart / 2) * 40;  // m v r about the centre of both, half of each mass and way
        run(*world, 4);
        const BodyStates now = world->bodies();
        const Vec2 way = now.position[1] - now.position[0], speed = now.velocity[1] - now.velocity[0];
        double spin = 0.5 * cross(way, speed) + 1.0 / 6 * 400 * now.omega[1];
        for (const Vec2& p : pointsOf(*world, 0))
            spin += (p - now.position[0]).squaredNorm() / static_cast<double>(ball.masses.size()) * now.omega[0];
        EXPECT_NEAR(spin, start, 0.02 * start) << apart;
    }
}

}  // namespace

}  // namespace jet::physics::test
