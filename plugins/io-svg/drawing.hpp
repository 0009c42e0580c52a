// Drawing: walks the elements in the order they are painted and makes the scene's groups, layers and shapes of them.
//
// The walk keeps its own stack of open containers, because files nest deeper than the program's stack is. References
// (<use>) are followed by opening what they refer to as if it stood there.
#pragma once

#include "image_items.hpp"
#include "shape_items.hpp"
#include "text_items.hpp"
#include "viewport.hpp"

#include <deque>
#include <vector>

namespace jet::svg {

struct MarkerVertex;

class Drawing {
public:
    Drawing(const Document& document, ImportRequest& request, Report& report);
    Result<void> draw();

private:
    /// A container whose elements are being drawn.
    struct Frame {
        ElementIndex cursor, end;  ///< elements still to draw
        Place place;
        int usesEnded = 0;        ///< references that end with this frame
        std::optional<Box> clip;  ///< scene units: what SVG shows of the content
        ElementIndex element = kNoElement;
        bool isMarker = false;
    };

    bool openOutermost();
    void setPage(const Vec2& size);
    void visit(ElementIndex e, const Place& around, std::string_view name);
    void visitSwitch(ElementIndex e, const Place& place, std::string_view name);
    void visitUse(ElementIndex use, Place place, std::string_view name);
    void visitViewport(ElementIndex e, ElementIndex use, Place place, std::string_view name);
    /// Opens a group or layer named so; its elements run from `first` to before `end`. Null: it stays closed.
    Frame* open(ElementIndex e, Place place, std::string_view name, ElementIndex first, ElementIndex end);
    void close();
    void addShape(ElementIndex e, const Place& place, std::string_view name);
    void addMarkers(ElementIndex e, const Place& place);
    void addMarker(ElementIndex marker, const MarkerVertex& vertex, const Place& around);
    bool isLayer(ElementIndex e, const Place& place) const;
    bool isRecursive(ElementIndex use, ElementIndex target) const;
    void noteUnsupported(ElementIndex e, const Style& style);

    const Document& document_;
    ImportRequest& request_;
    Report& report_;
    StyleResolver styles_;
    ShapeItems shapes_;
    TextItems texts_;
    ImageItems images_;
    std::deque<Frame> frames_;        // a deque: references stay valid while frames are opened
    std::vector<ElementIndex> uses_;  // the references being followed, outermost first
    std::size_t usesFollowed_ = 0;
    int openMarkers_ = 0;
    std::size_t containers_ = 0;
    bool pageUnknown_ = false;
    bool full_ = false;
};

}  // namespace jet::svg
