// What of the heap parts of a world take.
#pragma once

#include <cstddef>

namespace jet::bench {

std::size_t heapInUse();
/// Prints them; false when one takes as much as its limit or more.
bool memoryIsInLimits();

}  // namespace jet::bench
