// The Physics panel and its commands: what is drawn over a running game, and going back in time.
#include "physics_widget.hpp"

#include <jet/physics_view.hpp>
#include <jet/plugin.hpp>
#include <jet/rewind.hpp>
#include <jet/ui/panel.hpp>

namespace {

class PhysicsPanel final : public jet::Panel {
public:
    using Panel::Panel;
    QWidget* createWidget() override { return new jet::panels::PhysicsWidget(editor()); }
};

/// All marks on, or all off.
class ToggleCommand final : public jet::Command {
public:
    void run(jet::Editor& editor) override
    {
        jet::PhysicsMarks marks;
        const bool statistics = editor.simulation().physicsMarks().statistics;
        jet::PhysicsMarks shown = editor.simulation().physicsMarks();
        shown.statistics = false;
        if (!shown.any()) marks = jet::panels::allMarks();
        marks.statistics = statistics;
        editor.simulation().setPhysicsMarks(marks);
    }
};

class BackCommand final : public jet::Command {
public:
    void run(jet::Editor& editor) override
    {
        const jet::RewindState state = editor.simulation().rewindState();
        constexpr std::uint64_t kSteps = 60;
        editor.simulation().rewindTo(state.present > kSteps ? std::max(state.oldest, state.present - kSteps)
                                                            : state.oldest);
    }
    bool isEnabled(jet::Editor& editor) const override { return editor.simulation().rewindState().any; }
};

}  // namespace

JET_PLUGIN(plugin)
{
    plugin.panel<PhysicsPanel>("physics-debug");
    plugin.command<ToggleCommand>("physics-debug.toggle");
    plugin.command<BackCommand>("physics-debug.back");
}
