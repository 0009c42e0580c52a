// Scenes panel (thesis §3.3): the project as a tree.
#include "scenes_widget.hpp"

#include <jet/plugin.hpp>
#include <jet/ui/panel.hpp>

namespace {

class ScenesPanel final : public jet::Panel {
public:
    using Panel::Panel;
    QWidget* createWidget() override { return new jet::scenes::ScenesWidget(editor()); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.panel<ScenesPanel>("project-scenes"); }
