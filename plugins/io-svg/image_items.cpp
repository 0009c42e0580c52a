#include "image_items.hpp"

#include "picture_size.hpp"
#include "transform.hpp"

#include <filesystem>

namespace jet::svg {

namespace fs = std::filesystem;

namespace {

constexpr double kFarthest = 1e9;  // scene units

bool isDrawing(std::string_view href)
{
    return href.starts_with("data:image/svg") || extensionOf(fs::path(href)) == "svg";
}

/// Does the file lie in the folder, links followed?
bool isInside(const fs::path& file, const fs::path& folder)
{
    std::error_code ignored;
    const fs::path relative =
        fs::weakly_canonical(file, ignored).lexically_relative(fs::weakly_canonical(folder, ignored));
    return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

void ImageItems::add(ElementIndex e, std::string_view name, const Place& place)
{
    if (!place.toScene.isInvertible()) return;
    const std::optional<Picture> picture = pictureOf(e);
    if (!picture) return;
    const std::optional<Box> frame = frameOf(e, place, picture->size);
    if (!frame) return;
    Path path = Path::rectangle(*frame).transformed(place.toScene);
    if (!(path.bounds().min.cwiseAbs().maxCoeff() < kFarthest) ||
        !(path.bounds().max.cwiseAbs().maxCoeff() < kFarthest)) {
        report_.count("an image has coordinates beyond all bounds; it is left out", document_.offsetOf(e));
        return;
    }
    if (place.shown && place.style.visible) drawn_.extend(path.bounds());
    const Item& item = request_.edit.add<ImageItem>(*place.container, std::move(path));
    ++count_;
    request_.edit.set(item, "file", picture->file);
    if (!name.empty()) request_.edit.set(item, "name", name);
    if (place.opacity < 1) request_.edit.set(item, "opacity", place.opacity);
    if (!place.shown || !place.style.visible) request_.edit.set(item, "visible", false);
}

std::optional<ImageItems::Picture> ImageItems::pictureOf(ElementIndex e)
{
    const std::string_view href = document_[e].href();
    if (href.empty()) return {};  // SVG 2: nothing is shown
    if (isDrawing(href)) {
        report_.count("images that are drawings themselves are not drawn; import them on their own",
                      document_.offsetOf(e));
        return {};
    }
    if (!href.starts_with("data:")) return pictureInFile(e, href);
    const std::optional<std::string> content = contentOfData(href);
    const std::optional<Vec2> size = content ? sizeOfPicture(*content) : std::nullopt;
    if (size) return Picture{std::string(href), size};
    report_.count("images whose data is no PNG, JPEG or GIF picture are not drawn", document_.offsetOf(e));
    return {};
}

std::optional<ImageItems::Picture> ImageItems::pictureInFile(ElementIndex e, std::string_view href)
{
    const std::size_t offset = document_.offsetOf(e);
    if (href.starts_with("file://")) href.remove_prefix(7);
    if (href.find("://") != href.npos) {
        report_.count("images on the network are not fetched", offset);
        return {};
    }
    std::error_code ignored;
    const fs::path folder = fs::absolute(request_.file, ignored).parent_path();
    const std::string decoded = contentOfData("data:," + std::string(href)).value_or(std::string(href));
    fs::path file = (folder / decoded).lexically_normal();
    if (!fs::exists(file, ignored)) file = (folder / std::string(href)).lexically_normal();  // a name with a real '%'
    if (!isInside(file, folder)) {
        report_.note("the image '" + std::string(href) +
                         "' lies outside of the drawing's folder and is left out; put it beside "
                         "the drawing",
                     offset);
        return {};
    }
    const auto content = readFile(file);
    if (!content) {
        report_.note("the image '" + std::string(href) + "' is left out: " + content.error().message, offset);
        return {};
    }
    const std::optional<Vec2> size = sizeOfPicture(*content);
    if (!size) report_.count("the size of an image is not known; it is stretched over its frame", offset);
    return Picture{file.string(), size};
}

// User units. A missing side follows from the picture's own.
std::optional<Box> ImageItems::frameOf(ElementIndex e, const Place& place, const std::optional<Vec2>& size)
{
    const Element& element = document_[e];
    const auto length = [&](const char* name, Axis axis) -> std::optional<double> {
        const std::string_view text = element.attribute(name);
        return text.empty() || text == "auto" ? std::nullopt : parseLength(text, place.lengths, axis);
    };
    const Vec2 corner(length("x", Axis::X).value_or(0), length("y", Axis::Y).value_or(0));
    auto width = length("width", Axis::X), height = length("height", Axis::Y);
    if (size && !width) width = height ? *height * size->x() / size->y() : size->x();
    if (size && !height) height = *width * size->y() / size->x();
    if (!width || !height || !(*width > 0) || !(*height > 0)) return {};
    const Box viewport(corner, corner + Vec2(*width, *height));
    if (!size) return viewport;
    const std::string_view aspect = element.attribute("preserveAspectRatio");
    if (aspect.find("slice") != aspect.npos)
        report_.count("an image is larger than its frame; what sticks out is not cut off", document_.offsetOf(e));
    const Affine fitted = viewBoxTransform(Box({0, 0}, *size), viewport, aspect);
    return Box(fitted * Vec2(0, 0), fitted * *size);
}

}  // namespace jet::svg
