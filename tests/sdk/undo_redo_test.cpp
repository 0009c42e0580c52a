#include "scene_fakes.hpp"

#include <random>

namespace jet {
namespace {

class UndoRedoTest : public test::SceneFixture {
protected:
    void rename(const Item& item, std::string name, std::string_view mergeKey = {})
    {
        auto edit = items().begin("Rename");
        edit.set(item, "name", std::move(name));
        edit.commit(mergeKey);
    }
};

TEST_F(UndoRedoTest, LabelsTellWhatIsUndoneAndRedone)
{
    EXPECT_FALSE(history().canUndo());
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    rename(shape, "a");
    EXPECT_EQ(history().labels(), (std::vector<std::string>{"Add", "Rename"}));
    EXPECT_EQ(history().undoLabel(), "Rename");
    EXPECT_EQ(history().redoLabel(), "");
    history().undo();
    EXPECT_EQ(history().undoLabel(), "Add");
    EXPECT_EQ(history().redoLabel(), "Rename");
}

TEST_F(UndoRedoTest, UndoAtTheEndsIsNothing)
{
    const auto hash = scene.hash();
    history().undo();
    history().redo();
    EXPECT_EQ(scene.hash(), hash);
}

TEST_F(UndoRedoTest, ItemsComeBackAsTheSameObjects)
{
    const Item* shape = &addBox(Box({0, 0}, {1, 1}));
    const ItemId id = shape->id();
    auto edit = items().begin("Remove");
    edit.remove(*shape);
    edit.commit();
    EXPECT_EQ(items().find(id), nullptr);
    history().undo();
    EXPECT_EQ(items().find(id), shape);
}

TEST_F(UndoRedoTest, ANewStepForgetsWhatWasUndone)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    rename(shape, "a");
    history().undo();
    rename(shape, "b");
    EXPECT_FALSE(history().canRedo());
    EXPECT_EQ(history().position(), 2u);
}

TEST_F(UndoRedoTest, NothingIsUndoneInsideATransaction)
{
    addBox(Box({0, 0}, {1, 1}));
    auto edit = items().begin("Drag");
    EXPECT_EQ(failure([&] { history().undo(); }), "finish or cancel 'Drag' before undoing");
    EXPECT_EQ(failure([&] { history().redo(); }), "finish or cancel 'Drag' before redoing");
}

TEST_F(UndoRedoTest, GoingToAPositionTakesAllStepsBetween)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    std::vector<std::uint64_t> hashes{scene.hash()};
    for (int i = 0; i < 10; ++i) rename(shape, std::to_string(i)), hashes.push_back(scene.hash());
    history().goTo(4);
    EXPECT_EQ(scene.hash(), hashes[3]);
    history().goTo(11);
    EXPECT_EQ(scene.hash(), hashes[10]);
    history().goTo(1000);
    EXPECT_EQ(history().position(), 11u);
}

TEST_F(UndoRedoTest, StepsWithOneMergeKeyAreOne)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    const auto before = scene.hash();
    for (const char* name : {"a", "ab", "abc"}) rename(shape, name, "rename");
    EXPECT_EQ(history().position(), 2u);
    const auto after = scene.hash();
    history().undo();
    EXPECT_EQ(scene.hash(), before);
    history().redo();
    EXPECT_EQ(scene.hash(), after);
    EXPECT_EQ(shape.name(), "abc");
}

TEST_F(UndoRedoTest, OtherKeysAndOtherStepsBetweenKeepThemApart)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    rename(shape, "a", "one");
    rename(shape, "b", "two");
    rename(shape, "c");
    rename(shape, "d", "two");
    EXPECT_EQ(history().position(), 5u);
    history().undo();
    rename(shape, "e", "two");
    EXPECT_EQ(history().position(), 5u) << "not joined to what was there before the undo";
}

TEST_F(UndoRedoTest, NothingJoinsTheSavedState)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    rename(shape, "a", "rename");
    history().markClean();
    rename(shape, "b", "rename");
    EXPECT_FALSE(history().isClean());
    history().undo();
    EXPECT_TRUE(history().isClean());
    EXPECT_EQ(shape.name(), "a");
}

// Two steps that look alike: value at place 0, then the places change. Joined value by value, the second value would be
// undone at the wrong place.
TEST_F(UndoRedoTest, MergedStepsThatMovePlacesStayExact)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    {
        auto edit = items().begin("Effects");
        edit.addEffect(shape, "tint", {{"width", 1.0}});
        edit.addEffect(shape, "tint", {{"width", 2.0}});
        edit.commit();
    }
    std::vector<std::uint64_t> hashes{scene.hash()};
    for (const double width : {10.0, 20.0}) {
        auto edit = items().begin("Swap");
        edit.setEffect(shape, 0, "width", width);
        edit.moveEffect(shape, 0, 1);
        edit.commit("swap");
        hashes.push_back(scene.hash());
    }
    EXPECT_EQ(history().position(), 3u);
    history().undo();
    EXPECT_EQ(scene.hash(), hashes[0]);
    history().redo();
    EXPECT_EQ(scene.hash(), hashes[2]);
}

TEST_F(UndoRedoTest, CleanIsAPlaceInTheHistory)
{
    EXPECT_TRUE(history().isClean());
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    EXPECT_FALSE(history().isClean());
    history().markClean();
    rename(shape, "a");
    history().undo();
    EXPECT_TRUE(history().isClean());
    history().undo();
    EXPECT_FALSE(history().isClean());
    addBox(Box({0, 0}, {2, 2}));  // the saved state cannot be reached any more
    EXPECT_FALSE(history().isClean());
    history().undo();
    EXPECT_FALSE(history().isClean());
}

// --- the random walk

/// One random edit of the scene through a transaction that may be committed, merged or rolled back.
class Editor {
public:
    Editor(Scene& scene, std::uint32_t seed) : scene_(scene), random_(seed) {}

    void edit()
    {
        auto edit = scene_.items().begin("Random");
        const std::size_t count = 1 + roll(4);
        for (std::size_t i = 0; i < count; ++i) {
            try {
                change(edit);
            } catch (const Failure&) {
                // e.g. a group into itself: refused, and nothing happened
            }
        }
        if (roll(10) == 0) return;  // rolled back
        edit.commit(roll(4) == 0 ? "merge" : "");
    }

private:
    std::size_t roll(std::size_t sides) { return random_() % sides; }
    double real() { return std::uniform_real_distribution<double>(-1000, 1000)(random_); }
    const Item& any()
    {
        std::vector<const Item*> all;
        scene_.root().walk([&](const Item& item) { all.push_back(&item); });
        return *all[roll(all.size())];
    }
    const Item& container()
    {
        for (int i = 0; i < 20; ++i)
            if (const Item& item = any(); item.isContainer()) return item;
        return scene_.root();
    }
    Path path()
    {
        const Vec2 a(real(), real()), b(real(), real());
        return Path::ellipse(Box(a.cwiseMin(b), a.cwiseMax(b)));
    }
    Affine affine()
    {
        return Affine::translation({real(), real()}) * Affine::rotation(real()) *
               Affine::scaling({1 + real() / 2000, 1.1});
    }

    void change(Transaction& edit)
    {
        static constexpr const char* types[] = {"shape",  "body",   "group", "layer",
                                                "script", "torque", "rope",  "spring"};
        switch (roll(16)) {
        case 0:
        case 1: edit.add(types[roll(8)], container(), roll(2) ? path() : Path(), roll(5)); break;
        case 2: edit.remove(any()); break;
        case 3: edit.move(any(), container(), roll(5)); break;
        case 4: edit.set(any(), "name", "n" + std::to_string(roll(100))); break;
        case 5: edit.set(any(), roll(2) ? "visible" : "locked", roll(2) == 0); break;
        case 6: edit.setPath(any(), path()); break;
        case 7: edit.transform(any(), affine()); break;
        case 8: edit.setType(any(), types[roll(8)]); break;
        case 9: edit.addEffect(any(), "tint", {{"width", std::abs(real()) / 20}}); break;
        case 10: edit.removeEffect(any(), roll(2)); break;
        case 11: edit.moveEffect(any(), roll(3), roll(3)); break;
        case 12:
            edit.setEffect(any(), roll(2), roll(2) ? "width" : "visible", roll(2) ? Value(5.5) : Value(roll(2) == 0));
            break;
        case 13: edit.setScene("gravity", roll(3) ? Value(Vec2(real(), real())) : Value()); break;
        case 14: edit.addCopy(any(), container(), roll(5)); break;
        case 15: {
            MaterialTable table = scene_.materials();
            if (table.size() < 5) table.add("m" + std::to_string(roll(1000)));
            table.setPair(0, roll(table.size()), {std::abs(real()), 0.5, true});
            edit.setMaterials(table);
            edit.setSelection({any().id(), any().id()});
            break;
        }
        }
        if (scene_.items().itemCount() > 300) edit.remove(*scene_.root().children()[0]);
    }

    Scene& scene_;
    std::mt19937 random_;
};

class RandomWalkTest : public UndoRedoTest, public testing::WithParamInterface<std::uint32_t> {};

TEST_P(RandomWalkTest, EveryStateIsReachedAgainBitForBit)
{
    Editor editor(scene, GetParam());
    std::vector<std::uint64_t> hashes{scene.hash()};  // by position
    std::mt19937 random(GetParam() + 1);
    for (int i = 0; i < 1500; ++i) {
        if (random() % 4 == 0) {
            history().goTo(random() % (hashes.size() + 1));
        } else {
            editor.edit();
            if (history().canRedo()) {
                ASSERT_EQ(scene.hash(), hashes[history().position()]) << "it was rolled back or changed nothing";
            } else {
                hashes.resize(history().position());
                hashes.push_back(scene.hash());
            }
        }
        ASSERT_EQ(hashes.size(), history().labels().size() + 1);
        ASSERT_EQ(scene.hash(), hashes[history().position()]);
        ASSERT_EQ(scene.clone(events)->hash(), scene.hash());
    }
    for (std::size_t position = hashes.size(); position-- > 0;) {
        history().goTo(position);
        ASSERT_EQ(scene.hash(), hashes[position]) << "at step " << position;
    }
    history().goTo(history().labels().size());
    EXPECT_EQ(scene.hash(), hashes[history().position()]);
}

INSTANTIATE_TEST_SUITE_P(UndoRedo, RandomWalkTest, testing::Values(1U, 2U, 3U, 4U));

}  // namespace
}  // namespace jet
