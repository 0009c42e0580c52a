// A wheel shown twice, and a cart of two wheels shown twice; whether instances are what their symbols make of them.
#pragma once

#include "scene_fakes.hpp"

#include <jet/project.hpp>
#include <jet/symbols.hpp>

#include <gmock/gmock.h>

namespace jet::test {

class Symbols : public SceneFixture {
protected:
    Symbols()
    {
        auto edit = items().begin("Wheel");
        const Item& tyre = edit.add<ShapeItem>(layer(), Path::ellipse(Box({0, 0}, {10, 10})));
        const Item& hub = edit.add<ShapeItem>(layer(), Path::rectangle(Box({4, 4}, {6, 6})));
        edit.set(tyre, "name", "Tyre");
        edit.set(hub, "name", "Hub");
        tyre_ = tyre.id(), hub_ = hub.id();
        first_ = createSymbol(edit, scene, std::vector<const Item*>{&tyre, &hub}, "Wheel")->id();
        second_ = placeSymbol(edit, wheel(), layer(), Affine::translation({100, 20})).id();
        edit.commit();
    }
    const Item& wheel() { return *findSymbol(scene, "Wheel"); }
    const Item& first() { return *items().find(first_); }
    const Item& second() { return *items().find(second_); }
    const Item& tyre() { return *items().find(tyre_); }
    const Item& hub() { return *items().find(hub_); }
    static std::vector<std::string> membersOf(const Item& item)
    {
        std::vector<std::string> names;
        for (const auto& child : item.children()) names.push_back(child->name());
        return names;
    }
    std::unique_ptr<Scene> readBack()
    {
        std::vector<FormatNote> notes;
        auto read = readSceneText(writeSceneText(scene), "test.scene", other_, catalog, notes).orThrow();
        EXPECT_THAT(notes, testing::IsEmpty());
        return read;
    }
    /// What is in memory is what a file gives back, bit by bit: instances are exactly what their symbols make of them.
    void expectExact() { EXPECT_EQ(readBack()->hash(), scene.hash()) << writeSceneText(scene); }
    template <class Change>
    void edit(Change change)
    {
        auto edit = items().begin("Edit");
        change(edit);
        edit.commit();
    }

    ItemId tyre_, hub_, first_, second_;
    EventsCenter other_;
};

class NestedSymbols : public Symbols {
protected:
    /// A cart of two wheels and a board, twice.
    NestedSymbols()
    {
        edit([&](Transaction& t) {
            const Item& board = t.add<ShapeItem>(layer(), Path::rectangle(Box({0, -5}, {110, 0})));
            t.set(board, "name", "Board");
            cart_ = createSymbol(t, scene, std::vector<const Item*>{&first(), &second(), &board}, "Cart")->id();
            cart2_ = placeSymbol(t, *findSymbol(scene, "Cart"), layer(), Affine::scaling({0.3, 0.3})).id();
        });
    }
    const Item& cart() { return *items().find(cart_); }
    const Item& cart2() { return *items().find(cart2_); }
    ItemId cart_, cart2_;
};

}  // namespace jet::test
