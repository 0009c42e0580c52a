// Pulls: mouse joints between a body and the background, as a hand has them. They come and go while a world runs, so
// they belong to its state, and not to what it is made of: a state has them whole, and restoring it makes and removes
// them. No joint of another kind takes the place of one, nor the other way round (docs/decisions/0092).
#pragma once

#include "snapshot.hpp"

#include <jet/physics.hpp>

#include <type_traits>
#include <vector>

namespace jet::physics {

inline bool isPull(const JointDef& def)
{
    return def.kind == JointDef::Kind::Mouse && (def.a.body == kNoHandle) != (def.b.body == kNoHandle);
}

/// Makes `all` as long as `count`, with new ones at `places`, which ascend, and what is no pull where it was. Fails,
/// and changes nothing, where that is not possible.
template <class T, class IsPull>
void placePulls(std::vector<T>& all, const std::vector<std::uint32_t>& places, std::uint64_t count, IsPull&& isPull)
{
    std::uint64_t others = 0;
    for (const T& one : all) others += !isPull(one);
    if (count != others + places.size()) RestoreArchive::fail();
    std::size_t next = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const bool pull = next < places.size() && places[next] == i;
        const bool other = i < all.size() && !isPull(all[i]);
        if (pull == other) RestoreArchive::fail();
        next += pull;
    }
    all.resize(count);
    for (const std::uint32_t place : places) all[place] = T();
}

/// Those among `all` that are pulls, and where they are; each(one) archives all of one.
template <class Archive, class T, class IsPull, class Each>
void archivePulls(Archive& with, std::vector<T>& all, IsPull&& isPull, Each&& each)
{
    std::vector<std::uint32_t> places;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (isPull(all[i])) places.push_back(static_cast<std::uint32_t>(i));
    auto count = static_cast<std::uint64_t>(all.size());
    with(count), with.list(places, [&](std::uint32_t& place) { with(place); });
    if constexpr (std::is_same_v<Archive, RestoreArchive>) placePulls(all, places, count, isPull);
    for (const std::uint32_t place : places) each(all[place]);
}

template <class T, class IsPull>
void dropPulls(std::vector<T>& all, IsPull&& isPull)
{
    std::uint64_t others = 0;
    for (const T& one : all) others += !isPull(one);
    placePulls(all, {}, others, isPull);
}

/// What of its definition is fixed.
template <class Archive>
void archivePull(Archive& with, JointDef& def)
{
    def.kind = JointDef::Kind::Mouse;
    for (Anchor* anchor : {&def.a, &def.b}) with(anchor->body), with(anchor->point), with(anchor->radius);
}

}  // namespace jet::physics
