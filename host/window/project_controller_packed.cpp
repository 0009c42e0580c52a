// ProjectController and projects on their way to somebody else: packed into one file (*.jetz), and with all that they
// refer to in their folder.
#include "host/projects/collect.hpp"
#include "host/projects/project_archive.hpp"
#include "window/project_controller.hpp"

#include <jet/format.hpp>

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>

namespace jet::host {

namespace fs = std::filesystem;

bool ProjectController::openPacked(const fs::path& packed)
{
    const fs::path folder = unpackQuestion_(packed);
    if (folder.empty()) return false;
    const auto file = unpackProject(packed, folder);
    if (file) return load(*file);
    editor_.showMessage(file.error().text());
    return false;
}

fs::path ProjectController::askUnpack(const fs::path& packed)
{
    const QFileInfo info(QString::fromStdString(packed.string()));
    const QString folder = QFileDialog::getSaveFileName(
        window_, tr("Unpack “%1” into a new folder, to work on it there").arg(info.fileName()),
        info.dir().filePath(info.completeBaseName()), tr("Project folder (*)"), nullptr,
        QFileDialog::DontUseNativeDialog | QFileDialog::DontConfirmOverwrite);
    return folder.toStdString();
}

bool ProjectController::exportPacked(const fs::path& file)
{
    const auto packed = packProject(*project_);
    if (!packed) {
        editor_.showMessage(packed.error().text());
        return false;
    }
    if (const auto written = writeFileAtomically(file, packed->bytes); !written) {
        editor_.showMessage(written.error().text());
        return false;
    }
    if (const std::size_t left = packed->outside.size() + packed->missing.size(); left > 0) {
        editor_.showMessage(
            tr("%n file(s) the project uses are not in its folder, so they were not exported: use File > "
               "Collect into project, then export again.",
               nullptr, static_cast<int>(left))
                .toStdString());
    }
    editor_.showStatus(
        tr("Exported %1").arg(QDir::toNativeSeparators(QString::fromStdString(file.string()))).toStdString());
    return true;
}

// What is packed are the files of the project: they have to be what is seen.
void ProjectController::askAndExportPacked()
{
    documents_.commitScripts();
    if ((project_->file().empty() || isModified()) && !save()) return;
    const QString folder = QString::fromStdString(fs::absolute(project_->folder()).lexically_normal().string());
    const QString name = QString::fromStdString(project_->name()) + ".jetz";
    QString file =
        QFileDialog::getSaveFileName(window_, tr("Export as single file"), QDir(folder).filePath("../" + name),
                                     tr("Packed JET projects (*.jetz)"), nullptr, QFileDialog::DontUseNativeDialog);
    if (file.isEmpty()) return;
    if (!file.endsWith(QStringLiteral(".jetz"), Qt::CaseInsensitive)) file += QStringLiteral(".jetz");
    exportPacked(file.toStdString());
}

bool ProjectController::collect()
{
    documents_.commitScripts();
    if (SceneView* view = documents_.currentView()) view->endGesture();
    if (project_->file().empty() && !save()) return false;
    const auto collection = collectAssets(*project_);
    if (!collection) {
        editor_.showMessage(collection.error().text());
        return false;
    }
    for (const std::string& remark : describe(*collection)) {
        editor_.print({OutputLine::Kind::Warning, remark, {}, 0});
        editor_.showMessage(remark);
    }
    editor_.showStatus(
        collection->references == 0
            ? tr("Nothing to collect: all files are in the project").toStdString()
            : tr("Collected %n file(s)", nullptr, static_cast<int>(collection->copies.size())).toStdString());
    return true;
}

}  // namespace jet::host
