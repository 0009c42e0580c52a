#include "scene_fakes.hpp"

#include <gmock/gmock.h>

namespace jet {
namespace {

using test::Hooks;
using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class ItemsCenterTest : public test::SceneFixture {};

// --- transactions as a whole

TEST_F(ItemsCenterTest, LeavingWithoutCommitRestoresEverything)
{
    const Item& shape = addBox(Box({0, 0}, {10, 10}));
    const auto before = scene.hash();
    {
        auto edit = items().begin("Everything");
        const Item& group = edit.add<GroupItem>(layer());
        edit.move(shape, group, 0);
        edit.transform(group, Affine::scaling({2, 3}));
        edit.addEffect(shape, "tint");
        edit.setType(shape, "body");
        edit.set(shape, "name", "other");
        edit.setScene("gravity", Vec2(1, 2));
        MaterialTable materials("ice");
        edit.setMaterials(materials);
        edit.addCopy(group, layer());
        edit.remove(shape);
        EXPECT_NE(scene.hash(), before);
    }
    EXPECT_EQ(scene.hash(), before);
    EXPECT_EQ(history().position(), 1u);
    EXPECT_FALSE(items().inTransaction());
}

TEST_F(ItemsCenterTest, AnExceptionRestoresEverything)
{
    const auto before = scene.hash();
    EXPECT_THROW(
        {
            auto edit = items().begin("Half");
            edit.add<ShapeItem>(layer(), Path::rectangle(Box({0, 0}, {1, 1})));
            throw std::runtime_error("half-way");
        },
        std::runtime_error);
    EXPECT_EQ(scene.hash(), before);
}

TEST_F(ItemsCenterTest, AFinishedTransactionRefusesFurtherWork)
{
    auto edit = items().begin("Add");
    edit.commit();
    EXPECT_FALSE(edit.isOpen());
    EXPECT_EQ(failure([&] { edit.add<ShapeItem>(layer()); }), "the transaction is no longer open");
    edit.rollback();  // of nothing
    // Another one is none of its business.
    auto second = items().begin("Second");
    EXPECT_EQ(failure([&] { edit.commit(); }), "the transaction is no longer open");
    EXPECT_TRUE(second.isOpen());
}

TEST_F(ItemsCenterTest, ATransactionAbandonedByTheGuardLeavesTheNextOneAlone)
{
    const auto before = scene.hash();
    auto lost = items().begin("Tool that failed");
    lost.add<ShapeItem>(layer());
    items().abandon();
    EXPECT_EQ(scene.hash(), before);
    auto next = items().begin("Next");
    next.add<ShapeItem>(layer());
    lost.rollback();
    EXPECT_TRUE(next.isOpen());
    next.commit();
    EXPECT_EQ(layer().children().size(), 1u);
}

TEST_F(ItemsCenterTest, RestartGoesBackToTheBeginning)
{
    const Item& shape = addBox(Box({0, 0}, {10, 10}));
    auto edit = items().begin("Drag");
    const auto before = scene.hash();
    for (int i = 0; i < 100; ++i) {
        edit.restart();
        EXPECT_EQ(scene.hash(), before);
        edit.transform(shape, Affine::translation({0.1 * i, 0.7 * i}));
    }
    edit.commit();
    EXPECT_EQ(shape.path(),
              Path::rectangle(Box({0, 0}, {10, 10})).transformed(Affine::translation({0.1 * 99, 0.7 * 99})))
        << "one movement, not a hundred rounded ones";
    EXPECT_EQ(history().position(), 2u);
}

TEST_F(ItemsCenterTest, NothingChangedMakesNoUndoStep)
{
    const Item& shape = addBox(Box({0, 0}, {10, 10}));
    auto edit = items().begin("Nothing");
    edit.set(shape, "name", shape.name());
    edit.setPath(shape, shape.path());
    edit.transform(shape, Affine());
    edit.move(shape, layer(), 0);
    edit.setType(shape, "shape");
    edit.select(shape);
    EXPECT_TRUE(edit.isEmpty());
    edit.commit();
    EXPECT_EQ(history().position(), 1u);
    EXPECT_TRUE(items().isSelected(shape.id())) << "selecting needs no step";
}

TEST_F(ItemsCenterTest, TheSelectionBelongsToTheStep)
{
    const Item& a = addBox(Box({0, 0}, {1, 1}));
    const Item& b = addBox(Box({2, 0}, {3, 1}));
    items().setSelection({b.id(), a.id()});
    {
        auto edit = items().begin("Delete");
        edit.remove(a);
        EXPECT_EQ(items().selection(), std::vector{b.id()});
        edit.setSelection({});
        edit.commit();
    }
    history().undo();
    EXPECT_EQ(items().selection(), (std::vector{b.id(), a.id()}));
    history().redo();
    EXPECT_TRUE(items().selection().empty());
    {
        items().setSelection({b.id()});
        auto edit = items().begin("Rolled back");
        edit.remove(b);
    }
    EXPECT_EQ(items().selection(), std::vector{b.id()});
}

TEST_F(ItemsCenterTest, TheSelectionHoldsKnownItemsOnce)
{
    const Item& a = addBox(Box({0, 0}, {1, 1}));
    items().setSelection({a.id(), a.id(), ItemId{777}, scene.root().id()});
    EXPECT_EQ(items().selection(), std::vector{a.id()});
    items().setSelection({ItemId{777}});
    EXPECT_TRUE(items().selection().empty());
}

TEST_F(ItemsCenterTest, ManyItemsAreSelectedInAMoment)
{
    auto edit = items().begin("Many");
    std::vector<ItemId> all;
    for (int i = 0; i < 100'000; ++i) all.push_back(edit.add<ShapeItem>(layer()).id());
    edit.commit();
    items().setSelection(all);
    std::size_t found = 0;
    for (const ItemId id : all) found += items().isSelected(id);
    EXPECT_EQ(found, all.size());
    auto removal = items().begin("Delete");
    removal.remove(layer());
    removal.commit();
    EXPECT_TRUE(items().selection().empty());
}

// --- what cannot be done leaves the scene as it was

struct Refusal {
    const char* name;
    const char* message;
    std::function<void(Transaction&, const Item& layer, const Item& shape)> attempt;
};

std::ostream& operator<<(std::ostream& out, const Refusal& refusal) { return out << refusal.name; }

const std::vector<Refusal>& refusals()
{
    static const std::vector<Refusal> all{
        {"UnknownItemType", "item type 'spaceship'", [](auto& e, auto& l, auto&) { e.add("spaceship", l); }},
        {"UnknownEffect", "effect 'sparkle'", [](auto& e, auto&, auto& s) { e.addEffect(s, "sparkle"); }},
        {"UnknownTypeToTurnInto", "item type 'spaceship'", [](auto& e, auto&, auto& s) { e.setType(s, "spaceship"); }},
        {"ChildOfAShape", "not a group or layer", [](auto& e, auto&, auto& s) { e.add("shape", s); }},
        {"CopyIntoAShape", "not a group or layer", [](auto& e, auto& l, auto& s) { e.addCopy(l, s); }},
        {"NaNInANewPath", "not a number",
         [](auto& e, auto& l, auto&) {
             e.add("shape", l, Path::line({0, 0}, {kNaN, 1}));
         }},
        {"NaNInAPath", "not a number",
         [](auto& e, auto&, auto& s) {
             e.setPath(s, Path::line({0, kNaN}, {1, 1}));
         }},
        {"NaNInATransform", "not a number",
         [](auto& e, auto& l, auto&) {
             e.transform(l, Affine::translation({kNaN, 0}));
         }},
        {"OverflowInATransform", "not a number",
         [](auto& e, auto& l, auto&) {
             e.transform(l, Affine::scaling({1e308, 1e308}));
         }},
        {"SegmentThatIsNotThere", "no segment 9",
         [](auto& e, auto&, auto& s) {
             const std::size_t segments[] = {0, 9};
             e.transform(s, Affine::translation({1, 1}), segments);
         }},
        {"IntoItself", "into itself", [](auto& e, auto& l, auto&) { e.move(l, l, 0); }},
        {"IntoAChild", "into itself",
         [](auto& e, auto& l, auto&) {
             const Item& group = *l.children()[1];
             e.move(l, group, 0);
         }},
        {"RemovingTheTop", "cannot be removed", [](auto& e, auto& l, auto&) { e.remove(*l.parent()); }},
        {"MovingTheTop", "cannot be moved", [](auto& e, auto& l, auto&) { e.move(*l.parent(), l, 0); }},
        {"ChangingTheTop", "cannot be changed", [](auto& e, auto& l, auto&) { e.set(*l.parent(), "visible", false); }},
        {"UnknownProperty", "has no property 'speed'", [](auto& e, auto&, auto& s) { e.set(s, "speed", 1); }},
        {"NameThatIsANumber", "a name is a text", [](auto& e, auto&, auto& s) { e.set(s, "name", 1); }},
        {"NameThatIsNotUtf8", "not UTF-8", [](auto& e, auto&, auto& s) { e.set(s, "name", "\xff"); }},
        {"NameWithNul", "NUL", [](auto& e, auto&, auto& s) { e.set(s, "name", std::string("a\0b", 3)); }},
        {"VisibleAsText", "true or false", [](auto& e, auto&, auto& s) { e.set(s, "visible", "yes"); }},
        {"SceneValueOutOfRange", "must be from", [](auto& e, auto&, auto&) { e.setScene("time-step", 0.0); }},
        {"RestitutionAboveOne", "the materials 'ice' and 'ice': restitution is 2",
         [](auto& e, auto&, auto&) {
             MaterialTable table("ice");
             table.setPair(0, 0, {0.5, 2, true});
             e.setMaterials(table);
         }},
        {"SceneValueNaN", "finite", [](auto& e, auto&, auto&) { e.setScene("gravity", Vec2(kNaN, 0)); }},
        {"EffectValueOutOfRange", "must be from", [](auto& e, auto&, auto& s) { e.setEffect(s, 0, "width", 1000.0); }},
        {"EffectThatIsNotThere", "no effect number 5",
         [](auto& e, auto&, auto& s) { e.setEffect(s, 5, "width", 1.0); }},
        {"RemovingAnEffectThatIsNotThere", "no effect number 1", [](auto& e, auto&, auto& s) { e.removeEffect(s, 1); }},
        {"MovingAnEffectTooFar", "no effect number 3", [](auto& e, auto&, auto& s) { e.moveEffect(s, 0, 3); }},
        {"EffectWithAnUnknownValue", "no property 'speed'",
         [](auto& e, auto&, auto& s) {
             e.addEffect(s, "tint", {{"speed", 1}});
         }},
        {"EffectOnAnItemWithoutPath", "no path",
         [](auto& e, auto& l, auto&) { e.addEffect(*l.children()[1], "tint"); }},
        {"GroupWithChildrenAsShape", "must stay a group", [](auto& e, auto& l, auto&) { e.setType(l, "shape"); }},
    };
    return all;
}

class RefusedCallTest : public ItemsCenterTest, public testing::WithParamInterface<Refusal> {};

TEST_P(RefusedCallTest, LeavesTheSceneAsItWas)
{
    const Item& shape = addBox(Box({0, 0}, {10, 10}));
    auto edit = items().begin("Refused");
    edit.addEffect(shape, "tint");
    edit.add<GroupItem>(layer());
    items().setSelection({shape.id()});
    const auto before = scene.hash();
    EXPECT_THAT(failure([&] { GetParam().attempt(edit, layer(), shape); }), HasSubstr(GetParam().message));
    EXPECT_EQ(scene.hash(), before);
    EXPECT_EQ(items().selection(), std::vector{shape.id()});
    EXPECT_TRUE(edit.isOpen());
    edit.commit();
    history().undo();
    history().redo();
    EXPECT_EQ(scene.hash(), before);
}

INSTANTIATE_TEST_SUITE_P(ItemsCenter, RefusedCallTest, testing::ValuesIn(refusals()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_F(ItemsCenterTest, ItemsOfAnotherSceneAndRemovedOnesAreRefused)
{
    Scene other("Other", events, catalog);
    auto foreign = other.items().begin("Fill");
    for (int i = 0; i < 5; ++i) foreign.add<LayerItem>(other.root());
    foreign.commit();
    const Item& theirs = *other.root().children()[0];  // has the id of our layer
    ASSERT_EQ(theirs.id(), layer().id());
    const Item& gone = addBox(Box({0, 0}, {1, 1}));

    auto edit = items().begin("Mixed up");
    edit.remove(gone);
    const auto before = scene.hash();
    for (const Item* item : {&theirs, &gone, &other.root()}) {
        EXPECT_THAT(failure([&] { edit.add<ShapeItem>(*item); }), HasSubstr("not in this scene"));
        EXPECT_THAT(failure([&] { edit.remove(*item); }), HasSubstr("not in this scene"));
        EXPECT_THAT(failure([&] { edit.set(*item, "name", "x"); }), HasSubstr("not in this scene"));
        EXPECT_THAT(failure([&] { edit.move(*item, layer(), 0); }), HasSubstr("not in this scene"));
        EXPECT_THAT(failure([&] { edit.setPath(*item, {}); }), HasSubstr("not in this scene"));
        EXPECT_THAT(failure([&] { edit.transform(*item, Affine::scaling({2, 2})); }), HasSubstr("not in this scene"));
    }
    EXPECT_EQ(scene.hash(), before);
}

TEST_F(ItemsCenterTest, NothingIsNestedDeeperThanAFileMayHold)
{
    auto edit = items().begin("Deep");
    const Item* parent = &layer();
    for (int i = 2; i <= 999; ++i) parent = &edit.add<GroupItem>(*parent);
    const Item& pair = edit.add<GroupItem>(layer());
    edit.add<ShapeItem>(pair);
    const auto before = scene.hash();
    EXPECT_THAT(failure([&] { edit.move(pair, *parent, 0); }), HasSubstr("nested more than 1000 deep"));
    EXPECT_THAT(failure([&] { edit.addCopy(pair, *parent); }), HasSubstr("nested more than 1000 deep"));
    EXPECT_EQ(scene.hash(), before);
    edit.add<ShapeItem>(*parent);  // the thousandth
    edit.commit();
    EXPECT_NO_THROW((void)scene.clone(events));
}

TEST_F(ItemsCenterTest, AnEffectThatFailsWhenAppliedTakesItsWorkBack)
{
    const Item& shape = addBox(Box({0, 0}, {10, 10}));
    Hooks::now().applied = [](Transaction& edit, const Item& item) {
        edit.setType(item, "body");
        edit.add<ShapeItem>(*item.parent());
        edit.setSelection({});
        throw Failure(Error("no, thanks"));
    };
    items().setSelection({shape.id()});
    auto edit = items().begin("Apply");
    edit.set(shape, "name", "kept");
    const auto before = scene.hash();
    EXPECT_EQ(failure([&] { edit.addEffect(shape, "hook"); }), "no, thanks");
    EXPECT_EQ(scene.hash(), before);
    EXPECT_TRUE(items().isSelected(shape.id()));
    const ItemId next = edit.add<ShapeItem>(layer()).id();
    edit.rollback();
    auto again = items().begin("Again");
    EXPECT_EQ(again.add<ShapeItem>(layer()).id(), next) << "ids are given out anew";
}

// --- items

TEST_F(ItemsCenterTest, NewItemsHaveAllPropertiesStoredAndAName)
{
    auto edit = items().begin("Add");
    const Item& body = edit.add<BodyItem>(layer());
    const Item& rope = edit.add("rope", layer());
    edit.commit();
    for (const PropertySpec& spec : builtInItemType("body")->properties().specs())
        EXPECT_NE(body.properties().find(spec.id), nullptr) << spec.id;
    EXPECT_EQ(body.name(), "Body " + std::to_string(body.id().value));
    EXPECT_EQ(rope.name(), "Rope " + std::to_string(rope.id().value));
}

TEST_F(ItemsCenterTest, AnIndexPutsAnItemBetweenOthers)
{
    auto edit = items().begin("Add");
    const Item& a = edit.add("shape", layer());
    const Item& c = edit.add("shape", layer());
    const Item& b = edit.add("shape", layer(), {}, 1);
    const Item& last = edit.add("shape", layer(), {}, 1000);
    EXPECT_EQ(b.index(), 1u);
    EXPECT_EQ(last.index(), 3u);
    edit.move(a, layer(), 2);  // counted without itself: behind c
    EXPECT_EQ(a.index(), 2u);
    EXPECT_EQ(c.index(), 1u);
    EXPECT_EQ(b.index(), 0u);
}

TEST_F(ItemsCenterTest, ACopyLeadsToCopiesWhereTheOriginalsLedToEachOther)
{
    auto edit = items().begin("Build");
    const Item& outside = edit.add("shape", layer());
    const Item& group = edit.add("group", layer());
    const Item& ball = edit.add("shape", group, Path::ellipse(Box({0, 0}, {4, 4})));
    const Item& inner = edit.add("rope", group);
    const Item& outer = edit.add("rope", group);
    edit.set(inner, "target", ball.id());
    edit.set(outer, "target", outside.id());
    edit.set(ball, "name", "Ball");
    edit.set(ball, "visible", false);
    edit.addEffect(ball, "tint", {{"width", 7.0}});
    const Item& copy = edit.addCopy(group, layer(), 0);
    edit.commit();

    EXPECT_EQ(copy.index(), 0u);
    ASSERT_EQ(copy.children().size(), 3u);
    const Item& ballCopy = *copy.children()[0];
    EXPECT_NE(ballCopy.id(), ball.id());
    EXPECT_EQ(ballCopy.name(), "Ball");
    EXPECT_FALSE(ballCopy.visible());
    EXPECT_EQ(ballCopy.path(), ball.path());
    EXPECT_EQ(ballCopy.effects()[0], ball.effects()[0]);
    EXPECT_EQ(*copy.children()[1]->properties().find("target"), Value(ballCopy.id()));
    EXPECT_EQ(*copy.children()[2]->properties().find("target"), Value(outside.id())) << "outside references stay";
}

TEST_F(ItemsCenterTest, ACopyInAnotherSceneLeadsNowhereRatherThanToAStranger)
{
    auto edit = items().begin("Build");
    const Item& outside = edit.add("shape", layer());
    const Item& rope = edit.add("rope", layer());
    edit.set(rope, "target", outside.id());
    edit.commit();
    Scene other("Other", events, catalog);
    auto paste = other.items().begin("Paste");
    const Item& copy = paste.addCopy(rope, other.root());
    paste.commit();
    EXPECT_EQ(*copy.properties().find("target"), Value(ItemId{}));
}

TEST_F(ItemsCenterTest, AnotherTypeDropsWhatItDoesNotDeclareAndGetsItsOwnDefaults)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    const auto before = scene.hash();
    auto edit = items().begin("Body");
    edit.setType(shape, "body");
    edit.set(shape, "omega", 2.0);
    edit.commit();
    EXPECT_TRUE(shape.is<BodyItem>());
    EXPECT_EQ(*shape.properties().find("gravity-scale"), Value(1.0));
    auto back = items().begin("Torque");
    back.setType(shape, "torque");
    back.commit();
    EXPECT_EQ(shape.properties().find("omega"), nullptr);
    EXPECT_NE(shape.properties().find("value"), nullptr);
    history().undo();
    EXPECT_EQ(*shape.properties().find("omega"), Value(2.0));
    history().undo();
    EXPECT_EQ(scene.hash(), before);
}

TEST_F(ItemsCenterTest, ASignedZeroIsAChange)
{
    auto edit = items().begin("Zero");
    const Item& shape = edit.add<ShapeItem>(layer(), Path::line({0.0, 1}, {1, 1}));
    edit.commit();
    auto sign = items().begin("Sign");
    sign.setPath(shape, Path::line({-0.0, 1}, {1, 1}));
    EXPECT_FALSE(sign.isEmpty()) << "files and hashes tell them apart";
}

TEST_F(ItemsCenterTest, ValuesGivenAsNothingAreTheDefaults)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    auto edit = items().begin("Effect");
    edit.addEffect(shape, "tint", {{"width", Value()}, {"note", Value()}, {"join", "round"}});
    edit.commit();
    EXPECT_EQ(*shape.effects()[0].properties.find("width"), Value(2.0));
    EXPECT_EQ(*shape.effects()[0].properties.find("note"), Value(""));
    EXPECT_EQ(*shape.effects()[0].properties.find("join"), Value("round"));
}

// --- events

TEST_F(ItemsCenterTest, EachCommitUndoAndRedoIsToldOnceWithItsChanges)
{
    std::vector<std::pair<ItemsChanged::Cause, std::size_t>> told;
    const auto subscription = events.subscribe<ItemsChanged>(
        &scene, [&](const ItemsChanged& e) { told.emplace_back(e.cause, e.changes.size()); });
    {
        auto edit = items().begin("Two");
        edit.add<ShapeItem>(layer());
        edit.add<ShapeItem>(layer());
        edit.commit();
        items().begin("Rolled back").add<ShapeItem>(layer());
    }
    history().undo();
    history().redo();
    using Cause = ItemsChanged::Cause;
    EXPECT_EQ(told,
              (std::vector<std::pair<Cause, std::size_t>>{{Cause::Commit, 2}, {Cause::Undo, 2}, {Cause::Redo, 2}}));
}

TEST_F(ItemsCenterTest, AnOpenTransactionIsToldOfBetweenItsCallsAndOnce)
{
    int touched = 0, selected = 0;
    const auto a = events.subscribe<SceneTouched>(&scene, [&](const SceneTouched&) { ++touched; });
    const auto b = events.subscribe<SelectionChanged>(&scene, [&](const SelectionChanged&) { ++selected; });
    auto edit = items().begin("Drag");
    const Item& shape = edit.add<ShapeItem>(layer());
    edit.set(shape, "name", "Moved");
    edit.select(shape);
    EXPECT_EQ(touched + selected, 0) << "nothing is told in the middle of it";
    events.dispatchQueued();
    EXPECT_EQ(touched, 1);
    EXPECT_EQ(selected, 1);
    events.dispatchQueued();
    EXPECT_EQ(touched, 1) << "nothing has happened since";
    edit.rollback();
    EXPECT_EQ(touched, 2) << "at once: nothing is open any more";
    EXPECT_EQ(selected, 2);
}

TEST_F(ItemsCenterTest, ListenersSeeWholeStepsOnly)
{
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    const ItemId id = shape.id();
    std::vector<std::string> seen;
    const auto look = [&](const auto&) {
        EXPECT_FALSE(items().inTransaction());
        const Item* item = items().find(id);
        seen.push_back(item ? item->name() + (item->locked() ? " locked" : "") : "gone");
    };
    const auto a = events.subscribe<SceneTouched>(&scene, look);
    const auto b = events.subscribe<ItemsChanged>(&scene, look);
    const auto c = events.subscribe<SelectionChanged>(&scene, look);
    auto edit = items().begin("Two changes");
    edit.set(shape, "name", "Both");
    edit.set(shape, "locked", true);
    edit.select(shape);
    edit.commit();
    EXPECT_EQ(seen, std::vector<std::string>(3, "Both locked"));
    seen.clear();
    history().undo();
    EXPECT_EQ(seen, std::vector<std::string>(3, "Shape 2"));
}

// --- picking

TEST_F(ItemsCenterTest, PickingFindsTheTopMostShownAndUnlocked)
{
    const Item& below = addBox(Box({0, 0}, {10, 10}));
    const Item& above = addBox(Box({5, 5}, {15, 15}));
    EXPECT_EQ(items().itemAt({7, 7}, 0), &above);
    EXPECT_EQ(items().itemAt({2, 2}, 0), &below);
    EXPECT_EQ(items().itemAt({-1, 5}, 0.5), nullptr);
    EXPECT_EQ(items().itemAt({-1, 5}, 1.5), &below) << "within the distance of its edge";
    auto edit = items().begin("Hide");
    edit.set(above, "visible", false);
    EXPECT_EQ(items().itemAt({7, 7}, 0), &below);
    edit.set(layer(), "locked", true);
    EXPECT_EQ(items().itemAt({7, 7}, 0), nullptr);
}

TEST_F(ItemsCenterTest, ABoxTakesWhatLiesInItWhole)
{
    const Item& inside = addBox(Box({1, 1}, {2, 2}));
    addBox(Box({5, 5}, {15, 15}));
    EXPECT_EQ(items().itemsIn(Box({0, 0}, {10, 10})), std::vector<const Item*>{&inside});
}

}  // namespace
}  // namespace jet
