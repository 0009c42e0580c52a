// What all commands share: the global options, the plugin manager made from them, and the way messages are printed.
#pragma once

#include "host/plugins/crash_ledger.hpp"
#include "host/plugins/plugin_manager.hpp"
#include "host/plugins/user_choice.hpp"
#include "host/plugins/watchdog.hpp"

#include <jet/events.hpp>
#include <jet/plugins.hpp>
#include <jet/project.hpp>
#include <jet/result.hpp>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace jet::host {

/// Exit codes of the command line (stable).
enum Exit : int { kOk = 0, kFailed = 1, kUsage = 2 };

struct GlobalOptions {
    std::vector<std::filesystem::path> pluginPath;
    std::vector<std::filesystem::path> watch;  // also part of pluginPath
    std::vector<std::string> without;
    std::string set;      ///< the value of --plugins: names and files of sets, ids of plugins
    bool frozen = false;  ///< exact versions or nothing
    bool safeMode = false;
    bool trust = false;  ///< trust the plugins of the projects that are opened
    bool json = false;
    bool verbose = false;
};

class Session {
public:
    explicit Session(GlobalOptions options);
    ~Session();

    const GlobalOptions& options() const { return options_; }
    EventsCenter& events() { return events_; }
    /// Scans the plugins on first use. Throws Failure when the plugin set cannot be read, or with --frozen when other
    /// plugins are there than it names.
    PluginManager& plugins();

    /// Brings in the plugins beside the project file and reads its plugins.jetset; warns where plugins are left out
    /// because nobody trusted them yet. Before plugins(), where that is to find the set "project".
    void useProjectPlugins(const std::filesystem::path& project);
    /// Where the set "project" is found, for a program that brings in the project's plugins itself. Before plugins().
    void lookForSetsOf(const std::filesystem::path& project) { setsOf_ = project; }
    /// Warns of plugins that are not as the project was saved with, and answers them; with --frozen throws Failure that
    /// lists them.
    std::vector<PluginDifference> comparePlugins(const Project& project);
    /// There is no project to compare with: with --frozen and without a set throws Failure.
    void compareWithSet();

    /// The project to read: the path itself, or, of a packed project (*.jetz), a copy that goes with the session.
    /// Messages name the packed file. Throws Failure when it cannot be unpacked.
    std::filesystem::path readable(const std::filesystem::path& project);

    /// A text or path with the copies of packed projects called by the names of these.
    std::string named(std::string text) const;

    void error(const Error& error);
    void warning(const std::string& message, const Location& where = {});
    /// Plugins in which an earlier run ended. printCrashes() says so once, on stderr, for commands without a window.
    std::vector<CrashReport> crashes() const { return CrashLedger::reports(CrashLedger::defaultFolder()); }
    void printCrashes();
    /// What failed inside plugins and was not yet told: one failure is one message, so it waits for the command that
    /// may tell it with more context. Returns whether there was any.
    bool tellProblems();
    /// The first such failure, if any.
    std::optional<Error> problem() const;

private:
    void tell(const std::string& text);
    PluginOptions pluginOptions();
    std::optional<PluginSet> chosenSet();
    void bringInProject();
    void tellOfSet();

    GlobalOptions options_;
    EventsCenter events_;
    mutable std::mutex mutex_;             // guards the problems: plugins fail on any thread
    std::vector<PluginProblem> problems_;  // not yet told
    std::filesystem::path project_;        // whose plugins came in last
    std::filesystem::path setsOf_;
    std::unique_ptr<PluginManager> plugins_;
    std::unique_ptr<Watchdog> watchdog_;
    struct Unpacked;
    std::vector<std::unique_ptr<Unpacked>> unpacked_;
};

/// "0x…" hashes are printed as 16 hexadecimal digits.
std::string hashText(std::uint64_t hash);

}  // namespace jet::host
