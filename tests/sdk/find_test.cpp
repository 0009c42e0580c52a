// Queries as users write them.
#include "scene_fakes.hpp"

#include <jet/find.hpp>
#include <jet/symbols.hpp>

#include <gmock/gmock.h>

namespace jet {
namespace {

class Find : public test::SceneFixture {
protected:
    Find()
    {
        auto edit = items().begin("Things");
        const Item& front = edit.add<LayerItem>(scene.root());
        edit.set(front, "name", "Front");
        const auto add = [&](std::string_view type, const Item& parent, const char* name) -> const Item& {
            const Item& item = edit.add(type, parent, Path::rectangle(Box({0, 0}, {10, 10})));
            edit.set(item, "name", name);
            return item;
        };
        const Item& red = add("body", front, "Red Ball");
        edit.set(red, "velocity", Vec2(-3, 4));
        edit.set(red, "omega", 2.5);
        edit.addEffect(red, "tint");
        add("shape", layer(), "ball-pit");
        edit.set(add("shape", layer(), "Wall"), "visible", false);
        const Item& wheel = add("shape", layer(), "Tyre");
        createSymbol(edit, scene, std::vector<const Item*>{&wheel}, "Wheel");
        edit.commit();
    }
    std::vector<std::string> found(std::string_view query)
    {
        std::vector<std::string> names;
        for (const Item* item : findItems(scene, FindQuery::parse(query).orThrow())) names.push_back(item->name());
        return names;
    }
};

TEST_F(Find, FindsWhatMatchesAllTerms)
{
    const std::pair<const char*, std::vector<std::string>> queries[] = {
        {"ball", {"ball-pit", "Red Ball"}},
        {"BALL type:shape", {"ball-pit"}},
        {"name:ball*", {"ball-pit"}},
        {"name:\"red ball\"", {"Red Ball"}},
        {"name:????", {"Wall", "Tyre"}},
        {"-ball type:shape", {"Wall", "Tyre"}},
        {"omega>2", {"Red Ball"}},
        {"omega>2.5", {}},
        {"omega>=2.5 fixed=false", {"Red Ball"}},
        {"velocity.x<0 velocity.y=4", {"Red Ball"}},
        {"velocity>0", {}},
        {"effect:t*", {"Red Ball"}},
        {"layer:front", {"Red Ball"}},
        {"is:hidden", {"Wall"}},
        {"is:instance", {"Wheel"}},
        {"symbol:wheel", {"Wheel", "Tyre"}},
        {"type:body -layer:front", {}},
        {"visible=false", {"Wall"}},
        {"id:1", {"Layer 1"}},
        {"", {}},
    };
    for (const auto& [query, names] : queries) EXPECT_THAT(found(query), testing::ElementsAreArray(names)) << query;
}

TEST_F(Find, AnErrorTellsItsColumn)
{
    const std::tuple<const char*, int, const char*> wrong[] = {
        {"ball mass>", 11, "a value is missing"},
        {"mass>heavy", 6, "is not a number"},
        {"ball >2", 6, "a property is missing"},
        {"name:\"red", 6, "no second one"},
        {"is:red", 4, "knows hidden"},
        {"ball - x", 6, "without a space"},
    };
    for (const auto& [query, column, message] : wrong) {
        const auto read = FindQuery::parse(query);
        ASSERT_FALSE(read) << query;
        EXPECT_EQ(read.error().where.column, column) << query;
        EXPECT_THAT(read.error().message, testing::HasSubstr(message));
    }
}

}  // namespace
}  // namespace jet
