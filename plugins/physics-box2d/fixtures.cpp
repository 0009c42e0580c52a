#include "fixtures.hpp"

#include "convex_parts.hpp"
#include "units.hpp"
#include "validation.hpp"

#include <box2d/b2_chain_shape.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_fixture.h>
#include <box2d/b2_polygon_shape.h>

namespace jet::box2d {

namespace {

constexpr double kNearest = 0.06;  // scene units between the points of a chain; Box2D's limit is 0.05

class Fixtures {
public:
    Fixtures(b2Body& body, const RigidBodyDef& def, const Vec2& centre) : body_(body), centre_(centre)
    {
        fixture_.isSensor = def.common.sensor;
    }

    void addPart(const Ring& ring)
    {
        b2Vec2 corners[b2_maxPolygonVertices];
        for (std::size_t i = 0; i < ring.size(); ++i) corners[i] = metres(ring[i] - centre_);
        b2PolygonShape polygon;
        polygon.Set(corners, static_cast<int32>(ring.size()));
        add(polygon);
    }
    void addDisc(const Vec2& at, double radius)
    {
        b2CircleShape circle;
        circle.m_p = metres(at - centre_);
        circle.m_radius = metres(radius);
        add(circle);
    }
    /// Closed, with the body to the left of its way as x turns to y; Box2D's chains hold on their right.
    void addLoop(const Ring& ring, bool hole)
    {
        std::vector<b2Vec2> points = spaced(ring, true);
        if (points.size() < 3) return;
        if ((twiceArea(ring) < 0) != hole) std::reverse(points.begin(), points.end());
        b2ChainShape chain;
        chain.CreateLoop(points.data(), static_cast<int32>(points.size()));
        add(chain);
    }
    void addChain(const Ring& line)
    {
        const std::vector<b2Vec2> points = spaced(line, false);
        if (points.size() < 2) return;
        const std::size_t last = points.size() - 1;
        b2ChainShape chain;
        chain.CreateChain(points.data(), static_cast<int32>(points.size()), 2 * points[0] - points[1],
                          2 * points[last] - points[last - 1]);
        add(chain);
    }
    bool any() const { return any_; }

private:
    void add(const b2Shape& shape)
    {
        fixture_.shape = &shape;
        body_.CreateFixture(&fixture_);
        any_ = true;
    }
    std::vector<b2Vec2> spaced(const Ring& ring, bool closed) const
    {
        Ring kept;
        for (const Vec2& p : ring)
            if (kept.empty() || (p - kept.back()).norm() > kNearest) kept.push_back(p);
        while (closed && kept.size() > 1 && (kept.back() - kept.front()).norm() <= kNearest) kept.pop_back();
        std::vector<b2Vec2> points;
        for (const Vec2& p : kept) points.push_back(metres(p - centre_));
        return points;
    }

    b2Body& body_;
    Vec2 centre_;
    b2FixtureDef fixture_;
    bool any_ = false;
};

bool isThick(const Ring& ring) { return !convexParts({ring}).empty(); }

void addShape(Fixtures& fixtures, const ShapeDef& shape)
{
    switch (shape.kind) {
    case ShapeDef::Kind::Circle: return fixtures.addDisc(shape.points[0], shape.radius);
    case ShapeDef::Kind::Chain: return fixtures.addChain(shape.points);
    case ShapeDef::Kind::Polygon:
        if (isThick(shape.points)) fixtures.addPart(shape.points);
        return;
    case ShapeDef::Kind::Capsule: break;
    }
    const Vec2 &from = shape.points[0], &to = shape.points[1];
    fixtures.addDisc(from, shape.radius);
    fixtures.addDisc(to, shape.radius);
    if (!((to - from).norm() > 0)) return;
    const Vec2 across = shape.radius * perpendicular((to - from).normalized());
    const Ring middle{from + across, to + across, to - across, from - across};
    if (isThick(middle)) fixtures.addPart(middle);
}

}  // namespace

void addFixtures(b2Body& body, const RigidBodyDef& def, const Vec2& centre)
{
    Fixtures fixtures(body, def, centre);
    if (!def.shapes.empty()) {
        for (const ShapeDef& shape : def.shapes) addShape(fixtures, shape);
    } else if (def.common.fixed && !def.common.sensor && !sidesCross(def.borders)) {
        for (std::size_t i = 0; i < def.borders.size(); ++i) fixtures.addLoop(def.borders[i], isHole(def.borders, i));
    } else {
        for (const Ring& part : convexParts(def.borders)) fixtures.addPart(part);
    }
    if (!fixtures.any())
        fail("the body's outline is thinner than 0.06 units everywhere, too thin to compute with; make it larger.");
}

}  // namespace jet::box2d
