#include "host_call_watch.hpp"

namespace jet::host {

namespace {

Callback innermost(const ThreadCalls& calls, std::uint16_t plugin)
{
    const std::uint32_t depth = calls.depth;
    if (depth == 0 || depth > ThreadCalls::kDepth) return Callback::OwnCode;
    const CallFrame& frame = calls.frames[depth - 1];
    return frame.plugin == plugin ? frame.callback : Callback::OwnCode;
}

}  // namespace

void HostCallWatch::install()
{
    static auto* const watch = [] {
        auto* made = new HostCallWatch;  // outlives whoever calls while the program ends
        CallWatch::set(made);
        return made;
    }();
    (void)watch;
}

CallWatch::Owner HostCallWatch::ownerOf(const void* code) const { return CallBoard::ownerOf(code); }

void HostCallWatch::listens(Owner owner, int change)
{
    if (CallAccount* account = CallAccount::at(static_cast<std::uint16_t>(owner))) account->addListeners(change);
}

bool HostCallWatch::enter(Owner owner)
{
    const CallAccount* account = CallAccount::at(static_cast<std::uint16_t>(owner));
    if (!account || !account->plugin().usable()) return false;
    CallFrame& frame = CallBoard::here().enter(account->place(), Callback::Listener, CallClock::now());
    frame.openBefore = static_cast<std::uint32_t>(openTransactionCount());
    return true;
}

void HostCallWatch::leave() noexcept
{
    ThreadCalls& calls = CallBoard::here();
    const std::uint32_t depth = calls.depth.load(std::memory_order_relaxed);
    const CallFrame frame = calls.frames[depth <= ThreadCalls::kDepth ? depth - 1 : ThreadCalls::kDepth - 1];
    const std::uint64_t ticks = calls.leave(CallClock::now());
    CallAccount* account = depth <= ThreadCalls::kDepth ? CallAccount::at(frame.plugin) : nullptr;
    if (!account) return;
    account->add(Callback::Listener, ticks);
    if (openTransactionCount() > frame.openBefore) [[unlikely]]
        account->guard().leftOpen(account->plugin(), Callback::Listener, frame.openBefore);
}

void HostCallWatch::failed(Owner owner, std::exception_ptr problem)
{
    CallAccount::with(static_cast<std::uint16_t>(owner),
                      [&](Plugin& plugin, Guard& guard) { guard.fault(plugin, Callback::Listener, problem); });
}

std::uint16_t HostCallWatch::culpritHere()
{
    const ThreadCalls& calls = CallBoard::here();
    if (const std::uint32_t depth = calls.depth; depth > 0 && depth <= ThreadCalls::kDepth)
        return calls.frames[depth - 1].plugin;
    return CallBoard::ownerOnStack(__builtin_frame_address(0));
}

void HostCallWatch::brokeRule(const void* code, const std::string& rule)
{
    std::uint16_t place = code ? CallBoard::ownerOf(code) : std::uint16_t{0};
    if (place == 0) place = culpritHere();
    CallAccount::with(place, [&](Plugin& plugin, Guard& guard) {
        const Callback callback = innermost(CallBoard::here(), place);
        guard.fault(plugin, callback, std::string(nameOf(callback)) + " broke a rule: " + rule);
    });
}

}  // namespace jet::host
