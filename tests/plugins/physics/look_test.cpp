// A full look at eight pairs gives each of them what it gets alone, to the bit, with either instruction set: in heaps,
// in one place, thousands of units away, and with parts that are hardly there.
#include "rigid/look.hpp"
#include "rigid/manifold.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace jet::physics::test {

namespace {

struct World {
    std::vector<RigidContact> contacts;
    std::vector<Pose> poses;  // one a part
    std::vector<FatBox> boxes;
    std::vector<Part> parts;
    std::vector<float> surprise;
    LookInput input()
    {
        return {contacts.data(), poses.data(), boxes.data(), parts.data(), surprise.data(), 1.0F / 60};
    }
};

struct Told {
    bool meets = false, apart = false, reused = false, fast = false;
    float gap = 0, speed = 0;
};

Relative relative(const Pose& a, const Pose& b)
{
    return {turnedBack(a.turn, {static_cast<float>(b.x - a.x), static_cast<float>(b.y - a.y)}),
            turnedBack(a.turn, b.turn)};
}

float travelOf(const Pose& a, const Pose& b, float dt)
{
    const bool fromA = a.reach <= b.reach;
    const Vec2f arm{static_cast<float>(b.x - a.x), static_cast<float>(b.y - a.y)};
    const float omega = fromA ? b.omega : a.omega;
    const float dx = b.velocityX - a.velocityX + omega * arm.y, dy = b.velocityY - a.velocityY - omega * arm.x;
    return (std::sqrt(dx * dx + dy * dy) + std::abs(b.omega - a.omega) * (fromA ? a.reach : b.reach)) * dt;
}

float speedOf(const World& w, const RigidContact& c)
{
    const Pose &a = w.poses[c.bodyA], &b = w.poses[c.bodyB];
    const Vec2f n = turned(a.turn, c.normal), armA = turned(a.turn, c.onA[0]), armB = turned(b.turn, c.onB[0]);
    const float approach = -(n.x * (b.velocityX - a.velocityX) + n.y * (b.velocityY - a.velocityY) +
                             b.omega * cross(armB, n) - a.omega * cross(armA, n));
    return approach / std::min(w.parts[c.partA].length, w.parts[c.partB].length);
}

bool reuses(const RigidContact& c, const Relative& at, float reach)
{
    const Vec2f moved = at.move - c.at.move;
    const float most = kReuseMove * c.slop;
    return !(dot(moved, moved) > most * most || std::abs(cross(c.at.turn, at.turn)) > kReuseTurn ||
             dot(c.at.turn, at.turn) < 0 || reach > c.reach + c.slop || c.foreseen);
}

void renew(RigidContact& c, const Manifold& m, const Relative& at, float reach)
{
    const RigidContact old = c;
    const bool same = samePoint(c, m);
    c.at = at, c.reach = reach, c.foreseen = false, c.normal = m.normal;
    c.count = static_cast<std::uint8_t>(m.count);
    if (m.count == 0) c.separation[0] = m.gap;
    for (int i = 0; i < m.count; ++i) {
        const ManifoldPoint& p = m.points[i];
        c.onA[i] = p.onA, c.onB[i] = p.onB, c.ids[i] = p.id, c.separation[i] = p.separation;
        c.impulse[i] = c.tangentImpulse[i] = 0;
        for (int k = 0; k < old.count; ++k)
            if (old.ids[k] == p.id || same) c.impulse[i] = old.impulse[k], c.tangentImpulse[i] = old.tangentImpulse[k];
    }
}

/// One pair by the rules of Collider::update().
Told lookAlone(const World& w, RigidContact& c, float dt)
{
    Told told;
    c.due = false;
    told.meets = w.boxes[c.partA].meets(w.boxes[c.partB]);
    if (!told.meets) return told;
    const Part &a = w.parts[c.partA], &b = w.parts[c.partB];
    const Relative at = relative(w.poses[c.bodyA], w.poses[c.bodyB]);
    const float shorter = std::min(a.length, b.length), travel = travelOf(w.poses[c.bodyA], w.poses[c.bodyB], dt);
    const float surpriseA = w.surprise[c.bodyA], surpriseB = w.surprise[c.bodyB];
    const float reach = kSpeculative * c.slop + std::min(travel, kFast * shorter) + surpriseA + surpriseB;
    told.fast = travel > kFast * shorter;
    const Vec2f moved = at.move - c.at.move, turn = at.turn - c.at.turn;
    told.gap = c.separation[0] - std::sqrt(dot(moved, moved)) - std::sqrt(dot(turn, turn)) * b.reach;
    told.apart = c.count == 0 && told.gap > kSpeculative * c.slop + travel + surpriseA + surpriseB;
    if (told.apart) return told;
    told.reused = reuses(c, at, reach);
    if (told.reused) {
        for (int i = 0; i < c.count; ++i)
            c.separation[i] = dot(c.normal, at.move + turned(at.turn, c.onB[i]) - c.onA[i]);
    } else {
        const Manifold m = collide(a, b, at, reach);
        renew(c, m, at, reach);
        told.gap = m.count == 0 ? m.gap : 0;
    }
    told.speed = speedOf(w, c);
    return told;
}

class Heap {
public:
    explicit Heap(unsigned seed) : random_(seed) {}

    World make()
    {
        for (int i = 0; i < 300; ++i) addBody(i);
        for (int i = 0; i < 3000; ++i) addContact(i);
        return std::move(world_);
    }

private:
    float in(double from, double to)
    {
        return static_cast<float>(std::uniform_real_distribution<double>(from, to)(random_));
    }
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(random_() % count); }

    /// Circles, capsules, polygons of 3 to 8 corners, round ones among them; some as thin as a hair or no larger than
    /// single precision tells.
    Part part(int i)
    {
        if (i % 3 == 0) {
            const Vec2 centre(in(-0.5, 0.5), in(-0.5, 0.5));
            return makePart(&centre, 1, i % 9 == 0 ? 1e-6 : in(0.1, 1));
        }
        const int count = i % 7 == 0 ? 4 : static_cast<int>(below(7)) + 2;
        const double size = i % 17 == 0 ? 1e-5 : 1, a = size * in(0.3, 2), b = size * (i % 11 == 0 ? 1e-4 : in(0.3, 2));
        std::vector<Vec2> corners;
        for (int k = 0; k < count; ++k) {
            const double angle = 2 * 3.14159265358979 * k / count + (count == 4 ? 3.14159265358979 / 4 : 0);
            corners.push_back({a * std::cos(angle), b * std::sin(angle)});
        }
        return makePart(corners.data(), count, count == 2 || i % 5 == 0 ? size * in(0.05, 0.5) : 0);
    }

    /// Still, slow, or wild; a quarter in neat rows, where sides are parallel and ties decide; some in one place.
    void addBody(int i)
    {
        world_.parts.push_back(part(i));
        Pose& pose = world_.poses.emplace_back();
        const bool neat = i % 4 == 0;
        const double far = i < 150 ? 0 : 1e5;
        pose.x = far + (neat ? below(4) : i % 23 == 0 ? 1 : in(-2, 2));
        pose.y = far + (neat ? below(4) : i % 23 == 0 ? 1 : in(-2, 2));
        const double angle = neat ? 3.14159265358979 / 2 * below(4) : in(-40, 40);
        pose.turn = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
        const float speed = i % 5 == 0 ? 0 : std::pow(10.0F, in(-4, 4));
        pose.velocityX = in(-1, 1) * speed, pose.velocityY = in(-1, 1) * speed, pose.omega = in(-1, 1) * speed;
        pose.reach = world_.parts.back().reach;
        world_.surprise.push_back(i % 6 == 0 ? in(0, 2) : 0);
        const auto x = static_cast<float>(pose.x), y = static_cast<float>(pose.y);
        const float half = i % 8 == 0 ? 0.1F : 4;
        world_.boxes.push_back({x - half, y - half, x + half, y + half});
    }

    void addContact(int i)
    {
        RigidContact& c = world_.contacts.emplace_back();
        const std::uint32_t first = i % 2 == 0 ? 0 : 150;
        c.partA = first + below(150), c.partB = first + below(150);
        const Part &a = world_.parts[c.partA], &b = world_.parts[c.partB];
        if (a.count == 1 && b.count > 1) std::swap(c.partA, c.partB);
        c.bodyA = c.partA, c.bodyB = c.partB;
        c.slop = 0.002F * std::min(a.length, b.length);
        c.at = relative(world_.poses[c.bodyA], world_.poses[c.bodyB]);
        // As it was found before: here, nearly here, or elsewhere.
        const Manifold m = collide(world_.parts[c.partA], world_.parts[c.partB], c.at, 1);
        renew(c, m, c.at, i % 4 == 0 ? 100 : 0.01F);
        for (int k = 0; k < 2; ++k) c.impulse[k] = in(0, 5), c.tangentImpulse[k] = in(-1, 1);
        if (i % 3 == 0) c.at.move = c.at.move + Vec2f{in(-2, 2) * c.slop, in(-2, 2) * c.slop};
        if (i % 7 == 0) c.at.turn = turned(c.at.turn, {std::cos(in(0, 3)), std::sin(in(0, 3))});
        if (i % 5 == 0) std::swap(c.ids[0], c.ids[1]);
        c.foreseen = i % 13 == 0, c.touching = i % 2 == 0, c.due = i % 3 == 0, c.friction = in(0, 1);
        c.stepImpulse = in(0, 3), c.restitution = in(0, 1);
    }

    std::mt19937 random_;
    World world_;
};

void lookTogether(const Looker& looker, World& world, const Index (&which)[8], int kind, Seen& seen)
{
    int mostA = 1, mostB = 1;
    for (const Index i : which) {
        mostA = std::max<int>(mostA, world.parts[world.contacts[i].partA].count);
        mostB = std::max<int>(mostB, world.parts[world.contacts[i].partB].count);
    }
    if (kind == 0) looker.circles(world.input(), which, seen);
    if (kind == 1) looker.discs(world.input(), which, mostA, seen);
    if (kind == 2) looker.polygons(world.input(), which, mostA, mostB, seen);
}

int kindOf(const World& world, const RigidContact& c)
{
    return world.parts[c.partB].count > 1 ? 2 : world.parts[c.partA].count > 1 ? 1 : 0;
}

std::string difference(const RigidContact& a, const RigidContact& b)
{
    std::string text;
    const auto note = [&](const char* what, auto x, auto y) {
        if (std::memcmp(&x, &y, sizeof x) != 0) text += std::string(what) + " ";
    };
    note("at", a.at, b.at), note("reach", a.reach, b.reach), note("count", a.count, b.count);
    note("normal", a.normal, b.normal), note("foreseen", a.foreseen, b.foreseen), note("due", a.due, b.due);
    for (int k = 0; k < 2; ++k) {
        note("separation", a.separation[k], b.separation[k]), note("id", a.ids[k], b.ids[k]);
        note("onA", a.onA[k], b.onA[k]), note("onB", a.onB[k], b.onB[k]);
        note("impulse", a.impulse[k], b.impulse[k]), note("tangent", a.tangentImpulse[k], b.tangentImpulse[k]);
    }
    return text + "differ";
}

struct Tally {
    std::size_t meet = 0, apart = 0, reused = 0, one = 0, two = 0, none = 0;
};

void expectSame(World& world, const Looker& looker, const Index (&which)[8], int kind, Tally& tally)
{
    const std::vector<RigidContact> before = world.contacts;
    Seen seen;
    lookTogether(looker, world, which, kind, seen);
    for (int lane = 0; lane < 8; ++lane) {
        RigidContact alone = before[which[lane]];
        const RigidContact& c = world.contacts[which[lane]];
        const Told told = lookAlone(world, alone, world.input().dt);
        const auto bit = [&](std::uint32_t bits) { return (bits >> lane & 1U) != 0; };
        ASSERT_EQ(bit(seen.meet), told.meets);
        ASSERT_EQ(std::memcmp(&alone, &c, sizeof c), 0) << "kind " << kind << ": " << difference(alone, c);
        if (!told.meets) continue;
        ASSERT_EQ(bit(seen.apart), told.apart);
        ASSERT_EQ(bit(seen.fast), told.fast);
        ASSERT_TRUE(told.reused || seen.gap[lane] == told.gap);
        ++tally.meet, tally.apart += told.apart;
        if (told.apart) continue;
        ASSERT_EQ(bit(seen.reused), told.reused);
        ASSERT_TRUE(c.count == 0 || seen.speed[lane] == told.speed);
        tally.reused += told.reused, tally.none += c.count == 0, tally.one += c.count == 1, tally.two += c.count == 2;
    }
}

TEST(Look, EightPairsGetWhatEachOfThemGetsAlone)
{
    for (const KernelChoice choice : {KernelChoice::Sse2, KernelChoice::Best}) {
        for (int kind = 0; kind < 3; ++kind) {
            Tally tally;
            for (unsigned seed = 1; seed <= 4; ++seed) {
                World world = Heap(seed).make();
                std::vector<Index> all;
                for (Index i = 0; i < world.contacts.size(); ++i)
                    if (kindOf(world, world.contacts[i]) == kind) all.push_back(i);
                for (std::size_t first = 0; first + 8 <= all.size(); first += 8) {
                    Index which[8];
                    std::copy(all.begin() + static_cast<std::ptrdiff_t>(first),
                              all.begin() + static_cast<std::ptrdiff_t>(first) + 8, which);
                    if (first % 64 == 0) which[6] = which[7] = which[0];  // as where fewer than eight are left
                    expectSame(world, looker(choice), which, kind, tally);
                    if (HasFatalFailure()) return;
                }
            }
            EXPECT_GT(tally.apart, 20U) << kind;
            EXPECT_GT(tally.reused, 20U) << kind;
            EXPECT_GT(tally.none, 20U) << kind;
            EXPECT_GT(tally.one, 20U) << kind;
            EXPECT_TRUE(kind < 2 || tally.two > 100);
        }
    }
}

/// Each side of A against each of B.
SidePoints nearestOneByOne(const Part& a, const Part& b, const Relative& at)
{
    SidePoints best{{}, {}, 3e38F};
    for (int i = 0; i < a.count; ++i) {
        for (int j = 0; j < b.count; ++j) {
            const auto placed = [&](int k) { return at.move + turned(at.turn, b.corners[k % b.count]); };
            const manifold::Nearest n =
                manifold::nearestOfSegments(a.corners[i], a.corners[(i + 1) % a.count], placed(j), placed(j + 1));
            const Vec2f apart = n.onB - n.onA;
            if (const float squared = dot(apart, apart); squared < best.squared) best = {n.onA, n.onB, squared};
        }
    }
    return best;
}

TEST(Look, TheNearestSidesAreTheFirstThatOneByOneGives)
{
    const World world = Heap(5).make();
    for (const KernelChoice choice : {KernelChoice::Sse2, KernelChoice::Best}) {
        for (const RigidContact& c : world.contacts) {
            const Part &a = world.parts[c.partA], &b = world.parts[c.partB];
            const Relative at = relative(world.poses[c.bodyA], world.poses[c.bodyB]);
            const SidePoints wide = looker(choice).nearestSides(a, b, at), alone = nearestOneByOne(a, b, at);
            ASSERT_EQ(std::memcmp(&wide, &alone, sizeof wide), 0) << wide.squared << " " << alone.squared;
        }
    }
}

}  // namespace

}  // namespace jet::physics::test
