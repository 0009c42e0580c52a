#include "window/project_controller.hpp"

#include "host/projects/project_archive.hpp"

#include <jet/start_scene.hpp>

#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>

namespace jet::host {

namespace {

constexpr int kMostRecent = 10;

QString textOf(const std::filesystem::path& path) { return QString::fromStdString(path.string()); }
std::filesystem::path pathOf(const QString& text) { return text.toStdString(); }

}  // namespace

ProjectController::ProjectController(Editor& editor, Documents& documents, QWidget* window)
    : QObject(window), editor_(editor), documents_(documents), window_(window), question_([this] { return ask(); }),
      recoveryQuestion_([this](const auto& journals) { return askRecovery(journals); }),
      conflictQuestion_([this](const QStringList& files) { return askConflict(files); }),
      unpackQuestion_([this](const std::filesystem::path& packed) { return askUnpack(packed); })
{
}

ProjectController::~ProjectController() = default;

std::vector<ActionSpec> ProjectController::actions()
{
    return {
        {"file.new", QT_TRANSLATE_NOOP("Actions", "&New project"), "new", "Ctrl+N", [this] { askAndCreate(); }},
        {"file.open", QT_TRANSLATE_NOOP("Actions", "&Open project…"), "open", "Ctrl+O", [this] { askAndOpen(); }},
        {"file.save", QT_TRANSLATE_NOOP("Actions", "&Save project"), "save", "Ctrl+S", [this] { save(); }},
        {"file.save-as", QT_TRANSLATE_NOOP("Actions", "Save project &as…"), "", "Ctrl+Shift+S",
         [this] { askAndSaveAs(); }},
        {"file.collect", QT_TRANSLATE_NOOP("Actions", "Collect &into project"), "", "", [this] { collect(); }},
        {"file.export-single", QT_TRANSLATE_NOOP("Actions", "Export as single &file…"), "", "",
         [this] { askAndExportPacked(); }},
        {"file.recover", QT_TRANSLATE_NOOP("Actions", "&Recover unsaved changes…"), "", "",
         [this] { askAndRecover(); }},
    };
}

// --- which project is open

void ProjectController::install(std::unique_ptr<Project> project)
{
    close();
    journal_.reset();
    tree_.reset();
    project_ = std::move(project);
    tree_ = std::make_unique<ProjectTree>(*project_, editor_.events());
    takeLock(project_->file());
    startJournal();  // before the panels know the project: the journal hears of a change first
    editor_.events().post(&editor_, ProjectChanged{});
    if (Scene* start = startScene(*project_)) documents_.openScene(*start);
}

void ProjectController::startJournal()
{
    journal_ = std::make_unique<Journal>(*project_);
    journal_->setProblemHandler([this](const std::string& text) {
        editor_.showMessage(text.empty() ? tr("Changes are recorded for a recovery again.").toStdString() : text);
    });
}

void ProjectController::takeLock(const std::filesystem::path& file)
{
    if (!file.empty() && file == locked_ && lock_.isHeld()) return;
    lock_.release();
    readOnly_ = false;
    locked_ = file;
    if (file.empty()) return;
    auto taken = ProjectLock::take(file);
    readOnly_ = !taken;
    if (taken) {
        lock_ = std::move(*taken);
    } else {
        editor_.showMessage(taken.error().text());
    }
}

void ProjectController::close()
{
    documents_.closeAll();
    if (isModified()) tree_->revertFiles();
    if (journal_) journal_->discard();  // the user was asked
}

void ProjectController::create()
{
    install(Project::create(tr("Untitled").toStdString(), editor_.events(), editor_.catalog()));
}

bool ProjectController::open(const std::filesystem::path& path)
{
    if (isPackedProject(path)) return openPacked(path);
    const auto file = findProjectFile(path);
    return (file && offerRecovery(*file)) || load(path);
}

bool ProjectController::load(const std::filesystem::path& path)
{
    if (beforeOpen_) beforeOpen_(path);
    Result<std::unique_ptr<Project>> loaded = Project::load(path, editor_.events(), editor_.catalog());
    if (!loaded) {
        editor_.showMessage(loaded.error().text());
        return false;
    }
    if (mayOpen_ && !mayOpen_(**loaded)) return false;
    install(std::move(*loaded));
    remember(project_->file());
    tellNotes();
    return true;
}

void ProjectController::tellNotes()
{
    for (const FormatNote& note : project_->notes()) {
        editor_.print({OutputLine::Kind::Warning, Error(note.message, note.where).text(), {}, 0});
    }
    const bool told = tellMissing_ && tellMissing_();
    if (!told && !project_->notes().empty()) editor_.showMessage(project_->notes().front().message);
}

// --- after a crash

std::vector<JournalInfo> ProjectController::unsavedWork(const std::filesystem::path& only)
{
    std::error_code ignored;
    std::vector<JournalInfo> journals = findJournals();
    std::erase_if(journals, [&](const JournalInfo& info) {
        return info.inUse || (!only.empty() && !std::filesystem::equivalent(info.project, only, ignored));
    });
    return journals;
}

bool ProjectController::offerRecovery(const std::filesystem::path& only)
{
    for (;;) {
        const std::vector<JournalInfo> journals = unsavedWork(only);
        if (journals.empty()) return false;
        const RecoveryChoice choice = recoveryQuestion_(journals);
        if (choice.kind == RecoveryChoice::Kind::Later) return false;
        const std::filesystem::path journal = journals.at(choice.index).file;
        // Who opens a project was asked about the present one before.
        if (choice.kind == RecoveryChoice::Kind::Recover) return (!only.empty() || mayClose()) && recover(journal);
        if (const auto removed = Journal::remove(journal); !removed) {
            editor_.showMessage(removed.error().text());
            return false;
        }
    }
}

bool ProjectController::recover(const std::filesystem::path& journal)
{
    const auto info = inspectJournal(journal);
    if (beforeOpen_ && info && !info->project.empty()) beforeOpen_(info->project);
    Result<Recovery> recovery = recoverProject(journal, editor_.events(), editor_.catalog());
    if (!recovery) {
        editor_.showMessage(recovery.error().text());
        return false;
    }
    if (mayOpen_ && !mayOpen_(*recovery->project)) return false;
    install(std::move(recovery->project));
    if (!project_->file().empty()) remember(project_->file());
    tellNotes();
    for (const std::string& note : recovery->notes) editor_.showMessage(note);
    // The old journal goes only when the new one holds all of it.
    if (const auto kept = journal_->recordEverything(recovery->changes); !kept) {
        editor_.showMessage(kept.error().text());
    } else if (const auto removed = Journal::remove(journal); !removed) {
        editor_.showMessage(removed.error().text());
    }
    editor_.showStatus(
        tr("Recovered %n change(s); save to keep them", nullptr, static_cast<int>(recovery->changes)).toStdString());
    emit saved();  // the title tells what is open now
    return true;
}

RecoveryChoice ProjectController::askRecovery(const std::vector<JournalInfo>& journals)
{
    RecoveryDialog dialog(journals, window_);
    dialog.exec();
    return dialog.choice();
}

void ProjectController::askAndRecover()
{
    if (offerRecovery()) return;
    editor_.showStatus(tr("There are no unsaved changes of earlier sessions").toStdString());
}

bool ProjectController::isModified() const { return project_ && project_->isModified(); }

bool ProjectController::mayClose()
{
    documents_.commitScripts();
    if (!isModified()) return true;
    switch (question_()) {
    case Answer::Save: return save();
    case Answer::Discard: return true;
    case Answer::Cancel: return false;
    }
    return false;
}

ProjectController::Answer ProjectController::ask()
{
    QMessageBox box(QMessageBox::Warning, tr("Unsaved changes"),
                    tr("“%1” has changes that are not saved.").arg(QString::fromStdString(project_->name())),
                    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, window_);
    box.setInformativeText(tr("They are lost if you do not save them."));
    box.setDefaultButton(QMessageBox::Save);
    box.button(QMessageBox::Discard)->setText(tr("&Discard"));  // Qt's own texts have no letter to press
    switch (box.exec()) {
    case QMessageBox::Save: return Answer::Save;
    case QMessageBox::Discard: return Answer::Discard;
    default: return Answer::Cancel;
    }
}

// --- files

bool ProjectController::save()
{
    documents_.commitScripts();
    if (SceneView* view = documents_.currentView()) view->endGesture();
    if (project_->file().empty()) return askAndSaveAs();
    if (readOnly_) {
        takeLock(project_->file());  // it may be free by now
        if (readOnly_) return askAndSaveAs();
    }
    const auto changed = project_->changedOnDisk();
    return changed.empty() ? finishSave(project_->save()) : saveOverChanged(changed);
}

bool ProjectController::saveOverChanged(const std::vector<std::filesystem::path>& changed)
{
    QStringList files;
    for (const std::filesystem::path& file : changed) files << QDir::toNativeSeparators(textOf(file));
    switch (conflictQuestion_(files)) {
    case Conflict::Reload: return load(project_->file());
    case Conflict::KeepMine: return finishSave(project_->save(Overwrite::Allow));
    case Conflict::SaveAs: return askAndSaveAs();
    case Conflict::Cancel: return false;
    }
    return false;
}

ProjectController::Conflict ProjectController::askConflict(const QStringList& files)
{
    QMessageBox box(
        QMessageBox::Warning, tr("Changed by another program"),
        tr("Another program changed files of this project since they were opened:\n%1").arg(files.join('\n')),
        QMessageBox::NoButton, window_);
    box.setInformativeText(
        tr("Reload drops what you did since the last save. Keep mine replaces their version; it goes "
           "to the backups."));
    const auto* reload = box.addButton(tr("&Reload"), QMessageBox::DestructiveRole);
    const auto* mine = box.addButton(tr("&Keep mine"), QMessageBox::AcceptRole);
    const auto* elsewhere = box.addButton(tr("Save &as…"), QMessageBox::ActionRole);
    box.setDefaultButton(box.addButton(QMessageBox::Cancel));
    box.exec();
    const QAbstractButton* clicked = box.clickedButton();
    if (clicked == reload) return Conflict::Reload;
    if (clicked == mine) return Conflict::KeepMine;
    return clicked == elsewhere ? Conflict::SaveAs : Conflict::Cancel;
}

bool ProjectController::saveAs(const std::filesystem::path& folder)
{
    documents_.commitScripts();
    return finishSave(project_->saveAs(folder));
}

bool ProjectController::finishSave(const Result<void>& result)
{
    if (!result) {
        editor_.showMessage(result.error().text());
        return false;
    }
    remember(project_->file());
    takeLock(project_->file());
    tree_->markSaved();
    for (const std::string& note : project_->saveNotes()) editor_.showMessage(note);
    editor_.showStatus(tr("Saved %1").arg(QDir::toNativeSeparators(textOf(project_->file()))).toStdString());
    emit saved();
    return true;
}

bool ProjectController::askAndSaveAs()
{
    const QString proposed = QDir(recent_.isEmpty() ? QDir::homePath() : QFileInfo(recent_.front()).path() + "/..")
                                 .filePath(QString::fromStdString(project_->name()));
    const QString folder =
        QFileDialog::getSaveFileName(window_, tr("Save project in a new folder"), proposed, tr("Project folder (*)"),
                                     nullptr, QFileDialog::DontUseNativeDialog | QFileDialog::DontConfirmOverwrite);
    if (folder.isEmpty()) return false;
    if (QFileInfo::exists(folder + "/project.jet") && textOf(project_->file()) != folder + "/project.jet") {
        const auto answer = QMessageBox::question(window_, tr("Replace the project?"),
                                                  tr("There already is a project in %1. Replace it?").arg(folder));
        if (answer != QMessageBox::Yes) return false;
    }
    if (project_->file().empty()) project_->setName(QFileInfo(folder).fileName().toStdString());
    return saveAs(pathOf(folder));
}

void ProjectController::askAndCreate()
{
    if (mayClose()) create();
}

void ProjectController::askAndOpen()
{
    if (!mayClose()) return;
    const QString start = recent_.isEmpty() ? QString() : QFileInfo(recent_.front()).path();
    const QString file = QFileDialog::getOpenFileName(window_, tr("Open project"), start,
                                                      tr("JET projects (project.jet *.jet *.jetz);;All files (*)"),
                                                      nullptr, QFileDialog::DontUseNativeDialog);
    if (!file.isEmpty()) open(pathOf(file));
}

void ProjectController::askAndOpen(const QString& path)
{
    if (mayClose()) open(pathOf(path));
}

// --- recent projects

void ProjectController::remember(const std::filesystem::path& file)
{
    const QString path = textOf(std::filesystem::absolute(file));
    recent_.removeAll(path);
    recent_.prepend(path);
    if (recent_.size() > kMostRecent) recent_.resize(kMostRecent);
}

void ProjectController::fillRecentMenu(QMenu& menu)
{
    for (const QString& path : std::as_const(recent_)) {
        const QString folder = QFileInfo(path).dir().dirName();
        QAction* action = menu.addAction(QStringLiteral("%1   —   %2").arg(folder, QDir::toNativeSeparators(path)));
        action->setEnabled(QFileInfo::exists(path));
        connect(action, &QAction::triggered, this, [this, path] { askAndOpen(path); });
    }
    if (recent_.isEmpty()) menu.addAction(tr("No recent projects"))->setEnabled(false);
}

void ProjectController::restoreRecent(QSettings& settings)
{
    recent_ = settings.value("recent/projects").toStringList();
}
void ProjectController::saveRecent(QSettings& settings) const { settings.setValue("recent/projects", recent_); }

}  // namespace jet::host
