// Plugins panel: the installed plugins, see plugins_widget.hpp.
#include "plugins_widget.hpp"

#include <jet/plugin.hpp>
#include <jet/ui/panel.hpp>

namespace {

class PluginsPanel final : public jet::Panel {
public:
    using Panel::Panel;
    QWidget* createWidget() override { return new jet::plugins::PluginsWidget(editor()); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.panel<PluginsPanel>("plugin-manager"); }
