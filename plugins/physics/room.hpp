// Room for what is added in large numbers. Growing by doubling leaves up to half of a large body's memory unused.
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

}  // namespace jet::physics
