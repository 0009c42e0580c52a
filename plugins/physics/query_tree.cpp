#include "query_tree.hpp"

#include <algorithm>
#include <numeric>

namespace jet::physics {

namespace {

constexpr double kWorn = 2;  // times the size of its boxes when built: then it is built anew

double sizeOf(const Box& box) { return box.isNull() ? 0 : box.size().sum(); }

}  // namespace

double QueryTree::entering(const Box& box, const Vec2& from, const Vec2& way, double grown)
{
    double enter = 0, leave = 1;
    for (int axis = 0; axis < 2; ++axis) {
        const double low = box.min[axis] - grown, high = box.max[axis] + grown;
        if (way[axis] == 0) {
            if (from[axis] < low || from[axis] > high) return kOut;
            continue;
        }
        const double a = (low - from[axis]) / way[axis], b = (high - from[axis]) / way[axis];
        enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave ? enter : kOut;
}

double QueryTree::distance(const Box& box, const Vec2& point)
{
    const Vec2 off = (box.min - point).cwiseMax(point - box.max).cwiseMax(Vec2(0, 0));
    return off.norm();
}

void QueryTree::update(std::span<const Box> boxes)
{
    if (boxes.size() != count_ || refit(boxes) > kWorn * built_) build(boxes);
}

double QueryTree::refit(std::span<const Box> boxes)
{
    double sum = 0;
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& node = nodes_[i];
        if (node.leaf) {
            node.box = boxes[node.left];
        } else {
            node.box = nodes_[node.left].box;
            if (!nodes_[node.right].box.isNull()) node.box.extend(nodes_[node.right].box);
        }
        sum += sizeOf(node.box);
    }
    return sum;
}

void QueryTree::build(std::span<const Box> boxes)
{
    count_ = boxes.size();
    nodes_.clear();
    order_.resize(count_);
    std::iota(order_.begin(), order_.end(), 0U);
    if (count_ == 0) return;
    nodes_.reserve(2 * count_);
    build(boxes, order_);
    built_ = refit(boxes);
}

std::uint32_t QueryTree::build(std::span<const Box> boxes, std::span<std::uint32_t> items)
{
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    if (items.size() == 1) {
        nodes_[index].left = nodes_[index].right = items[0];
        nodes_[index].leaf = true;
        return index;
    }
    const auto middle = [&](std::uint32_t item) {
        return boxes[item].isNull() ? Vec2(0, 0) : Vec2(boxes[item].min + boxes[item].max);
    };
    Box centres;
    for (const std::uint32_t item : items) centres.extend(middle(item));
    const int axis = centres.size().x() >= centres.size().y() ? 0 : 1;
    const std::size_t half = items.size() / 2;
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                         const double p = middle(a)[axis], q = middle(b)[axis];
                         return p < q || (p == q && a < b);
                     });
    const std::uint32_t left = build(boxes, items.first(half)), right = build(boxes, items.subspan(half));
    nodes_[index].left = left, nodes_[index].right = right;
    return index;
}

}  // namespace jet::physics
