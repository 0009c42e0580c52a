// How the bodies of a large world are divided, so that threads share as little as can be.
//
// Domains are the leaves of a binary tree: the root is node 1, the children of node n are 2n and 2n + 1. What holds two
// bodies together belongs to the lowest node above both: to their domain, or to the border between two domains. Nodes
// that do not lie above each other have no body in common, so they may be solved at once; a node comes after its
// children. Which body is where does not depend on the count of threads, so neither do results.
//
// Bodies of a domain lie side by side in the solver's arrays, in *slots*, and never in one cache line with another's.
#pragma once

#include "pool.hpp"
#include "snapshot.hpp"
#include "state.hpp"

#include <type_traits>

namespace jet::physics {

class Domains {
public:
    using Node = std::uint8_t;
    static constexpr std::size_t kBlock = 128;  // bodies a thread takes at once
    static constexpr Node kRoot = 1;
    static constexpr int kMostDepth = 2, kLevels = kMostDepth + 1;
    static constexpr std::size_t kNodes = (std::size_t{2} << kMostDepth) - 1;

    struct Body {
        Index body = 0;
        double x = 0, y = 0;  // scene units
    };
    struct Slots {
        Index first = 0, last = 0;  // [first, last)
    };

    /// 0: undivided; every body is the root's.
    int depth() const { return depth_; }
    std::size_t leaves() const { return std::size_t{1} << depth_; }
    Node leaf(std::size_t index) const { return static_cast<Node>(leaves() + index); }
    bool isLeaf(Node node) const { return levelOf(node) == depth_; }

    Node nodeOf(Index body) const { return depth_ == 0 ? kRoot : nodes_[body]; }
    /// The lowest node above both.
    static Node meet(Node a, Node b)
    {
        while (a != b) (a > b ? a : b) >>= 1;
        return a;
    }
    /// Calls work(n) for the node and all below it, children first.
    template <class Work>
    void below(Node node, Work&& work) const
    {
        if (!isLeaf(node)) below(static_cast<Node>(2 * node), work), below(static_cast<Node>(2 * node + 1), work);
        work(node);
    }
    /// The same, each node between its children, so that halves of the order are halves of the tree.
    template <class Work>
    void across(Node node, Work&& work) const
    {
        if (isLeaf(node)) return work(node);
        across(static_cast<Node>(2 * node), work);
        work(node);
        across(static_cast<Node>(2 * node + 1), work);
    }
    static int levelOf(Node node) { return 31 - __builtin_clz(node); }

    /// Body 0 is in slot 0; those of the root alone come last. Undivided, they are in the order of the bodies.
    Index slotOf(Index body) const
    {
        if (depth_ > 0) return slots_[body];
        return body == 0 ? 0 : body + kGap - 1;
    }
    /// kNone: nobody's.
    Index bodyAt(Index slot) const
    {
        if (depth_ > 0) return bodies_[slot];
        return slot == 0 ? 0 : slot < kGap ? kNone : slot - kGap + 1;
    }
    Slots slotsOf(Node node) const { return ranges_[node]; }
    std::size_t slotCount() const { return ranges_[kRoot].last; }
    /// Bodies that came since the division; they are the root's.
    std::size_t newcomers() const { return newcomers_; }

    /// Calls work(body, slot) for each body, many at once. All but the solver keeps bodies in the order of their
    /// numbers. Where each domain has stretches of those, it goes by domains, as the solver does; where they are mixed
    /// it goes by numbers, so that a line of memory is one thread's, and the same one's in each step.
    template <class Work>
    void eachBody(Pool& pool, Work&& work) const
    {
        eachBody(pool, work, nullptr);
    }
    /// The same; where there are several threads, ask(body, slot) comes some bodies before work() does, to ask for
    /// memory that another may have.
    template <class Work, class Ask>
    void eachBody(Pool& pool, Work&& work, Ask&& ask) const
    {
        const std::size_t count = std::max<std::size_t>(count_, 1);
        if (pool.threads() <= 1) {
            for (Index body = 1; body < count; ++body) work(body, slotOf(body));
            return;
        }
        const auto askFor = [&](Index body, Index slot) {
            if constexpr (!std::is_null_pointer_v<std::remove_cvref_t<Ask>>) ask(body, slot);
        };
        if (depth_ > 0 && !mixed_) {
            const auto range = [&](std::size_t first, std::size_t last) {
                for (auto slot = static_cast<Index>(first); slot < last; ++slot) {
                    if (slot + kAhead < last) askFor(bodies_[slot + kAhead], slot + kAhead);
                    work(bodies_[slot], slot);
                }
            };
            // Each domain begins elsewhere, so that threads do not go side by side through the same lines.
            pool.run(leaves() * kPieces, [&](std::size_t i) {
                const std::size_t domain = i / kPieces, turned = i + kPieces * domain / leaves();
                const Slots slots = ranges_[leaf(domain)];
                const auto at = [&](std::size_t piece) {
                    return slots.first + (slots.last - slots.first) * piece / kPieces;
                };
                range(at(turned % kPieces), at(turned % kPieces + 1));
            });
            const Slots rest = ranges_[kRoot];
            pool.ranges(rest.last - rest.first, kBlock,
                        [&](std::size_t first, std::size_t last) { range(rest.first + first, rest.first + last); });
            return;
        }
        pool.ranges(count - 1, kBlock, [&](std::size_t first, std::size_t last) {
            for (auto body = static_cast<Index>(first + 1); body <= last; ++body) {
                if (body + kAhead <= last) askFor(body + kAhead, slotOf(body + kAhead));
                work(body, slotOf(body));
            }
        });
    }

    /// New bodies go to the root.
    void resize(std::size_t bodies);
    /// Divides bodies that move, each weighing its links and one; `links` hold two of them together. Where the tree is
    /// cut, few links go across, and small groups of linked bodies stay whole.
    void divide(int depth, std::vector<Body> bodies, const std::vector<std::pair<Index, Index>>& links);
    std::size_t bytes() const { return nodes_.capacity() * (sizeof(Node) + 2 * sizeof(Index)); }

    template <class Archive>
    void archive(Archive& with, std::size_t bodies)
    {
        resize(bodies);
        with(depth_), with(newcomers_);
        if (depth_ < 0 || depth_ > kMostDepth) RestoreArchive::fail();
        nodes_.resize(depth_ > 0 ? bodies : 0, kRoot);
        with(nodes_);
        if constexpr (std::is_same_v<Archive, RestoreArchive>) place();
    }

private:
    static constexpr std::size_t kStretch = 8;  // bodies side by side that one domain has, on average; less is mixed
    static constexpr Index kAhead = 10;         // bodies
    static constexpr std::size_t kPieces = 16;  // of a domain, of which a thread takes one after the other
    static constexpr Index kGap = 4;            // slots between domains: two lines, as processors fetch pairs of them
    struct Item {
        Body at;
        Index group;  // bodies of one group are not parted
        float weight;
    };
    void group(std::vector<Item>&, const std::vector<std::pair<Index, Index>>& links) const;
    void bisect(Node, std::vector<Item>&, std::size_t first, std::size_t last,
                const std::vector<std::pair<Index, Index>>& links);
    static std::size_t cutOf(const std::vector<Item>&, std::size_t first, std::size_t last, float total, bool upright);
    void place();

    int depth_ = 0;
    std::size_t count_ = 0;  // bodies, with body 0
    std::uint64_t newcomers_ = 0;
    // Of a divided world.
    std::vector<Node> nodes_;    // [bodies]
    std::vector<Index> slots_;   // [bodies]
    std::vector<Index> bodies_;  // [slots]
    Slots ranges_[kNodes + 1];
    bool mixed_ = false;  // are numbers of bodies of all domains mixed?
};

}  // namespace jet::physics
