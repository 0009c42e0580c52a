// References: what <use>, <symbol> and markers draw in places other than their own.
#include "drawing.hpp"

#include "markers.hpp"
#include "shapes.hpp"

#include <algorithm>

namespace jet::svg {

namespace {

constexpr std::size_t kMostUses = 50'000;  // references followed in all ("use bomb")
constexpr std::size_t kMostUsesNested = 32;

Box boundsOf(const Box& box, const Affine& m) { return Path::rectangle(box).transformed(m).bounds(); }

bool takesMarkers(Tag tag)
{
    return tag == Tag::Path || tag == Tag::Line || tag == Tag::Polyline || tag == Tag::Polygon;
}

}  // namespace

void Drawing::visitUse(ElementIndex use, Place place, std::string_view name)
{
    const Element& element = document_[use];
    const std::string_view href = element.href();
    const ElementIndex target = document_.findReference(href);
    if (target == kNoElement) {
        const bool outside = !href.empty() && !href.starts_with('#');
        report_.count(outside ? "a reference leads to another file, which is not read; it is left out"
                              : "a reference leads to nothing in this drawing; it is left out",
                      document_.offsetOf(use));
        return;
    }
    if (isRecursive(use, target)) {
        report_.count("a reference leads back to itself; it is left out", document_.offsetOf(use));
        return;
    }
    if (++usesFollowed_ > kMostUses) {
        report_.count("the drawing has more than 50000 references that lead to references; the rest is left out",
                      document_.offsetOf(use));
        return;
    }
    const auto offset = [&](const char* attribute, Axis axis) {
        return parseLength(element.attribute(attribute), place.lengths, axis).value_or(0);
    };
    place.toScene = Affine(place.toScene * Affine::translation({offset("x", Axis::X), offset("y", Axis::Y)}));

    const std::size_t framesBefore = frames_.size();
    uses_.push_back(use);
    const Tag tag = document_[target].tag;
    if (tag == Tag::Symbol || tag == Tag::Svg) {
        Place inner = place;
        inner.style = styles_.compute(target, place.style, place.lengths);
        inner.opacity *= inner.style.opacity;
        inner.shown = place.shown && inner.style.display;
        visitViewport(target, use, std::move(inner), name);
    } else {
        visit(target, place, name);
    }
    if (frames_.size() > framesBefore) {
        ++frames_[framesBefore].usesEnded;
    } else {
        uses_.pop_back();
    }
}

bool Drawing::isRecursive(ElementIndex use, ElementIndex target) const
{
    return document_.contains(target, use) || uses_.size() >= kMostUsesNested ||
           std::find(uses_.begin(), uses_.end(), use) != uses_.end();
}

void Drawing::visitViewport(ElementIndex e, ElementIndex use, Place place, std::string_view name)
{
    const std::optional<Viewport> viewport =
        innerViewport(document_[e], use == kNoElement ? nullptr : &document_[use], place.lengths);
    if (!viewport) return;
    const Affine outer = place.toScene;
    const Vec2 corner = document_[e].tag == Tag::Symbol
                            ? Vec2(0, 0)
                            : Vec2(parseLength(document_[e].attribute("x"), place.lengths, Axis::X).value_or(0),
                                   parseLength(document_[e].attribute("y"), place.lengths, Axis::Y).value_or(0));
    place.toScene = Affine(outer * viewport->toOuter);
    place.lengths.viewport = viewport->userSize;
    const bool clips = !place.style.overflowVisible;
    Frame* frame = open(e, std::move(place), name, e + 1, document_[e].next);
    if (frame && clips) frame->clip = boundsOf(Box(corner, corner + viewport->size), outer);
}

void Drawing::addShape(ElementIndex e, const Place& place, std::string_view name)
{
    if (place.style.order.markersFirst) addMarkers(e, place);
    shapes_.add(e, name, place);
    if (!place.style.order.markersFirst) addMarkers(e, place);
}

void Drawing::addMarkers(ElementIndex e, const Place& place)
{
    const auto& ids = place.style.markers;
    const bool any =
        std::any_of(ids.begin(), ids.end(), [&](std::string_view id) { return document_.find(id) != kNoElement; });
    if (!any || !takesMarkers(document_[e].tag) || !place.style.visible) return;
    if (openMarkers_ > 0) {
        report_.count("markers of what is itself in a marker are not drawn", document_.offsetOf(e));
        return;
    }
    Report::Silence silence(report_);  // the path's faults are told when its shape is added
    const auto vertices = markerVertices(shapePath(document_, e, place.lengths, report_));
    for (const MarkerVertex& vertex : vertices) addMarker(document_.find(ids[std::size_t(vertex.kind)]), vertex, place);
}

void Drawing::addMarker(ElementIndex marker, const MarkerVertex& vertex, const Place& around)
{
    if (marker == kNoElement || document_[marker].tag != Tag::Marker || ++usesFollowed_ > kMostUses) return;
    const auto placement = placeMarker(document_[marker], vertex, around.style.strokeWidth, around.lengths);
    if (!placement) return;
    Place place = around;
    place.style = styles_.computeFromRoot(marker);  // markers inherit from where they stand
    place.opacity *= place.style.opacity;
    place.toScene = Affine(around.toScene * placement->toUser);
    place.lengths.viewport = placement->viewport;
    Frame* frame = open(marker, std::move(place), document_[marker].label(), marker + 1, document_[marker].next);
    if (!frame) return;
    frame->isMarker = true;
    ++openMarkers_;
}

}  // namespace jet::svg
