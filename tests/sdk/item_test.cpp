#include "scene_fakes.hpp"

namespace jet {
namespace {

class ItemTest : public test::SceneFixture {
protected:
    const Item& add(std::string_view type, std::string name, const Item& parent, Path path = {})
    {
        auto edit = items().begin("Add");
        const Item& item = edit.add(type, parent, std::move(path));
        edit.set(item, "name", std::move(name));
        edit.commit();
        return item;
    }
};

TEST_F(ItemTest, SiblingsAndPlacesFollowTheTree)
{
    const Item& a = add("shape", "a", layer());
    const Item& b = add("shape", "b", layer());
    EXPECT_EQ(a.sibling(), &b);
    EXPECT_EQ(b.priorSibling(), &a);
    EXPECT_EQ(a.priorSibling(), nullptr);
    EXPECT_EQ(b.sibling(), nullptr);
    EXPECT_EQ(b.index(), 1u);
    EXPECT_EQ(scene.root().sibling(), nullptr);
    EXPECT_TRUE(scene.root().isAncestorOf(a));
    EXPECT_FALSE(a.isAncestorOf(a));
    EXPECT_EQ(&topGroup(a), &scene.root());
}

TEST_F(ItemTest, VisibilityAndLocksComeFromAllAncestors)
{
    const Item& group = add("group", "group", layer());
    const Item& shape = add("shape", "shape", group);
    EXPECT_TRUE(shape.shown() && shape.editable());
    auto edit = items().begin("Hide");
    edit.set(layer(), "visible", false);
    edit.set(group, "locked", true);
    edit.commit();
    EXPECT_FALSE(shape.shown());
    EXPECT_FALSE(shape.editable());
    EXPECT_TRUE(shape.visible() && !shape.locked());
}

TEST_F(ItemTest, BoundsFollowEachChangeBelow)
{
    const Item& group = add("group", "group", layer());
    EXPECT_TRUE(group.bounds().isNull());
    const Item& shape = add("shape", "shape", group, Path::rectangle(Box({0, 0}, {10, 10})));
    EXPECT_EQ(scene.root().bounds(), Box({0, 0}, {10, 10}));
    auto edit = items().begin("Change");
    edit.transform(group, Affine::translation({5, 0}));
    EXPECT_EQ(scene.root().bounds(), Box({5, 0}, {15, 10}));
    const Item& other = edit.add("shape", layer(), Path::rectangle(Box({100, 100}, {110, 110})));
    EXPECT_EQ(scene.root().bounds(), Box({5, 0}, {110, 110}));
    edit.move(other, group, 0);
    EXPECT_EQ(group.bounds(), Box({5, 0}, {110, 110}));
    edit.remove(other);
    EXPECT_EQ(layer().bounds(), Box({5, 0}, {15, 10}));
    edit.remove(shape);
    EXPECT_TRUE(scene.root().bounds().isNull());
    edit.rollback();
    EXPECT_EQ(scene.root().bounds(), Box({0, 0}, {10, 10}));
}

TEST_F(ItemTest, RevisionsGrowWithTheItemsOwnChangesOnly)
{
    const Item& shape = add("shape", "shape", layer(), Path::rectangle(Box({0, 0}, {1, 1})));
    const auto own = shape.revision(), parents = layer().revision();
    auto edit = items().begin("Change");
    edit.setPath(shape, Path::rectangle(Box({0, 0}, {2, 2})));
    edit.commit();
    EXPECT_GT(shape.revision(), own);
    EXPECT_EQ(layer().revision(), parents);
    const auto changed = shape.revision();
    history().undo();
    EXPECT_GT(shape.revision(), changed) << "an undone path is another path for who kept something of it";
}

TEST_F(ItemTest, TheClosestNameWinsOverTheFirst)
{
    const Item& far = add("group", "far", layer());
    const Item& farBall = add("shape", "Ball", far);
    const Item& near = add("group", "near", layer());
    const Item& script = add("script", "Script", near);
    EXPECT_EQ(findClosestByName(script, "Ball"), &farBall);
    const Item& nearBall = add("shape", "Ball", near);
    EXPECT_EQ(findClosestByName(script, "Ball"), &nearBall);
    EXPECT_EQ(findByName(scene.root(), "Ball"), &farBall);
    EXPECT_EQ(findClosestByName(script, "near"), &near);
    EXPECT_EQ(findClosestByName(script, "Script"), nullptr) << "oneself is not looked for";
    EXPECT_EQ(findByName(scene.root(), "nobody"), nullptr);
}

TEST_F(ItemTest, EffectsAreFoundByType)
{
    const Item& shape = add("shape", "shape", layer(), Path::rectangle(Box({0, 0}, {1, 1})));
    auto edit = items().begin("Effects");
    edit.addEffect(shape, "tint", {{"width", 3}});
    edit.addEffect(shape, "tint", {{"width", 4}});
    edit.commit();
    ASSERT_NE(shape.effect("tint"), nullptr);
    EXPECT_EQ(*shape.effect("tint")->properties.find("width"), Value(3.0))
        << "the first one, its integer kept as a real";
    EXPECT_EQ(shape.effect("hook"), nullptr);
}

}  // namespace
}  // namespace jet
