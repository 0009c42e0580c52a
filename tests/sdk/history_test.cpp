// The history's memory, its saved state and who hears of it. Undo and redo themselves are in undo_redo_test.cpp.
#include "scene_fakes.hpp"

namespace jet {
namespace {

class HistoryTest : public test::SceneFixture {
protected:
    void rename(const Item& item, std::string name)
    {
        auto edit = items().begin("Rename");
        edit.set(item, "name", std::move(name));
        edit.commit();
    }
};

TEST_F(HistoryTest, TenThousandStepsFitAndAreAllUndone)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    const auto before = scene.hash();
    for (int i = 0; i < 10'000; ++i) {
        auto edit = items().begin("Move");
        edit.transform(shape, Affine::translation({0.1, 0.3}));
        edit.commit();
    }
    EXPECT_EQ(history().size(), 10'001u);
    EXPECT_EQ(history().forgotten(), 0u);
    EXPECT_LT(history().memory(), UndoRedoCenter::kDefaultMemoryLimit / 16);
    history().goTo(1);
    EXPECT_EQ(scene.hash(), before);
}

TEST_F(HistoryTest, TheOldestStepsAreForgottenWhenMemoryIsShort)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    history().setMemoryLimit(100'000);
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < 100; ++i) {
        rename(shape, std::string(4000, static_cast<char>('a' + i % 26)));
        hashes.push_back(scene.hash());
        ASSERT_LE(history().memory(), 100'000u);
    }
    EXPECT_EQ(history().size() + history().forgotten(), 101u);
    EXPECT_GT(history().size(), 8u);
    EXPECT_LT(history().size(), 26u);
    const std::size_t kept = history().size();
    history().goTo(0);
    EXPECT_EQ(scene.hash(), hashes[100 - kept - 1]);
    history().goTo(kept);
    EXPECT_EQ(scene.hash(), hashes.back());
}

TEST_F(HistoryTest, TheLastStepIsKeptHoweverLargeItIs)
{
    history().setMemoryLimit(1);
    addBox(Box({0, 0}, {1, 1}));
    const Item& second = addBox(Box({0, 0}, {1, 1}));
    EXPECT_EQ(history().size(), 1u);
    history().undo();
    EXPECT_EQ(items().find(second.id()), nullptr);
}

TEST_F(HistoryTest, WhatARemovedSubtreeTakesCounts)
{
    auto edit = items().begin("Large");
    const Item& group = edit.add<GroupItem>(layer());
    for (int i = 0; i < 1000; ++i) edit.add<ShapeItem>(group, Path::ellipse(Box({0, 0}, {1, 1})));
    edit.commit();
    const std::size_t before = history().memory();
    edit.rollback();
    auto removal = items().begin("Remove");
    removal.remove(group);
    removal.commit();
    EXPECT_GT(history().memory() - before, 1000u * 4 * sizeof(Segment));
}

TEST_F(HistoryTest, ASavedStateThatWasForgottenIsNeverReachedAgain)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    rename(shape, "saved");
    history().markClean();
    EXPECT_EQ(history().cleanPosition(), 2u);
    rename(shape, "later");
    history().setMemoryLimit(1);
    EXPECT_EQ(history().size(), 1u);
    EXPECT_EQ(history().cleanPosition(), 0u) << "before the one step that is left";
    rename(shape, "last");
    EXPECT_EQ(history().cleanPosition(), std::nullopt);
    history().goTo(0);
    EXPECT_FALSE(history().isClean());
}

TEST_F(HistoryTest, EachChangeOfTheHistoryIsTold)
{
    int told = 0;
    const auto subscription = events.subscribe<HistoryChanged>(&scene, [&](const HistoryChanged&) { ++told; });
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    EXPECT_EQ(told, 1);
    history().markClean();
    EXPECT_EQ(told, 2);
    history().markClean();
    EXPECT_EQ(told, 2) << "nothing changed";
    rename(shape, "a");
    history().undo();
    history().redo();
    EXPECT_EQ(told, 5);
    history().clear();
    EXPECT_EQ(told, 6);
    items().begin("Nothing").commit();
    EXPECT_EQ(told, 6);
}

TEST_F(HistoryTest, AListenerMayEditWhileItIsToldOfAStep)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    rename(shape, "first");
    rename(shape, "second");
    std::size_t seen = 0;
    bool reacted = false;
    const auto subscription = events.subscribe<ItemsChanged>(&scene, [&](const ItemsChanged& e) {
        if (std::exchange(reacted, true)) return;
        for (int i = 0; i < 50; ++i) rename(shape, "by a listener " + std::to_string(i));  // forgets the redo steps
        for (const Change& change : e.changes) seen += changedItem(change) == shape.id();
    });
    history().undo();
    EXPECT_EQ(seen, 1u) << "what was told of is still there";
    EXPECT_EQ(history().size(), 52u);
}

TEST_F(HistoryTest, StepsAreToldInTheOrderMadeToEveryListener)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    bool reacted = false;
    std::vector<std::string> first, second;
    const auto note = [&](std::vector<std::string>& names, const ItemsChanged& e) {
        for (const Change& change : e.changes) names.push_back(std::get<PropertyChanged>(change).after.text());
    };
    const auto a = events.subscribe<ItemsChanged>(&scene, [&](const ItemsChanged& e) {
        note(first, e);
        if (!std::exchange(reacted, true)) rename(shape, "reaction");
    });
    const auto b = events.subscribe<ItemsChanged>(&scene, [&](const ItemsChanged& e) { note(second, e); });
    rename(shape, "action");
    EXPECT_EQ(first, (std::vector<std::string>{"action", "reaction"}));
    EXPECT_EQ(second, first) << "else a journal of them could not be replayed";
}

}  // namespace
}  // namespace jet
