#include "window/project_controller.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QMessageBox>
#include <QSettings>

namespace jet::host {

namespace {

constexpr int kMostRecent = 10;

QString textOf(const std::filesystem::path& path) { return QString::fromStdString(path.string()); }
std::filesystem::path pathOf(const QString& text) { return text.toStdString(); }

}  // namespace

ProjectController::ProjectController(Editor& editor, Documents& documents, QWidget* window)
    : QObject(window), editor_(editor), documents_(documents), window_(window), question_([this] { return ask(); })
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
    };
}

// --- which project is open

void ProjectController::install(std::unique_ptr<Project> project)
{
    close();
    project_ = std::move(project);
    editor_.events().post(&editor_, ProjectChanged{});
    const std::vector<Scene*> scenes = project_->scenes();
    if (!scenes.empty()) documents_.openScene(*scenes.front());
}

void ProjectController::close() { documents_.closeAll(); }

void ProjectController::create()
{
    install(Project::create(tr("Untitled").toStdString(), editor_.events(), editor_.catalog()));
}

bool ProjectController::open(const std::filesystem::path& path)
{
    if (beforeOpen_) beforeOpen_(path);
    Result<std::unique_ptr<Project>> loaded = Project::load(path, editor_.events(), editor_.catalog());
    if (!loaded) {
        editor_.showMessage(loaded.error().text());
        return false;
    }
    install(std::move(*loaded));
    remember(project_->file());
    for (const FormatNote& note : project_->notes()) {
        editor_.print({OutputLine::Kind::Warning, Error(note.message, note.where).text(), {}, 0});
    }
    const bool told = tellMissing_ && tellMissing_();
    if (!told && !project_->notes().empty()) editor_.showMessage(project_->notes().front().message);
    return true;
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
    return project_->file().empty() ? askAndSaveAs() : finishSave(project_->save());
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
                                                      tr("JET projects (project.jet *.jet);;All files (*)"), nullptr,
                                                      QFileDialog::DontUseNativeDialog);
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
