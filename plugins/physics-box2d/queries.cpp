// Rays, cast shapes, boxes and nearest points, by Box2D's tree and its distance routines.
#include "units.hpp"
#include "validation.hpp"
#include "world.hpp"

#include <box2d/b2_chain_shape.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_distance.h>
#include <box2d/b2_edge_shape.h>
#include <box2d/b2_fixture.h>

namespace jet::box2d {

namespace {

bool seen(const b2Fixture& fixture, const std::vector<Body>& bodies, const QueryFilter& filter)
{
    const BodyHandle handle = handleOf(*fixture.GetBody());
    if (handle == kNoHandle || handle == filter.except) return false;
    const BodyCommon& common = bodies[handle].common;
    return (common.layer & filter.mask) != 0 && (!common.sensor || filter.sensors);
}

class NearestRay final : public b2RayCastCallback {
public:
    NearestRay(const std::vector<Body>& bodies, const QueryFilter& filter) : bodies_(bodies), filter_(filter) {}
    std::optional<CastHit> hit;

    float ReportFixture(b2Fixture* fixture, const b2Vec2& point, const b2Vec2& normal, float fraction) override
    {
        if (!seen(*fixture, bodies_, filter_) || fixture->GetType() == b2Shape::e_chain) return -1;
        const BodyHandle body = handleOf(*fixture->GetBody());
        hit = CastHit{body, units(point), Vec2(static_cast<double>(normal.x), static_cast<double>(normal.y)),
                      static_cast<double>(fraction)};
        return fraction;
    }

private:
    const std::vector<Body>& bodies_;
    const QueryFilter& filter_;
};

/// Calls visit(fixture) for the fixtures in the box that the filter shows.
template <class Visit>
class Each final : public b2QueryCallback {
public:
    Each(const std::vector<Body>& bodies, const QueryFilter& filter, Visit visit)
        : bodies_(bodies), filter_(filter), visit_(std::move(visit))
    {
    }
    bool ReportFixture(b2Fixture* fixture) override
    {
        if (seen(*fixture, bodies_, filter_)) visit_(*fixture);
        return true;
    }

private:
    const std::vector<Body>& bodies_;
    const QueryFilter& filter_;
    Visit visit_;
};

template <class Visit>
void eachFixture(const Stage& stage, const QueryFilter& filter, const Box& box, Visit visit)
{
    Each<Visit> callback(stage.bodies(), filter, std::move(visit));
    stage.world().QueryAABB(&callback, {metres(box.min), metres(box.max)});
}

b2DistanceInput distanceTo(const b2Fixture& fixture, int32 child, const b2DistanceProxy& proxy)
{
    b2DistanceInput input;
    input.proxyA.Set(fixture.GetShape(), child);
    input.transformA = fixture.GetBody()->GetTransform();
    input.proxyB = proxy;
    input.transformB.SetIdentity();
    input.useRadii = false;
    // Polygons and chains have a skin of 0.1 units, of which the drawing knows nothing.
    if (fixture.GetType() != b2Shape::e_circle) input.proxyA.m_radius = 0;
    return input;
}

b2DistanceOutput distanceOf(b2DistanceInput input, bool radii)
{
    input.useRadii = radii;
    b2SimplexCache cache;
    cache.count = 0;
    b2DistanceOutput output;
    b2Distance(&output, &cache, &input);
    return output;
}

/// A cast shape as a proxy over points of its own.
struct Caster {
    explicit Caster(const ShapeDef& shape)
    {
        for (const Vec2& p : shape.points) points.push_back(metres(p));
        const bool round = shape.kind == ShapeDef::Kind::Circle || shape.kind == ShapeDef::Kind::Capsule;
        proxy.m_vertices = points.data();
        proxy.m_count = static_cast<int32>(points.size());
        proxy.m_radius = round ? metres(shape.radius) : 0;
        for (const Vec2& p : shape.points) {
            box.extend(p - Vec2(shape.radius, shape.radius) * round);
            box.extend(p + Vec2(shape.radius, shape.radius) * round);
        }
    }
    b2Vec2 middle() const
    {
        b2Vec2 sum(0, 0);
        for (const b2Vec2& p : points) sum += (1.0F / static_cast<float>(points.size())) * p;
        return sum;
    }

    std::vector<b2Vec2> points;
    b2DistanceProxy proxy;
    Box box;
};

/// Chains hold on one side, also what is cast.
struct Front {
    Front(const b2Fixture& fixture, int32 child)
    {
        if (fixture.GetType() != b2Shape::e_chain) return;
        b2EdgeShape edge;
        static_cast<const b2ChainShape*>(fixture.GetShape())->GetChildEdge(&edge, child);
        const b2Transform& at = fixture.GetBody()->GetTransform();
        first = b2Mul(at, edge.m_vertex1);
        out = b2Cross(b2Mul(at, edge.m_vertex2) - first, 1.0F);
        out.Normalize();
    }
    bool isBefore(const b2Vec2& point) const { return b2Dot(out, point - first) >= 0; }
    bool isLeftBy(const Vec2& way) const { return b2Dot(out, metres(way)) > 0; }

    b2Vec2 first{0, 0}, out{0, 0};
};

}  // namespace

std::optional<CastHit> World::rayCast(const Vec2& from, const Vec2& to, const QueryFilter& filter) const
{
    checks().place("a ray", "start", from);
    checks().place("a ray", "end", to);
    const b2Vec2 a = metres(from), b = metres(to);
    if (!((b - a).LengthSquared() > 0)) return std::nullopt;
    NearestRay ray(stage_->bodies(), filter);
    stage_->world().RayCast(&ray, a, b);
    // Box2D's chains stop rays from both sides.
    Box swept;
    swept.extend(from), swept.extend(to);
    eachFixture(*stage_, filter, swept, [&](const b2Fixture& fixture) {
        if (fixture.GetType() != b2Shape::e_chain) return;
        for (int32 child = 0; child < fixture.GetShape()->GetChildCount(); ++child) {
            const Front front(fixture, child);
            b2RayCastOutput out;
            const float most = ray.hit ? static_cast<float>(ray.hit->fraction) : 1;
            if (!front.isBefore(a) || front.isLeftBy(to - from) || !fixture.RayCast(&out, {a, b, most}, child))
                continue;
            const Vec2 normal(static_cast<double>(out.normal.x), static_cast<double>(out.normal.y));
            ray.hit = CastHit{handleOf(*fixture.GetBody()), units(a + out.fraction * (b - a)), normal,
                              static_cast<double>(out.fraction)};
        }
    });
    return ray.hit;
}

std::optional<CastHit> World::shapeCast(const ShapeDef& shape, const Vec2& way, const QueryFilter& filter) const
{
    checks().check("a cast", shape, false);
    checks().place("a cast", "way", way);
    const Caster caster(shape);
    Box swept = caster.box;
    swept.extend(Box(caster.box.min + way, caster.box.max + way));
    std::optional<CastHit> best;
    const auto take = [&](const CastHit& hit) {
        if (!best || hit.fraction < best->fraction || (hit.fraction == best->fraction && hit.body < best->body))
            best = hit;
    };
    eachFixture(*stage_, filter, swept, [&](const b2Fixture& fixture) {
        const BodyHandle body = handleOf(*fixture.GetBody());
        for (int32 child = 0; child < fixture.GetShape()->GetChildCount(); ++child) {
            const Front front(fixture, child);
            if (!front.isBefore(caster.middle())) continue;  // it comes from behind
            const b2DistanceInput near = distanceTo(fixture, child, caster.proxy);
            const b2DistanceOutput start = distanceOf(near, true);
            if (!(start.distance > 0)) {  // it begins there
                Vec2 out = way.squaredNorm() > 0
                               ? Vec2(-way)
                               : Vec2(caster.box.center() - units(fixture.GetBody()->GetWorldCenter()));
                if (!(out.squaredNorm() > 0)) out = Vec2(0, -1);
                take({body, units(start.pointA), out.stableNormalized(), 0});
                continue;
            }
            if (front.isLeftBy(way)) continue;
            b2ShapeCastInput input;
            input.proxyA = near.proxyA, input.proxyB = near.proxyB;
            input.transformA = near.transformA, input.transformB = near.transformB;
            input.translationB = metres(way);
            b2ShapeCastOutput hit;
            if (!b2ShapeCast(&hit, &input) || hit.lambda > 1) continue;
            const Vec2 normal(static_cast<double>(hit.normal.x), static_cast<double>(hit.normal.y));
            take({body, units(hit.point), normal, static_cast<double>(hit.lambda)});
        }
    });
    return best;
}

std::vector<BodyHandle> World::overlapping(const Box& box, const QueryFilter& filter) const
{
    if (box.isNull()) return {};
    checks().place("a box", "first corner", box.min);
    checks().place("a box", "second corner", box.max);
    const ShapeDef area{
        ShapeDef::Kind::Polygon, {box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}}, 0};
    const Caster caster(area);
    std::vector<BodyHandle> found;
    eachFixture(*stage_, filter, box, [&](const b2Fixture& fixture) {
        for (int32 child = 0; child < fixture.GetShape()->GetChildCount(); ++child)
            if (!(distanceOf(distanceTo(fixture, child, caster.proxy), true).distance > 0))
                return found.push_back(handleOf(*fixture.GetBody()));
    });
    // The box may lie within a fixed body, of which Box2D knows the border alone.
    read();
    for (BodyHandle body = 0; body < bodyCount(); ++body) {
        const Body& one = stage_->bodies()[body];
        if (!one.solid || !one.common.fixed || !one.body->IsEnabled()) continue;
        if (!readings_.bounds[body].intersects(box) || !seen(*one.body->GetFixtureList(), stage_->bodies(), filter))
            continue;
        if (contains(body, box.center())) found.push_back(body);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

std::optional<CastHit> World::nearest(const Vec2& point, double reach, const QueryFilter& filter) const
{
    checks().place("a query", "point", point);
    checks().atLeast("a query", "reach", reach, 0);
    if (!(reach > 0)) return std::nullopt;
    b2CircleShape dot;
    dot.m_p = metres(point);
    dot.m_radius = 0;
    b2DistanceProxy proxy;
    proxy.Set(&dot, 0);
    std::optional<CastHit> best;
    const Vec2 span(reach, reach);
    eachFixture(*stage_, filter, Box(point - span, point + span), [&](const b2Fixture& fixture) {
        const BodyHandle body = handleOf(*fixture.GetBody());
        for (int32 child = 0; child < fixture.GetShape()->GetChildCount(); ++child) {
            const b2DistanceOutput out = distanceOf(distanceTo(fixture, child, proxy), true);
            const Vec2 at = units(out.pointA);
            const double fraction = units(out.distance) / reach;
            if (fraction > 1) continue;
            if (best && (best->fraction < fraction || (best->fraction == fraction && best->body <= body))) continue;
            const Vec2 off = point - at;
            best = CastHit{body, at, off.norm() > 0 ? Vec2(off.normalized()) : Vec2(0, -1), fraction};
        }
    });
    return best;
}

}  // namespace jet::box2d
