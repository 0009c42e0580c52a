// The crash ledger: while the program runs, a file shows which plugin is in which callback (the CallBoard, mapped). A
// program that ends well removes its file; what a dead one left tells the next start whom to name.
//
//   CrashLedger ledger(CrashLedger::defaultFolder());      // before the first plugin is loaded
//   for (const CrashReport& report : CrashLedger::reports(folder)) ...; CrashLedger::told(report);
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace jet::host {

/// One run that ended inside a plugin.
struct CrashReport {
    std::string plugin;          ///< id
    std::string title;           ///< "id version"
    std::string callback;        ///< "Tool::press"
    std::string message;         ///< a sentence: when, how, plugin, callback
    bool toldBefore = false;     ///< a headless command printed it already
    std::filesystem::path file;  ///< the ledger it was read from
};

class CrashLedger {
public:
    /// $XDG_STATE_HOME/jet/ledger, or ~/.local/state/jet/ledger; empty without a home.
    static std::filesystem::path defaultFolder();

    /// Begins to note, and to catch the signals of crashes. Where the folder cannot be written, nothing is noted. One a
    /// process. The file goes when the program ends in order, after all static destructors.
    explicit CrashLedger(const std::filesystem::path& folder);
    CrashLedger(const CrashLedger&) = delete;
    CrashLedger& operator=(const CrashLedger&) = delete;

    /// main() returns: what crashes from now on does so in static destructors.
    static void ending();
    /// What dead processes left. Removes ledgers that tell of no plugin.
    static std::vector<CrashReport> reports(const std::filesystem::path& folder);
    /// Was printed: the window still offers to go on without the plugin.
    static void told(const CrashReport& report);
    /// Was answered.
    static void settled(const CrashReport& report);
};

}  // namespace jet::host
