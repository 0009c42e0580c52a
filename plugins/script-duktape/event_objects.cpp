// The objects listeners are called with.
#include "listeners.hpp"
#include "play.hpp"
#include "text.hpp"

namespace jet::duktape {

namespace {

void put(duk_context* ctx, const char* name, double value)
{
    duk_push_number(ctx, value);
    duk_put_prop_string(ctx, -2, name);
}

void put(duk_context* ctx, const char* name, bool value)
{
    duk_push_boolean(ctx, value);
    duk_put_prop_string(ctx, -2, name);
}

void put(duk_context* ctx, const char* name, std::nullptr_t)
{
    duk_push_null(ctx);
    duk_put_prop_string(ctx, -2, name);
}

void put(duk_context* ctx, const char* name, std::string_view value)
{
    pushText(ctx, value);
    duk_put_prop_string(ctx, -2, name);
}

void put(duk_context* ctx, const Play& play, const char* name, const Vec2& value)
{
    play.pushVector(ctx, value);
    duk_put_prop_string(ctx, -2, name);
}

void putModifiers(duk_context* ctx, const Modifiers& modifiers)
{
    put(ctx, "shift", modifiers.shift);
    put(ctx, "alt", modifiers.alt);
    put(ctx, "control", modifiers.control);
}

void putKey(duk_context* ctx, const KeyEvent& key)
{
    put(ctx, "key", std::string_view(key.key));
    put(ctx, "text", std::string_view(key.text));
    put(ctx, "repeat", key.repeat);
    putModifiers(ctx, key.modifiers);
}

void putPointer(duk_context* ctx, const Play& play, const PointerEvent& pointer)
{
    constexpr const char* kButtons[] = {"none", "left", "right", "middle"};
    put(ctx, "x", pointer.scene.x());
    put(ctx, "y", pointer.scene.y());
    put(ctx, play, "point", pointer.scene);
    put(ctx, play, "pixels", pointer.pixels);
    put(ctx, "button", std::string_view(kButtons[static_cast<std::size_t>(pointer.button)]));
    putModifiers(ctx, pointer.modifiers);
}

void putBodies(duk_context* ctx, Play& play, const ScriptEvent& event)
{
    const Item* a = play.simulation.scene().items().find(event.bodyA);
    const Item* b = play.simulation.scene().items().find(event.bodyB);
    play.items.push(ctx, a);
    duk_put_prop_literal(ctx, -2, "itemA");
    play.items.push(ctx, b);
    duk_put_prop_literal(ctx, -2, "itemB");
    play.items.pushBody(ctx, a);
    duk_put_prop_literal(ctx, -2, "bodyA");
    play.items.pushBody(ctx, b);
    duk_put_prop_literal(ctx, -2, "bodyB");
}

void putCollision(duk_context* ctx, Play& play, const ScriptEvent& event)
{
    putBodies(ctx, play, event);
    put(ctx, play, "point", event.contact.point);
    put(ctx, play, "normal", event.contact.normal);
    put(ctx, "penetration", event.contact.penetration);
    put(ctx, "impulse", event.contact.impulse);
}

/// Null where the engine tells that two bodies touch, but not where.
void putPlace(duk_context* ctx, Play& play, const Contact& contact)
{
    const bool known = contact.normal != Vec2(0, 0);
    for (const auto& [name, value] : {std::pair("point", contact.point), std::pair("normal", contact.normal)})
        known ? put(ctx, play, name, value) : put(ctx, name, nullptr);
}

}  // namespace

void pushEvent(duk_context* ctx, const ScriptEvent& event)
{
    Play& play = Play::of(ctx);
    duk_push_object(ctx);
    put(ctx, "type", std::string_view(eventName(event.kind)));
    switch (event.kind) {
    case ScriptEventKind::Step:
    case ScriptEventKind::PrePaint:
    case ScriptEventKind::PostPaint:
        put(ctx, "step", static_cast<double>(play.simulation.stepCount()));
        put(ctx, "time", play.simulation.time());
        break;
    case ScriptEventKind::KeyDown:
    case ScriptEventKind::KeyUp:
    case ScriptEventKind::KeyTyped: putKey(ctx, event.key); break;
    case ScriptEventKind::BodyCollision: putCollision(ctx, play, event); break;
    case ScriptEventKind::ContactBegin:
        putBodies(ctx, play, event);
        putPlace(ctx, play, event.contact);
        put(ctx, "impulse", event.contact.impulse);
        break;
    case ScriptEventKind::ContactEnd: putBodies(ctx, play, event); break;
    case ScriptEventKind::PointerDown:
    case ScriptEventKind::PointerUp:
    case ScriptEventKind::PointerMove: putPointer(ctx, play, event.pointer); break;
    }
}

}  // namespace jet::duktape
