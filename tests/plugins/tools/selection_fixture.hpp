// Three squares in a scene and the selection tool over them.
#pragma once

#include "support/tool_fixture.hpp"

#include <vector>

namespace jet::test {

class SelectionToolTest : public ToolFixture {
protected:
    SelectionToolTest() : ToolFixture{"org.jet.tool.selection"} {}

    ToolDriver& select() { return tool("selection"); }
    /// Two squares apart, and one over the right half of the first.
    const Item& left = addRectangle(Box({0, 0}, {40, 40}));
    const Item& right = addRectangle(Box({200, 0}, {240, 40}));
    const Item& over = addRectangle(Box({20, 0}, {60, 40}));
};

}  // namespace jet::test
