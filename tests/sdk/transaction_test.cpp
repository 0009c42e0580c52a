// Transactions within transactions: savepoints of one undo step. What single ones do is in items_center_test.cpp.
#include "scene_fakes.hpp"

#include <jet/call_watch.hpp>

namespace jet {
namespace {

class NestedTransactionTest : public test::SceneFixture {
protected:
    std::size_t shapes() { return layer().children().size(); }
};

TEST_F(NestedTransactionTest, AnInnerCommitIsPartOfTheOuterStep)
{
    const auto before = scene.hash();
    auto outer = items().begin("Outer");
    outer.add<ShapeItem>(layer());
    {
        auto inner = items().begin("Inner");
        inner.add<ShapeItem>(layer());
        inner.commit("a key that does not count");
    }
    outer.commit();
    EXPECT_EQ(shapes(), 2u);
    EXPECT_EQ(history().labels(), std::vector<std::string>{"Outer"});
    history().undo();
    EXPECT_EQ(scene.hash(), before);
}

TEST_F(NestedTransactionTest, AnInnerRollbackTakesBackItsPartOnly)
{
    auto outer = items().begin("Outer");
    const Item& shape = outer.add<ShapeItem>(layer());
    outer.select(shape);
    const auto before = scene.hash();
    {
        auto inner = items().begin("Inner");
        inner.set(shape, "name", "Changed");
        const Item& second = inner.add<ShapeItem>(layer());
        inner.select(second);
        EXPECT_FALSE(inner.isEmpty());
    }
    EXPECT_EQ(scene.hash(), before);
    EXPECT_EQ(items().selection(), std::vector<ItemId>{shape.id()});
    const Item& third = outer.add<ShapeItem>(layer());
    EXPECT_EQ(third.id().value, shape.id().value + 1) << "the ids that were given are free again";
    outer.commit();
    EXPECT_EQ(shapes(), 2u);
}

TEST_F(NestedTransactionTest, AnExceptionInAHelperLeavesTheOuterTransactionAsItWas)
{
    auto outer = items().begin("Outer");
    const Item& shape = outer.add<ShapeItem>(layer());
    const auto before = scene.hash();
    EXPECT_EQ(failure([&] {
                  auto inner = items().begin("Inner");
                  inner.remove(shape);
                  inner.set(layer(), "no-such-property", 1);
              }),
              "'layer' has no property 'no-such-property'");
    EXPECT_EQ(scene.hash(), before);
    EXPECT_TRUE(outer.isOpen());
}

TEST_F(NestedTransactionTest, TheOuterOneWaitsForTheInner)
{
    auto outer = items().begin("Outer");
    auto inner = items().begin("Inner");
    const std::string message = "finish or cancel 'Inner' first, which was begun inside of 'Outer'";
    EXPECT_EQ(failure([&] { outer.add<ShapeItem>(layer()); }), message);
    EXPECT_EQ(failure([&] { outer.commit(); }), message);
    EXPECT_EQ(failure([&] { outer.restart(); }), message);
    inner.commit();
    outer.add<ShapeItem>(layer());
    outer.commit();
    EXPECT_EQ(shapes(), 1u);
}

TEST_F(NestedTransactionTest, RollingBackTheOuterOneEndsTheInner)
{
    const auto before = scene.hash();
    auto outer = items().begin("Outer");
    outer.add<ShapeItem>(layer());
    auto inner = items().begin("Inner");
    inner.add<ShapeItem>(layer());
    outer.rollback();
    EXPECT_FALSE(inner.isOpen());
    EXPECT_FALSE(items().inTransaction());
    EXPECT_EQ(scene.hash(), before);
    EXPECT_EQ(failure([&] { inner.commit(); }), "the transaction is no longer open");
}

TEST_F(NestedTransactionTest, AbandoningEndsAllOfThem)
{
    const auto before = scene.hash();
    auto outer = items().begin("Outer");
    outer.add<ShapeItem>(layer());
    auto inner = items().begin("Inner");
    inner.add<ShapeItem>(layer());
    EXPECT_EQ(items().transactionLabel(), "Outer");
    items().abandon();
    EXPECT_FALSE(outer.isOpen());
    EXPECT_EQ(scene.hash(), before);
    EXPECT_EQ(items().transactionLabel(), "");
}

TEST_F(NestedTransactionTest, WhatAPluginLeftOpenIsTakenBackWithoutTheOuterOnes)
{
    auto outer = items().begin("Outer");
    outer.add<ShapeItem>(layer());
    const std::size_t open = openTransactionCount();
    auto inner = items().begin("Inner");
    inner.add<ShapeItem>(layer());
    auto innermost = items().begin("Innermost");
    innermost.add<ShapeItem>(layer());
    EXPECT_EQ(openTransactionLabel(items()), "Innermost");
    EXPECT_EQ(openTransactionCount(), open + 2);
    EXPECT_EQ(abandonTransactions(open), "Inner");
    EXPECT_FALSE(inner.isOpen());
    ASSERT_TRUE(outer.isOpen());
    EXPECT_EQ(shapes(), 1u);
    outer.commit();
    EXPECT_EQ(openTransactionCount(), open - 1);
}

TEST_F(NestedTransactionTest, RestartGoesBackToItsOwnBeginning)
{
    auto outer = items().begin("Outer");
    const Item& shape = outer.add<ShapeItem>(layer(), Path::rectangle(Box({0, 0}, {1, 1})));
    auto inner = items().begin("Drag");
    for (int i = 1; i <= 3; ++i) {
        inner.restart();
        inner.transform(shape, Affine::translation(Vec2(i, 0)));
    }
    inner.commit();
    outer.commit();
    EXPECT_EQ(shape.bounds(), Box({3, 0}, {4, 1}));
    history().undo();
    EXPECT_EQ(shapes(), 0u);
}

TEST_F(NestedTransactionTest, ManyLevelsAreOneStep)
{
    const auto before = scene.hash();
    std::vector<Transaction> levels;
    for (int i = 0; i < 100; ++i) {
        levels.push_back(items().begin("Level " + std::to_string(i)));
        levels.back().add<ShapeItem>(layer());
    }
    for (; levels.size() > 1; levels.pop_back()) {
        if (levels.size() % 2 == 0) levels.back().commit();  // the odd ones roll back what is in them
    }
    levels.front().commit();
    EXPECT_EQ(history().size(), 1u);
    const auto after = scene.hash();
    history().undo();
    EXPECT_EQ(scene.hash(), before);
    history().redo();
    EXPECT_EQ(scene.hash(), after);
}

}  // namespace
}  // namespace jet
