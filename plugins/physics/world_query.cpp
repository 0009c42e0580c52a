// Queries over all bodies.
#include "validation.hpp"
#include "world.hpp"

namespace jet::physics {

const Queries& World::queries() const
{
    refresh();
    const_cast<World*>(this)->queries_.update(state_);  // a cache of what the nodes say
    return queries_;
}

std::optional<CastHit> World::rayCast(const Vec2& from, const Vec2& to, const QueryFilter& filter) const
{
    checks().place("a ray", "start", from);
    checks().place("a ray", "end", to);
    return queries().rayCast(state_, from, to - from, filter);
}

std::optional<CastHit> World::shapeCast(const ShapeDef& shape, const Vec2& way, const QueryFilter& filter) const
{
    checks().check("a cast", shape, true);
    checks().place("a cast", "way", way);
    return queries().shapeCast(state_, shape, way, filter);
}

std::vector<BodyHandle> World::overlapping(const Box& box, const QueryFilter& filter) const
{
    if (box.isNull()) return {};
    checks().place("a box", "first corner", box.min);
    checks().place("a box", "second corner", box.max);
    return queries().overlapping(state_, box, filter);
}

std::optional<CastHit> World::nearest(const Vec2& point, double reach, const QueryFilter& filter) const
{
    checks().place("a query", "point", point);
    checks().atLeast("a query", "reach", reach, 0);
    return queries().nearest(state_, point, reach, filter);
}

bool World::contains(BodyHandle handle, const Vec2& point) const
{
    requireBody(handle);
    if (!isFinite(point)) return false;
    refresh();
    return queries_.contains(state_, handle, point);
}

}  // namespace jet::physics
