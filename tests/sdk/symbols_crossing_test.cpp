// Changes that cross each other within one transaction: in several instances, in their symbols, in symbols of symbols.
// Nothing is lost that another change does not contradict, and all is exact again whenever a call needs it so.
#include "symbols_fixture.hpp"

namespace jet {
namespace {

using test::NestedSymbols;
using test::Symbols;
using testing::ElementsAre;
using testing::SizeIs;

class CrossingSymbols : public Symbols {
protected:
    /// The wheel gets groups P and Q and, in P, a group R with a dot in it.
    CrossingSymbols()
    {
        edit([&](Transaction& t) {
            for (const char* name : {"P", "Q"}) t.set(t.add<GroupItem>(first()), "name", name);
            const Item& inner = t.add<GroupItem>(in(first(), "P"));
            t.set(inner, "name", "R");
            t.set(t.add<ShapeItem>(inner, Path::line({0, 0}, {1, 1})), "name", "Dot");
        });
        step_ = history().position();
    }
    void TearDown() override
    {
        expectExact();
        const std::uint64_t after = scene.hash();
        const std::size_t steps = history().position();
        while (history().position() > step_) history().undo();
        expectExact();
        while (history().position() < steps) history().redo();
        EXPECT_EQ(scene.hash(), after);
    }
    const Item& in(const Item& holder, const std::string& name)
    {
        const Item* found = nullptr;
        holder.walk([&](const Item& item) {
            if (item.name() == name && &item != &holder) found = &item;
        });
        if (!found) throw std::runtime_error(name + " is gone");
        return *found;
    }
    std::size_t step_ = 0;
};

// What a shape became is known to its symbol before what was put into it.
TEST_F(CrossingSymbols, AShapeThatBecomesAGroupAndGetsMembersInOneStepKeepsThem)
{
    edit([&](Transaction& t) {
        t.setType(in(second(), "Hub"), GroupItem::type);
        t.set(t.add<ShapeItem>(in(second(), "Hub"), Path::line({104, 24}, {106, 26})), "name", "Nut");
    });
    EXPECT_EQ(in(first(), "Nut").parent(), &hub());
    EXPECT_THAT(membersOf(in(second(), "Hub")), ElementsAre("Nut"));
}

// The same, and the instance moves before the commit: it used to look for the member in a symbol that had none.
TEST_F(CrossingSymbols, AnInstanceMovesAfterOneOfItsShapesBecameAGroupWithMembers)
{
    edit([&](Transaction& t) {
        t.setType(in(second(), "Hub"), GroupItem::type);
        t.set(t.add<ShapeItem>(in(second(), "Hub"), Path::line({104, 24}, {106, 26})), "name", "Nut");
        setPlacement(t, second(), Affine::translation({-50, 0}));
    });
    EXPECT_EQ(in(first(), "Nut").bounds(), Box({4, 4}, {6, 6}));
    EXPECT_EQ(in(second(), "Nut").bounds(), Box({-46, 4}, {-44, 6}));
}

// To copy, what is pending follows first, and with it the group that became a shape in an instance. A shape that held
// a group is what the commit threw at: no instance had a counterpart of it.
TEST_F(CrossingSymbols, ACopyIsRefusedIntoAGroupThatBecomesAShapeBeforeIt)
{
    const Item* group = nullptr;
    edit([&](Transaction& t) { group = &t.add<GroupItem>(layer()); });
    for (const bool intoTheSymbol : {true, false}) {
        edit([&](Transaction& t) {
            t.setType(in(first(), "Q"), ShapeItem::type);
            t.set(in(wheel(), "Tyre"), "locked", true);
            const Item& target = in(intoTheSymbol ? wheel() : second(), "Q");
            EXPECT_EQ(failure([&] { t.addCopy(*group, target); }),
                      "'Q' is not a group or layer; items go into groups and layers");
        });
        EXPECT_EQ(in(second(), "Q").type(), ShapeItem::type);
        EXPECT_TRUE(tyre().locked());
        expectExact();
        if (intoTheSymbol) history().undo();
    }
}

// Linking lets the other instance's detaching follow, after which there is no placement to keep.
TEST_F(NestedSymbols, AnInstanceIsLinkedAnewThatWasDetachedElsewhereInTheSameStep)
{
    const Item* other = nullptr;
    edit([&](Transaction& t) {
        const Item& dot = t.add<ShapeItem>(layer(), Path::line({0, 0}, {1, 1}));
        other = symbolOf(scene, *createSymbol(t, scene, std::vector<const Item*>{&dot}, "Dot"));
    });
    edit([&](Transaction& t) {
        detachInstance(t, *cart().children()[1]);
        t.set(*other->children()[0], "name", "Spot");
        swapSymbol(t, *symbolOf(scene, cart2())->children()[1], *other);
    });
    EXPECT_EQ(symbolOf(scene, *cart2().children()[1]), other);
    expectExact();
}

// One instance moves a group away from where the other puts an instance: the group goes on with all that is in it.
TEST_F(CrossingSymbols, WhatMovesAwayFromAGroupThatIsLinkedElsewhereKeepsItsMembers)
{
    const Item* dot = nullptr;
    edit([&](Transaction& t) {
        const Item& shape = t.add<ShapeItem>(layer(), Path::line({0, 0}, {1, 1}));
        dot = symbolOf(scene, *createSymbol(t, scene, std::vector<const Item*>{&shape}, "Spot"));
    });
    edit([&](Transaction& t) {
        t.set(in(first(), "P"), kLinkSymbol, dot->id());
        t.move(in(second(), "R"), in(second(), "Q"), 0);
    });
    for (const Item* wheel : {&first(), &second()}) {
        EXPECT_EQ(symbolOf(scene, in(*wheel, "P")), dot);
        EXPECT_EQ(in(*wheel, "Dot").parent()->parent(), &in(*wheel, "Q"));
    }
}

TEST_F(CrossingSymbols, WhatMovesOutOfAGroupBeforeItIsLinkedStaysTheSameInAllInstances)
{
    const Item* spot = nullptr;
    edit([&](Transaction& t) {
        const Item& shape = t.add<ShapeItem>(layer(), Path::line({0, 0}, {1, 1}));
        spot = symbolOf(scene, *createSymbol(t, scene, std::vector<const Item*>{&shape}, "Spot"));
    });
    const ItemId inFirst = in(first(), "Dot").id(), inSecond = in(second(), "Dot").id();
    edit([&](Transaction& t) {
        t.move(in(first(), "R"), in(first(), "Q"), 0);
        t.set(in(first(), "P"), kLinkSymbol, spot->id());
    });
    EXPECT_EQ(in(first(), "Dot").id(), inFirst);
    EXPECT_EQ(in(second(), "Dot").id(), inSecond) << "a joint may hold it";
    EXPECT_EQ(in(second(), "Dot").parent()->parent(), &in(second(), "Q"));
}

TEST_F(CrossingSymbols, TwoGroupsThatTwoInstancesMoveIntoEachOtherStayInOneTree)
{
    edit([&](Transaction& t) {
        const Item& left = t.add<GroupItem>(first());
        const Item& right = t.add<GroupItem>(first());
        t.set(left, "name", "Left"), t.set(right, "name", "Right");
        t.move(in(first(), "P"), left, 0), t.move(in(first(), "Q"), right, 0);
    });
    edit([&](Transaction& t) {
        t.move(in(first(), "P"), in(first(), "Q"), 0);
        t.move(in(second(), "Q"), in(second(), "R"), 0);
    });
    for (const Item* wheel : {&first(), &second()}) {
        EXPECT_TRUE(in(*wheel, "Right").isAncestorOf(in(*wheel, "Q")));
        EXPECT_TRUE(in(*wheel, "Q").isAncestorOf(in(*wheel, "Dot")));
    }
}

TEST_F(CrossingSymbols, WhatOneInstanceRemovesDoesNotComeBackWithWhatAnotherAdds)
{
    edit([&](Transaction& t) {
        t.remove(in(first(), "P"));
        t.set(t.add<GroupItem>(second()), "name", "New");
    });
    for (const Item* wheel : {&first(), &second()})
        EXPECT_THAT(membersOf(*wheel), ElementsAre("Tyre", "Hub", "Q", "New"));
}

// The name was given back, the instance moved, and then both were taken back: the name still has to be taken in.
TEST_F(CrossingSymbols, AChangeIsKeptOfWhichOnlyTheContraryWasTakenBack)
{
    edit([&](Transaction& t) {
        t.set(in(second(), "Hub"), "name", "Axle");
        auto inner = items().begin("Inner");
        inner.set(in(second(), "Axle"), "name", "Hub");
        setPlacement(inner, second(), Affine::translation({7, 7}));
        inner.rollback();
    });
    EXPECT_EQ(hub().name(), "Axle");
}

TEST_F(CrossingSymbols, AnInstanceFromAnotherSceneShowsTheSymbolAsItIsByNow)
{
    const auto there = scene.clone(other_);
    edit([&](Transaction& t) {
        t.set(t.add(GroupItem::type, wheel(), {}, 0), "name", "First");
        const Item& copy = t.addCopy(*there->items().find(second_), layer());
        t.set(in(copy, "Hub"), "name", "Axle");
    });
    EXPECT_THAT(membersOf(first()), ElementsAre("First", "Tyre", "Axle", "P", "Q"));
}

// The symbol that was empty gets its members from the group, while one of its instances has got one of its own.
TEST_F(CrossingSymbols, AGroupThatFillsASymbolWhoseInstancesChangeKeepsItsChanges)
{
    const Item* symbol = nullptr;
    const Item* instance = nullptr;
    edit([&](Transaction& t) {
        const Item& shape = t.add<ShapeItem>(layer(), Path::line({0, 0}, {1, 1}));
        instance = createSymbol(t, scene, std::vector<const Item*>{&shape}, "Spot");
        symbol = symbolOf(scene, *instance);
        t.remove(shape);
    });
    const Item* group = nullptr;
    edit([&](Transaction& t) {
        group = &t.add<GroupItem>(layer());
        t.set(t.add<ShapeItem>(*group, Path::line({0, 0}, {2, 2})), "name", "Line");
        t.set(*group, kLinkSymbol, symbol->id());
        EXPECT_THAT(membersOf(*instance), ElementsAre("Line"));
        t.set(t.add<ShapeItem>(*instance, Path::line({0, 0}, {3, 3})), "name", "Long");
        t.set(in(*group, "Line"), "name", "Short");
    });
    EXPECT_THAT(membersOf(*instance), ElementsAre("Short", "Long"));
    EXPECT_THAT(membersOf(*group), ElementsAre("Short", "Long"));
}

}  // namespace
}  // namespace jet
