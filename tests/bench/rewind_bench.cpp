// What keeping the last ten seconds costs: saving and packing a state beside the step itself, the memory of 600 states,
// and going back to one, with JET's engine and Box2D's in worlds of rigid boxes, and with soft balls.
#include "bench/summary.hpp"

#include <jet/rewind.hpp>
#include <jet/testing/catalog.hpp>

#include <jet/physics.hpp>

#include <cmath>
#include <cstdio>

namespace {

using namespace jet;
constexpr double kStep = 1.0 / 60;
constexpr int kSteps = 600;

RigidBodyDef box(const Vec2& at, double size, bool fixed)
{
    RigidBodyDef def;
    const Vec2 half = fixed ? Vec2(2000, 50) : Vec2(size / 2, size / 2);
    def.shapes = {{ShapeDef::Kind::Polygon,
                   {at - half, at + Vec2(half.x(), -half.y()), at + half, at + Vec2(-half.x(), half.y())},
                   0}};
    def.common.fixed = fixed;
    return def;
}

SoftBodyDef ball(const Vec2& centre, double radius)
{
    constexpr int corners = 24;
    SoftBodyDef def;
    def.particles = {centre};
    auto& border = def.borders.emplace_back();
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 6.283185307179586 * i / corners;
        def.particles.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
        border.push_back(i + 1);
        def.springs.push_back({0, i + 1, radius, 100, 1, 0});
    }
    for (std::uint32_t i = 0; i < corners; ++i)
        for (const std::uint32_t k : {1U, 2U}) {
            const std::uint32_t a = i + 1, b = (i + k) % corners + 1;
            def.springs.push_back({a, b, (def.particles[a] - def.particles[b]).norm(), 100, 1, 0});
        }
    def.masses.assign(corners + 1, 1.0 / (corners + 1));
    return def;
}

void fill(PhysicsWorld& world, int rigid, int soft)
{
    world.addRigidBody(box({0, 50}, 0, true));
    for (int i = 0; i < rigid; ++i)
        world.addRigidBody(box({25.0 * (i % 20) + i % 7, -15.0 - 25 * (i / 20)}, 18, false));
    for (int i = 0; i < soft; ++i) world.addSoftBody(ball({-60.0 - 45 * (i % 6), -30.0 - 45 * (i / 6)}, 20));
}

void measure(bench::Summary& summary, const std::string& name, PhysicsEngine& engine, int rigid, int soft)
{
    WorldSettings settings;
    const auto world = engine.createWorld(settings);
    fill(*world, rigid, soft);
    RewindHistory history({10, std::size_t{256} << 20}, kStep);
    double stepping = 0, saving = 0, packing = 0;
    std::size_t size = 0;
    for (int i = 1; i <= kSteps; ++i) {
        const double start = bench::processorSeconds();
        world->step(kStep);
        const double stepped = bench::processorSeconds();
        const auto state = world->save();
        const double saved = bench::processorSeconds();
        history.record(static_cast<std::uint64_t>(i), state);
        stepping += stepped - start, saving += saved - stepped, packing += bench::processorSeconds() - saved;
        size += state.size();
    }
    double back = 0;
    for (const std::uint64_t step : {599U, 450U, 300U, 150U, 24U}) {
        const double start = bench::processorSeconds();
        world->restore(history.find(step)->bytes);
        back = std::max(back, bench::processorSeconds() - start);
    }
    const double kept = static_cast<double>(history.state().bytes);
    summary.note(name + ": step", 1e6 * stepping / kSteps, "µs");
    summary.note(name + ": save", 1e6 * saving / kSteps, "µs");
    summary.note(name + ": pack", 1e6 * packing / kSteps, "µs");
    summary.note(name + ": state", static_cast<double>(size) / kSteps / 1024, "kB");
    summary.note(name + ": 600 states", kept / 1048576, "MB");
    summary.note(name + ": packed to", 100 * kept / static_cast<double>(size), "%");
    summary.note(name + ": going back, slowest of five", 1e3 * back, "ms");
}

}  // namespace

int main(int argc, char** argv)
{
    return jet::bench::run(argc, argv, [](const jet::bench::Times&, jet::bench::Summary& summary) {
        jet::test::TestCatalog catalog{"org.jet.physics"};
        jet::PhysicsEngine& own = *catalog.physicsEngine("jet-physics");
        measure(summary, "60 boxes", own, 60, 0);
        measure(summary, "1,000 boxes", own, 1000, 0);
        measure(summary, "10,000 boxes", own, 10000, 0);
        measure(summary, "36 soft balls", own, 0, 36);
        try {
            catalog.load("org.jet.physics-box2d");
            measure(summary, "60 boxes on Box2D", *catalog.physicsEngine("physics-box2d"), 60, 0);
        } catch (const jet::Failure&) {  // built without Box2D
        }
    });
}
