// The one door through which the SDK changes an Item; plugins have no such door.
#pragma once

#include <jet/item.hpp>

namespace jet {

struct Item::Mutator {
    static void setPath(Item& item, Path path)
    {
        item.path_ = std::move(path);
        item.touch();
    }
    static void setProperties(Item& item, Properties properties)
    {
        item.properties_ = std::move(properties);
        item.touch();
    }
    /// Also "name", "visible", "locked"; a None value erases.
    static void setProperty(Item& item, std::string_view id, const Value& value);
    static void setType(Item& item, std::string_view type)
    {
        item.type_ = type;
        item.touch();
    }
    static void setName(Item& item, std::string name)
    {
        item.name_ = std::move(name);
        item.touch();
    }
    static void setFlags(Item& item, bool visible, bool locked)
    {
        item.visible_ = visible, item.locked_ = locked;
        item.touch();
    }
    static std::uint32_t& slot(Item& item) { return item.slot_; }
    static std::uint32_t slot(const Item& item) { return item.slot_; }
    static std::uint32_t& order(const Item& item) { return item.order_; }
    static void setId(Item& item, ItemId id) { item.id_ = id; }
    static std::vector<EffectInstance>& effects(Item& item)
    {
        item.touch();
        return item.effects_;
    }
    static const std::vector<std::unique_ptr<Item>>& children(const Item& item) { return item.children_; }
    static void insert(Item& parent, std::size_t index, std::unique_ptr<Item> child);
    static std::unique_ptr<Item> take(Item& parent, std::size_t index);
    static Item* child(Item& parent, std::size_t index) { return parent.children_[index].get(); }
    /// A copy of everything but the children.
    static std::unique_ptr<Item> copyAlone(const Item& source, ItemId id);
};

}  // namespace jet
