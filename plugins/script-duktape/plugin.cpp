// JavaScript for playing scenes (thesis §3.4.5; SPEC SC), on Duktape. docs/script-api.md is its reference.
#include "runtime.hpp"

#include <jet/plugin.hpp>

namespace {

class DuktapeEngine final : public jet::ScriptEngine {
public:
    std::unique_ptr<jet::ScriptRuntime> createRuntime(jet::Simulation& simulation) override
    {
        return std::make_unique<jet::duktape::Runtime>(simulation);
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.scriptEngine<DuktapeEngine>("duktape"); }
