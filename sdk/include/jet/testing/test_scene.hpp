// TestScene: a Scene with short ways to look at what is in it.
//
//   ASSERT_EQ(scene.shapes().size(), 1u);
//   EXPECT_EQ(scene.shapes()[0].bounds(), Box({10, 10}, {60, 40}));
//   EXPECT_TRUE(scene.named("Ball").is<BodyItem>());
#pragma once

#include <jet/scene.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace jet::test {

/// Some items of a scene. Its elements are references, so that it reads as a list of items; they live as long as items
/// do.
class ItemList {
public:
    class Iterator {
    public:
        explicit Iterator(const Item* const* at) : at_(at) {}
        const Item& operator*() const { return **at_; }
        Iterator& operator++()
        {
            ++at_;
            return *this;
        }
        bool operator==(const Iterator&) const = default;

    private:
        const Item* const* at_;
    };

    ItemList() = default;
    ItemList(std::initializer_list<const Item*> items) : items_(items) {}
    explicit ItemList(std::vector<const Item*> items) : items_(std::move(items)) {}

    std::size_t size() const { return items_.size(); }
    bool empty() const { return items_.empty(); }
    /// Throws Failure when there are not so many, naming how many there are.
    const Item& operator[](std::size_t index) const;
    const Item& front() const { return (*this)[0]; }
    const Item& back() const { return (*this)[items_.empty() ? 0 : items_.size() - 1]; }
    Iterator begin() const { return Iterator(items_.data()); }
    Iterator end() const { return Iterator(items_.data() + items_.size()); }
    const std::vector<const Item*>& pointers() const { return items_; }
    /// The same items in the same order.
    bool operator==(const ItemList&) const = default;

private:
    std::vector<const Item*> items_;
};

class TestScene final : public Scene {
public:
    using Scene::Scene;

    /// All items of a type, in tree order: bottom first.
    ItemList itemsOf(std::string_view type) const;
    ItemList shapes() const { return itemsOf(ShapeItem::type); }
    ItemList bodies() const { return itemsOf(BodyItem::type); }
    /// All items but the implicit top group.
    ItemList all() const;
    /// The selected items, in the order selected.
    ItemList selected() const;
    /// The first item of that name; throws Failure when there is none.
    const Item& named(std::string_view name) const;
    /// The text of its file: two scenes are equal when their texts are.
    std::string text() const;
};

}  // namespace jet::test
