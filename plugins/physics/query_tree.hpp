// A tree of boxes over what queries may find: built once from the top by halving along the longer side, and fitted
// again from the leaves when bodies have moved; built anew when that has made its boxes much larger.
#pragma once

#include <jet/geometry.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace jet::physics {

class QueryTree {
public:
    /// [items] boxes; null ones are never found.
    void update(std::span<const Box> boxes);

    /// Calls visit(item) for each item whose box meets the region.
    template <class Visit>
    void visit(const Box& region, Visit&& visit) const
    {
        descend([&](const Box& box) { return box.intersects(region) ? 0.0 : kOut; }, [] { return 1.0; }, visit);
    }

    /// Calls visit(item) for each item whose box, `grown` on all sides, the way from `from` to `from + way` meets
    /// before `most()`, a part of the way that may shrink meanwhile; nearer boxes mostly come first.
    template <class Most, class Visit>
    void along(const Vec2& from, const Vec2& way, double grown, Most&& most, Visit&& visit) const
    {
        descend([&](const Box& box) { return entering(box, from, way, grown); }, most, visit);
    }

    /// Calls visit(item) for each item whose box is nearer to the point than `most()`.
    template <class Most, class Visit>
    void around(const Vec2& point, Most&& most, Visit&& visit) const
    {
        descend([&](const Box& box) { return distance(box, point); }, most, visit);
    }

private:
    static constexpr double kOut = 1e300;

    struct Node {
        Box box;
        std::uint32_t left = 0, right = 0;  // left == right: a leaf, the item
        bool leaf = false;
    };

    /// The part of the way at which it enters the box.
    static double entering(const Box& box, const Vec2& from, const Vec2& way, double grown);
    static double distance(const Box& box, const Vec2& point);

    template <class Cost, class Most, class Visit>
    void descend(Cost&& cost, Most&& most, Visit&& visit) const
    {
        if (nodes_.empty()) return;
        struct Open {
            std::uint32_t node;
            double cost;
        };
        // Halving gives a tree of at most 33 levels, of which each leaves one node waiting.
        std::array<Open, 80> stack;
        std::size_t top = 0;
        const auto push = [&](std::uint32_t node) {
            if (nodes_[node].box.isNull()) return;
            const double c = cost(nodes_[node].box);
            if (c <= most()) stack[top++] = {node, c};
        };
        push(0);
        while (top > 0) {
            const Open open = stack[--top];
            if (open.cost > most()) continue;
            const Node& node = nodes_[open.node];
            if (node.leaf) {
                visit(node.left);
                continue;
            }
            const std::size_t before = top;
            push(node.left), push(node.right);
            // The nearer one is on top.
            if (top == before + 2 && stack[top - 1].cost > stack[top - 2].cost)
                std::swap(stack[top - 1], stack[top - 2]);
        }
    }

    void build(std::span<const Box> boxes);
    std::uint32_t build(std::span<const Box> boxes, std::span<std::uint32_t> items);
    double refit(std::span<const Box> boxes);

    std::vector<Node> nodes_;  // parents before their children
    std::vector<std::uint32_t> order_;
    std::size_t count_ = 0;
    double built_ = 0;  // sum of the boxes' sizes when it was built
};

}  // namespace jet::physics
