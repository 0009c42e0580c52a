// The items of the playing scene as scripts see them: the same item is always the same JavaScript object.
#pragma once

#include <jet/item.hpp>
#include <jet/physics.hpp>

#include <duktape.h>

#include <unordered_map>
#include <vector>

namespace jet {
class Simulation;
}

namespace jet::duktape {

/// Objects hold the index of their slot under a hidden key, never a pointer.
struct ItemSlot {
    const Item* item = nullptr;  ///< the playing scene's tree does not change
    BodyHandle body = kNoHandle;
    JointHandle joint = kNoHandle;
    void* object = nullptr;
    void* bodyObject = nullptr;
    void* position = nullptr;  ///< the live vectors of the body, made when first asked for
    void* velocity = nullptr;
};

class ItemTable {
public:
    explicit ItemTable(Simulation& simulation) : simulation_(simulation) {}

    /// Pushes the item's object, made when first asked for; null for null.
    void push(duk_context* ctx, const Item* item);
    /// Pushes the object of the item's body; null when it has none.
    void pushBody(duk_context* ctx, const Item* item);
    /// The slot that the object at `index` holds under that key; null when it holds none.
    const ItemSlot* slotOf(duk_context* ctx, duk_idx_t index, const char* hiddenKey) const;
    /// Pushes body.position or body.velocity: a vector whose x and y are the body's.
    void pushLive(duk_context* ctx, const ItemSlot& slot, bool velocity);

private:
    ItemSlot& slot(duk_context* ctx, const Item& item);

    Simulation& simulation_;
    std::vector<ItemSlot> slots_;
    std::unordered_map<std::uint64_t, std::size_t> byId_;
};

/// Adds what is in C++ to the prototypes: of items (items.cpp), bodies and live vectors (bodies.cpp), torques
/// (actuators.cpp), joints (joints.cpp).
void bindItems(duk_context* ctx, duk_idx_t kit);
void bindBodies(duk_context* ctx, duk_idx_t kit);
void bindVectors(duk_context* ctx, duk_idx_t kit);
void bindActuators(duk_context* ctx, duk_idx_t kit);
void bindJoints(duk_context* ctx, duk_idx_t kit);

}  // namespace jet::duktape
