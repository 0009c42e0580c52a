// ImageItems: makes image items of <image>, of data in the drawing and of files beside it.
#pragma once

#include "shape_items.hpp"

namespace jet::svg {

class ImageItems {
public:
    ImageItems(const Document& document, ImportRequest& request, Report& report)
        : document_(document), request_(request), report_(report)
    {
    }

    void add(ElementIndex e, std::string_view name, const Place& place);
    std::size_t count() const { return count_; }
    /// Scene units: of all images shown.
    const Box& drawn() const { return drawn_; }

private:
    /// A picture that can be shown: what an image item calls it, and how large it is, where that could be read.
    struct Picture {
        std::string file;
        std::optional<Vec2> size;
    };
    std::optional<Picture> pictureOf(ElementIndex e);
    std::optional<Picture> pictureInFile(ElementIndex e, std::string_view href);
    std::optional<Box> frameOf(ElementIndex e, const Place& place, const std::optional<Vec2>& size);

    const Document& document_;
    ImportRequest& request_;
    Report& report_;
    std::size_t count_ = 0;
    Box drawn_;
};

}  // namespace jet::svg
