// HostCallWatch: what the SDK's centers ask and tell the host about code of plugins (see jet/call_watch.hpp). Owners
// are places on the CallBoard.
#pragma once

#include "guard.hpp"

namespace jet::host {

class HostCallWatch final : public CallWatch {
public:
    /// Makes it the process's watch; more than once does no harm.
    static void install();

    Owner ownerOf(const void* code) const override;
    void listens(Owner owner, int change) override;
    bool enter(Owner owner) override;
    void leave() noexcept override;
    void failed(Owner owner, std::exception_ptr problem) override;
    void brokeRule(const void* code, const std::string& rule) override;

    /// The plugin the calling thread works for: the one of the innermost guarded call, else the one whose code is on
    /// the stack; 0 if none.
    static std::uint16_t culpritHere();
};

}  // namespace jet::host
