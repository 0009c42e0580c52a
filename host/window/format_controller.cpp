#include "window/format_controller.hpp"

#include "canvas/insertion_point.hpp"
#include "window/picture_import.hpp"

#include <jet/format.hpp>
#include <jet/plugins.hpp>
#include <jet/ui/pictures.hpp>

#include <QCoreApplication>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMimeData>
#include <QRegularExpression>

#include <algorithm>

namespace jet::host {

namespace {

std::span<const std::byte> bytesOf(const std::string& content) { return std::as_bytes(std::span(content)); }

QString patternOf(const Contribution& format)
{
    QStringList patterns;
    for (const std::string& extension : format.extensions)
        patterns << QStringLiteral("*.") + QString::fromStdString(extension);
    return patterns.join(QLatin1Char(' '));
}

bool isPackage(const QString& file) { return QFileInfo(file).suffix().toLower() == QLatin1String("jetplugin"); }

}  // namespace

FormatController::FormatController(Editor& editor, Documents& documents, QWidget* window)
    : QObject(window), editor_(editor), documents_(documents), window_(window)
{
    window_->setAcceptDrops(true);
    window_->installEventFilter(this);
}

std::vector<ActionSpec> FormatController::actions()
{
    const auto open = [this] { return documents_.currentScene() != nullptr; };
    return {
        {"file.import", QT_TRANSLATE_NOOP("Actions", "&Import…"), "import", "Ctrl+I", [this] { askAndImport(); }, open},
        {"file.export", QT_TRANSLATE_NOOP("Actions", "&Export…"), "export", "Ctrl+E", [this] { askAndExport(); }, open},
    };
}

bool FormatController::importFile(const std::filesystem::path& file)
{
    Scene* scene = documents_.currentScene();
    if (!scene) return false;
    if (SceneView* view = documents_.currentView()) view->endGesture();
    if (isPicture(file)) {
        const SceneView* view = documents_.viewOf(*scene);
        return placePictures(editor_, *scene, {QString::fromStdString(file.string())},
                             view ? view->sceneCentre() : QPointF());
    }
    Importer* importer = editor_.catalog().importer(extensionOf(file));
    if (!importer) {
        editor_.showMissing(ContributionKind::Importer, extensionOf(file));
        return false;
    }
    const Result<std::string> content = readFile(file);
    if (!content) {
        editor_.showMessage(content.error().text());
        return false;
    }
    const bool wasEmpty = scene->root().bounds().isNull();
    std::vector<FormatNote> notes;
    auto edit = scene->items().begin("Import " + file.filename().string());
    const Item& place = insertionPoint(editor_, *scene, edit);
    const std::size_t before = place.children().size();
    ImportRequest request{file, bytesOf(*content), edit, place, notes, {}};
    const Result<void> read = importer->read(request);
    if (read) adoptPictures(edit, *scene, place, before);
    report(notes);
    if (!read) {
        edit.rollback();
        editor_.showMessage(read.error().text());
        return false;
    }
    edit.commit();
    SceneView* view = documents_.viewOf(*scene);
    if (view && wasEmpty) view->frame(scene->root().bounds());
    return true;
}

bool FormatController::exportFile(const std::filesystem::path& file)
{
    Scene* scene = documents_.currentScene();
    if (!scene) return false;
    Exporter* exporter = editor_.catalog().exporter(extensionOf(file));
    if (!exporter) {
        editor_.showMissing(ContributionKind::Exporter, extensionOf(file));
        return false;
    }
    documents_.commitScripts();
    std::vector<FormatNote> notes;
    const ExportRequest request{*scene, nullptr, std::nullopt, 0, 0, std::nullopt, file, notes, {}};
    const Result<std::vector<std::byte>> content = exporter->write(request);
    report(notes);
    const Result<void> written = content ? writeFileAtomically(file, *content) : Result<void>(content.error());
    if (!written) {
        editor_.showMessage(written.error().text());
        return false;
    }
    editor_.showStatus(tr("Exported %1").arg(QString::fromStdString(file.string())).toStdString());
    return true;
}

bool FormatController::isPicture(const std::filesystem::path& file) const
{
    const std::string extension = extensionOf(file);
    const auto formats = editor_.catalog().contributions(ContributionKind::Importer);
    const bool isImported = std::any_of(formats.begin(), formats.end(), [&](const Contribution& format) {
        return std::find(format.extensions.begin(), format.extensions.end(), extension) != format.extensions.end();
    });
    return !isImported && ui::isPictureName(file);
}

void FormatController::importFiles(const QStringList& files, const QPointF& at)
{
    QStringList pictures;
    for (const QString& file : files) {
        if (isPackage(file)) {
            installPackage(file.toStdString());
        } else if (isPicture(file.toStdString())) {
            pictures << file;
        } else {
            importFile(file.toStdString());
        }
    }
    Scene* scene = documents_.currentScene();
    if (pictures.isEmpty() || !scene) return;
    if (SceneView* view = documents_.currentView()) view->endGesture();
    placePictures(editor_, *scene, pictures, at);
}

void FormatController::installPackage(const std::filesystem::path& file)
{
    const auto done = editor_.plugins().install(file);
    editor_.showMessage(done ? done->message : done.error().text());
}

bool FormatController::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() != QEvent::DragEnter && event->type() != QEvent::Drop)
        return QObject::eventFilter(watched, event);
    auto* drop = static_cast<QDropEvent*>(event);  // a QDragEnterEvent is one
    QStringList packages;
    for (const QUrl& url : drop->mimeData()->urls())
        if (url.isLocalFile() && isPackage(url.toLocalFile())) packages << url.toLocalFile();
    if (packages.isEmpty()) return false;
    drop->acceptProposedAction();
    if (event->type() == QEvent::Drop) importFiles(packages);
    return true;
}

void FormatController::report(const std::vector<FormatNote>& notes)
{
    for (const FormatNote& note : notes) {
        editor_.print({OutputLine::Kind::Warning, Error(note.message, note.where).text(), {}, 0});
    }
    if (!notes.empty())
        editor_.showStatus(
            tr("%n remark(s) in the Output panel", nullptr, static_cast<int>(notes.size())).toStdString());
}

// --- dialogs

QString FormatController::filters(ContributionKind kind, const QString& all) const
{
    QStringList lines, patterns;
    for (const Contribution& format : editor_.catalog().contributions(kind)) {
        patterns << patternOf(format);
        lines << QStringLiteral("%1 (%2)").arg(QString::fromStdString(format.label), patterns.back());
    }
    if (lines.size() > 1 && !all.isEmpty())
        lines.prepend(QStringLiteral("%1 (%2)").arg(all, patterns.join(QLatin1Char(' '))));
    return lines.join(QStringLiteral(";;"));
}

void FormatController::askAndImport()
{
    const QString offered =
        filters(ContributionKind::Importer, tr("All formats")) + ";;" + QString::fromStdString(ui::pictureFilter());
    const QString file = QFileDialog::getOpenFileName(window_, tr("Import into the scene"), lastFolder_, offered,
                                                      nullptr, QFileDialog::DontUseNativeDialog);
    if (file.isEmpty()) return;
    lastFolder_ = QFileInfo(file).path();
    importFile(file.toStdString());
}

void FormatController::askAndExport()
{
    const QString offered = filters(ContributionKind::Exporter, {});
    if (offered.isEmpty()) return editor_.showMessage(tr("No export formats are installed.").toStdString());
    QString chosen;
    QString file = QFileDialog::getSaveFileName(window_, tr("Export the scene"), lastFolder_, offered, &chosen,
                                                QFileDialog::DontUseNativeDialog);
    if (file.isEmpty()) return;
    lastFolder_ = QFileInfo(file).path();
    if (QFileInfo(file).suffix().isEmpty()) {  // the chosen filter's first pattern: "PNG (*.png)"
        file += chosen.section(QStringLiteral("(*"), 1).section(QRegularExpression(QStringLiteral("[ )]")), 0, 0);
    }
    exportFile(file.toStdString());
}

}  // namespace jet::host
