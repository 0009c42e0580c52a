#include "item_values.hpp"

#include "text.hpp"

#include <jet/simulation.hpp>

#include <cmath>

namespace jet::duktape {

namespace {

[[noreturn]] void complainUnknown(Native& call, const Item& item, const std::string& property)
{
    throw Complaint{'"' + item.name() + "\" has no property \"" + property + "\"; it has " +
                    call.play.properties.known(item)};
}

struct Push {
    Native& call;
    void operator()(std::monostate) const { duk_push_undefined(call.ctx); }
    void operator()(bool v) const { duk_push_boolean(call.ctx, v); }
    void operator()(std::int64_t v) const { duk_push_number(call.ctx, static_cast<double>(v)); }
    void operator()(double v) const { duk_push_number(call.ctx, v); }
    void operator()(const Vec2& v) const { call.play.pushVector(call.ctx, v); }
    void operator()(Color v) const { pushText(call.ctx, v.text()); }
    void operator()(const std::string& v) const { pushText(call.ctx, v); }
    void operator()(ItemId v) const { call.play.items.push(call.ctx, call.play.simulation.scene().items().find(v)); }
    void operator()(const Path& v) const { pushText(call.ctx, Value(v).text()); }
    void operator()(const RawText& v) const { pushText(call.ctx, v.text); }
};

std::int64_t integer(const Native& call, duk_idx_t index)
{
    const double v = call.number(index);
    if (v != std::floor(v) || std::abs(v) > 9007199254740992.0)
        throw Complaint{"expected an integer, got " + call.describe(index)};
    return static_cast<std::int64_t>(v);
}

}  // namespace

bool hasProperty(Native& call, const Item& item, const std::string& property)
{
    const PropertyTables::Found found = call.play.properties.find(item, property);
    return found.spec || found.stored;
}

void pushProperty(Native& call, const Item& item, const std::string& property)
{
    const PropertyTables::Found found = call.play.properties.find(item, property);
    if (!found.spec && !found.stored) complainUnknown(call, item, property);
    std::visit(Push{call}, (found.stored ? *found.stored : found.spec->fallback).content());
}

Value propertyFrom(Native& call, const Item& item, const std::string& property, duk_idx_t index)
{
    const auto [spec, stored] = call.play.properties.find(item, property);
    if (!spec && !stored) complainUnknown(call, item, property);
    switch (spec ? spec->kind : stored->kind()) {
    case ValueKind::Bool: return Value(call.boolean(index));
    case ValueKind::Integer: return Value(integer(call, index));
    case ValueKind::Real: return Value(call.number(index));
    case ValueKind::Vec2: return Value(call.vector(index));
    case ValueKind::Color: return Value(Color::parse(call.text(index)).orThrow());
    case ValueKind::Item: return duk_is_null(call.ctx, index) ? Value(ItemId{}) : Value(call.item(index).id());
    case ValueKind::Path: return Value::parse(ValueKind::Path, call.text(index)).orThrow();
    case ValueKind::Text:
    case ValueKind::Choice: return Value(call.text(index));
    case ValueKind::None:
    case ValueKind::Raw: break;
    }
    throw Complaint{'"' + property + "\" cannot be set: the plugin that declares it is absent"};
}

}  // namespace jet::duktape
