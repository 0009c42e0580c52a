#include "domains.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace jet::physics {

namespace {

constexpr std::size_t kWhole = 16;  // groups of up to this part of all bodies stay whole

constexpr float kUneven = 0.04F;  // of the weight: so much may the halves differ for the sake of a better cut

using Links = std::vector<std::pair<Index, Index>>;

}  // namespace

void Domains::resize(std::size_t bodies)
{
    if (count_ == bodies) return;
    if (depth_ == 0 || count_ > bodies) {
        depth_ = 0, count_ = bodies;
        place();
        return;
    }
    for (; count_ < bodies; ++count_, ++newcomers_) {
        nodes_.push_back(kRoot);
        slots_.push_back(static_cast<Index>(bodies_.size()));
        bodies_.push_back(static_cast<Index>(count_));
    }
    ranges_[kRoot].last = static_cast<Index>(bodies_.size());
}

/// Slots follow from nodes.
void Domains::place()
{
    std::fill(std::begin(ranges_), std::end(ranges_), Slots());
    if (depth_ == 0) {
        nodes_ = {}, slots_ = {}, bodies_ = {};
        ranges_[kRoot] = {kGap, static_cast<Index>(std::max<std::size_t>(count_, 1)) + kGap - 1};
        return;
    }
    std::size_t stretches = 0;
    for (std::size_t body = 1; body < nodes_.size(); ++body) stretches += nodes_[body] != nodes_[body - 1];
    mixed_ = stretches * kStretch > nodes_.size();
    slots_.assign(count_, 0);
    bodies_.assign(kGap, kNone);
    bodies_[0] = 0;
    const auto fill = [&](Node node) {
        ranges_[node].first = static_cast<Index>(bodies_.size());
        for (Index body = 1; body < nodes_.size(); ++body) {
            if (nodes_[body] != node) continue;
            slots_[body] = static_cast<Index>(bodies_.size());
            bodies_.push_back(body);
        }
        ranges_[node].last = static_cast<Index>(bodies_.size());
        bodies_.resize((bodies_.size() + 2 * kGap - 1) / kGap * kGap, kNone);
    };
    for (std::size_t i = 0; i < leaves(); ++i) fill(leaf(i));
    fill(kRoot);
    bodies_.resize(ranges_[kRoot].last);
}

/// Small groups of linked bodies are seen as one, at the middle of them.
void Domains::group(std::vector<Item>& items, const Links& links) const
{
    std::vector<Index> root(count_);
    std::iota(root.begin(), root.end(), Index{0});
    const auto rootOf = [&](Index body) {
        while (root[body] != body) body = root[body] = root[root[body]];
        return body;
    };
    std::vector<float> weight(count_, 1);
    for (const auto& [a, b] : links) {
        weight[a] += 0.5F, weight[b] += 0.5F;
        const Index first = rootOf(a), second = rootOf(b);
        root[std::max(first, second)] = std::min(first, second);
    }
    struct Sum {
        double x = 0, y = 0;
        std::size_t count = 0;
    };
    std::vector<Sum> sums(count_);
    for (const Item& item : items) {
        Sum& sum = sums[rootOf(item.at.body)];
        sum.x += item.at.x, sum.y += item.at.y, ++sum.count;
    }
    for (Item& item : items) {
        item.weight = weight[item.at.body];
        const Sum& sum = sums[item.group = rootOf(item.at.body)];
        if (sum.count * kWhole <= items.size()) {
            item.at.x = sum.x / static_cast<double>(sum.count), item.at.y = sum.y / static_cast<double>(sum.count);
        } else {
            item.group = item.at.body;
        }
    }
}

void Domains::divide(int depth, std::vector<Body> bodies, const Links& links)
{
    depth_ = depth;
    newcomers_ = 0;
    if (depth > 0) {
        nodes_.assign(count_, kRoot);
        std::vector<Item> items;
        items.reserve(bodies.size());
        for (const Body& body : bodies) items.push_back({body, body.body, 1});
        group(items, links);
        bisect(kRoot, items, 0, items.size(), links);
    }
    place();
}

/// Where sorted items are cut in two halves of about the same weight: not within a group, rather in a gap, else in the
/// middle.
std::size_t Domains::cutOf(const std::vector<Item>& items, std::size_t first, std::size_t last, float total,
                           bool upright)
{
    const auto gapAfter = [&](std::size_t i) {
        const Body &a = items[i].at, &b = items[i + 1].at;
        return items[i].group == items[i + 1].group ? -1 : upright ? b.y - a.y : b.x - a.x;
    };
    float sum = 0;
    double widest = -1;
    for (std::size_t i = first; i + 1 < last; ++i) {
        sum += items[i].weight;
        if (std::abs(2 * sum - total) <= kUneven * total) widest = std::max(widest, gapAfter(i));
    }
    std::size_t cut = last;
    float best = 2 * total;
    sum = 0;
    for (std::size_t i = first; i + 1 < last; ++i) {
        sum += items[i].weight;
        const double gap = gapAfter(i);
        const float off = std::abs(2 * sum - total);
        if (gap < 0 || (widest >= 0 && (off > kUneven * total || gap < 0.5 * widest)) || off >= best) continue;
        best = off, cut = i + 1;
    }
    return cut;
}

/// Along the axis that fewer links go across.
void Domains::bisect(Node node, std::vector<Item>& items, std::size_t first, std::size_t last, const Links& links)
{
    if (isLeaf(node)) return;
    const auto begin = items.begin() + static_cast<std::ptrdiff_t>(first),
               end = items.begin() + static_cast<std::ptrdiff_t>(last);
    const float total = std::accumulate(begin, end, 0.0F, [](float sum, const Item& i) { return sum + i.weight; });
    const auto sort = [&](bool upright) {
        std::sort(begin, end, [upright](const Item& a, const Item& b) {
            const double p = upright ? a.at.y : a.at.x, q = upright ? b.at.y : b.at.x;
            return p != q ? p < q : a.group != b.group ? a.group < b.group : a.at.body < b.at.body;
        });
    };
    const auto assign = [&](bool upright) {
        const std::size_t cut = cutOf(items, first, last, total, upright);
        for (std::size_t i = first; i < last; ++i)
            nodes_[items[i].at.body] = static_cast<Node>(2 * node + (i < cut ? 0 : 1));
        return cut;
    };
    const auto crossing = [&] {
        return std::count_if(links.begin(), links.end(), [&](const std::pair<Index, Index>& link) {
            return (nodes_[link.first] ^ nodes_[link.second]) == 1 && nodes_[link.first] >> 1 == node;
        });
    };
    sort(true);
    assign(true);
    const auto upright = crossing();
    sort(false);
    std::size_t cut = assign(false);
    if (upright < crossing()) sort(true), cut = assign(true);
    bisect(static_cast<Node>(2 * node), items, first, cut, links);
    bisect(static_cast<Node>(2 * node + 1), items, cut, last, links);
}

}  // namespace jet::physics
