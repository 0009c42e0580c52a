// What engines refuse: the sentence names the engine, the item, the field, the value and the range.
#include <jet/physics_checks.hpp>
#include <jet/physics_removal.hpp>
#include <jet/result.hpp>
#include <jet/value.hpp>

#include <gmock/gmock.h>

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

TEST(ActuatorKind, HasANameForMessages)
{
    std::string names;
    for (const auto kind : {ActuatorKind::Spring, ActuatorKind::AngularSpring, ActuatorKind::Torque,
                            ActuatorKind::Force, ActuatorKind::ForceField})
        names.append(nameOf(kind)).append(", ");
    EXPECT_EQ(names, "spring, angular spring, torque, force, force field, ");
    EXPECT_EQ(refusalOf([] { nameOf(static_cast<ActuatorKind>(9)); }), "Physics: there is no such kind of actuator.");
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

std::string polygonRefusal(std::vector<Vec2> points)
{
    return refusalOf([&] { kChecks.check("body 1", ShapeDef{ShapeDef::Kind::Polygon, std::move(points), 0}, false); });
}

TEST(PhysicsChecks, PolygonsEncloseAnAreaAreConvexAndHaveEachPointOnce)
{
    EXPECT_EQ(polygonRefusal({{0, 0}, {4, 0}, {4, 3}, {0, 3}}), "");
    EXPECT_EQ(polygonRefusal({{0, 3}, {4, 3}, {4, 0}, {0, 0}}), "") << "in either direction";
    EXPECT_EQ(polygonRefusal({{0, 0}, {2, 1e-9}, {4, 0}, {4, 3}}), "") << "what rounding pushed in";
    const std::string flat = "Toy: body 1: a polygon of its shape encloses no area; draw one that does.";
    EXPECT_EQ(polygonRefusal({{5, 5}, {5, 5}, {5, 5}}), flat);
    EXPECT_EQ(polygonRefusal({{0, 0}, {4, 0}, {9, 0}}), flat);
    EXPECT_EQ(polygonRefusal({{0, 0}, {4e-13, 0}, {4e-13, 3e-13}}), flat);
    EXPECT_EQ(polygonRefusal({{0, 0}, {4, 0}, {4, 0}, {4, 3}}),
              "Toy: body 1: a polygon of its shape has its points 1 and 2 at one place; leave one of them out.");
    const std::string hollow = "Toy: body 1: a polygon of its shape is not convex; give such an outline as borders.";
    EXPECT_EQ(polygonRefusal({{0, 0}, {4, 0}, {1, 1}, {0, 4}}), hollow);
    EXPECT_EQ(polygonRefusal({{0, -5}, {3, 4}, {-5, -2}, {5, -2}, {-3, 4}}), hollow) << "turns one way, but twice";
}

TEST(PhysicsChecks, ChainsAndCapsulesHaveALength)
{
    const auto refusal = [](ShapeDef shape) { return refusalOf([&] { kChecks.check("body 1", shape, true); }); };
    EXPECT_EQ(refusal({ShapeDef::Kind::Capsule, {{1, 1}, {1, 1}}, 2}),
              "Toy: body 1: both points of its capsule are at one place; use a circle instead.");
    EXPECT_EQ(refusal({ShapeDef::Kind::Chain, {{1, 1}, {1, 1}, {1, 1}}, 0}),
              "Toy: body 1: the points of its chain are all at one place; a chain needs two different ones.");
    EXPECT_EQ(refusal({ShapeDef::Kind::Chain, {{1, 1}, {1, 1}, {2, 1}}, 0}), "");
}

TEST(PhysicsChecks, WhatWouldBeLostInSquaresAndQuotientsIsRefused)
{
    EXPECT_EQ(refusalOf([] { kChecks.checkMass(3, 1e-320); }),
              "Toy: body 3: mass is " + numberText(1e-320) + "; it must be " + numberText(1e-6) + " or more.");
    RigidBodyDef rigid;
    rigid.borders = {{{0, 0}, {1e-150, 0}, {0, 1e-150}}};
    EXPECT_THAT(refusalOf([&] { kChecks.check(2, rigid, 1); }), testing::StartsWith("Toy: body 2: its size is "));
    SoftBodyDef soft;
    soft.particles = {{0, 0}, {1e-150, 0}};
    soft.masses = {1, 1e-9};
    EXPECT_THAT(refusalOf([&] { kChecks.check(2, soft, 1); }), testing::StartsWith("Toy: body 2: particle 1's mass"));
    soft.masses = {1, 1};
    EXPECT_THAT(refusalOf([&] { kChecks.check(2, soft, 1); }), testing::StartsWith("Toy: body 2: its size is "));
    soft.particles = {{3, 0}, {3, 0}};
    EXPECT_EQ(refusalOf([&] { kChecks.check(2, soft, 1); }), "") << "at one place they have none";
    EXPECT_THAT(refusalOf([] {
                    kChecks.check("a cast", ShapeDef{ShapeDef::Kind::Circle, {{0, 0}}, 1e-300}, false);
                }),
                testing::StartsWith("Toy: a cast: the radius of its shape is "));
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
    for (const Simd simd : {Simd::Automatic, Simd::Sse2, Simd::Avx2, Simd::Avx512}) {
        WorldSettings settings;
        settings.simd = simd;
        EXPECT_EQ(refusalOf([&] { kChecks.check(settings); }), "");
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
