// Ellipse tool: drag a box, get an ellipse of four segments in it (thesis §3.5.1.4). Shift makes a circle, Alt grows it
// from its centre.
#include <jet/box_tool.hpp>
#include <jet/plugin.hpp>

namespace {

class EllipseTool final : public jet::BoxTool {
public:
    explicit EllipseTool(jet::ToolHost& host) : BoxTool(host, {"ellipse", "circle"}) {}
    jet::Path shape(const jet::Box& box) const override { return jet::Path::ellipse(box); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<EllipseTool>("ellipse"); }
