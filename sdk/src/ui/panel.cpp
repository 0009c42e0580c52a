// The key function of Panel: one vtable for all plugins.
#include <jet/ui/panel.hpp>

namespace jet {

Panel::~Panel() = default;

}  // namespace jet
