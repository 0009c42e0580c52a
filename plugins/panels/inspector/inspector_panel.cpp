// Inspector panel: see inspector_widget.hpp.
#include "inspector_widget.hpp"

#include <jet/plugin.hpp>
#include <jet/ui/panel.hpp>

namespace {

class InspectorPanel final : public jet::Panel {
public:
    using Panel::Panel;
    QWidget* createWidget() override { return new jet::inspector::InspectorWidget(editor()); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.panel<InspectorPanel>("inspector"); }
