// Queries against brute force over discs, boxes and outlines of soft bodies, whose answers geometry tells.
#include "lab.hpp"

#include <cstdio>
#include <optional>

namespace jet::conformance {

namespace {

/// Discs and turned boxes, or soft bodies that are no more the discs they were drawn as; none of them overlap.
struct Yard {
    struct Thing {
        bool disc = false;
        std::vector<Vec2> ring;  // of a soft body, as it is now
        Vec2 at;
        double radius = 0, angle = 0;
        Vec2 half{0, 0};

        /// Distance to the outline; below 0 inside. (Boxes: exact outside, and the depth inside.)
        double distance(const Vec2& p) const
        {
            if (disc) return (p - at).norm() - radius;
            if (!ring.empty()) return distanceOfRing(p);
            const Vec2 local = Affine::rotation(-angle) * Vec2(p - at);
            const Vec2 q = local.cwiseAbs() - half;
            return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
        }
        double distanceOfRing(const Vec2& p) const
        {
            double least = 1e9;
            bool inside = false;
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()], side = b - a;
                const double t = std::clamp((p - a).dot(side) / side.squaredNorm(), 0.0, 1.0);
                least = std::min(least, (a + t * side - p).norm());
                if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / side.y() * side.x())
                    inside = !inside;
            }
            return inside ? -least : least;
        }
    };

    Yard(const Lab& lab, bool soft) : world(lab.world({0, 0})) { soft ? fillSoft() : fill(); }

    void fill()
    {
        for (int row = 0; row < 8; ++row)
            for (int column = 0; column < 8; ++column) {
                Thing thing;
                thing.disc = (row + column) % 2 == 0;
                thing.at = Vec2(60 * column, 60 * row) + Vec2(number(-8, 8), number(-8, 8));
                thing.radius = number(5, 18), thing.angle = number(0, 3);
                thing.half = {number(4, 14), number(4, 14)};
                RigidBodyDef def = thing.disc ? disc(thing.at, thing.radius)
                                              : box(thing.at, 2 * thing.half.x(), 2 * thing.half.y(), 1, thing.angle);
                if (thing.disc) def.common.layer = 2;
                def.common.fixed = column % 3 != 0;
                world->addRigidBody(def);
                things.push_back(thing);
            }
        world->step(kStep);
    }

    void fillSoft()
    {
        for (int i = 0; i < 64; ++i) {
            const Vec2 place = Vec2(60 * (i % 8), 60 * (i / 8)) + Vec2(number(-8, 8), number(-8, 8));
            SoftBodyDef def = softBall(place, number(8, 18), 200, 1, 12, 2);
            for (SpringDef& spring : def.springs) spring.restLength *= number(0.8, 1.2);
            world->addSoftBody(def);
            things.emplace_back().at = place;
        }
        run(*world, 1);
        const std::vector<std::uint32_t> border = softBall({0, 0}, 1, 200, 1, 12, 2).borders[0];
        for (BodyHandle body = 0; body < things.size(); ++body)
            for (const std::uint32_t particle : border) things[body].ring.push_back(points(*world, body)[particle]);
    }

    /// First contact of a disc of this radius on its way, by sphere tracing: exact to 1e-9.
    std::optional<std::pair<BodyHandle, double>> sweep(const Vec2& from, const Vec2& to, double radius) const
    {
        const double length = (to - from).norm();
        std::optional<std::pair<BodyHandle, double>> best;
        for (BodyHandle i = 0; i < things.size(); ++i) {
            double t = 0;
            for (int k = 0; k < 4000 && t <= length; ++k) {
                const double d = things[i].distance(from + t / length * (to - from)) - radius;
                if (d < 1e-9) {
                    if (!best || t / length < best->second) best = {i, t / length};
                    break;
                }
                t += d;
            }
        }
        return best;
    }
    double closest(BodyHandle thing, const Vec2& from, const Vec2& to) const
    {
        double least = 1e9;
        for (int k = 0; k <= 2000; ++k)
            least = std::min(least, things[thing].distance(from + k / 2000.0 * (to - from)));
        return least;
    }
    double least(const Vec2& p) const
    {
        double d = 1e9;
        for (const Thing& thing : things) d = std::min(d, thing.distance(p));
        return d;
    }

    mutable Numbers number;
    std::vector<Thing> things;
    std::unique_ptr<PhysicsWorld> world;
};

template <class Cast>
Outcome compareCasts(const Yard& yard, double radius, Cast cast)
{
    int wrong = 0, hits = 0;
    double off = 0;
    std::string first;
    const auto isWrong = [&](const std::string& what, const Vec2& from, const Vec2& to) {
        ++wrong;
        if (!first.empty()) return;
        char text[120];
        std::snprintf(text, sizeof text, "%s from (%.3f, %.3f) to (%.3f, %.3f)", what.c_str(), from.x(), from.y(),
                      to.x(), to.y());
        first = text;
    };
    for (int i = 0; i < 400; ++i) {
        const Vec2 from(yard.number(-60, 480), yard.number(-60, 480)), to(yard.number(-60, 480), yard.number(-60, 480));
        if (yard.least(from) < radius + 0.5) continue;
        const auto should = yard.sweep(from, to, radius);
        const std::optional<CastHit> is = cast(from, to);
        if (should.has_value() != is.has_value()) {
            // A graze may go either way.
            double closest = 1e9;
            for (int k = 0; k <= 1000; ++k) closest = std::min(closest, yard.least(from + k / 1000.0 * (to - from)));
            if (std::abs(closest - radius) > 0.3) isWrong(should ? "missed" : "hit nothing there", from, to);
            continue;
        }
        if (!should) continue;
        ++hits;
        const double apart = std::abs(is->fraction - should->second) * (to - from).norm();
        // A graze of the nearer one may go either way.
        const BodyHandle nearer = is->fraction < should->second ? is->body : should->first;
        if (is->body != should->first && apart > 0.3 && std::abs(yard.closest(nearer, from, to) - radius) > 0.3)
            isWrong("another body", from, to);
        if (is->body != should->first) continue;
        // Across the surface: along a graze a hair's breadth is far.
        const Vec2 there = from + is->fraction * (to - from);
        off = std::max(off, std::abs(yard.things[is->body].distance(there) - radius));
        if (is->normal.dot(to - from) >= 0 || std::abs(is->normal.norm() - 1) > 1e-3) isWrong("wrong normal", from, to);
    }
    if (hits < 100) return holds(false, "only " + std::to_string(hits) + " hits");
    if (wrong > 0) return measured(wrong, "of " + std::to_string(hits) + " wrong", 0, first);
    return measured(off, "units", 0.25, std::to_string(hits) + " hits");
}

Outcome rays(const Lab& lab, bool soft)
{
    const Yard yard(lab, soft);
    const auto any = yard.world->rayCast({-100, 0}, {600, 0});
    if (!any) return {Outcome::Verdict::Missing, 0, 0, {}, "a ray through bodies finds nothing"};
    return compareCasts(yard, 0, [&](const Vec2& from, const Vec2& to) { return yard.world->rayCast(from, to); });
}

Outcome casts(const Lab& lab, bool soft)
{
    const Yard yard(lab, soft);
    const auto cast = [&](const Vec2& from, const Vec2& to) {
        return yard.world->shapeCast({ShapeDef::Kind::Circle, {from}, 4}, to - from);
    };
    if (!cast({-100, 0}, {600, 0})) return {Outcome::Verdict::Missing, 0, 0, {}, "a cast disc finds nothing"};
    return compareCasts(yard, 4, cast);
}

Outcome boxes(const Lab& lab, bool soft)
{
    const Yard yard(lab, soft);
    int wrong = 0, found = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec2 from(yard.number(-60, 480), yard.number(-60, 480));
        const Box area(from, from + Vec2(yard.number(2, 80), yard.number(2, 80)));
        const std::vector<BodyHandle> is = yard.world->overlapping(area);
        found += static_cast<int>(is.size());
        for (BodyHandle b = 0; b < yard.things.size(); ++b) {
            // The distance of the thing to the box, by points of both that are dense enough.
            double least = 1e9;
            for (int x = 0; x <= 24; ++x)
                for (int y = 0; y <= 24; ++y)
                    least =
                        std::min(least, yard.things[b].distance(area.min + area.size().cwiseProduct(Vec2(x, y) / 24)));
            const bool listed = std::binary_search(is.begin(), is.end(), b);
            if (std::abs(least) > 2.5 && listed != (least < 0)) ++wrong;
        }
    }
    if (found == 0) return {Outcome::Verdict::Missing, 0, 0, {}, "a box over bodies finds nothing"};
    return measured(wrong, "wrong answers", 0, std::to_string(found) + " found");
}

Outcome nearest(const Lab& lab, bool soft)
{
    const Yard yard(lab, soft);
    double off = 0;
    int found = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec2 p(yard.number(-60, 480), yard.number(-60, 480));
        const double should = yard.least(p);
        if (should < 0.2) continue;
        const auto is = yard.world->nearest(p, 40);
        if (std::abs(should - 40) < 0.5) continue;
        if (is.has_value() != (should <= 40))
            return holds(false, is ? "finds something where nothing is near" : "finds nothing where something is near");
        if (!is) continue;
        ++found;
        off = std::max({off, std::abs(is->fraction * 40 - should), std::abs((is->point - p).norm() - should)});
    }
    return measured(off, "units", 0.25, std::to_string(found) + " found");
}

Outcome filter(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    RigidBodyDef first = fixed(disc({50, 0}, 5)), sensor = fixed(disc({100, 0}, 5));
    first.common.layer = 2, sensor.common.sensor = true;
    const BodyHandle a = world->addRigidBody(first), b = world->addRigidBody(sensor);
    const BodyHandle c = world->addRigidBody(fixed(disc({150, 0}, 5)));
    world->step(kStep);
    const auto ray = [&](const QueryFilter& f) {
        const auto hit = world->rayCast({0, 0}, {200, 0}, f);
        return hit ? hit->body : kNoHandle;
    };
    if (ray({}) == kNoHandle) return {Outcome::Verdict::Missing, 0, 0, {}, "no ray casts"};
    return holds(ray({}) == a && ray({1, kNoHandle, false}) == c && ray({1, kNoHandle, true}) == b &&
                     ray({~0U, a, false}) == c,
                 "layers, the excepted body or sensors are not heeded");
}

Outcome agreement(const Lab& lab, bool soft)
{
    const Yard yard(lab, soft);
    const PhysicsWorld& world = *yard.world;
    int wrong = 0, hits = 0;
    std::string first;
    const auto expect = [&](bool is, const char* otherwise) {
        wrong += !is;
        if (!is && first.empty()) first = otherwise;
    };
    const Vec2 near(0.3, 0.3);  // Box2D's polygons have a skin of 0.1 units, which rays do not know
    for (int i = 0; i < 400; ++i) {
        const Vec2 from(yard.number(-60, 480), yard.number(-60, 480)), to(yard.number(-60, 480), yard.number(-60, 480));
        if (yard.least(from) < 1.5) continue;
        const Vec2 way = to - from;
        const auto ray = world.rayCast(from, to);
        const auto cast = world.shapeCast({ShapeDef::Kind::Circle, {from}, 1}, way);
        if (!ray) continue;
        ++hits;
        expect(cast.has_value(), "a disc goes where a ray does not");
        if (cast)
            expect(cast->fraction * way.norm() <= ray->fraction * way.norm() + 0.2, "a disc goes farther than a ray");
        const std::vector<BodyHandle> there = world.overlapping(Box(ray->point - near, ray->point + near));
        expect(std::binary_search(there.begin(), there.end(), ray->body), "a box at a hit does not overlap the body");
        const auto nearest = world.nearest(ray->point, 1);
        expect(nearest && nearest->fraction < 0.3, "no border is near a hit");
        expect(world.contains(ray->body, ray->point - 0.5 * ray->normal) ||
                   yard.things[ray->body].distance(ray->point - 0.5 * ray->normal) > -0.2,
               "the body is not behind its surface");
        expect(!world.contains(ray->body, ray->point + 0.5 * ray->normal), "the body is before its surface");
        if (ray->fraction * way.norm() > 1) {
            const Vec2 before = ray->point - way.normalized();
            const auto again = world.rayCast(before, to);
            expect(again && again->body == ray->body && (again->point - ray->point).norm() < 0.2,
                   "a ray from nearer by hits something else");
        }
    }
    if (hits < 100) return holds(false, "only " + std::to_string(hits) + " hits");
    return measured(wrong, "contradictions", 0, first.empty() ? std::to_string(hits) + " hits" : first);
}

Outcome frontOfChains(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    RigidBodyDef line;
    line.shapes = {{ShapeDef::Kind::Chain, {{-60, 5}, {-20, 0}, {20, 0}, {60, 5}}, 0}};  // solid below
    line.common.fixed = true;
    world->addRigidBody(line);
    world->step(kStep);
    int wrong = 0;
    for (const double x : {-40.0, -15.0, 3.0, 12.0, 45.0}) {
        const auto disc = [&](double y) { return ShapeDef{ShapeDef::Kind::Circle, {{x, y}}, 4}; };
        const auto square = [&](double y) { return ShapeDef{ShapeDef::Kind::Polygon, boxRing({x, y}, 8, 8, 0.2), 0}; };
        wrong += !world->rayCast({x, -30}, {x, 30}) + !world->shapeCast(disc(-30), {0, 60}).has_value() +
                 !world->shapeCast(square(-30), {0, 60}).has_value();
        wrong += world->rayCast({x, 30}, {x, -30}).has_value() + world->shapeCast(disc(30), {0, -60}).has_value() +
                 world->shapeCast(square(30), {0, -60}).has_value();
    }
    return measured(wrong, "of 30 wrong", 0, "rays, discs and squares from before and behind");
}

Outcome contains(const Lab& lab)
{
    const auto world = lab.world({0, 0});
    const BodyHandle ring = world->addRigidBody(drawn({circleRing({0, 0}, 30, 24), circleRing({0, 0}, 10, 24)}));
    const BodyHandle round = world->addRigidBody(disc({100, 0}, 10));
    world->step(kStep);
    return holds(world->contains(ring, {20, 0}) && !world->contains(ring, {0, 0}) && !world->contains(ring, {40, 0}) &&
                     world->contains(round, {106, 6}) && !world->contains(round, {108, 8}),
                 "a ring with a hole, or a disc, does not contain what it should");
}

}  // namespace

std::vector<Check> queryChecks()
{
    std::vector<Check> checks;
    for (const bool soft : {false, true}) {
        const auto add = [&](const char* name, Outcome (*check)(const Lab&, bool)) {
            checks.push_back({"queries", name + std::string(soft ? ", soft bodies" : ""),
                              [=](const Lab& lab) { return check(lab, soft); }});
        };
        add("ray casts", rays);
        add("shape casts", casts);
        add("overlapping a box", boxes);
        add("nearest point", nearest);
        add("rays, casts, boxes agree", agreement);
    }
    checks.push_back({"queries", "filters", filter});
    checks.push_back({"queries", "containing a point", contains});
    checks.push_back({"queries", "chains have a front", frontOfChains});
    return checks;
}

}  // namespace jet::conformance
