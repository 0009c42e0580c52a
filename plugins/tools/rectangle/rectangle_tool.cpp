// Rectangle tool: drag a box, get a ShapeItem (thesis §3.5.1.3). Shift keeps it square, Alt grows it from its centre.
#include <jet/box_tool.hpp>
#include <jet/plugin.hpp>

namespace {

class RectangleTool final : public jet::BoxTool {
public:
    explicit RectangleTool(jet::ToolHost& host) : BoxTool(host, {"rectangle", "square"}) {}
    jet::Path shape(const jet::Box& box) const override { return jet::Path::rectangle(box); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<RectangleTool>("rectangle"); }
