// Joints of every kind against the mechanics they stand for, springs and angular springs between bodies.
#include "lab.hpp"

namespace jet::conformance {

namespace {

using Kind = JointDef::Kind;

Outcome revolute(const Lab& lab)
{
    // T = 2 pi sqrt((I + m l²) / (m g l)) for small swings; a disc has I = m r² / 2.
    const double g = 100, l = 50, r = 5, start = 0.05;
    const auto world = lab.world({0, g});
    const BodyHandle bob = world->addRigidBody(disc({l * std::sin(start), l * std::cos(start)}, r));
    world->addJoint(joint(Kind::Revolute, background({0, 0}), on(bob, {0, 0})));
    Period period;
    double stretch = 0;
    for (int i = 1; i <= 1200; ++i) {
        world->step(kStep);
        period.add(at(*world, bob).x(), i * kStep);
        stretch = std::max(stretch, std::abs(at(*world, bob).norm() - l));
    }
    const double should = 2 * kPi * std::sqrt((r * r / 2 + l * l) / (g * l));
    return measured(percentOff(period.seconds(), should), "% of the period", 1,
                    "off its pivot by " + std::to_string(stretch).substr(0, 6) + " units");
}

Outcome swinging(const Lab& lab)
{
    // Nothing slows down what turns about a hinge, or on a rod; two seconds at 2 rad/s.
    double off = 0;
    for (const Kind kind : {Kind::Revolute, Kind::Distance}) {
        const auto world = lab.world({0, 0});
        RigidBodyDef def = disc({40, 0}, 5);
        def.common.velocity = {0, 80}, def.common.omega = 2;
        const BodyHandle bob = world->addRigidBody(def);
        world->addJoint(joint(kind, background({0, 0}), on(bob, kind == Kind::Distance ? Vec2(40, 0) : Vec2(0, 0))));
        run(*world, 2);
        off = std::max(off, percentOff(world->bodies().velocity[bob].norm(), 80));
    }
    return measured(off, "% of its speed", 10, "2 s at 2 rad/s, on a hinge and on a rod");
}

Outcome revoluteLimit(const Lab& lab)
{
    const auto world = lab.world({0, 200});
    const BodyHandle lever = world->addRigidBody(box({20, 0}, 40, 6));
    JointDef def = joint(Kind::Revolute, background({0, 0}), on(lever, {0, 0}));
    def.limited = true, def.lower = -0.2, def.upper = 0.5;
    const JointHandle hinge = world->addJoint(def);
    run(*world, 4);
    return measured(std::abs(world->joint(hinge).value - 0.5), "rad", 0.04);
}

Outcome revoluteMotor(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle wheel = world->addRigidBody(disc({0, 0}, 10, 2));
    JointDef def = joint(Kind::Revolute, background({0, 0}), on(wheel, {0, 0}));
    def.driven = true, def.motorSpeed = 3, def.maxTorque = 50;
    const JointHandle motor = world->addJoint(def);
    run(*world, 0.5);
    double off = percentOff(omega(*world, wheel), 50 * 0.5 / 100);
    run(*world, 10);
    off = std::max(off, percentOff(omega(*world, wheel), 3));
    world->setMotor(motor, true, -1);
    run(*world, 10);
    off = std::max(off, percentOff(omega(*world, wheel), -1));
    return measured(off, "% of τ t / I, of its speed", 0.5);
}

Outcome prismatic(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle slider = world->addRigidBody(box({0, 0}, 10, 10));
    JointDef def = joint(Kind::Prismatic, background({0, 0}), on(slider, {0, 0}));
    def.axis = {1, 1}, def.limited = true, def.lower = -10, def.upper = 30;
    const JointHandle rail = world->addJoint(def);
    double aside = 0;
    for (int i = 0; i < 240; ++i) {
        world->step(kStep);
        const Vec2 p = at(*world, slider);
        aside = std::max(aside, std::abs(p.x() - p.y()) / std::numbers::sqrt2);
    }
    return measured(std::max(aside, std::abs(world->joint(rail).value - 30)), "units off the rail or its end", 0.3);
}

Outcome prismaticMotor(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle slider = world->addRigidBody(box({0, 0}, 10, 10, 4));
    JointDef def = joint(Kind::Prismatic, background({0, 0}), on(slider, {0, 0}));
    def.driven = true, def.motorSpeed = 20, def.maxForce = 40;
    world->addJoint(def);
    run(*world, 1);
    double off = percentOff(velocity(*world, slider).x(), 10);
    run(*world, 5);
    off = std::max(off, percentOff(velocity(*world, slider).x(), 20));
    return measured(off, "% of F t / m, of its speed", 0.5);
}

Outcome weld(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle beam = world->addRigidBody(box({20, 0}, 40, 8));
    world->addJoint(joint(Kind::Weld, background({0, 0}), on(beam, {0, 0})));
    run(*world, 3);
    return measured((at(*world, beam) - Vec2(20, 0)).norm(), "units of sag", 0.5, "a cantilever of 40 units");
}

Outcome distance(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle bob = world->addRigidBody(disc({30, 0}, 3));
    world->addJoint(joint(Kind::Distance, background({0, 0}), on(bob, {30, 0})));
    double worst = 0;
    for (int i = 0; i < 300; ++i) world->step(kStep), worst = std::max(worst, std::abs(at(*world, bob).norm() - 30));
    return measured(worst / 30 * 100, "% of the length", 1.5, "swinging");
}

Outcome distanceSpring(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle ball = world->addRigidBody(disc({0, 30}, 3));
    JointDef def = joint(Kind::Distance, background({0, 0}), on(ball, {0, 30}));
    def.hertz = 1, def.dampingRatio = 0, def.length = 25;
    world->addJoint(def);
    Period period;
    double most = 0;
    for (int i = 1; i <= 360; ++i) {
        world->step(kStep);
        period.add(at(*world, ball).y() - 25, i * kStep);
        most = std::max(most, at(*world, ball).y());
    }
    if (most > 30.5) return holds(false, "it gains energy");
    return measured(percentOff(period.seconds(), 1), "% of the period", 3, "1 Hz, undamped");
}

Outcome rope(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle weight = world->addRigidBody(disc({10, 0}, 3));
    JointDef def = joint(Kind::Rope, background({0, 0}), on(weight, {10, 0}));
    def.length = 40;
    world->addJoint(def);
    world->step(kStep);
    if (percentOff(velocity(*world, weight).y(), 100 * kStep) > 1) return holds(false, "a slack rope holds");
    double longest = 0;
    for (int i = 0; i < 600; ++i) world->step(kStep), longest = std::max(longest, at(*world, weight).norm());
    return measured(std::max(0.0, longest / 40 - 1) * 100, "% too long", 2);
}

Outcome wheel(const Lab& lab)
{
    // At rest the spring of frequency f under a mass is pressed by g / (2 pi f)².
    const auto world = lab.world({0, 100});
    const BodyHandle body = world->addRigidBody(disc({0, 0}, 5, 2));
    JointDef def = joint(Kind::Wheel, background({0, 0}), on(body, {0, 0}));
    def.axis = {0, 1}, def.hertz = 1.5, def.dampingRatio = 0.5, def.driven = true, def.motorSpeed = 4,
    def.maxTorque = 1e5;
    world->addJoint(def);
    run(*world, 8);
    const double should = 100 / (2 * kPi * 1.5) / (2 * kPi * 1.5);
    const double worst = std::max(percentOff(at(*world, body).y(), should), percentOff(omega(*world, body), 4));
    return measured(worst, "% of g / (2 π f)², of its speed", 2);
}

Outcome motor(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle body = world->addRigidBody(box({0, 0}, 10, 10, 2));
    JointDef def = joint(Kind::Motor, background({0, 0}), on(body, {0, 0}));
    def.driven = true, def.motorVelocity = {30, 0}, def.motorSpeed = 2, def.maxForce = 40, def.maxTorque = 1e5;
    world->addJoint(def);
    run(*world, 1);
    double off = percentOff(velocity(*world, body).x(), 20);
    run(*world, 5);
    off = std::max({off, percentOff(velocity(*world, body).x(), 30), percentOff(omega(*world, body), 2)});
    return measured(off, "% of F t / m, of its speeds", 1);
}

Outcome mouse(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle body = world->addRigidBody(disc({0, 0}, 5));
    JointDef def = joint(Kind::Mouse, background({0, 0}), on(body, {0, 0}));
    def.hertz = 5, def.maxForce = 1e6;
    const JointHandle handle = world->addJoint(def);
    world->setJointTarget(handle, {40, -30});
    run(*world, 3);
    return measured((at(*world, body) - Vec2(40, -30)).norm(), "units off its target", 0.2);
}

/// What a hand does that drags a body: far away it pulls with all its force, an even pointer it follows as its damping
/// says, and between grabs it is not there.
Outcome dragging(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle body = world->addRigidBody(disc({0, 0}, 5, 2));
    const double hertz = 5, zeta = 0.9, speed = 60;
    JointDef def = joint(Kind::Mouse, background({0, 0}), on(body, {0, 0}));
    def.hertz = hertz, def.dampingRatio = zeta, def.maxForce = 100;
    const JointHandle weak = world->addJoint(def);
    world->setJointTarget(weak, {1000, 0});
    run(*world, 1);
    double off = percentOff(velocity(*world, body).x(), 100 * 1.0 / 2);
    world->removeJoint(weak);
    const Vec2 flying = velocity(*world, body);
    run(*world, 0.5);
    if ((velocity(*world, body) - flying).norm() > 0.01) return holds(false, "what is let go does not fly on");
    // The lag of a damped spring at an even speed: 2 zeta v / w.
    def.a = background(at(*world, body)), def.b = on(body, at(*world, body)), def.maxForce = 1e6;
    const JointHandle strong = world->addJoint(def);
    Vec2 pointer = at(*world, body);
    for (int i = 0; i < 120; ++i) {
        pointer += Vec2(0, speed * kStep);
        world->setJointTarget(strong, pointer);
        world->step(kStep);
    }
    // The pointer moves in steps, and the body in between.
    const double lag = 2 * zeta * speed / (2 * kPi * hertz), behind = pointer.y() - at(*world, body).y();
    if (std::abs(behind - lag) > speed * kStep)
        return holds(false,
                     "it follows a pointer " + std::to_string(behind) + " units behind, not " + std::to_string(lag));
    return measured(off, "% of F t / m", 1,
                    "lag " + std::to_string(behind).substr(0, 5) + " of " + std::to_string(lag).substr(0, 5) +
                        " units");
}

Outcome pulley(const Lab& lab)
{
    // Atwood's machine: a = g (M - m) / (M + m).
    const auto world = lab.world({0, 100});
    const BodyHandle light = world->addRigidBody(disc({-20, 60}, 3, 1)),
                     heavy = world->addRigidBody(disc({20, 60}, 3, 3));
    JointDef def = joint(Kind::Pulley, on(light, {-20, 60}), on(heavy, {20, 60}));
    def.groundA = {-20, 0}, def.groundB = {20, 0};
    world->addJoint(def);
    run(*world, 0.5);
    const double stretch = std::abs(at(*world, light).y() + at(*world, heavy).y() - 120);
    return measured(percentOff(at(*world, heavy).y() - 60, 0.5 * 50 * 0.25), "% of g (M - m) / (M + m) t² / 2", 4,
                    "rope off by " + std::to_string(stretch).substr(0, 6) + " units");
}

Outcome breaking(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle held = world->addRigidBody(disc({0, 20}, 3, 2)), lost = world->addRigidBody(disc({100, 20}, 3, 6));
    JointDef def = joint(Kind::Rope, background({0, 0}), on(held, {0, 20}));
    def.breakForce = 400;
    const JointHandle first = world->addJoint(def);
    def.a.point = {100, 0}, def.b = on(lost, {100, 20});
    const JointHandle second = world->addJoint(def);
    run(*world, 2);
    return holds(!world->joint(first).broken && world->joint(second).broken && at(*world, lost).y() > 100,
                 "a rope that carries 400 broke at 200, or held 600");
}

Outcome reaction(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle body = world->addRigidBody(disc({0, 30}, 3, 4));
    const JointHandle pin = world->addJoint(joint(Kind::Revolute, background({0, 0}), on(body, {0, 0})));
    run(*world, 3);
    return measured((world->joint(pin).force - Vec2(0, -400)).norm() / 4, "% of the weight", 2, "force of a pin");
}

Outcome removing(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle a = world->addRigidBody(box({0, 0}, 10, 10)), b = world->addRigidBody(box({12, 0}, 10, 10));
    world->addJoint(joint(Kind::Weld, background({0, 0}), on(a, {0, 0})));
    const JointHandle second = world->addJoint(joint(Kind::Weld, on(a, {6, 0}), on(b, {6, 0})));
    run(*world, 1);
    const bool held = at(*world, b).y() < 2;
    world->removeJoint(second);
    run(*world, 1);
    return holds(held && at(*world, b).y() > 40, held ? "a removed joint holds on" : "two welds do not hold two boxes");
}

Outcome chain(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    BodyHandle last = kNoHandle;
    for (int i = 0; i < 20; ++i) {
        const BodyHandle link = world->addRigidBody(box({5.0 + 10 * i, 0}, 10, 3));
        world->addJoint(joint(Kind::Revolute, {last, {10.0 * i, 0}, 0}, on(link, {10.0 * i, 0})));
        last = link;
    }
    run(*world, 10);
    double worst = 0;
    for (JointHandle j = 0; j < 20; ++j)
        worst = std::max(worst, (world->joint(j).pointA - world->joint(j).pointB).norm());
    return measured(worst, "units apart", 1, "20 links, 10 s");
}

Outcome drawnBodies(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle body = world->addRigidBody(drawn({boxRing({20, 0}, 40, 8)}));
    world->addJoint(joint(Kind::Weld, background({0, 0}), on(body, {0, 0})));
    run(*world, 2);
    return measured((at(*world, body) - Vec2(20, 0)).norm(), "units of sag", 0.5, "a body as drawings make them");
}

Outcome springPeriod(const Lab& lab)
{
    double worst = 0;
    for (const double ks : {1.0, 10.0, 100.0}) {
        const auto world = lab.world({0, 0});
        const BodyHandle body = world->addRigidBody(disc({0, 60}, 5, 2));
        world->addSpring({background({0, 0}), on(body, {0, 60}), 50, ks, 0, 0});
        Period period;
        const double should = 2 * kPi * std::sqrt(2 / ks);
        for (int i = 1; i * kStep < 5 * should; ++i)
            world->step(kStep), period.add(at(*world, body).y() - 50, i * kStep);
        worst = std::max(worst, percentOff(period.seconds(), should));
    }
    return measured(worst, "% of 2 π √(m / ks)", 2.5, "between a body and the background, ks 1 … 100");
}

Outcome springTears(const Lab& lab)
{
    const auto world = lab.world({0, 100});
    const BodyHandle held = world->addRigidBody(disc({0, 20}, 3)), lost = world->addRigidBody(disc({50, 20}, 3));
    // At rest 10 units longer than its 20; swinging, 20.
    world->addSpring({background({0, 0}), on(held, {0, 20}), 20, 10, 0, 2.1});
    world->addSpring({background({50, 0}), on(lost, {50, 20}), 20, 10, 0, 1.9});
    run(*world, 4);
    return holds(at(*world, held).y() < 45 && at(*world, lost).y() > 100,
                 "a spring that is to tear at 1.9 of its length held, or one at 2.1 did not");
}

Outcome stiffSprings(const Lab& lab)
{
    double fastest = 0;
    for (const double ks : {1e3, 1e6, 1e9}) {
        const auto world = lab.world({0, 0});
        const BodyHandle a = world->addRigidBody(disc({0, 0}, 5, 0.01)), b = world->addRigidBody(disc({22, 0}, 5, 100));
        world->addSpring({on(a, {3, 3}), on(b, {22, 0}), 18, ks, 0.1, 0});
        const double energy = 0.5 * ks * 2 * 2;
        for (int i = 0; i < 300; ++i) {
            world->step(kStep);
            const double now =
                0.5 * 0.01 * velocity(*world, a).squaredNorm() + 0.5 * 100 * velocity(*world, b).squaredNorm();
            fastest = std::max(fastest, now / energy);
        }
    }
    return measured(fastest, "of the energy put in", 1.02, "ks to 10⁹, masses 1 : 10,000");
}

Outcome angularSpring(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle arm = world->addRigidBody(box({0, 20}, 4, 40, 2));
    world->addJoint(joint(Kind::Revolute, background({0, 0}), on(arm, {0, 0})));
    AngularSpringActuatorDef def;
    def.a = background({40, 0}), def.centre = background({0, 0}), def.b = on(arm, {0, 40});
    def.ks = 4000, def.kd = 0;
    world->addAngularSpring(def);
    world->setOmega(arm, 0.5);
    world->setVelocity(arm, {-10, 0});
    Period period;
    for (int i = 1; i <= 900; ++i) world->step(kStep), period.add(world->bodies().angle[arm], i * kStep);
    const double inertia = 2 * (16 + 1600) / 12.0 + 2 * 400;
    return measured(percentOff(period.seconds(), 2 * kPi * std::sqrt(inertia / 4000)), "% of 2 π √(I / ks)", 2);
}

}  // namespace

std::vector<Check> jointChecks()
{
    return {{"joints", "revolute", revolute},
            {"joints", "revolute, limits", revoluteLimit},
            {"joints", "revolute, motor", revoluteMotor},
            {"joints", "prismatic, limits", prismatic},
            {"joints", "prismatic, motor", prismaticMotor},
            {"joints", "weld", weld},
            {"joints", "distance", distance},
            {"joints", "distance, elastic", distanceSpring},
            {"joints", "rope", rope},
            {"joints", "wheel", wheel},
            {"joints", "motor", motor},
            {"joints", "mouse", mouse},
            {"joints", "mouse, dragging", dragging},
            {"joints", "pulley", pulley},
            {"joints", "breaking", breaking},
            {"joints", "reaction force", reaction},
            {"joints", "removing", removing},
            {"joints", "chain of twenty", chain},
            {"joints", "what swings keeps its speed", swinging},
            {"joints", "drawn bodies", drawnBodies},
            {"springs between bodies", "period", springPeriod},
            {"springs between bodies", "tearing", springTears},
            {"springs between bodies", "any stiffness", stiffSprings},
            {"springs between bodies", "angular spring", angularSpring}};
}

}  // namespace jet::conformance
