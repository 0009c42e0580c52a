// Room for what is added in large numbers. Growing by doubling leaves up to half of a large body's memory unused. At
// its first step a world gives back what it has to spare; most have all their bodies then.
#pragma once

#include <algorithm>
#include <cstddef>

namespace jet::physics {

/// Room for `more` elements in each of the vectors; those that must grow have an eighth to spare.
template <class... Vectors>
void makeRoom(std::size_t more, Vectors&... vectors)
{
    const auto grow = [more](auto& values) {
        const std::size_t needed = values.size() + more;
        if (needed > values.capacity()) values.reserve(std::max(needed, values.size() + values.size() / 8));
    };
    (grow(vectors), ...);
}

/// Bytes the vectors have, used or not.
template <class... Vectors>
std::size_t roomOf(const Vectors&... vectors)
{
    return ((vectors.capacity() * sizeof(vectors[0])) + ...);
}

/// Gives back what the vectors have to spare.
template <class... Vectors>
void fitRoom(Vectors&... vectors)
{
    (vectors.shrink_to_fit(), ...);
}

}  // namespace jet::physics
