// What engines refuse: the sentence names the engine, the item, the field, the value and the range.
#include <jet/physics_checks.hpp>
#include <jet/result.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace jet {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const PhysicsChecks kChecks("Toy", {1000, 1e6});

std::string refusalOf(const std::function<void()>& act)
{
    try {
        act();
    } catch (const Failure& failure) {
        return failure.error().message;
    }
    return {};
}

JointDef jointOf(JointDef::Kind kind)
{
    JointDef def;
    def.kind = kind;
    def.b.body = 0;
    return def;
}

TEST(PhysicsChecks, NameItemFieldValueAndRange)
{
    EXPECT_EQ(refusalOf([] { kChecks.checkMass(3, -1); }), "Toy: body 3: mass is -1; it must be above 0.");
    EXPECT_EQ(refusalOf([] { kChecks.checkMass(3, kNan); }),
              "Toy: body 3: mass is not a number; it must be a number from -1000000 to 1000000.");
    EXPECT_EQ(refusalOf([] { kChecks.index("joint", 7, 2); }), "Toy: joint 7 does not exist; there are 2.");
    EXPECT_EQ(refusalOf([] {
                  kChecks.place("body 1", "position", {0, 2000});
              }),
              "Toy: body 1: position's y is 2000; it must be within 1000 units of the origin, where the engine can "
              "compute.");
    WorldSettings settings;
    settings.materials[0].restitution = 1.5;
    EXPECT_EQ(refusalOf([&] { kChecks.check(settings); }),
              "Toy: materials 0 and 0: restitution is 1.5; it must be from 0 to 1.");
}

TEST(PhysicsChecks, EachFieldOfAJointIsNamedByItself)
{
    const std::pair<double JointDef::*, const char*> kFields[] = {{&JointDef::maxForce, "maximal force"},
                                                                  {&JointDef::maxTorque, "maximal torque"},
                                                                  {&JointDef::hertz, "frequency"},
                                                                  {&JointDef::dampingRatio, "damping ratio"},
                                                                  {&JointDef::breakForce, "breaking force"}};
    for (const auto& [field, name] : kFields) {
        JointDef def = jointOf(JointDef::Kind::Wheel);
        def.*field = -2;
        EXPECT_EQ(refusalOf([&] { kChecks.check(5, def); }),
                  "Toy: joint 5 (wheel): " + std::string(name) + " is -2; it must be 0 or more.");
    }
    JointDef def = jointOf(JointDef::Kind::Revolute);
    def.lower = 2, def.upper = 1;
    EXPECT_EQ(refusalOf([&] { kChecks.check(0, def); }),
              "Toy: joint 0 (revolute): lower limit is 2; it must be no greater than the upper one, which is 1.");
    def = jointOf(JointDef::Kind::Pulley);
    def.ratio = 0;
    EXPECT_EQ(refusalOf([&] { kChecks.check(0, def); }), "Toy: joint 0 (pulley): ratio is 0; it must be above 0.");
    def.b.body = 4;
    EXPECT_EQ(refusalOf([&] { kChecks.checkAnchors(0, def, 2); }),
              "Toy: joint 0 (pulley): its body 4 does not exist; there are 2.");
    def.b.body = kNoHandle;
    EXPECT_NE(refusalOf([&] { kChecks.checkAnchors(0, def, 2); }).find("both its ends are in the background"),
              std::string::npos);
}

TEST(PhysicsChecks, AnAxisHasADirectionWhereOneIsNeeded)
{
    for (const JointDef::Kind kind : {JointDef::Kind::Prismatic, JointDef::Kind::Wheel}) {
        JointDef def = jointOf(kind);
        EXPECT_EQ(refusalOf([&] { kChecks.check(0, def); }), "");
        def.axis = {0, 0};
        EXPECT_NE(refusalOf([&] { kChecks.check(0, def); }).find("its axis is (0, 0)"), std::string::npos);
    }
    JointDef weld = jointOf(JointDef::Kind::Weld);
    weld.axis = {0, 0};
    EXPECT_EQ(refusalOf([&] { kChecks.check(0, weld); }), "");
}

TEST(PhysicsChecks, KindsThatThereAreNotAreRefused)
{
    JointDef joint = jointOf(static_cast<JointDef::Kind>(99));
    EXPECT_NE(refusalOf([&] { kChecks.check(2, joint); }).find("joint 2: its kind"), std::string::npos);
    ForceFieldDef field;
    field.kind = static_cast<ForceFieldDef::Kind>(9);
    EXPECT_NE(refusalOf([&] { kChecks.check(1, field); }).find("force field 1: its kind"), std::string::npos);
    ShapeDef shape;
    shape.kind = static_cast<ShapeDef::Kind>(9);
    EXPECT_NE(refusalOf([&] { kChecks.check("a cast", shape, false); }).find("kind of shape"), std::string::npos);
    for (const int which : {0, 1, 2}) {
        WorldSettings settings;
        if (which == 0) settings.precision = static_cast<Precision>(9);
        if (which == 1) settings.simd = static_cast<Simd>(9);
        if (which == 2) settings.method = static_cast<Method>(9);
        EXPECT_NE(refusalOf([&] { kChecks.check(settings); }), "") << which;
    }
}

TEST(PhysicsChecks, WhatTheContractDeclaresByDefaultIsTaken)
{
    EXPECT_EQ(refusalOf([] { kChecks.check(WorldSettings()); }), "");
    EXPECT_EQ(refusalOf([] { kChecks.check(0, RigidBodyDef(), 1); }), "");
    EXPECT_EQ(refusalOf([] { kChecks.check(0, SoftBodyDef(), 1); }), "");
    EXPECT_EQ(refusalOf([] { kChecks.check(0, ForceFieldDef()); }), "");
    EXPECT_EQ(refusalOf([] { kChecks.check(0, SpringActuatorDef(), 0); }), "");
    EXPECT_EQ(refusalOf([] { kChecks.check(0, AngularSpringActuatorDef(), 0); }), "");
    EXPECT_EQ(refusalOf([] { kChecks.check(0, JointDef()); }), "");
}

}  // namespace

}  // namespace jet
