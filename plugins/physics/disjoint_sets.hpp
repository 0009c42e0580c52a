// Disjoint sets over an array: each member names another of its set, its root itself. The least of a set is its root,
// so that roots do not depend on the order in which sets were united.
#pragma once

#include "state.hpp"

#include <algorithm>
#include <vector>

namespace jet::physics {

/// The paths on the way become shorter.
inline Index rootOf(std::vector<Index>& sets, Index member)
{
    while (sets[member] != member) member = sets[member] = sets[sets[member]];
    return member;
}

inline void unite(std::vector<Index>& sets, Index a, Index b)
{
    a = rootOf(sets, a), b = rootOf(sets, b);
    sets[std::max(a, b)] = std::min(a, b);
}

}  // namespace jet::physics
