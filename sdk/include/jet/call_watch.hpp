// CallWatch: what the centers of the SDK and the host's guard tell each other about calls into plugins. Plugins do not
// use it: that they are guarded is the host's business.
#pragma once

#include <jet/version.hpp>

#include <cstdint>
#include <exception>
#include <string>

namespace jet {

class ItemsCenter;

/// Whose code runs. The host sets one for the process; without it all code counts as JET's own.
class JET_API CallWatch {
public:
    /// 0: code of JET itself.
    using Owner = std::uint32_t;

    virtual ~CallWatch();

    /// The plugin the machine code at this address belongs to. [any thread]
    virtual Owner ownerOf(const void* code) const = 0;
    /// A listener of the plugin came (1) or ended (-1).
    virtual void listens(Owner owner, int change) = 0;
    /// A listener of the plugin is about to be called: false when the plugin is switched off. Followed by leave().
    /// [any thread]
    virtual bool enter(Owner owner) = 0;
    virtual void leave() noexcept = 0;
    /// A listener of the plugin threw. Called after leave(). [any thread]
    virtual void failed(Owner owner, std::exception_ptr problem) = 0;
    /// Code at this address did what the SDK forbids; `rule` is a sentence. The call itself is refused with a Failure.
    /// [any thread]
    virtual void brokeRule(const void* code, const std::string& rule) = 0;

    /// The watch must outlive its being set. [any thread]
    static void set(CallWatch* watch);
    static CallWatch* get();
};

/// How many transactions are open on the calling thread.
JET_API std::size_t openTransactionCount();
/// The label of the scene's innermost open transaction; empty if none.
JET_API std::string openTransactionLabel(const ItemsCenter& items);
/// Rolls back those opened last until only `count` are left. Returns the label of the first one it rolled back.
JET_API std::string abandonTransactions(std::size_t count);

}  // namespace jet
