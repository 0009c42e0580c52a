#include "item_values.hpp"

#include "text.hpp"

#include <jet/catalog.hpp>
#include <jet/item_type.hpp>
#include <jet/simulation.hpp>

#include <cmath>

namespace jet::duktape {

namespace {

// Tables of built-in types only: types of plugins store all their properties, and their catalog is not for this thread.
const PropertySpec* specOf(const Item& item, std::string_view property)
{
    const ItemType* type = builtInItemType(item.type());
    return type ? type->properties().find(property) : nullptr;
}

[[noreturn]] void complainUnknown(const Item& item, const std::string& property)
{
    std::string known = "name, visible, locked";
    if (const ItemType* type = builtInItemType(item.type())) {
        for (const PropertySpec& spec : type->properties().specs()) known += ", " + spec.id;
    } else {
        for (const auto& [id, value] : item.properties().entries()) known += ", " + id;
    }
    throw Complaint{'"' + item.name() + "\" has no property \"" + property + "\"; it has " + known};
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

bool hasProperty(const Item& item, const std::string& property)
{
    return item.property(property).has_value() || specOf(item, property);
}

void pushProperty(Native& call, const Item& item, const std::string& property)
{
    std::optional<Value> value = item.property(property);
    if (!value) {
        const PropertySpec* spec = specOf(item, property);
        if (!spec) complainUnknown(item, property);
        value = spec->fallback;
    }
    std::visit(Push{call}, value->content());
}

Value propertyFrom(Native& call, const Item& item, const std::string& property, duk_idx_t index)
{
    const PropertySpec* spec = specOf(item, property);
    const std::optional<Value> stored = item.property(property);
    if (!spec && !stored) complainUnknown(item, property);
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
