// Drives one tool of one plugin in a process of its own, as bin/jet would: what happens to the process is the test.
//
//   evil-runner PLUGIN_FOLDER STATE_FOLDER TOOL ACTION...     press | release | cancel | deactivate | paint | command
//
// Prints what the guard tells, then the state of the scene and "survived".
#include "host/plugins/crash_ledger.hpp"
#include "host/plugins/plugin_manager.hpp"
#include "host/plugins/watchdog.hpp"
#include "support/recording_painter.hpp"
#include <jet/testing/tool_driver.hpp>

#include <cstdio>
#include <mutex>

namespace jet::host {
namespace {

void act(const std::string& action, Tool& tool)
{
    test::RecordingPainter painter;
    if (action == "press") tool.press({});
    if (action == "release") tool.release({});
    if (action == "cancel") tool.cancel();
    if (action == "deactivate") tool.deactivate();
    if (action == "paint") tool.paint(painter);
}

int run(const std::vector<std::string>& arguments)
{
    static const CrashLedger ledger{std::filesystem::path(arguments[1])};
    std::mutex printing;
    const auto print = [&](const char* what) {
        return [&printing, what](const PluginProblem& problem) {
            const std::lock_guard lock(printing);
            std::printf("%s: %s\n", what, problem.message.c_str());
        };
    };
    PluginOptions options;
    options.searchPath = {arguments[0]};
    PluginManager plugins(options);
    plugins.setProblemHandler(print("problem"));
    plugins.setHangHandler(print("hang"));
    plugins.scan();
    const Watchdog watchdog(std::chrono::milliseconds(20), 0.1);  // patience of 0.3 s
    EventsCenter events;
    Scene scene("Scene", events, plugins);
    const auto before = scene.hash();
    test::TestToolHost host(scene);
    if (auto tool = plugins.createTool(arguments[2], host)) {
        tool->activate();
        for (std::size_t i = 3; i < arguments.size(); ++i) act(arguments[i], *tool);
    }
    events.dispatchQueued();
    std::printf("scene %s, %s\n", scene.hash() == before ? "unchanged" : "changed",
                scene.items().inTransaction() ? "in a transaction" : "at rest");
    std::printf("survived\n");
    std::fflush(stdout);
    return 0;
}

}  // namespace
}  // namespace jet::host

int main(int argc, char** argv)
{
    const int code = jet::host::run({argv + 1, argv + argc});
    jet::host::CrashLedger::ending();
    return code;
}
