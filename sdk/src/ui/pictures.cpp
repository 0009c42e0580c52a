#include <jet/assets.hpp>
#include <jet/format.hpp>
#include <jet/ui/pictures.hpp>

#include <QCoreApplication>
#include <QImageReader>
#include <QStringList>

namespace jet::ui {

namespace fs = std::filesystem;

namespace {

Box placed(const Box& frame, const Vec2& pixels, PictureFit fit)
{
    const Vec2 half = 0.5 * pixels;
    if (frame.isEmpty()) return {frame.center() - half, frame.center() + half};
    if (fit == PictureFit::Stretch) return frame;
    const Vec2 fitting = half * std::min(frame.width() / pixels.x(), frame.height() / pixels.y());
    return {frame.center() - fitting, frame.center() + fitting};
}

/// What the item's property "file" says.
std::string referenceTo(const Scene& scene, const fs::path& file)
{
    const fs::path folder = scene.assetFolder();
    const fs::path whole = fs::absolute(file).lexically_normal();
    if (folder.empty()) return whole.string();
    if (liesIn(whole, folder))
        return whole.lexically_relative(fs::absolute(folder).lexically_normal()).generic_string();
    return storeAsset(folder, file.filename().string(), readFile(file).orThrow()).orThrow();
}

}  // namespace

bool isPictureName(const fs::path& file)
{
    const QByteArray extension = QByteArray::fromStdString(extensionOf(file));
    return !extension.isEmpty() && QImageReader::supportedImageFormats().contains(extension);
}

std::string pictureFilter()
{
    QStringList patterns;
    for (const QByteArray& format : QImageReader::supportedImageFormats())
        patterns << QStringLiteral("*.") + QString::fromLatin1(format);
    return QCoreApplication::translate("Pictures", "Pictures (%1)").arg(patterns.join(QLatin1Char(' '))).toStdString();
}

std::optional<Vec2> pictureSize(const fs::path& file)
{
    QImageReader reader(QString::fromStdString(file.string()));
    reader.setAutoTransform(true);
    QSize size = reader.size();
    if (!size.isValid()) size = reader.read().size();  // of formats that tell it only then
    if (size.isEmpty()) return std::nullopt;
    if (reader.transformation() & QImageIOHandler::TransformationRotate90) size.transpose();
    return Vec2(size.width(), size.height());
}

const Item& addPicture(Transaction& edit, const Item& parent, const Scene& scene, const fs::path& file,
                       const Box& frame, PictureFit fit)
{
    const std::optional<Vec2> size = pictureSize(file);
    if (!size)
        throw Failure(Error("this file is not there, or is no picture that can be shown; choose a PNG or JPEG file",
                            Location{file.string(), 0, 0}));
    const std::string reference = referenceTo(scene, file);
    const Item& item = edit.add<ImageItem>(parent, Path::rectangle(placed(frame, *size, fit)));
    edit.set(item, "file", reference);
    edit.set(item, "name", file.stem().string().empty() ? std::string("Image") : file.stem().string());
    return item;
}

}  // namespace jet::ui
