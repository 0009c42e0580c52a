// What the checks share: outcomes, a laboratory that makes worlds of one engine, and bodies to put into them.
//
// A check builds a scene whose outcome a formula tells, runs it, and answers how far off the engine is. What the engine
// refuses with a Failure is "not supported"; what it takes and computes wrongly "falls short".
#pragma once

#include <jet/physics.hpp>
#include <jet/result.hpp>

#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace jet::conformance {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kStep = 1.0 / 60;

struct Outcome {
    enum class Verdict { Supported, Missing, Short };
    Verdict verdict = Verdict::Supported;
    double value = 0;  ///< how far off, in `unit`; less is better
    double bound = 0;  ///< the most that counts as supported
    std::string unit;  ///< empty: nothing was measured, it is so or not
    std::string note;
};

/// Supported when `value` is at most `bound`.
inline Outcome measured(double value, std::string unit, double bound, std::string note = {})
{
    return {value <= bound ? Outcome::Verdict::Supported : Outcome::Verdict::Short, value, bound, std::move(unit),
            std::move(note)};
}
inline Outcome holds(bool is, std::string otherwise)
{
    return {is ? Outcome::Verdict::Supported : Outcome::Verdict::Short, 0, 0, {}, is ? std::string() : otherwise};
}
inline double percentOff(double is, double should) { return 100 * std::abs(is / should - 1); }

class Lab {
public:
    explicit Lab(PhysicsEngine& engine) : engine_(engine) {}

    std::unique_ptr<PhysicsWorld> world(const WorldSettings& settings) const
    {
        auto made = engine_.createWorld(settings);
        if (!made) throw Failure(Error("the engine made no world"));
        return made;
    }
    std::unique_ptr<PhysicsWorld> world(const Vec2& gravity, double friction = 0.6, double restitution = 0) const
    {
        WorldSettings settings;
        settings.gravity = gravity;
        settings.materials = {MaterialPair{friction, restitution, true}};
        return world(settings);
    }

private:
    PhysicsEngine& engine_;
};

struct Check {
    std::string group, name;
    std::function<Outcome(const Lab&)> run;
};

std::vector<Check> motionChecks();
std::vector<Check> contactChecks();
std::vector<Check> changeChecks();
std::vector<Check> removalChecks();
std::vector<Check> jointChecks();
std::vector<Check> queryChecks();
std::vector<Check> stateChecks();
std::vector<Check> softChecks();

inline void run(PhysicsWorld& world, double seconds, double dt = kStep)
{
    for (int i = 0; i < static_cast<int>(std::lround(seconds / dt)); ++i) world.step(dt);
}
inline Vec2 at(const PhysicsWorld& world, BodyHandle body) { return world.bodies().position[body]; }
inline Vec2 velocity(const PhysicsWorld& world, BodyHandle body) { return world.bodies().velocity[body]; }
inline double omega(const PhysicsWorld& world, BodyHandle body) { return world.bodies().omega[body]; }

inline std::vector<Vec2> boxRing(const Vec2& centre, double width, double height, double angle = 0)
{
    const Affine turn = Affine::rotation(angle);
    std::vector<Vec2> ring;
    for (const Vec2& corner : {Vec2(-0.5, -0.5), Vec2(0.5, -0.5), Vec2(0.5, 0.5), Vec2(-0.5, 0.5)})
        ring.push_back(centre + turn.linear() * Vec2(corner.x() * width, corner.y() * height));
    return ring;
}
inline std::vector<Vec2> circleRing(const Vec2& centre, double radius, int corners)
{
    std::vector<Vec2> ring;
    for (int i = 0; i < corners; ++i)
        ring.push_back(centre + radius * Vec2(std::cos(2 * kPi * i / corners), std::sin(2 * kPi * i / corners)));
    return ring;
}
inline RigidBodyDef box(const Vec2& centre, double width, double height, double mass = 1, double angle = 0)
{
    RigidBodyDef def;
    def.shapes = {{ShapeDef::Kind::Polygon, boxRing(centre, width, height, angle), 0}};
    def.mass = mass;
    return def;
}
inline RigidBodyDef disc(const Vec2& centre, double radius, double mass = 1)
{
    RigidBodyDef def;
    def.shapes = {{ShapeDef::Kind::Circle, {centre}, radius}};
    def.mass = mass;
    return def;
}
/// As a drawing makes it.
inline RigidBodyDef drawn(std::vector<std::vector<Vec2>> borders, double mass = 1)
{
    RigidBodyDef def;
    def.borders = std::move(borders);
    def.mass = mass;
    return def;
}
inline RigidBodyDef fixed(RigidBodyDef def)
{
    def.common.fixed = true;
    return def;
}
inline RigidBodyDef moving(RigidBodyDef def, const Vec2& velocity, double omega = 0)
{
    def.common.velocity = velocity, def.common.omega = omega;
    return def;
}
/// A fixed slab whose upper side is y = top.
inline RigidBodyDef ground(double top, double width = 4000) { return fixed(box({0, top + 50}, width, 100)); }

/// A disc of rings of particles about a hub, mass 1.
inline SoftBodyDef softBall(const Vec2& centre, double radius, double ks = 200, double kd = 1, int corners = 24,
                            int rings = 3)
{
    SoftBodyDef def;
    def.particles = {centre};
    for (int ring = 1; ring <= rings; ++ring)
        for (const Vec2& p : circleRing(centre, radius * ring / rings, corners)) def.particles.push_back(p);
    def.masses.assign(def.particles.size(), 1.0 / static_cast<double>(def.particles.size()));
    const auto index = [&](int ring, int i) {
        return ring == 0 ? 0U : static_cast<std::uint32_t>(1 + (ring - 1) * corners + (i + corners) % corners);
    };
    const auto link = [&](std::uint32_t a, std::uint32_t b) {
        def.springs.push_back({a, b, (def.particles[a] - def.particles[b]).norm(), ks, kd, 0});
    };
    for (int ring = 1; ring <= rings; ++ring)
        for (int i = 0; i < corners; ++i) {
            link(index(ring, i), index(ring, i + 1));
            link(index(ring, i), index(ring - 1, i));
            if (ring > 1) link(index(ring, i), index(ring - 1, i + 1)), link(index(ring, i + 1), index(ring - 1, i));
        }
    auto& border = def.borders.emplace_back();
    for (int i = 0; i < corners; ++i) border.push_back(index(rings, i));
    return def;
}

/// Where the particles of a soft body are.
inline std::span<const Vec2> points(const PhysicsWorld& world, BodyHandle body)
{
    const BodyStates states = world.bodies();
    return states.points.subspan(states.firstPoint[body], states.firstPoint[body + 1] - states.firstPoint[body]);
}

inline JointDef joint(JointDef::Kind kind, const Anchor& a, const Anchor& b)
{
    JointDef def;
    def.kind = kind;
    def.a = a, def.b = b;
    return def;
}
inline Anchor background(const Vec2& point) { return {kNoHandle, point, 0}; }
inline Anchor on(BodyHandle body, const Vec2& point) { return {body, point, 0}; }

/// Numbers that look random and are the same everywhere.
class Numbers {
public:
    double operator()(double from, double to)
    {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return from + (to - from) * static_cast<double>(state_ >> 11) * 0x1.0p-53;
    }

private:
    std::uint64_t state_ = 42;
};

/// Times between upward passes of a value through zero.
class Period {
public:
    void add(double value, double time)
    {
        if (count_ > 0 && last_ < 0 && value >= 0) {
            const double when = time - (time - lastTime_) * value / (value - last_);
            if (crossings_++ == 0) first_ = when;
            latest_ = when;
        }
        last_ = value, lastTime_ = time, ++count_;
    }
    double seconds() const { return crossings_ > 1 ? (latest_ - first_) / (crossings_ - 1) : 0; }

private:
    int count_ = 0, crossings_ = 0;
    double last_ = 0, lastTime_ = 0, first_ = 0, latest_ = 0;
};

}  // namespace jet::conformance
