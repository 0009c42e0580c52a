#include "canvas/damage_tracker.hpp"

namespace jet::host {

void DamageTracker::visit(const Item& item, bool shown, Box& damage)
{
    shown = shown && item.visible();
    Painted& painted = painted_[item.id().value];
    const bool isNew = painted.pass == 0;
    // An item that comes later in the tree than one it used to precede has changed its place in the stack.
    const bool reordered = !isNew && painted.order < lastOrder_;
    if (!isNew) lastOrder_ = std::max(lastOrder_, painted.order);
    if (isNew || reordered || painted.revision != item.revision() || painted.shown != shown) {
        if (!isNew && painted.shown) damage.extend(painted.box);
        painted.revision = item.revision();
        painted.shown = shown;
        painted.box = item.isContainer() ? Box() : paintedArea(item.bounds());
        if (shown) damage.extend(painted.box);
    }
    painted.order = order_++;
    painted.pass = pass_;
    for (const auto& child : item.children()) visit(*child, shown, damage);
}

Box DamageTracker::update(const Scene& scene)
{
    ++pass_;
    order_ = lastOrder_ = 0;
    Box damage;
    visit(scene.root(), true, damage);
    if (painted_.size() != order_) {  // some were not met: they are gone
        std::erase_if(painted_, [&](const auto& entry) {
            const Painted& painted = entry.second;
            if (painted.pass == pass_) return false;
            if (painted.shown) damage.extend(painted.box);
            return true;
        });
    }
    return damage;
}

void DamageTracker::reset(const Scene& scene) { update(scene); }

}  // namespace jet::host
