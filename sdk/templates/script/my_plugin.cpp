// A script engine. Its language has two sentences, one a line:
//
//   say Hello                    prints when play starts
//   on D push Ball 40 0          a force on the body called Ball while the key D is held
//
// Put your own language's interpreter in its place: run() compiles and starts a script, dispatch() calls its listeners.
#include <jet/plugin.hpp>
#include <jet/script.hpp>
#include <jet/simulation.hpp>

#include <sstream>
#include <vector>

namespace {

struct Push {
    std::string key;
    jet::ItemId body;
    jet::Vec2 force;
};

class MyPluginRuntime final : public jet::ScriptRuntime {
public:
    explicit MyPluginRuntime(jet::Simulation& simulation) : simulation_(simulation) {}

    jet::Result<void> run(const jet::Item& script) override
    {
        const auto code = script.property("code");
        std::istringstream lines(code ? code->as<std::string>() : std::string());
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number)
            if (auto done = sentence(script, line); !done)
                return jet::Error(done.error().message, {script.name(), number, 0});
        return {};
    }

    void dispatch(const jet::ScriptEvent& event) override
    {
        if (event.kind != jet::ScriptEventKind::Step) return;
        for (const Push& push : pushes_)
            if (simulation_.isPressed(push.key))
                simulation_.world().applyForce(simulation_.bodyOf(push.body), push.force);
    }

    bool listensTo(jet::ScriptEventKind kind) const override
    {
        return kind == jet::ScriptEventKind::Step && !pushes_.empty();
    }

private:
    jet::Result<void> sentence(const jet::Item& script, const std::string& line)
    {
        std::istringstream words(line);
        words.imbue(std::locale::classic());  // numbers are read the same everywhere
        std::string verb;
        if (!(words >> verb)) return {};
        if (verb == "say") {
            std::string text;
            std::getline(words >> std::ws, text);
            simulation_.print(text);
            return {};
        }
        Push push;
        std::string action, name;
        words >> push.key >> action >> name >> push.force.x() >> push.force.y();
        if (!words || verb != "on" || action != "push")
            return jet::Error("A sentence is 'say TEXT' or 'on KEY push BODY X Y', not '" + line + "'.");
        const jet::Item* body = jet::findClosestByName(script, name);
        if (!body || simulation_.bodyOf(body->id()) == jet::kNoHandle)
            return jet::Error("There is no body called '" + name + "' in this scene.");
        push.body = body->id();
        pushes_.push_back(push);
        return {};
    }

    jet::Simulation& simulation_;
    std::vector<Push> pushes_;
};

class MyPluginEngine final : public jet::ScriptEngine {
public:
    std::unique_ptr<jet::ScriptRuntime> createRuntime(jet::Simulation& simulation) override
    {
        return std::make_unique<MyPluginRuntime>(simulation);
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.scriptEngine<MyPluginEngine>("my-plugin"); }
