// PluginTest: a GoogleTest fixture with a Workbench, and readable values in what a failed test prints.
//
//   class StarToolTest : public jet::test::PluginTest {
//   protected:
//       StarToolTest() : PluginTest{"org.example.star"} {}
//   };
//   TEST_F(StarToolTest, ADragMakesOneShapeAndOneUndoStep)
//   {
//       tool("star").drag({10, 10}, {60, 40});
//       ASSERT_EQ(scene().shapes().size(), 1u);
//       EXPECT_EQ(undoSteps(), 1u);
//       undo();
//       EXPECT_EQ(scene().hash(), emptySceneHash());
//   }
#pragma once

#include <jet/testing/workbench.hpp>

#include <gtest/gtest.h>

#include <initializer_list>
#include <ostream>
#include <string_view>

namespace jet {

// Found by GoogleTest through the namespace of the values.
inline void PrintTo(const Box& box, std::ostream* out)
{
    *out << "[(" << box.min.x() << ", " << box.min.y() << "), (" << box.max.x() << ", " << box.max.y() << ")]";
}
inline void PrintTo(const Color& color, std::ostream* out) { *out << color.text(); }
inline void PrintTo(const Path& path, std::ostream* out) { *out << '"' << path.text() << '"'; }
inline void PrintTo(const Value& value, std::ostream* out)
{
    *out << value.text() << " (" << kindName(value.kind()) << ")";
}
inline void PrintTo(const ItemId& id, std::ostream* out) { *out << "item " << id.value; }

namespace test {

inline void PrintTo(const ItemList& items, std::ostream* out)
{
    *out << "{";
    for (const Item& item : items) *out << " '" << item.name() << "'";
    *out << " }";
}

class PluginTest : public ::testing::Test, protected Workbench {
protected:
    explicit PluginTest(std::initializer_list<std::string_view> plugins) : Workbench(plugins) {}
};

}  // namespace test
}  // namespace jet
