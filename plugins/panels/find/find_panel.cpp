// Find panel: see find_widget.hpp.
#include "find_widget.hpp"

#include <jet/plugin.hpp>
#include <jet/ui/panel.hpp>

namespace {

class FindPanel final : public jet::Panel {
public:
    using Panel::Panel;
    QWidget* createWidget() override { return new jet::find::FindWidget(editor()); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.panel<FindPanel>("find"); }
