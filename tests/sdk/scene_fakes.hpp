// A scene with a layer, and the fakes registered without a library.
#pragma once

#include "fixtures/fakes.hpp"
#include "support/test_catalog.hpp"

#include <gtest/gtest.h>

namespace jet::test {

/// All of the above.
inline void registerFakes(TestCatalog& catalog)
{
    Hooks::clear();
    catalog.inCode().effect<TintEffect>("tint");
    catalog.inCode().effect<HookEffect>("hook");
    catalog.inCode().effect<BoxBodyEffect>("box-body");
    catalog.inCode().itemType<RopeType>("rope");
    catalog.inCode().physicsEngine<FallingEngine>("falling");
    catalog.inCode().scriptEngine<HookScripts>("hooks");
}

/// A scene with a layer, and the fakes.
class SceneFixture : public testing::Test {
protected:
    SceneFixture()
    {
        registerFakes(catalog);
        auto edit = scene.items().begin("Layer");
        layer_ = edit.add<LayerItem>(scene.root()).id();
        edit.commit();
        scene.undoRedo().clear();
        scene.undoRedo().markClean();
    }
    ItemsCenter& items() { return scene.items(); }
    UndoRedoCenter& history() { return scene.undoRedo(); }
    const Item& layer() { return *scene.items().find(layer_); }
    const Item& addBox(const Box& box, std::string_view type = ShapeItem::type, const Item* parent = nullptr)
    {
        auto edit = items().begin("Add");
        const Item& item = edit.add(type, parent ? *parent : layer(), Path::rectangle(box));
        edit.commit();
        return item;
    }
    /// The message of the Failure that `action` throws; "nothing" where it throws none.
    template <class Action>
    static std::string failure(Action&& action)
    {
        try {
            action();
        } catch (const Failure& f) {
            return f.what();
        }
        return "nothing";
    }

    TestCatalog catalog;
    EventsCenter events;
    Scene scene{"Scene", events, catalog};

private:
    ItemId layer_;
};

}  // namespace jet::test
