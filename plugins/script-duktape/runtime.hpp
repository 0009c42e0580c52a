// The scripts of one running simulation: runs them in order, calls their listeners, stops and reports what goes wrong.
#pragma once

#include "heap.hpp"
#include "play.hpp"

#include <jet/script.hpp>

namespace jet::duktape {

class Runtime final : public ScriptRuntime, public ContactListening {
public:
    explicit Runtime(Simulation& simulation, const Limits& limits = {});

    Result<void> run(const Item& script) override;
    void dispatch(const ScriptEvent& event) override;
    bool listensTo(ScriptEventKind kind) const override { return play_.listeners.any(kind); }
    bool listensToContacts() const override
    {
        return listensTo(ScriptEventKind::ContactBegin) || listensTo(ScriptEventKind::ContactEnd);
    }

    /// Bytes in use by all scripts.
    std::size_t memoryUsed() const { return play_.budget.memoryUsed(); }
    /// Frees what only cycles hold. For tests that count.
    void collectGarbage();

private:
    void callListener(ScriptEventKind kind, std::size_t index);
    void stopListener(ScriptEventKind kind, std::size_t index);
    void report(const Fault& fault, std::string_view consequence);

    Play play_;
    Heap heap_;
};

}  // namespace jet::duktape
