// ProjectController: the open project and its file: new, open, save, recent, and asking before changes are lost.
#pragma once

#include "window/actions.hpp"
#include "window/documents.hpp"
#include "window/recovery_dialog.hpp"

#include <jet/journal.hpp>
#include <jet/project_lock.hpp>
#include <jet/project_tree.hpp>

#include <filesystem>
#include <functional>

class QSettings;

namespace jet::host {

class ProjectController final : public QObject {
    Q_OBJECT

public:
    enum class Answer { Save, Discard, Cancel };
    /// What to do when another program changed the project's files.
    enum class Conflict { Reload, KeepMine, SaveAs, Cancel };

    ProjectController(Editor& editor, Documents& documents, QWidget* window);
    ~ProjectController() override;

    std::vector<ActionSpec> actions();
    void fillRecentMenu(QMenu& menu);

    Project& project() const { return *project_; }
    ProjectTree& tree() const { return *tree_; }
    /// False until the first one is made or opened.
    bool hasProject() const { return project_ != nullptr; }
    /// A new, untitled project.
    void create();
    /// False, and the present project stays, when it cannot be read; the message bar says why. Offers what a crash left
    /// of it first. A packed project is unpacked where the user wants it first.
    bool open(const std::filesystem::path& path);
    /// The same for who was asked about that already.
    bool openAsSaved(const std::filesystem::path& path) { return load(path); }
    /// What crashes left behind: of that project, or of all.
    static std::vector<JournalInfo> unsavedWork(const std::filesystem::path& only = {});
    bool save();
    bool saveAs(const std::filesystem::path& folder);
    /// Packs the saved project into one file, *.jetz.
    bool exportPacked(const std::filesystem::path& file);
    /// Copies what the project uses from elsewhere into its folder; one undo step a scene.
    bool collect();
    /// Offers the changes that a crash left behind: those of `only`, or of all projects. False where there are none.
    bool offerRecovery(const std::filesystem::path& only = {});
    /// Opens the project of a journal with the changes in it, in place of the present one.
    bool recover(const std::filesystem::path& journal);
    /// Another editor has the project: it can be saved under another name only.
    bool isReadOnly() const { return readOnly_; }
    /// Asks about unsaved changes, if any; false: the user wants to stay.
    bool mayClose();
    bool isModified() const;
    /// Closes all tabs; before the window goes.
    void close();

    void restoreRecent(QSettings& settings);
    void saveRecent(QSettings& settings) const;
    /// Replaces the question box, for tests.
    void setQuestion(std::function<Answer()> question) { question_ = std::move(question); }
    /// Called with the path before a project is read.
    void setBeforeOpen(std::function<void(const std::filesystem::path&)> before) { beforeOpen_ = std::move(before); }
    /// Asked before a project that was read takes the place of the present one; false keeps the present one.
    void setMayOpen(std::function<bool(const Project&)> may) { mayOpen_ = std::move(may); }
    /// Tells which plugins the opened project misses; false when it misses none.
    void setTellMissing(std::function<bool()> tell) { tellMissing_ = std::move(tell); }
    void setRecoveryQuestion(std::function<RecoveryChoice(const std::vector<JournalInfo>&)> question)
    {
        recoveryQuestion_ = std::move(question);
    }
    /// Where to unpack a packed project; an empty path: nowhere.
    void setUnpackQuestion(std::function<std::filesystem::path(const std::filesystem::path&)> question)
    {
        unpackQuestion_ = std::move(question);
    }
    void setConflictQuestion(std::function<Conflict(const QStringList&)> question)
    {
        conflictQuestion_ = std::move(question);
    }

signals:
    void saved();

private:
    void install(std::unique_ptr<Project> project);
    void askAndCreate();
    void askAndOpen();
    void askAndOpen(const QString& path);
    bool askAndSaveAs();
    void askAndRecover();
    void askAndExportPacked();
    bool openPacked(const std::filesystem::path& packed);
    std::filesystem::path askUnpack(const std::filesystem::path& packed);
    bool load(const std::filesystem::path& path);
    bool saveOverChanged(const std::vector<std::filesystem::path>& changed);
    void startJournal();
    void takeLock(const std::filesystem::path& file);
    void tellNotes();
    bool finishSave(const Result<void>& result);
    void remember(const std::filesystem::path& file);
    Answer ask();
    RecoveryChoice askRecovery(const std::vector<JournalInfo>& journals);
    Conflict askConflict(const QStringList& files);

    Editor& editor_;
    Documents& documents_;
    QWidget* window_;
    std::unique_ptr<Project> project_;
    std::unique_ptr<ProjectTree> tree_;  // of project_
    std::unique_ptr<Journal> journal_;   // of project_
    ProjectLock lock_;
    std::filesystem::path locked_;  // the file lock_ is for
    bool readOnly_ = false;
    QStringList recent_;
    std::function<Answer()> question_;
    std::function<void(const std::filesystem::path&)> beforeOpen_;
    std::function<bool(const Project&)> mayOpen_;
    std::function<bool()> tellMissing_;
    std::function<RecoveryChoice(const std::vector<JournalInfo>&)> recoveryQuestion_;
    std::function<Conflict(const QStringList&)> conflictQuestion_;
    std::function<std::filesystem::path(const std::filesystem::path&)> unpackQuestion_;
};

}  // namespace jet::host
