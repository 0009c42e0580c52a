// Who listens to what. Listeners may be added and removed while they are being called; a new one hears from the next
// event on.
#pragma once

#include <jet/script.hpp>

#include <duktape.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace jet::duktape {

struct EventName {
    ScriptEventKind kind;
    const char* name;
};
inline constexpr std::array<EventName, 12> kEventNames{{
    {ScriptEventKind::Step, "onStep"},
    {ScriptEventKind::PrePaint, "onPrePaint"},
    {ScriptEventKind::PostPaint, "onPostPaint"},
    {ScriptEventKind::KeyDown, "onKeyDown"},
    {ScriptEventKind::KeyUp, "onKeyUp"},
    {ScriptEventKind::KeyTyped, "onKeyTyped"},
    {ScriptEventKind::BodyCollision, "onBodyCollision"},
    {ScriptEventKind::PointerDown, "onPointerDown"},
    {ScriptEventKind::PointerUp, "onPointerUp"},
    {ScriptEventKind::PointerMove, "onPointerMove"},
    {ScriptEventKind::ContactBegin, "onContactBegin"},
    {ScriptEventKind::ContactEnd, "onContactEnd"},
}};
const char* eventName(ScriptEventKind kind);
std::optional<ScriptEventKind> eventKind(std::string_view name);

struct Listener {
    std::uint32_t key = 0;  ///< under which the stash keeps the function alive
    void* function = nullptr;
    ItemId script;            ///< that added it
    bool removed = false;     ///< while an event is being delivered; swept away after it
    std::int64_t growth = 0;  ///< bytes by which its calls have grown the heap
};

class ListenerTable {
public:
    /// Adds the function at `index`, unless it listens already.
    void add(duk_context* ctx, ScriptEventKind kind, duk_idx_t index, ItemId script);
    void remove(duk_context* ctx, ScriptEventKind kind, void* function);
    void remove(Listener& listener);

    /// Some may be marked as removed. References are invalidated by add().
    std::vector<Listener>& of(ScriptEventKind kind) { return lists_[static_cast<std::size_t>(kind)]; }
    bool any(ScriptEventKind kind) const { return alive_[static_cast<std::size_t>(kind)] > 0; }
    std::size_t count(ScriptEventKind kind) const { return alive_[static_cast<std::size_t>(kind)]; }
    /// Forgets the removed ones and lets go of their functions. Not while an event is being delivered.
    void sweep(duk_context* ctx);
    /// The one whose calls have grown the heap most; null when there is none.
    Listener* greediest();
    ScriptEventKind kindOf(const Listener& listener) const;

private:
    std::array<std::vector<Listener>, kEventNames.size()> lists_;
    std::array<std::size_t, kEventNames.size()> alive_{};
    std::uint32_t nextKey_ = 0;
    bool dirty_ = false;
};

/// JetSystem's functions, into the kit.
void bindEvents(duk_context* ctx, duk_idx_t kit);
/// Pushes the object that listeners get.
void pushEvent(duk_context* ctx, const ScriptEvent& event);

}  // namespace jet::duktape
