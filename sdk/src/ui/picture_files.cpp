#include "picture_files.hpp"

#include <QBuffer>
#include <QCache>
#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QImageReader>

namespace jet::ui {

namespace {

constexpr int kCacheKilobytes = 256 * 1024;
constexpr qint64 kMostPixels = 128 * 1024 * 1024;

struct Kept {
    QImage image;  // null: could not be read
    QDateTime modified = {};
    qint64 bytes = 0;
};

QImage read(QImageReader& reader)
{
    reader.setAutoTransform(true);
    const QSize size = reader.size();
    if (size.isValid() && qint64(size.width()) * size.height() > kMostPixels) return {};
    return reader.read().convertToFormat(QImage::Format_ARGB32_Premultiplied);
}

// RFC 2397: "data:image/png;base64,…".
QImage readData(const QString& address)
{
    const qsizetype comma = address.indexOf(QLatin1Char(','));
    if (comma < 0) return {};
    const QByteArray text = QByteArray::fromPercentEncoding(address.mid(comma + 1).toUtf8());
    QByteArray bytes = address.left(comma).endsWith(QLatin1String(";base64")) ? QByteArray::fromBase64(text) : text;
    QBuffer buffer(&bytes);
    QImageReader reader(&buffer);
    return read(reader);
}

}  // namespace

QImage pictureFile(const std::string& folder, std::string_view file)
{
    static QCache<QString, Kept> cache(kCacheKilobytes);
    if (file.empty()) return {};
    const QString name = QString::fromUtf8(file.data(), qsizetype(file.size()));
    if (file.starts_with("data:")) {
        if (const Kept* kept = cache.object(name)) return kept->image;
        auto* fresh = new Kept{readData(name)};
        const QImage image = fresh->image;
        cache.insert(name, fresh, 1 + int((image.sizeInBytes() + name.size()) / 1024));
        return image;
    }
    const QFileInfo info(QDir(QString::fromStdString(folder)).filePath(name));
    if (!info.isFile()) return {};
    const QString path = info.absoluteFilePath();
    const Kept* kept = cache.object(path);
    if (kept && kept->modified == info.lastModified() && kept->bytes == info.size()) return kept->image;
    QImageReader reader(path);
    auto* fresh = new Kept{read(reader), info.lastModified(), info.size()};
    const QImage image = fresh->image;
    cache.insert(path, fresh, 1 + int(image.sizeInBytes() / 1024));
    return image;
}

}  // namespace jet::ui
