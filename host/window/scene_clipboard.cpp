#include "window/scene_clipboard.hpp"

#include <jet/project.hpp>

#include <QClipboard>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QGuiApplication>
#include <QMimeData>
#include <QSaveFile>

namespace jet::host {

namespace {

const QString kMimeType = QStringLiteral("application/x-jet-scene+xml");

}  // namespace

void copyToClipboard(const std::vector<const Item*>& items, const Scene& scene)
{
    EventsCenter quiet;
    Scene clips("Clipboard", quiet, scene.catalog());
    auto edit = clips.items().begin("Copy");
    for (const Item* item : items) edit.addCopy(*item, clips.root());
    edit.commit();
    const QByteArray text = QByteArray::fromStdString(writeSceneText(clips));
    auto* data = new QMimeData;
    data->setData(kMimeType, text);
    data->setText(QString::fromUtf8(text));
    QGuiApplication::clipboard()->setMimeData(data);  // takes it
}

namespace {

// Empty: there is no place for it.
QString keptFile()
{
    const QString session = qEnvironmentVariable("XDG_RUNTIME_DIR");
    return session.isEmpty() ? QString() : session + QStringLiteral("/jet/clipboard.xml");
}

QByteArray keptText()
{
    QFile file(keptFile());
    return file.open(QFile::ReadOnly) ? file.readAll() : QByteArray();
}

// A text editor, a chat or another program may have passed it on as plain text.
QByteArray clipboardText()
{
    const QMimeData* data = QGuiApplication::clipboard()->mimeData();
    if (!data || data->formats().isEmpty()) return keptText();
    if (data->hasFormat(kMimeType)) {
        const QByteArray items = data->data(kMimeType);
        return items.isEmpty() ? keptText() : items;  // Qt may not have noticed that the owner has gone
    }
    const QByteArray text = data->text().trimmed().toUtf8();
    return text.startsWith("<scene") || (text.startsWith("<?xml") && text.contains("<scene")) ? text : QByteArray();
}

}  // namespace

void keepClipboard()
{
    const QClipboard* clipboard = QGuiApplication::clipboard();
    const QString path = keptFile();
    if (path.isEmpty() || !clipboard->ownsClipboard() || !clipboard->mimeData()->hasFormat(kMimeType)) return;
    QDir().mkpath(QFileInfo(path).path());
    QSaveFile file(path);
    if (!file.open(QFile::WriteOnly)) return;  // it is a comfort, no promise
    file.setPermissions(QFile::ReadOwner | QFile::WriteOwner);
    file.write(clipboard->mimeData()->data(kMimeType));
    file.commit();
}

std::unique_ptr<Scene> sceneOnClipboard(EventsCenter& events, Catalog& catalog)
{
    const QByteArray text = clipboardText();
    if (text.isEmpty()) return nullptr;
    std::vector<FormatNote> notes;
    return readSceneText(text.toStdString(), "clipboard", events, catalog, notes).orThrow();
}

}  // namespace jet::host
