#include "drawing.hpp"

#include "shapes.hpp"
#include "transform.hpp"

#include <algorithm>

namespace jet::svg {

namespace {

constexpr int kDeepest = 200;  // containers within one another; deeper ones are drawn into the last
constexpr std::size_t kMostItems = 1'000'000;
constexpr std::size_t kProgressStep = 1024;  // elements

// SVG 2, section 5.9.2: does the user read that language? JET reads English.
bool acceptsLanguage(std::string_view list)
{
    while (!list.empty()) {
        const std::size_t comma = std::min(list.find(','), list.size());
        const std::string_view language = trimmed(list.substr(0, comma));
        if (language == "en" || language.starts_with("en-")) return true;
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return false;
}

bool passesConditions(const Element& element)
{
    if (element.has("requiredExtensions")) return false;
    return !element.has("systemLanguage") || acceptsLanguage(element.attribute("systemLanguage"));
}

std::string_view unsupported(Tag tag)
{
    switch (tag) {
    case Tag::ForeignObject: return "content that is not SVG is not drawn";
    default: return {};
    }
}

}  // namespace

Drawing::Drawing(const Document& document, ImportRequest& request, Report& report)
    : document_(document), request_(request), report_(report), styles_(document),
      shapes_(document, styles_, request, report), texts_(document, styles_, request, report),
      images_(document, request, report)
{
}

Result<void> Drawing::draw()
{
    if (!openOutermost()) return {};
    for (std::size_t step = 0; !frames_.empty() && !full_; ++step) {
        Frame& frame = frames_.back();
        if (frame.cursor >= frame.end) {
            close();
            continue;
        }
        const ElementIndex e = frame.cursor;
        frame.cursor = document_[e].next;
        visit(e, frame.place, {});
        full_ = shapes_.count() + texts_.count() + images_.count() + containers_ > kMostItems;
        const double done = double(e) / double(document_.elements().size());
        if (step % kProgressStep == 0 && !request_.progress(done)) return Error("The import was cancelled.");
    }
    if (full_) report_.note("the drawing has more than a million items; the rest is left out", 0);
    if (pageUnknown_) {
        Box drawn = shapes_.drawn();
        drawn.extend(texts_.drawn());
        drawn.extend(images_.drawn());
        setPage(drawn.isNull() ? Vec2(0, 0) : Vec2(drawn.max.cwiseMax(0.0)));
    }
    return {};
}

bool Drawing::openOutermost()
{
    const Element& root = document_[0];
    Place place;
    place.container = &request_.parent;
    place.lengths = {Vec2(100, 100), Vec2(100, 100), place.style.fontSize};
    place.style = styles_.compute(0, place.style, place.lengths);
    const std::optional<Viewport> viewport = outermostViewport(root, place.style.fontSize);
    if (!viewport) {
        report_.note("the drawing has a width or height of zero or below; nothing of it is shown",
                     document_.offsetOf(0));
        return false;
    }
    place.lengths = {viewport->userSize, viewport->userSize, place.style.fontSize};
    const Affine own = parseTransform(root.attribute("transform")).value_or(Affine());
    place.toScene = Affine(own * viewport->toOuter);
    place.opacity = place.style.opacity;
    const bool empty = request_.parent.bounds().isNull();  // a drawing put into another does not change the page
    pageUnknown_ = empty && !viewport->sized;
    if (empty && viewport->sized) setPage(viewport->size);
    noteUnsupported(0, place.style);
    if (!place.style.display) return false;
    frames_.push_back({1, root.next, std::move(place), 0, {}, 0, false});
    return true;
}

void Drawing::setPage(const Vec2& size)
{
    try {
        request_.edit.setScene("page-width", size.x());
        request_.edit.setScene("page-height", size.y());
    } catch (const Failure& failure) {
        report_.note("the size of the page is not kept: " + failure.error().message, 0);
    }
}

void Drawing::visit(ElementIndex e, const Place& around, std::string_view name)
{
    const Element& element = document_[e];
    const bool isContainer = element.tag == Tag::Group || element.tag == Tag::Anchor || element.tag == Tag::Switch ||
                             element.tag == Tag::Use || element.tag == Tag::Svg;
    const bool isLeaf = element.tag == Tag::Text || element.tag == Tag::Image;
    const std::string_view problem = unsupported(element.tag);
    if ((!isContainer && !isShape(element.tag) && !isLeaf && problem.empty()) || !passesConditions(element)) return;
    Place place = around;
    place.style = styles_.compute(e, around.style, around.lengths);
    place.lengths.fontSize = place.style.fontSize;
    if (!problem.empty()) {
        if (place.style.display) report_.count(problem, document_.offsetOf(e));
        return;
    }
    const std::string_view transform =
        place.style.transform.empty() ? element.attribute("transform") : place.style.transform;
    if (!transform.empty()) place.toScene = Affine(place.toScene * parseTransform(transform).value_or(Affine()));
    place.opacity *= place.style.opacity;
    place.shown = around.shown && place.style.display;
    noteUnsupported(e, place.style);
    if (name.empty()) name = element.label();

    switch (element.tag) {
    case Tag::Group:
    case Tag::Anchor: open(e, std::move(place), name, e + 1, element.next); break;
    case Tag::Switch: visitSwitch(e, place, name); break;
    case Tag::Svg: visitViewport(e, kNoElement, std::move(place), name); break;
    case Tag::Use: visitUse(e, std::move(place), name); break;
    case Tag::Text: texts_.add(e, name, place); break;
    case Tag::Image: images_.add(e, name, place); break;
    default: addShape(e, place, name); break;
    }
}

void Drawing::visitSwitch(ElementIndex e, const Place& place, std::string_view name)
{
    for (ElementIndex child = e + 1; child < document_[e].next; child = document_[child].next) {
        const Tag tag = document_[child].tag;
        if (tag == Tag::Foreign || tag == Tag::Unknown || !passesConditions(document_[child])) continue;
        open(e, place, name, child, document_[child].next);
        return;
    }
}

Drawing::Frame* Drawing::open(ElementIndex e, Place place, std::string_view name, ElementIndex first, ElementIndex end)
{
    if (place.depth < kDeepest) {
        const std::string_view type = isLayer(e, place) ? LayerItem::type : GroupItem::type;
        const Item& group = request_.edit.add(type, *place.container);
        if (!name.empty()) request_.edit.set(group, "name", name);
        if (!place.shown) request_.edit.set(group, "visible", false);
        place.container = &group;
        place.shown = true;  // what is in it is hidden with it
        ++place.depth;
        ++containers_;
    } else {
        report_.count("groups are nested more than 200 deep; deeper ones are drawn into the one around them",
                      document_.offsetOf(e));
        if (!place.shown) return nullptr;
    }
    frames_.push_back({first, end, std::move(place), 0, {}, e, false});
    return &frames_.back();
}

void Drawing::close()
{
    const Frame& frame = frames_.back();
    if (frame.clip && frame.place.depth < kDeepest) {
        const Box bounds = frame.place.container->bounds();
        if (!bounds.isNull() && !frame.clip->inflated(1e-6 * frame.clip->size().norm()).contains(bounds)) {
            report_.count("a nested drawing is larger than its frame; what sticks out is not cut off",
                          document_.offsetOf(frame.element));
        }
    }
    uses_.resize(uses_.size() - std::size_t(frame.usesEnded));
    if (frame.isMarker) --openMarkers_;
    frames_.pop_back();
}

// What Inkscape calls a layer, and every group at the top of a drawing.
bool Drawing::isLayer(ElementIndex e, const Place& place) const
{
    if (document_[e].tag != Tag::Group) return false;
    return document_[e].attribute("inkscape:groupmode") == "layer" || (document_[e].parent == 0 && place.depth == 0);
}

void Drawing::noteUnsupported(ElementIndex e, const Style& style)
{
    const std::size_t offset = document_.offsetOf(e);
    if (style.hasClipPath) report_.count("clip paths do not cut anything off", offset);
    if (style.hasMask) report_.count("masks do not hide anything", offset);
    if (style.hasFilter) report_.count("filters are not applied", offset);
    const bool severalMembers = document_.firstChild(e) != kNoElement && document_[e + 1].next < document_[e].next;
    if (style.opacity < 1 && severalMembers) {
        report_.count("the opacity of a group is given to each of its members; where they overlap they show through",
                      offset);
    }
}

}  // namespace jet::svg
