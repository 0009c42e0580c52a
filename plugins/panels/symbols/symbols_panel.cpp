// Symbols panel: the front scene's symbols and what is done with them.
#include "symbols_widget.hpp"

#include <jet/plugin.hpp>
#include <jet/ui/panel.hpp>

namespace {

class SymbolsPanel final : public jet::Panel {
public:
    using Panel::Panel;
    QWidget* createWidget() override { return new jet::symbol_list::SymbolsWidget(editor()); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.panel<SymbolsPanel>("symbol-list"); }
