#include "window/scene_clipboard.hpp"

#include <jet/project.hpp>

#include <QClipboard>
#include <QGuiApplication>
#include <QMimeData>

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

// A text editor, a chat or another program may have passed it on as plain text.
QByteArray clipboardText()
{
    const QMimeData* data = QGuiApplication::clipboard()->mimeData();
    if (!data) return {};
    if (data->hasFormat(kMimeType)) return data->data(kMimeType);
    const QByteArray text = data->text().trimmed().toUtf8();
    return text.startsWith("<scene") || (text.startsWith("<?xml") && text.contains("<scene")) ? text : QByteArray();
}

}  // namespace

bool clipboardHasItems() { return !clipboardText().isEmpty(); }

std::unique_ptr<Scene> sceneOnClipboard(EventsCenter& events, Catalog& catalog)
{
    const QByteArray text = clipboardText();
    if (text.isEmpty()) return nullptr;
    std::vector<FormatNote> notes;
    return readSceneText(text.toStdString(), "clipboard", events, catalog, notes).orThrow();
}

}  // namespace jet::host
