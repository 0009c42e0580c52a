#include "window/picture_import.hpp"

#include "canvas/insertion_point.hpp"

#include <jet/assets.hpp>
#include <jet/format.hpp>
#include <jet/ui/pictures.hpp>

#include <QBuffer>
#include <QClipboard>
#include <QCoreApplication>
#include <QGuiApplication>
#include <QImage>
#include <QMimeData>
#include <QUrl>

namespace jet::host {

namespace {

const Vec2 kAside(20, 20);  // scene units, between pictures that come together

QStringList pictureFiles(const QMimeData& data)
{
    QStringList files;
    for (const QUrl& url : data.urls())
        if (url.isLocalFile() && ui::isPictureName(url.toLocalFile().toStdString())) files << url.toLocalFile();
    return files;
}

/// The picture's bytes and a name for them; an empty name: it cannot be read.
std::pair<std::string, std::string> contentOf(const std::string& file)
{
    if (!file.starts_with("data:")) {
        auto content = readFile(file);
        return {content ? std::filesystem::path(file).filename().string() : "", content ? *content : ""};
    }
    const QByteArray address = QByteArray::fromStdString(file);
    const qsizetype comma = address.indexOf(',');
    const QByteArray kind = address.left(comma);
    const QByteArray text = QByteArray::fromPercentEncoding(address.mid(comma + 1));
    const QByteArray bytes = kind.endsWith(";base64") ? QByteArray::fromBase64(text) : text;
    QByteArray extension = kind.mid(kind.indexOf('/') + 1);  // "data:image/gif;base64"
    extension.truncate(std::max<qsizetype>(extension.indexOf(';'), 0));
    return {extension.isEmpty() ? std::string() : "picture." + extension.toStdString(), bytes.toStdString()};
}

bool pastePixels(Editor& editor, Scene& scene, const QImage& image, const QPointF& at)
{
    if (image.isNull()) return false;
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    image.save(&buffer, "PNG");
    const std::filesystem::path folder = scene.assetFolder();
    if (folder.empty()) {
        editor.showMessage(QCoreApplication::translate("Pictures",
                                                       "A pasted picture becomes a file of the project: save "
                                                       "the project first, then paste again.")
                               .toStdString());
        return true;
    }
    const auto stored = storeAsset(folder, "Pasted.png", {bytes.constData(), static_cast<std::size_t>(bytes.size())});
    if (!stored) {
        editor.showMessage(stored.error().text());
        return true;
    }
    placePictures(editor, scene, {QString::fromStdString((folder / *stored).string())}, at);
    return true;
}

}  // namespace

bool placePictures(Editor& editor, Scene& scene, const QStringList& files, const QPointF& at)
{
    auto edit = scene.items().begin("Place picture");
    const Item& place = insertionPoint(editor, scene, edit);
    std::vector<ItemId> made;
    Vec2 centre(at.x(), at.y());
    for (const QString& file : files) {
        try {
            made.push_back(ui::addPicture(edit, place, scene, file.toStdString(), Box(centre, centre)).id());
            centre += kAside;
        } catch (const Failure& failure) {
            editor.showMessage(failure.error().text());
        }
    }
    if (made.empty()) return false;  // leaving without commit: nothing happened
    edit.setSelection(std::move(made));
    edit.commit();
    return true;
}

void adoptPictures(Transaction& edit, const Scene& scene, const Item& parent, std::size_t first)
{
    const std::filesystem::path folder = scene.assetFolder();
    if (folder.empty()) return;
    const auto adopt = [&](const Item& item) {
        if (!item.is<ImageItem>()) return;
        const auto file = item.property("file")->as<std::string>();
        const bool isData = file.starts_with("data:");
        if (!isData && !std::filesystem::path(file).is_absolute()) return;
        if (!isData && liesIn(file, folder)) {
            const auto whole = std::filesystem::absolute(folder).lexically_normal();
            edit.set(item, "file", std::filesystem::path(file).lexically_relative(whole).generic_string());
            return;
        }
        const auto [name, content] = contentOf(file);
        if (name.empty()) return;
        if (const auto stored = storeAsset(folder, name, content)) edit.set(item, "file", *stored);
    };
    const auto children = parent.children();
    for (std::size_t i = first; i < children.size(); ++i) children[i]->walk(adopt);
}

bool pastePicture(Editor& editor, Scene& scene, const QPointF& at)
{
    const QMimeData* data = QGuiApplication::clipboard()->mimeData();
    if (!data) return false;
    if (const QStringList files = pictureFiles(*data); !files.isEmpty()) return placePictures(editor, scene, files, at);
    return data->hasImage() && pastePixels(editor, scene, qvariant_cast<QImage>(data->imageData()), at);
}

}  // namespace jet::host
