// Symbols: what is changed in one instance changes in all, exactly, undone in one step, and files hold it once.
#include "symbols_fixture.hpp"

#include <jet/arrange.hpp>

namespace jet {
namespace {

using test::NestedSymbols;
using test::Symbols;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

TEST_F(Symbols, TheItemsItWasMadeOfStayAndAnInstanceHasCopiesInItsPlace)
{
    EXPECT_EQ(tyre().parent(), &first());
    EXPECT_EQ(symbolOf(scene, first()), &wheel());
    EXPECT_THAT(membersOf(second()), ElementsAre("Tyre", "Hub"));
    EXPECT_EQ(second().children()[1]->bounds(), Box({104, 24}, {106, 26}));
    EXPECT_THAT(instancesOf(scene, wheel()), ElementsAre(&first(), &second()));
    EXPECT_EQ(items().itemCount(), 1u + 3 + 3) << "the symbol's own items are not in the scene";
    EXPECT_EQ(items().itemAt({105, 25}, 0), second().children()[1].get());
    expectExact();
}

TEST_F(Symbols, AChangeInOneInstanceIsMadeInAllAndIsOneStep)
{
    const std::uint64_t before = scene.hash();
    const std::size_t steps = history().size();
    edit([&](Transaction& t) {
        t.set(*second().children()[0], "name", "Rim");
        t.setPath(*second().children()[1], Path::rectangle(Box({103, 23}, {107, 27})));
        t.addEffect(*second().children()[1], "tint");
    });
    EXPECT_EQ(tyre().name(), "Rim");
    EXPECT_EQ(hub().bounds(), Box({3, 3}, {7, 7}));
    EXPECT_THAT(hub().effects(), SizeIs(1));
    EXPECT_EQ(history().size(), steps + 1);
    expectExact();
    const std::uint64_t after = scene.hash();
    history().undo();
    EXPECT_EQ(scene.hash(), before);
    history().redo();
    EXPECT_EQ(scene.hash(), after);
}

TEST_F(Symbols, ItemsAddedMovedAndRemovedInOneInstanceFollowInAll)
{
    edit([&](Transaction& t) {
        const Item& group = t.add<GroupItem>(second());
        t.set(group, "name", "Spokes");
        t.add<ShapeItem>(group, Path::line({100, 25}, {110, 25}));
        t.move(*second().children()[1], group, 0);
        t.remove(*second().children()[0]);
    });
    EXPECT_THAT(membersOf(first()), ElementsAre("Spokes"));
    ASSERT_THAT(first().children()[0]->children(), SizeIs(2));
    EXPECT_EQ(first().children()[0]->children()[0].get(), &hub()) << "it moved, it was not made anew";
    EXPECT_EQ(first().children()[0]->children()[1]->bounds(), Box({0, 5}, {10, 5}));
    expectExact();
}

TEST_F(Symbols, ChangesOfTwoInstancesInOneStepAreJoined)
{
    edit([&](Transaction& t) {
        t.set(hub(), "name", "Axle");
        t.add<ShapeItem>(first(), Path::line({0, 0}, {1, 1}));
        t.set(*second().children()[1], "locked", true);
        t.remove(*second().children()[0]);
    });
    for (const Item* wheel : {&first(), &second()}) {
        ASSERT_THAT(wheel->children(), SizeIs(2));
        EXPECT_EQ(wheel->children()[0]->name(), "Axle");
        EXPECT_TRUE(wheel->children()[0]->locked());
    }
    expectExact();
}

TEST_F(Symbols, NamePlaceVisibilityAndEffectsOfAnInstanceAreItsOwn)
{
    edit([&](Transaction& t) {
        t.set(second(), "name", "Rear wheel");
        t.set(second(), "visible", false);
        t.transform(second(), Affine::rotation(0.7, {3, 4}));
        t.transform(second(), Affine::scaling({2, 0.5}));
    });
    EXPECT_EQ(first().name(), "Wheel");
    EXPECT_TRUE(first().visible());
    EXPECT_TRUE(placementOf(first()).isIdentity());
    EXPECT_EQ(hub().bounds(), Box({4, 4}, {6, 6}));
    expectExact();
    edit([&](Transaction& t) { t.set(first(), "symbol-offset", Vec2(7, 0)); });
    EXPECT_EQ(hub().bounds(), Box({11, 4}, {13, 6}));
    expectExact();
}

TEST_F(Symbols, ADragOfAnInstanceMovesItsItemsAtOnceAndRestartsExactly)
{
    const std::uint64_t before = scene.hash();
    auto drag = items().begin("Move");
    for (int step = 0; step < 5; ++step) {
        drag.restart();
        EXPECT_EQ(scene.hash(), before);
        drag.transform(second(), Affine::translation({0.1 * step, 1.0 * step}));
        EXPECT_EQ(second().children()[1]->bounds().min, Vec2(104 + 0.1 * step, 24 + step));
    }
    drag.rollback();
    EXPECT_EQ(scene.hash(), before);
}

TEST_F(Symbols, EditsAndMovesOfAnInstanceMixInOneStep)
{
    edit([&](Transaction& t) {
        t.set(*second().children()[0], "name", "A");
        t.transform(second(), Affine::translation({1, 1}));
        t.setPath(*second().children()[0], Path::rectangle(Box({101, 21}, {103, 23})));
        const Item& third = t.addCopy(second(), layer());
        t.set(*third.children()[1], "name", "B");
    });
    EXPECT_THAT(membersOf(first()), ElementsAre("A", "B"));
    EXPECT_EQ(tyre().bounds(), Box({0, 0}, {2, 2}));
    EXPECT_THAT(instancesOf(scene, wheel()), SizeIs(3));
    expectExact();
}

TEST_F(Symbols, ADetachedInstanceIsAPlainGroupThatFollowsNoMore)
{
    edit([&](Transaction& t) { detachInstance(t, second()); });
    edit([&](Transaction& t) { t.set(hub(), "name", "Axle"); });
    EXPECT_FALSE(isInstance(second()));
    EXPECT_THAT(membersOf(second()), ElementsAre("Tyre", "Hub"));
    history().undo(), history().undo();
    EXPECT_TRUE(isInstance(second()));
    edit([&](Transaction& t) { ungroupItems(t, std::vector<const Item*>{&second()}); });
    EXPECT_THAT(membersOf(layer()), ElementsAre("Wheel", "Tyre", "Hub"));
    EXPECT_THAT(membersOf(first()), ElementsAre("Tyre", "Hub"));
    expectExact();
}

TEST_F(Symbols, AnotherSymbolTakesTheSamePlace)
{
    edit([&](Transaction& t) {
        const Item& star = t.add<ShapeItem>(layer(), Path::rectangle(Box({0, 0}, {1, 1})));
        const Item* one = createSymbol(t, scene, std::vector<const Item*>{&star});
        swapSymbol(t, second(), *symbolOf(scene, *one));
    });
    ASSERT_THAT(second().children(), SizeIs(1));
    EXPECT_EQ(second().bounds(), Box({100, 20}, {101, 21}));
    EXPECT_EQ(symbolOf(scene, second())->name(), "Symbol 1");
    expectExact();
}

TEST_F(Symbols, ASymbolIsDeletedOnlyWhenItIsNotUsed)
{
    EXPECT_EQ(failure([&] { edit([&](Transaction& t) { removeSymbol(t, wheel()); }); }),
              "the symbol 'Wheel' is used 2 times; detach or delete its instances first");
    edit([&](Transaction& t) {
        t.remove(first());
        detachInstance(t, second());
        removeSymbol(t, wheel());
    });
    EXPECT_THAT(symbolsOf(scene), testing::IsEmpty());
    history().undo();
    EXPECT_THAT(instancesOf(scene, wheel()), SizeIs(2));
    expectExact();
}

TEST_F(NestedSymbols, AChangeInsideOfTheInnerOneReachesAllOfThem)
{
    EXPECT_THAT(instancesOf(scene, wheel()), SizeIs(4));
    edit([&](Transaction& t) {
        t.set(*cart2().children()[1]->children()[1], "name", "Axle");
        t.add<ShapeItem>(*cart2().children()[0], Path::line({0, 0}, {1, 1}));
    });
    for (const Item* wheel : instancesOf(scene, wheel())) {
        ASSERT_THAT(wheel->children(), SizeIs(3));
        EXPECT_EQ(wheel->children()[1]->name(), "Axle");
    }
    expectExact();
}

TEST_F(NestedSymbols, PlacesOfInnerInstancesFollowInTheOuterOnes)
{
    edit([&](Transaction& t) { t.transform(*cart2().children()[1], Affine::translation({-3, 0})); });
    EXPECT_NEAR(cart().children()[1]->bounds().min.x(), 90, 1e-9);
    expectExact();
    edit([&](Transaction& t) { t.transform(cart2(), Affine::rotation(1, {5, 5})); });
    expectExact();
    edit([&](Transaction& t) { detachInstance(t, *cart2().children()[0]); });
    EXPECT_THAT(instancesOf(scene, wheel()), SizeIs(2));
    EXPECT_THAT(membersOf(*cart().children()[0]), ElementsAre("Tyre", "Hub"));
    expectExact();
    edit([&](Transaction& t) { t.remove(*cart().children()[1]); });
    EXPECT_THAT(membersOf(cart2()), ElementsAre("Wheel", "Board"));
    expectExact();
}

// One cart makes a spring of what the other, in the same step, makes a wheel: whichever comes last, all of it is.
TEST_F(NestedSymbols, TypesThatTwoInstancesDisagreeAboutLeaveNoPropertiesOfTheOther)
{
    for (const bool springFirst : {true, false}) {
        edit([&](Transaction& t) {
            const Item& dot = t.add<ShapeItem>(layer(), Path::line({0, 0}, {1, 1}));
            const Item& empty = *createSymbol(t, scene, std::vector<const Item*>{&dot}, "Empty");
            t.remove(dot);
            t.move(empty, cart(), 0);
        });
        ASSERT_THAT(membersOf(cart2()), ElementsAre("Empty", "Wheel", "Wheel", "Board"));
        edit([&](Transaction& t) {
            const auto makeASpring = [&](const Item& cart) { t.setType(*cart.children()[0], "spring"); };
            const auto makeAWheel = [&](const Item& cart) { swapSymbol(t, *cart.children()[0], wheel()); };
            springFirst ? makeASpring(cart()) : makeAWheel(cart());
            springFirst ? makeAWheel(cart2()) : makeASpring(cart2());
        });
        EXPECT_EQ(cart().children()[0]->type(), cart2().children()[0]->type());
        expectExact();
        history().undo();
        expectExact();
        history().undo();
    }
}

TEST_F(NestedSymbols, ASymbolMadeInsideOfAnInstanceIsMadeInAll)
{
    edit([&](Transaction& t) {
        createSymbol(t, scene, std::vector<const Item*>{cart2().children()[0].get(), cart2().children()[2].get()},
                     "Half");
    });
    EXPECT_THAT(instancesOf(scene, *findSymbol(scene, "Half")), SizeIs(2));
    EXPECT_THAT(membersOf(cart()), ElementsAre("Wheel", "Half"));
    expectExact();
}

TEST_F(NestedSymbols, ASymbolCannotBecomeAPartOfItself)
{
    const std::string refused = "which cannot be a part of itself; detach it first";
    const std::uint64_t before = scene.hash();
    EXPECT_THAT(failure([&] { edit([&](Transaction& t) { t.move(cart(), *cart2().children()[0], 0); }); }),
                HasSubstr(refused));
    EXPECT_THAT(failure([&] { edit([&](Transaction& t) { t.addCopy(cart2(), cart()); }); }), HasSubstr(refused));
    EXPECT_THAT(failure([&] {
                    edit([&](Transaction& t) {
                        const Item& inner = t.add<GroupItem>(*cart2().children()[0]);
                        t.set(inner, "symbol", findSymbol(scene, "Cart")->id());
                    });
                }),
                HasSubstr("cannot be a part of itself"));
    EXPECT_THAT(failure([&] {
                    edit([&](Transaction& t) { swapSymbol(t, *cart().children()[0], *findSymbol(scene, "Cart")); });
                }),
                HasSubstr("cannot be a part of itself"));
    EXPECT_EQ(scene.hash(), before);
}

TEST_F(NestedSymbols, SymbolsComeAlongIntoAnotherSceneAndAreKnownThere)
{
    Scene there("There", other_, catalog);
    auto paste = there.items().begin("Paste");
    const Item& one = paste.addCopy(cart2(), there.root());
    paste.addCopy(first(), there.root());
    paste.commit();
    EXPECT_THAT(symbolsOf(there), SizeIs(2));
    EXPECT_EQ(symbolOf(there, one)->name(), "Cart");
    EXPECT_THAT(instancesOf(there, *findSymbol(there, "Wheel")), SizeIs(3));
    EXPECT_EQ(one.bounds(), cart2().bounds());
    // changed there: what comes later shows the symbol as it is there
    auto change = there.items().begin("Change");
    change.set(*there.items().find(one.children()[0]->children()[0]->id()), "name", "Rim");
    change.commit();
    auto again = there.items().begin("Paste");
    const Item& late = again.addCopy(cart(), there.root());
    again.commit();
    EXPECT_THAT(symbolsOf(there), SizeIs(2));
    EXPECT_THAT(membersOf(*late.children()[0]), ElementsAre("Rim", "Hub"));
    there.undoRedo().undo(), there.undoRedo().undo(), there.undoRedo().undo();
    EXPECT_THAT(symbolsOf(there), testing::IsEmpty());
}

TEST_F(NestedSymbols, ACopyOfTheSceneIsLinkedAsWell)
{
    const auto copy = scene.clone(other_);
    EXPECT_EQ(copy->hash(), scene.hash());
    auto change = copy->items().begin("Change");
    change.set(*copy->items().find(hub_), "name", "Axle");
    change.commit();
    const Item& far = *copy->items().find(cart2_);
    EXPECT_EQ(far.children()[1]->children()[1]->name(), "Axle");
    EXPECT_EQ(findClosestByName(*copy->items().find(tyre_), "Axle"), copy->items().find(hub_));
}

TEST_F(Symbols, AFileHoldsASymbolOnceAndAChangeIsOneLine)
{
    const std::string before = writeSceneText(scene);
    EXPECT_THAT(before, HasSubstr("<instance symbol=\"" + std::to_string(wheel().id().value) +
                                  "\" matrix=\"1 0 0 1 100 20\" ids=\""));
    edit([&](Transaction& t) { t.set(*second().children()[1], "name", "Axle"); });
    const std::string after = writeSceneText(scene);
    std::istringstream a(before), b(after);
    int different = 0;
    for (std::string x, y; std::getline(a, x) && std::getline(b, y);) different += x != y;
    EXPECT_EQ(different, 1);
    EXPECT_EQ(std::ranges::count(before, '\n'), std::ranges::count(after, '\n'));
}

TEST_F(Symbols, ReferencesInsideOfASymbolStayInsideOfEachInstance)
{
    edit([&](Transaction& t) {
        const Item& rope = t.add("rope", first(), Path::line({0, 0}, {5, 5}));
        t.set(rope, "target", hub_);
    });
    const auto target = [](const Item& wheel) { return wheel.children()[2]->property("target")->as<ItemId>(); };
    EXPECT_EQ(target(first()), hub_);
    EXPECT_EQ(target(second()), second().children()[1]->id());
    expectExact();
    edit([&](Transaction& t) { t.set(*second().children()[2], "target", second().children()[0]->id()); });
    EXPECT_EQ(target(first()), tyre_);
    expectExact();
}

// Copies once referred to their own tyre, which neither the symbol says nor the file gave back.
TEST_F(Symbols, AMemberThatRefersIntoOneInstanceDoesSoInCopiesOfItToo)
{
    edit([&](Transaction& t) { t.add("rope", first(), Path::line({0, 0}, {5, 5})); });
    edit([&](Transaction& t) { t.set(*wheel().children()[2], "target", tyre_); });
    expectExact();
    edit([&](Transaction& t) { t.addCopy(layer(), layer()); });
    expectExact();
    std::vector<ItemId> targets;
    scene.root().walk([&](const Item& item) {
        if (item.type() == "rope") targets.push_back(item.property("target")->as<ItemId>());
    });
    EXPECT_THAT(targets, testing::AllOf(SizeIs(4), testing::Each(tyre_)));
}

TEST_F(Symbols, AnInstanceFlattenedToALineTakesNoPointsIntoTheSymbol)
{
    edit([&](Transaction& t) { t.transform(second(), Affine::scaling({1, 0})); });
    edit([&](Transaction& t) {
        t.setPath(*second().children()[1], Path::line({0, 0}, {1, 1}));
        t.set(*second().children()[1], "name", "Axle");
    });
    EXPECT_EQ(hub().bounds(), Box({4, 4}, {6, 6}));
    EXPECT_EQ(hub().name(), "Axle");
    expectExact();
}

TEST_F(Symbols, TheSymbolsOwnItemsCanBeChangedToo)
{
    edit([&](Transaction& t) {
        t.set(*wheel().children()[1], "name", "Axle");
        t.add<ShapeItem>(wheel(), Path::line({0, 0}, {1, 1}));
    });
    EXPECT_EQ(hub().name(), "Axle");
    EXPECT_THAT(second().children(), SizeIs(3));
    expectExact();
    const std::string kept = "cannot be moved into a symbol or out of it, only copied";
    EXPECT_THAT(failure([&] { edit([&](Transaction& t) { t.move(*wheel().children()[1], layer(), 0); }); }),
                HasSubstr(kept));
    EXPECT_THAT(failure([&] { edit([&](Transaction& t) { t.set(wheel(), "visible", false); }); }),
                HasSubstr("but a name"));
}

struct BadFile {
    const char* text;
    const char* message;
};

TEST(SymbolFiles, ErrorsTellPlaceAndRemedy)
{
    const BadFile files[] = {
        {R"(<item type="group" id="1" name="a"><instance symbol="7"/></item>)", "there is no symbol with the id 7"},
        {R"(<item type="shape" id="1" name="a"><instance symbol="7"/></item>)", "only an item of type 'group'"},
        {R"(<item type="group" id="1" name="a"><instance symbol="7" matrix="1 0"/></item>)", "six numbers"},
        {R"(<item type="group" id="1" name="a"><instance symbol="7" ids="3-"/></item>)", "numbers and ranges"},
        {R"(<item type="group" id="1" name="a"><instance symbol="7"/><item type="shape" id="2" name="b"/></item>)",
         "leave <item> out"},
        {R"(<symbols><symbol id="7" name="s" key="k"><item type="group" id="1" name="a"><instance symbol="7"/></item></symbol></symbols>)",
         "'s' would be a part of itself"},
        {R"(<symbols><symbol id="7" name="s" key="k"><item type="shape" id="1" name="a"/></symbol></symbols>
            <item type="group" id="2" name="b"><instance symbol="7" ids="1"/></item>)",
         "used by another item"},
    };
    test::TestCatalog catalog;
    EventsCenter events;
    for (const BadFile& file : files) {
        std::vector<FormatNote> notes;
        const auto read = readSceneText(std::string("<scene version=\"1\">\n") + file.text + "\n</scene>\n",
                                        "bad.scene", events, catalog, notes);
        ASSERT_FALSE(read) << file.text;
        EXPECT_THAT(read.error().message, HasSubstr(file.message));
        EXPECT_GE(read.error().where.line, 2);
    }
}

TEST(SymbolFiles, SymbolsThatDoubleThemselvesAreRefused)
{
    std::string text = "<scene version=\"1\"><symbols>";
    text += R"(<symbol id="1000" name="s0" key="k0"><item type="shape" id="1" name="x"/></symbol>)";
    for (int i = 1; i <= 40; ++i) {
        const std::string n = std::to_string(i), inner = std::to_string(1000 + i - 1);
        text += "<symbol id=\"" + std::to_string(1000 + i) + "\" name=\"s" + n + "\" key=\"k" + n + "\">";
        for (int twin = 0; twin < 2; ++twin)
            text += "<item type=\"group\" id=\"" + std::to_string(2 * i + twin) + "\" name=\"g\"><instance symbol=\"" +
                    inner + "\"/></item>";
        text += "</symbol>";
    }
    test::TestCatalog catalog;
    EventsCenter events;
    std::vector<FormatNote> notes;
    const auto read = readSceneText(text + "</symbols></scene>", "laughs.scene", events, catalog, notes);
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message, HasSubstr("use fewer instances"));
}

TEST(SymbolFiles, IdsMayBeLeftOutByHand)
{
    test::TestCatalog catalog;
    EventsCenter events;
    std::vector<FormatNote> notes;
    const auto scene = readSceneText(R"(<scene version="1">
  <symbols><symbol id="7" name="s" key="k"><item type="acme-rope" id="1" name="a"><property id="links">2.50</property></item></symbol></symbols>
  <item type="group" id="2" name="b"><instance symbol="7" matrix="1 0 0 1 5 5"/></item>
</scene>)",
                                     "hand.scene", events, catalog, notes)
                           .orThrow();
    const Item& instance = *scene->items().find(ItemId{2});
    ASSERT_THAT(instance.children(), SizeIs(1));
    EXPECT_EQ(instance.children()[0]->property("links"), Value(RawText{"2.50"})) << "of a plugin that is absent";
    EXPECT_EQ(instance.children()[0]->id(), ItemId{8});
}

}  // namespace
}  // namespace jet
