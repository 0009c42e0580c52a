#include "picture_files.hpp"

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
    QDateTime modified;
    qint64 bytes = 0;
};

QImage read(const QString& path)
{
    QImageReader reader(path);
    reader.setAutoTransform(true);
    const QSize size = reader.size();
    if (size.isValid() && qint64(size.width()) * size.height() > kMostPixels) return {};
    return reader.read().convertToFormat(QImage::Format_ARGB32_Premultiplied);
}

}  // namespace

QImage pictureFile(const std::string& folder, std::string_view file)
{
    static QCache<QString, Kept> cache(kCacheKilobytes);
    if (file.empty()) return {};
    const QString name = QString::fromUtf8(file.data(), qsizetype(file.size()));
    const QFileInfo info(QDir(QString::fromStdString(folder)).filePath(name));
    if (!info.isFile()) return {};
    const QString path = info.absoluteFilePath();
    const Kept* kept = cache.object(path);
    if (kept && kept->modified == info.lastModified() && kept->bytes == info.size()) return kept->image;
    auto* fresh = new Kept{read(path), info.lastModified(), info.size()};
    const QImage image = fresh->image;
    cache.insert(path, fresh, 1 + int(image.sizeInBytes() / 1024));
    return image;
}

}  // namespace jet::ui
