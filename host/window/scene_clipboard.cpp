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

bool clipboardHasItems()
{
    const QMimeData* data = QGuiApplication::clipboard()->mimeData();
    return data && data->hasFormat(kMimeType);
}

std::unique_ptr<Scene> sceneOnClipboard(EventsCenter& events, Catalog& catalog)
{
    if (!clipboardHasItems()) return nullptr;
    std::vector<FormatNote> notes;
    const std::string text = QGuiApplication::clipboard()->mimeData()->data(kMimeType).toStdString();
    return readSceneText(text, "clipboard", events, catalog, notes).orThrow();
}

}  // namespace jet::host
