// Pairs of parts whose boxes came to meet, and the contacts they become.
#include "collider.hpp"
#include "room.hpp"

#include <bit>
#include <cmath>
#include <tuple>

namespace jet::physics {

namespace {

constexpr float kThin = 0.5F;              // of the thickness
constexpr std::size_t kSoughtABlock = 16;  // parts
constexpr std::size_t kMergedAShare = 64;  // pairs: fewer are merged by one thread
constexpr std::size_t kAddedABlock = 32;   // pairs
constexpr std::size_t kPrefetched = 6;     // pairs

/// Sorts by the left side, then by the part.
std::uint64_t leftOf(const FatBox& box, Index part)
{
    const auto bits = std::bit_cast<std::uint32_t>(box.minX + 0.0F);  // null has no sign
    return static_cast<std::uint64_t>(bits >> 31 != 0 ? ~bits : bits | 0x80000000U) << 32 | part;
}

}  // namespace

void Collider::findPairs(const WorldSettings& settings, Pool& pool, Arena& arena)
{
    if (!sweep_.anyMoved()) return;
    sweep_.begin(arena, pool);
    const std::size_t blocks = (sweep_.parts() + kSoughtABlock - 1) / kSoughtABlock;
    if (foundBy_.size() < blocks) foundBy_.resize(blocks);
    // From left to right: the order decides the order of solving, and this one lets tall heaps rest.
    pool.run(blocks, [&](std::size_t block) {
        auto& found = foundBy_[block];
        found.clear();
        const std::size_t first = block * kSoughtABlock, last = std::min(sweep_.parts(), first + kSoughtABlock);
        sweep_.seek(first, last, [&](Index a, Index b) {
            // Parts of one body are never a pair, and those of a scribble all overlap.
            if (parts_[a].body == parts_[b].body) return;
            const std::uint64_t left = leftOf(sweep_.box(a), a), right = leftOf(sweep_.box(b), b);
            found.push_back(right >> 32 < left >> 32 ? FoundPair{right, left} : FoundPair{left, right});
            known_.prefetch(found.back().key()), prefetchPair(found.back());
        });
        std::erase_if(found,
                      [&](const FoundPair& pair) { return known_.contains(pair.key()) || !accepts(pair, settings); });
        std::sort(found.begin(), found.end());
    });
    sweep_.finish(arena);
    mergeFound(blocks, pool);
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    addFound(settings, pool);
    hits_.resize(contacts_.size(), 0);
}

/// What the blocks found, each in order, into one list. Each thread merges what some blocks found; of two of these
/// lists that become one, each merges a part.
void Collider::mergeFound(std::size_t blocks, Pool& pool)
{
    runs_.assign(1, 0);
    for (std::size_t block = 0; block < blocks; ++block) runs_.push_back(runs_.back() + foundBy_[block].size());
    const std::size_t all = runs_.back();
    found_.resize(all), merged_.resize(all);
    if (all == 0) return;
    const auto threads = static_cast<std::size_t>(pool.threads());
    const std::size_t shares = all < kMergedAShare * threads ? 1 : std::min(threads, blocks);
    const auto share = [&](std::size_t i) { return i * blocks / shares; };
    const int levels = std::bit_width((blocks + shares - 1) / shares - 1);
    pool.run(shares, [&](std::size_t i) { mergeBlocks(share(i), share(i + 1), levels); });
    if (levels % 2 != 0) found_.swap(merged_);
    for (std::size_t i = 0; i < shares; ++i) runs_[i] = runs_[share(i)];
    runs_[shares] = all;
    for (std::size_t width = 1; width < shares; width *= 2, found_.swap(merged_)) {
        const std::size_t pairs = (shares + 2 * width - 1) / (2 * width),
                          parts = std::max<std::size_t>(1, shares / pairs);
        const auto end = [&](std::size_t run) { return runs_[std::min(run, shares)]; };
        pool.run(pairs * parts, [&](std::size_t i) {
            const std::size_t run = i / parts * 2 * width;
            mergePart({end(run), end(run + width), end(run + 2 * width)}, i % parts, parts);
        });
    }
}

/// Neighbours of [first, last) are merged so many times: after an even number of times they lie in found_.
void Collider::mergeBlocks(std::size_t first, std::size_t last, int levels)
{
    for (std::size_t block = first; block < last; ++block)
        std::copy(foundBy_[block].begin(), foundBy_[block].end(),
                  found_.begin() + static_cast<std::ptrdiff_t>(runs_[block]));
    auto *from = &found_, *to = &merged_;
    for (int level = 0; level < levels; ++level, std::swap(from, to)) {
        const std::size_t width = std::size_t{1} << level;
        for (std::size_t run = first; run < last; run += 2 * width) {
            const auto place = [&](std::vector<FoundPair>& list, std::size_t block) {
                return list.begin() + static_cast<std::ptrdiff_t>(runs_[std::min(block, last)]);
            };
            const auto middle = place(*from, run + width);
            std::merge(place(*from, run), middle, middle, place(*from, run + 2 * width), place(*to, run));
        }
    }
}

/// A part of what two neighbouring lists of found_ become in merged_.
void Collider::mergePart(const Neighbours& lists, std::size_t part, std::size_t parts)
{
    const auto place = [](std::vector<FoundPair>& list, std::size_t i) {
        return list.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const auto first = place(found_, lists.first), middle = place(found_, lists.middle),
               last = place(found_, lists.last);
    const auto cut = [&](std::size_t which) {
        const auto here = place(found_, lists.first + (lists.middle - lists.first) * which / parts);
        const auto other = which == 0       ? middle
                           : which == parts ? last
                           : here == middle ? last
                                            : std::lower_bound(middle, last, *here);
        return std::pair(here, other);
    };
    const auto [from, otherFrom] = cut(part);
    const auto [to, otherTo] = cut(part + 1);
    std::merge(from, to, otherFrom, otherTo, place(merged_, lists.first) + (from - first) + (otherFrom - middle));
}

/// New contacts have their numbers in the order of the pairs; all else of them is up to each alone.
void Collider::addFound(const WorldSettings& settings, Pool& pool)
{
    takeContacts();
    const auto know = [&] {
        for (std::size_t i = 0; i < found_.size(); ++i) {
            if (i + kPrefetched < found_.size()) known_.prefetch(found_[i + kPrefetched].key());
            known_.insert(found_[i].key());
        }
    };
    const auto make = [&](std::size_t block) {
        const std::size_t last = std::min(found_.size(), (block + 1) * kAddedABlock);
        for (std::size_t i = block * kAddedABlock; i < last; ++i) {
            if (i + kPrefetched < last) prefetchNew(found_[i + kPrefetched].contact);
            makeContact(found_[i], settings);
        }
    };
    pool.beside((found_.size() + kAddedABlock - 1) / kAddedABlock, make, know);
}

/// New pairs lie anywhere in memory.
void Collider::prefetchPair(const FoundPair& pair) const
{
    for (const Index part : {pair.partA(), pair.partB()}) {
        __builtin_prefetch(&parts_[part]), __builtin_prefetch(&parts_[part].thickness);
    }
}

/// Numbers of new contacts: gaps first, the last ones that came to be.
void Collider::takeContacts()
{
    const std::size_t old = std::min(found_.size(), free_.size()), more = found_.size() - old;
    auto fresh = static_cast<Index>(contacts_.size());
    for (std::size_t i = 0; i < found_.size(); ++i) found_[i].contact = i < old ? free_[free_.size() - 1 - i] : fresh++;
    free_.resize(free_.size() - old);
    if (more == 0) return;
    makeRoom(more, contacts_, places_, nearing_);
    contacts_.resize(contacts_.size() + more), places_.resize(contacts_.size(), kIdle);
    nearing_.resize(contacts_.size());
}

void Collider::prefetchNew(Index contact) const
{
    __builtin_prefetch(&contacts_[contact], 1), __builtin_prefetch(&contacts_[contact].normal, 1);
    __builtin_prefetch(&nearing_[contact], 1);
}

bool Collider::mayMeet(Index a, Index b) const
{
    const RigidBody &bodyA = bodies_[a], &bodyB = bodies_[b];
    if (a == b || (!bodyA.moves && !bodyB.moves) || !bodyA.enabled || !bodyB.enabled) return false;
    const Rules &rulesA = rulesOf(bodyA), &rulesB = rulesOf(bodyB);
    if (rulesA.group != 0 && rulesA.group == rulesB.group) return false;
    return (rulesA.layer & rulesB.mask) != 0 && (rulesB.layer & rulesA.mask) != 0;
}

/// A moving round part rests on sides of the other: circles come second.
std::pair<Index, Index> Collider::orderedParts(const FoundPair& pair) const
{
    Index a = std::min(pair.partA(), pair.partB()), b = std::max(pair.partA(), pair.partB());
    if (parts_[a].count < parts_[b].count && parts_[a].count == 1) std::swap(a, b);
    return {a, b};
}

bool Collider::accepts(const FoundPair& pair, const WorldSettings& settings) const
{
    const auto [partA, partB] = orderedParts(pair);
    const Index a = parts_[partA].body, b = parts_[partB].body;
    return mayMeet(a, b) && materialsOf(a, b, settings).collides && !(isLonger(partA, partB) && apart(partA, partB)) &&
           !excluded_.contains(bodyKey(a, b));
}

const MaterialPair& Collider::materialsOf(Index a, Index b, const WorldSettings& settings) const
{
    return settings.materials[static_cast<std::size_t>(rulesOf(bodies_[a]).material) * settings.materialCount +
                              rulesOf(bodies_[b]).material];
}

void Collider::makeContact(const FoundPair& pair, const WorldSettings& settings)
{
    RigidContact c;
    std::tie(c.partA, c.partB) = orderedParts(pair);
    const Part &partA = parts_[c.partA], &partB = parts_[c.partB];
    c.bodyA = partA.body, c.bodyB = partB.body;
    const RigidBody &bodyA = bodies_[c.bodyA], &bodyB = bodies_[c.bodyB];
    const MaterialPair& materials = materialsOf(c.bodyA, c.bodyB, settings);
    c.friction = static_cast<float>(materials.friction), c.restitution = static_cast<float>(materials.restitution);
    c.slop = kSlop * (!bodyA.moves ? partB.length : !bodyB.moves ? partA.length : std::min(partA.length, partB.length));
    c.resolve = !bodyA.sensor && !bodyB.sensor;
    c.special = bodyA.oneSided || bodyB.oneSided || isLonger(c.partA, c.partB);
    Nearing n;
    n.bodyA = c.bodyA, n.bodyB = c.bodyB, n.slop = c.slop;
    n.thin = kThin * std::min(partA.thickness, partB.thickness);
    contacts_[pair.contact] = c, places_[pair.contact] = kIdle, nearing_[pair.contact] = n;
}

void Collider::forgetPair(Index contact)
{
    known_.erase(contacts_[contact].key());
    free_.push_back(contact);
}

/// Boxes of long oblique parts meet much that they do not: here B's box is looked at from A's sides.
bool Collider::apart(Index partA, Index partB) const
{
    const Index longer = parts_[partA].length >= parts_[partB].length ? partA : partB;
    const Part& part = parts_[longer];
    if (part.count < 2) return false;
    const FatBox& box = sweep_.box(longer == partA ? partB : partA);
    const Pose& pose = poses_[part.body];
    const float halfX = 0.5F * (box.maxX - box.minX), halfY = 0.5F * (box.maxY - box.minY);
    const double middleX = 0.5 * (static_cast<double>(box.minX) + box.maxX),
                 middleY = 0.5 * (static_cast<double>(box.minY) + box.maxY);
    const Vec2f middle{static_cast<float>(middleX - pose.x), static_cast<float>(middleY - pose.y)};
    const float room = part.radius + std::max(pose.room, 0.0F) + ahead(part.body) + pose.travel + surprise_[part.body];
    for (int i = 0; i < part.count; ++i) {
        const Vec2f n = turned(pose.turn, part.normals[i]);
        const float away =
            dot(n, middle) - dot(part.normals[i], part.corners[i]) - std::abs(n.x) * halfX - std::abs(n.y) * halfY;
        if (away > room) return true;
    }
    return false;
}

}  // namespace jet::physics
