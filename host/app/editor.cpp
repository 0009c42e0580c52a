#include "editor.hpp"

#include "host/plugins/plugin_control.hpp"
#include "host/window/launch.hpp"

#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>

namespace jet::host {

namespace {

bool isSet(const char* variable)
{
    const char* value = std::getenv(variable);
    return value && *value;
}

// libjet-window.so lies beside libjet-sdk.so.
JetRunWindow loadWindow(std::string& problem)
{
    const auto file = builtInPluginFolder().parent_path().parent_path() / "libjet-window.so";
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* entry = library ? dlsym(library, kJetRunWindowSymbol) : nullptr;
    if (!entry) {
        const char* reason = dlerror();
        problem = reason ? reason : "unknown reason";
    }
    return reinterpret_cast<JetRunWindow>(entry);
}

}  // namespace

int runEditor(int argc, char** argv, const GlobalOptions& global, const std::filesystem::path& project)
{
    const bool display = isSet("DISPLAY") || isSet("WAYLAND_DISPLAY") || isSet("QT_QPA_PLATFORM");
    if (!display) {
        std::fprintf(
            stderr,
            "error: there is no display for the editor; 'jet play PROJECT' plays without one (see 'jet --help')\n");
        return kFailed;
    }
    std::error_code ignored;
    if (!project.empty() && !std::filesystem::exists(project, ignored)) {
        std::fprintf(stderr, "%s: error: there is no such project; 'jet project new DIR' makes one\n", project.c_str());
        return kFailed;
    }
    std::string problem;
    const JetRunWindow run = loadWindow(problem);
    if (!run) {
        std::fprintf(stderr, "error: the editor's window cannot be loaded: %s; install JET again\n", problem.c_str());
        return kFailed;
    }
    Session session(global);
    PluginManager& plugins = session.plugins();
    PluginControl control(plugins, session.events());
    const WindowLaunch launch{
        plugins, session.events(), project, global.safeMode, [&plugins] { return plugins.problems(); }, &control};
    return run(argc, argv, launch);
}

}  // namespace jet::host
