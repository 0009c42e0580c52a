// The one door into libjet-window.so: bin/jet loads it with dlopen when the editor is wanted, so that `jet --version`
// and the headless commands never load Qt.
#pragma once

#include "plugin_runtime.hpp"

#include <jet/catalog.hpp>
#include <jet/events.hpp>
#include <jet/plugins.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace jet::host {

/// What the editor is started with. Everything referred to outlives the call.
struct WindowLaunch {
    jet::Catalog& catalog;
    jet::EventsCenter& events;      ///< owned by the calling thread, which becomes the GUI thread
    std::filesystem::path project;  ///< empty: a new, untitled project
    bool safeMode = false;          ///< started with the shipped plugins only: said in the title
    /// Sentences about plugins that are faulted or were refused; may be empty.
    std::function<std::vector<std::string>()> pluginProblems;
    jet::PluginsCenter* plugins = nullptr;  ///< null: there are none to manage
    /// Brings in the plugins beside a project; `ask` is asked whether to trust them. Returns what the user should know.
    std::function<std::string(const std::filesystem::path& project, const std::function<bool(const std::string&)>& ask)>
        useProjectPlugins = {};
    /// Null: plugins are not guarded in the window and cannot be reloaded, as in tests.
    PluginRuntime* runtime = nullptr;
    /// Runs that ended inside plugins, and what to do when the user has chosen which ones to go on without, or to go on
    /// with the shipped ones only. The catalog is used only after that.
    std::vector<CrashNote> crashes = {};
    std::function<void(const std::vector<std::string>& leftOut, bool safeMode)> goOn = {};
    /// Folders whose plugins are reloaded when they are rebuilt.
    std::vector<std::filesystem::path> watch = {};
    /// Projects open only with exactly the plugins they were saved with.
    bool frozen = false;
    /// Gives `plugins` the way to reload one; called with an empty one when the window goes.
    std::function<void(std::function<jet::Result<jet::PluginChange>(const std::string& plugin)>)> setReloader = {};
};

}  // namespace jet::host

/// Shows the editor and runs it until its window closes; returns the exit code. [main thread]
extern "C" JET_API int jet_run_window(int argc, char** argv, const jet::host::WindowLaunch& launch);
/// Its type and its name, for dlsym.
using JetRunWindow = int (*)(int argc, char** argv, const jet::host::WindowLaunch& launch);
inline constexpr const char* kJetRunWindowSymbol = "jet_run_window";
