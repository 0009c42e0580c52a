#include <jet/testing/test_scene.hpp>

#include <jet/project.hpp>

namespace jet::test {

const Item& ItemList::operator[](std::size_t index) const
{
    if (index >= items_.size())
        throw Failure(Error("The test asks for item " + std::to_string(index) + " of a list of " +
                            std::to_string(items_.size()) + "."));
    return *items_[index];
}

ItemList TestScene::itemsOf(std::string_view type) const
{
    std::vector<const Item*> found;
    root().walk([&](const Item& item) {
        if (item.type() == type) found.push_back(&item);
    });
    return ItemList(std::move(found));
}

ItemList TestScene::all() const
{
    std::vector<const Item*> found;
    root().walk([&](const Item& item) {
        if (item.parent()) found.push_back(&item);
    });
    return ItemList(std::move(found));
}

ItemList TestScene::selected() const
{
    std::vector<const Item*> found;
    for (const ItemId id : items().selection()) found.push_back(items().find(id));
    return ItemList(std::move(found));
}

const Item& TestScene::named(std::string_view name) const
{
    if (const Item* item = findByName(root(), name)) return *item;
    throw Failure(Error("The test's scene has no item called '" + std::string(name) + "'."));
}

std::string TestScene::text() const { return writeSceneText(*this); }

}  // namespace jet::test
