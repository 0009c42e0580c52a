// Journal: what was done since the last save, on disk, so that no crash loses it (docs/file-format.md, "Journals").
//
//   Journal journal(project);            // right after the project was made or loaded, before anybody else listens
//   ...                                  // each commit, undo and redo is appended when its event comes
//   project.save();                      // tells the journal; a save that succeeds ends it, the next change begins
//   anew journal.discard();                   // the user does not want the changes
//
// After a crash: findJournals() · recoverProject(), save, Journal::remove() - or keep the file for later.
//
// What is written is data only: no plugin is needed to write, read or recover it. A record goes to the operating system
// before its event ends, so the end of the process, however sudden, loses nothing that was committed. A thread calls
// fdatasync within kSyncDelay after it, so a power cut loses at most what was done in that time.
#pragma once

#include <jet/project.hpp>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jet {

/// What one commit, undo or redo did, as bytes: always forwards, so an undo is written as the changes it made.
JET_API std::string encodeChanges(const Scene& scene, std::span<const Change> changes, ItemsChanged::Cause cause);
/// A scene with encoded changes made.
struct ReplayedScene {
    std::unique_ptr<Scene> scene;
    std::size_t records = 0;  ///< made, whole ones, from the first on
    Error problem;            ///< why the next one could not be made: it is damaged, or of another state of the scene
};
/// Makes encoded changes, in order, in a copy of the scene, which has no history. Nothing in the bytes is trusted.
JET_API ReplayedScene replayChanges(const Scene& scene, std::span<const std::string_view> records);

/// $XDG_STATE_HOME/jet/journals, or the same under ~/.local/state; empty where there is neither.
JET_API std::filesystem::path journalFolder();

/// The most time between a change and the fdatasync that makes it outlive a power cut.
inline constexpr std::chrono::milliseconds kSyncDelay{250};

/// Records the changes of one project. [owner's thread of the project's events]
class JET_API Journal {
public:
    /// Makes its file at the first change, in `folder`. The project must outlive the journal.
    explicit Journal(Project& project, std::filesystem::path folder = journalFolder());
    /// Keeps the file: only saving or discard() end it.
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// The file; empty while there is nothing to record.
    const std::filesystem::path& file() const;
    /// Changes recorded since the last save.
    std::size_t changeCount() const;
    /// Forgets the changes: the file goes.
    void discard();
    /// Compares the tree of filters and scenes with what was recorded, and records the difference. ProjectChanged and
    /// ProjectTreeChanged do this by themselves.
    void recordStructure();
    /// After a recovery: the project's unsaved state becomes this journal's first record, so that the recovered
    /// journal may be removed. `unsaved` is the number of changes it stands for: findJournals() leaves out journals
    /// without any.
    Result<void> recordEverything(std::size_t unsaved = 1);
    /// Waits until all that was recorded is on the disk.
    void sync();
    /// Called when changes can no longer be recorded (a full disk), and, with an empty text, when they can be again:
    /// nothing is lost in between, the file starts with the whole state then. The default prints to stderr.
    void setProblemHandler(std::function<void(const std::string&)> handler);
    /// Rewritten as a snapshot when it is larger than this and than four snapshots. Bytes; the default is 32 MiB.
    void setCompactionSize(std::uintmax_t bytes);

    /// Removes a journal found by findJournals(). An Error when the editor that writes it is alive.
    static Result<void> remove(const std::filesystem::path& file);

private:
    class Private;
    std::unique_ptr<Private> d_;
};

/// A journal on disk, as a person chooses by.
struct JournalInfo {
    std::filesystem::path file;
    std::filesystem::path project;  ///< its project.jet, absolute; empty for a project that was never saved
    std::string name;               ///< of the project
    std::chrono::system_clock::time_point lastChange;
    std::size_t changes = 0;  ///< commits, undos, redos and changes of the tree since the last save
    bool inUse = false;       ///< the editor that writes it is alive
    bool torn = false;        ///< the last record is incomplete or damaged: it was under way when the process ended
};

/// The journals in the folder, the latest first; those without a change are left out. Reads no more than their heads
/// and the heads of their records.
JET_API std::vector<JournalInfo> findJournals(const std::filesystem::path& folder = journalFolder());
/// The journals of this project that no living editor writes.
JET_API std::vector<JournalInfo> findJournals(const Project& project,
                                              const std::filesystem::path& folder = journalFolder());
JET_API Result<JournalInfo> inspectJournal(const std::filesystem::path& file);

/// A project with the changes of a journal made in it, not yet saved.
struct Recovery {
    std::unique_ptr<Project> project;
    std::size_t changes = 0;         ///< recovered
    std::vector<std::string> notes;  ///< what the user should know: a file changed since, a torn tail, ...
};

/// Opens the journal's project and makes its changes; a scene that was never saved, or whose file has gone or is
/// another one now, comes from the journal alone. No file is touched: the recovered scenes are unsaved, without a
/// history.
JET_API Result<Recovery> recoverProject(const std::filesystem::path& journal, EventsCenter& events, Catalog& catalog);

}  // namespace jet
