#include "hand_deeds.hpp"

#include <utility>

namespace jet {

namespace {

void apply(Simulation& simulation, const HandDeed& deed)
{
    switch (deed.kind) {
    case HandDeed::Kind::Grab: simulation.grab(deed.point, deed.reach); break;
    case HandDeed::Kind::Drag: simulation.drag(deed.point); break;
    case HandDeed::Kind::LetGo: simulation.letGo(); break;
    }
}

}  // namespace

void HandDeeds::does(Simulation& simulation, HandDeed deed)
{
    deed.step = simulation.stepCount();
    apply(simulation, deed);
    pending_.push_back(deed);
    moved_ = true;
}

void HandDeeds::dropStray(Simulation& simulation)
{
    if (std::exchange(stray_, false) && simulation.held()) does(simulation, {HandDeed::Kind::LetGo, {0, 0}});
}

void HandDeeds::act(Simulation& simulation, HandDeed deed)
{
    if (deed.kind != HandDeed::Kind::Grab && !grips_) return;
    dropStray(simulation);
    does(simulation, deed);
    grips_ = deed.kind != HandDeed::Kind::LetGo && simulation.held().has_value();
}

void HandDeeds::goOn(Simulation& simulation)
{
    dropStray(simulation);
    if (std::exchange(back_, false))
        std::erase_if(deeds_, [&](const HandDeed& deed) { return deed.step >= simulation.stepCount(); });
    deeds_.insert(deeds_.end(), pending_.begin(), pending_.end());
    pending_.clear();
    moved_ = false;  // a frame follows
}

void HandDeeds::again(Simulation& simulation) const
{
    for (const HandDeed& deed : deeds_)
        if (deed.step == simulation.stepCount()) apply(simulation, deed);
}

void HandDeeds::wentBack()
{
    pending_.clear();
    back_ = stray_ = true;
    grips_ = false;
}

void HandDeeds::forgetBefore(std::uint64_t step)
{
    std::erase_if(deeds_, [step](const HandDeed& deed) { return deed.step < step; });
}

}  // namespace jet
