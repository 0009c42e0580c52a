#include "editor.hpp"

#include "managed_plugins.hpp"

#include "host/packages/installer.hpp"
#include "host/plugins/plugin_control.hpp"
#include "host/plugins/project_trust.hpp"
#include "host/window/launch.hpp"

#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>

namespace jet::host {

namespace fs = std::filesystem;

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

/// The plugins beside a project, if the user trusts them or says so now. Returns what the user should know.
std::string bringIn(const fs::path& project, PluginManager& plugins, bool trust,
                    const std::function<bool(const std::string&)>& ask)
{
    const auto found = findProjectPlugins(project);
    for (const Plugin* plugin : plugins.plugins())
        if (plugin->origin == PluginOrigin::Project && (!found || plugin->folder.parent_path() != found->folder))
            plugins.removeFolder(fs::path(plugin->folder));  // of the project that was open before
    if (!found) return {};
    if (plugins.options().safeMode) return "The plugins of the project are left out in safe mode.";
    if (!found->isTrusted()) {
        if (found->fingerprint.empty()) return found->advice();
        std::string question = found->trust == ProjectPlugins::Trust::Changed
                                   ? "The plugins of this project changed since you trusted it:"
                                   : "This project brings plugins of its own:";
        for (const std::string& name : found->names) question += "\n" + (found->folder / name).string();
        if (!trust && !ask(question)) return found->advice();
        if (const auto stored = trustProject(*found); !stored) return stored.error().text();
    }
    plugins.addFolder(found->folder, PluginOrigin::Project);
    return {};
}

PackageActions packageActions(PluginManager& plugins)
{
    PackageActions actions;
    actions.install = [&plugins](const fs::path& file) -> Result<std::vector<PackageActions::Installed>> {
        InstallOptions options;
        options.folder = userPluginFolder();
        options.installed = installedPlugins(plugins);
        const auto done = installPackage(file, std::move(options));
        if (!done) return done.error();
        std::string message = done->name + " " + done->version.text() + " is installed.";
        for (const std::string& note : done->notes) message += " " + note;
        return std::vector<PackageActions::Installed>{{done->id, done->folder, message}};
    };
    actions.remove = [&plugins](const std::string& id) {
        return removePlugin(id, {userPluginFolder(), installedPlugins(plugins), false});
    };
    return actions;
}

/// Are the plugins those that the set or the project records? Says on stderr where they differ.
bool isAsRecorded(Session& session, const fs::path& project)
{
    try {
        if (project.empty()) {
            session.compareWithSet();
        } else {
            session.useProjectPlugins(project);
            session.comparePlugins(
                *Project::load(session.readable(project), session.events(), session.plugins()).orThrow());
        }
        return true;
    } catch (const Failure& failure) {
        session.error(failure.error());
        return false;
    }
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
    std::string problem;
    const JetRunWindow run = loadWindow(problem);
    if (!run) {
        std::fprintf(stderr, "error: the editor's window cannot be loaded: %s; install JET again\n", problem.c_str());
        return kFailed;
    }
    Session session(global);
    session.lookForSetsOf(project);
    if (global.frozen && !isAsRecorded(session, project)) return kFailed;
    PluginManager& plugins = session.plugins();
    PluginControl control(plugins, session.events(), packageActions(plugins));
    const auto useProjectPlugins = [&](const fs::path& file, const std::function<bool(const std::string&)>& ask) {
        std::string told = control.setProject(file);
        const std::string left = bringIn(file, plugins, global.trust, ask);
        told += (told.empty() || left.empty() ? "" : " ") + left;
        session.events().post(&control, PluginsChanged{});
        return told;
    };
    ManagedPlugins runtime(plugins);
    WindowLaunch launch{plugins,  session.events(), project, global.safeMode, [&plugins] { return plugins.problems(); },
                        &control, useProjectPlugins};
    launch.runtime = &runtime;
    const auto crashes = session.crashes();
    for (const CrashReport& crash : crashes) launch.crashes.push_back({crash.plugin, crash.message});
    launch.goOn = [&](const std::vector<std::string>& ids, bool safeMode) {
        plugins.leaveOut(ids, safeMode);
        if (safeMode && global.set.empty()) plugins.useSet(std::nullopt);  // one that was chosen for all runs
        for (const CrashReport& crash : crashes) CrashLedger::settled(crash);
    };
    launch.watch = global.watch;
    launch.frozen = global.frozen;
    launch.setReloader = [&control](auto reload) { control.setReloader(std::move(reload)); };
    return run(argc, argv, launch);
}

}  // namespace jet::host
