// History panel: see history_widget.hpp.
#include "history_widget.hpp"

#include <jet/plugin.hpp>
#include <jet/ui/panel.hpp>

namespace {

class HistoryPanel final : public jet::Panel {
public:
    using Panel::Panel;
    QWidget* createWidget() override { return new jet::history::HistoryWidget(editor()); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.panel<HistoryPanel>("history"); }
