// ToolFixture: the test kit's PluginTest for JET's own tests of tools; lists of items are lists of pointers.
#pragma once

#include <jet/testing/gtest.hpp>

#include <vector>

namespace jet::test {

class ToolFixture : public PluginTest {
protected:
    using PluginTest::PluginTest;

    std::vector<const Item*> itemsOf(std::string_view type) { return scene().itemsOf(type).pointers(); }
    std::vector<const Item*> shapes() { return scene().shapes().pointers(); }
    std::vector<const Item*> selected() { return scene().selected().pointers(); }
};

}  // namespace jet::test
