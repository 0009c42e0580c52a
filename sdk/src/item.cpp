#include "item_mutator.hpp"

#include <algorithm>
#include <cassert>

namespace jet {

Item::Item(ItemId id, std::string_view type) : id_(id), type_(type) {}

Item::~Item()
{
    // Flatten the subtree first: a deep tree must not be destroyed by deep recursion.
    std::vector<std::unique_ptr<Item>> pending = std::move(children_);
    while (!pending.empty()) {
        const std::unique_ptr<Item> last = std::move(pending.back());
        pending.pop_back();
        for (auto& child : last->children_) pending.push_back(std::move(child));
        last->children_.clear();
    }
}

void Item::touch()
{
    ++revision_;
    for (Item* item = this; item && item->boundsValid_; item = item->parent_) item->boundsValid_ = false;
}

bool Item::shown() const
{
    for (const Item* item = this; item; item = item->parent_)
        if (!item->visible_) return false;
    return true;
}

bool Item::editable() const
{
    for (const Item* item = this; item; item = item->parent_)
        if (item->locked_) return false;
    return true;
}

std::optional<Value> Item::property(std::string_view id) const
{
    if (id == "name") return Value(name_);
    if (id == "visible") return Value(visible_);
    if (id == "locked") return Value(locked_);
    if (const Value* value = properties_.find(id)) return *value;
    return std::nullopt;
}

const EffectInstance* Item::effect(std::string_view type) const
{
    const auto found = std::find_if(effects_.begin(), effects_.end(), [&](const auto& e) { return e.type == type; });
    return found == effects_.end() ? nullptr : &*found;
}

std::size_t Item::index() const
{
    if (!parent_) return 0;
    // From where it was found last, outwards: siblings come and go one by one, so it is there or near.
    const auto& all = parent_->children_;
    const std::size_t hint = std::min<std::size_t>(index_, all.size() - 1);
    for (std::size_t below = hint, above = hint;;) {
        if (all[below].get() == this) return index_ = static_cast<std::uint32_t>(below);
        if (all[above].get() == this) return index_ = static_cast<std::uint32_t>(above);
        assert((below > 0 || above + 1 < all.size()) && "an item that its parent does not have");
        if (below > 0) --below;
        if (above + 1 < all.size()) ++above;
    }
}

const Item* Item::sibling() const
{
    if (!parent_) return nullptr;
    const std::size_t next = index() + 1;
    return next < parent_->children_.size() ? parent_->children_[next].get() : nullptr;
}

const Item* Item::priorSibling() const
{
    const std::size_t here = index();
    return parent_ && here > 0 ? parent_->children_[here - 1].get() : nullptr;
}

bool Item::isAncestorOf(const Item& other) const
{
    for (const Item* item = other.parent_; item; item = item->parent_)
        if (item == this) return true;
    return false;
}

Box Item::bounds() const
{
    if (!boundsValid_) {
        bounds_ = path_.bounds();
        for (const auto& child : children_) {
            const Box box = child->bounds();
            if (!box.isNull()) bounds_.extend(box);
        }
        boundsValid_ = true;
    }
    return bounds_;
}

void Item::Mutator::setProperty(Item& item, std::string_view id, const Value& value)
{
    if (id == "name") {
        item.name_ = value.as<std::string>();
    } else if (id == "visible") {
        item.visible_ = value.as<bool>();
    } else if (id == "locked") {
        item.locked_ = value.as<bool>();
    } else if (value.isNone()) {
        item.properties_.erase(id);
    } else {
        item.properties_.set(id, value);
    }
    item.touch();
}

void Item::Mutator::insert(Item& parent, std::size_t index, std::unique_ptr<Item> child)
{
    child->parent_ = &parent;
    child->index_ = static_cast<std::uint32_t>(index);
    parent.children_.insert(parent.children_.begin() + static_cast<std::ptrdiff_t>(index), std::move(child));
    for (Item* item = &parent; item && item->boundsValid_; item = item->parent_) item->boundsValid_ = false;
}

std::unique_ptr<Item> Item::Mutator::take(Item& parent, std::size_t index)
{
    std::unique_ptr<Item> child = std::move(parent.children_[index]);
    parent.children_.erase(parent.children_.begin() + static_cast<std::ptrdiff_t>(index));
    child->parent_ = nullptr;
    for (Item* item = &parent; item && item->boundsValid_; item = item->parent_) item->boundsValid_ = false;
    return child;
}

std::unique_ptr<Item> Item::Mutator::copyAlone(const Item& source, ItemId id)
{
    auto copy = std::make_unique<Item>(id, source.type_);
    copy->name_ = source.name_;
    copy->path_ = source.path_;
    copy->properties_ = source.properties_;
    copy->effects_ = source.effects_;
    copy->visible_ = source.visible_;
    copy->locked_ = source.locked_;
    return copy;
}

const Item* findByName(const Item& root, std::string_view name)
{
    const Item* found = nullptr;
    root.walk([&](const Item& item) {
        if (!found && item.name() == name) found = &item;
        return found == nullptr;
    });
    return found;
}

const Item* findClosestByName(const Item& from, std::string_view name)
{
    for (const Item* level = &from; level->parent(); level = level->parent()) {
        for (const auto& sibling : level->parent()->children())
            if (sibling.get() != level && sibling->name() == name) return sibling.get();
        for (const auto& sibling : level->parent()->children()) {
            if (sibling.get() == level) continue;
            if (const Item* found = findByName(*sibling, name)) return found;
        }
        if (level->parent()->name() == name) return level->parent();
    }
    return nullptr;
}

bool isPaintedBefore(const Item& a, const Item& b)
{
    const auto depth = [](const Item* item) {
        int count = 0;
        while ((item = item->parent())) ++count;
        return count;
    };
    const Item *x = &a, *y = &b;
    int depthX = depth(x), depthY = depth(y);
    const int levels = depthX - depthY;
    while (depthX > depthY) x = x->parent(), --depthX;
    while (depthY > depthX) y = y->parent(), --depthY;
    if (x == y) return levels < 0;  // one is an ancestor of the other, and painted first
    while (x->parent() != y->parent()) x = x->parent(), y = y->parent();
    return x->index() < y->index();
}

Affine frameOf(const Path& path)
{
    Vec2 origin, right, down;
    if (const std::size_t count = path.segmentCount(); count >= 4) {
        origin = path.segment(0).point;
        right = path.segment(1).point - origin;
        down = path.segment(count - 1).point - origin;
    } else if (const Box box = path.bounds(); !box.isNull()) {
        origin = box.min;
        right = Vec2(box.width(), 0);
        down = Vec2(0, box.height());
    }
    return Affine::fromSvg(right.x(), right.y(), down.x(), down.y(), origin.x(), origin.y());
}

const Item& topGroup(const Item& item)
{
    const Item* top = &item;
    while (top->parent()) top = top->parent();
    return *top;
}

}  // namespace jet
