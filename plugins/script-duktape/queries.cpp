// ctx.rayCast, ctx.shapeCast, ctx.overlapping, ctx.nearest: what is where in the world.
#include "bindings.hpp"
#include "native.hpp"
#include "text.hpp"

#include <jet/simulation.hpp>

#include <cmath>
#include <string>
#include <string_view>

namespace jet::duktape {

namespace {

constexpr std::size_t kMostPoints = 8;  // of a polygon; see ShapeDef

bool isMissing(const Native& call, duk_idx_t index) { return duk_is_null_or_undefined(call.ctx, index) != 0; }

[[noreturn]] void expected(const Native& call, std::string_view name, std::string_view what, duk_idx_t index)
{
    throw Complaint{"'" + std::string(name) + "' must be " + std::string(what) + ", got " + call.describe(index)};
}

double finite(const Native& call, duk_idx_t index, std::string_view name)
{
    const double value = duk_is_number(call.ctx, index) ? duk_get_number(call.ctx, index) : std::nan("");
    if (!std::isfinite(value)) expected(call, name, "a finite number", index);
    return value;
}

/// A member of the object at `index`, as finite().
double member(const Native& call, duk_idx_t index, const std::string& name, const char* key)
{
    duk_get_prop_string(call.ctx, index, key);
    const double value = finite(call, duk_get_top_index(call.ctx), name + '.' + key);
    duk_pop(call.ctx);
    return value;
}

Vec2 point(const Native& call, duk_idx_t index, const std::string& name)
{
    if (!duk_is_object(call.ctx, index)) expected(call, name, "a point { x, y }", index);
    const double x = member(call, index, name, "x");
    return {x, member(call, index, name, "y")};
}

/// Pushes the member; is it there?
bool pushMember(const Native& call, duk_idx_t index, const char* key)
{
    duk_get_prop_string(call.ctx, index, key);
    return !isMissing(call, -1);
}

std::uint32_t bits(const Native& call, duk_idx_t index, std::string_view name)
{
    // ~1 and 1 << 31 are below 0 in the language.
    const double value = finite(call, index, name);
    if (value != std::floor(value) || value < -2147483648.0 || value > 4294967295.0)
        expected(call, name, "a whole number of 32 bits", index);
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
}

void checkKeys(const Native& call, duk_idx_t index)
{
    duk_enum(call.ctx, index, DUK_ENUM_OWN_PROPERTIES_ONLY);
    while (duk_next(call.ctx, -1, 0)) {
        const std::string key = stringAt(call.ctx, -1);
        if (key != "mask" && key != "except" && key != "sensors")
            throw Complaint{"there is no option '" + shortened(key, 40) + "'; there are mask, except, sensors"};
        duk_pop(call.ctx);
    }
    duk_pop(call.ctx);
}

/// Whose body a query leaves out: kNoHandle for an item without one.
BodyHandle bodyAt(const Native& call, duk_idx_t index, std::string_view name)
{
    const ItemSlot* slot = call.play.items.slotOf(call.ctx, index, DUK_HIDDEN_SYMBOL("body"));
    if (!slot) slot = call.play.items.slotOf(call.ctx, index, DUK_HIDDEN_SYMBOL("item"));
    if (!slot) expected(call, name, "a body or an item", index);
    return slot->body;
}

QueryFilter filter(const Native& call, duk_idx_t index)
{
    QueryFilter filter;
    if (isMissing(call, index)) return filter;
    if (!duk_is_object(call.ctx, index)) expected(call, "options", "an object", index);
    checkKeys(call, index);
    if (pushMember(call, index, "mask")) filter.mask = bits(call, duk_get_top_index(call.ctx), "options.mask");
    if (pushMember(call, index, "except")) filter.except = bodyAt(call, duk_get_top_index(call.ctx), "options.except");
    if (pushMember(call, index, "sensors")) {
        if (!duk_is_boolean(call.ctx, -1)) expected(call, "options.sensors", "true or false", -1);
        filter.sensors = duk_get_boolean(call.ctx, -1) != 0;
    }
    duk_pop_3(call.ctx);
    return filter;
}

/// { center, radius }, { from, to, radius } or { points }.
ShapeDef shape(const Native& call, duk_idx_t index)
{
    ShapeDef def;
    constexpr const char* kForms = "{ center, radius }, { from, to, radius } or { points }";
    if (!duk_is_object(call.ctx, index)) expected(call, "shape", kForms, index);
    const auto at = [&] { return duk_get_top_index(call.ctx); };
    if (pushMember(call, index, "center")) {
        def.kind = ShapeDef::Kind::Circle;
        def.points = {point(call, at(), "shape.center")};
    } else if (pushMember(call, index, "from")) {
        def.kind = ShapeDef::Kind::Capsule;
        def.points = {point(call, at(), "shape.from")};
        pushMember(call, index, "to");
        def.points.push_back(point(call, at(), "shape.to"));
    } else if (pushMember(call, index, "points")) {
        if (!duk_is_array(call.ctx, at())) expected(call, "shape.points", "an array of points", at());
        const std::size_t count = duk_get_length(call.ctx, at());
        if (count < 3 || count > kMostPoints)
            throw Complaint{"'shape.points' must be 3 to 8 points of a convex polygon, got " + std::to_string(count)};
        const duk_idx_t list = at();
        for (duk_uarridx_t i = 0; i < count; ++i) {
            duk_get_prop_index(call.ctx, list, i);
            def.points.push_back(point(call, at(), "shape.points[" + std::to_string(i) + ']'));
        }
    } else {
        expected(call, "shape", kForms, index);
    }
    if (def.kind != ShapeDef::Kind::Polygon) {
        duk_get_prop_literal(call.ctx, index, "radius");
        def.radius = finite(call, at(), "shape.radius");
        if (!(def.radius > 0)) expected(call, "shape.radius", "above 0", at());
    }
    return def;
}

/// Of a body that no item draws: null, and null.
void putBody(const Native& call, BodyHandle body)
{
    const Item* item = call.play.simulation.scene().items().find(call.play.simulation.itemOf(body));
    call.play.items.push(call.ctx, item);
    duk_put_prop_literal(call.ctx, -2, "item");
    call.play.items.pushBody(call.ctx, item);
    duk_put_prop_literal(call.ctx, -2, "body");
}

/// `whole`: the length that the hit's fraction is of.
duk_ret_t give(const Native& call, const std::optional<CastHit>& hit, double whole)
{
    if (!hit) return duk_push_null(call.ctx), 1;
    duk_push_object(call.ctx);
    putBody(call, hit->body);
    call.play.pushVector(call.ctx, hit->point);
    duk_put_prop_literal(call.ctx, -2, "point");
    call.play.pushVector(call.ctx, hit->normal);
    duk_put_prop_literal(call.ctx, -2, "normal");
    duk_push_number(call.ctx, hit->fraction);
    duk_put_prop_literal(call.ctx, -2, "fraction");
    duk_push_number(call.ctx, hit->fraction * whole);
    duk_put_prop_literal(call.ctx, -2, "distance");
    return 1;
}

const PhysicsWorld& world(const Native& call) { return call.play.simulation.world(); }

duk_ret_t rayCast(Native& call)
{
    const Vec2 from = point(call, 0, "from"), to = point(call, 1, "to");
    const QueryFilter seen = filter(call, 2);
    return give(call, world(call).rayCast(from, to, seen), (to - from).norm());
}

duk_ret_t shapeCast(Native& call)
{
    const ShapeDef cast = shape(call, 0);
    const Vec2 way = point(call, 1, "way");
    const QueryFilter seen = filter(call, 2);
    return give(call, world(call).shapeCast(cast, way, seen), way.norm());
}

duk_ret_t nearest(Native& call)
{
    const Vec2 from = point(call, 0, "point");
    const double reach = finite(call, 1, "reach");
    if (reach < 0) expected(call, "reach", "0 or more", 1);
    const QueryFilter seen = filter(call, 2);
    return give(call, world(call).nearest(from, reach, seen), reach);
}

duk_ret_t overlapping(Native& call)
{
    if (!duk_is_object(call.ctx, 0)) expected(call, "box", "a box { x, y, width, height }", 0);
    const Vec2 corner = point(call, 0, "box");
    const double width = member(call, 0, "box", "width"), height = member(call, 0, "box", "height");
    if (width < 0 || height < 0) throw Complaint{"'box' must have a width and a height of 0 or more"};
    const QueryFilter seen = filter(call, 1);
    const auto found = world(call).overlapping(Box(corner, corner + Vec2(width, height)), seen);
    const duk_idx_t list = duk_push_array(call.ctx);
    duk_uarridx_t count = 0;
    for (const BodyHandle body : found) {
        const Item* item = call.play.simulation.scene().items().find(call.play.simulation.itemOf(body));
        if (!item) continue;  // nothing a script could do with it
        call.play.items.push(call.ctx, item);
        duk_put_prop_index(call.ctx, list, count++);
    }
    return 1;
}

}  // namespace

void bindQueries(duk_context* ctx, duk_idx_t kit)
{
    duk_get_prop_string(ctx, kit, "ctx");
    method<rayCast>(ctx, "rayCast", 3);
    method<shapeCast>(ctx, "shapeCast", 3);
    method<overlapping>(ctx, "overlapping", 2);
    method<nearest>(ctx, "nearest", 3);
    duk_pop(ctx);
}

}  // namespace jet::duktape
