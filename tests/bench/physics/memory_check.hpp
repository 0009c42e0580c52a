// What of the heap parts of a world take.
#pragma once

#include <cstddef>

namespace jet::bench {

std::size_t heapInUse();
void printMemory();

}  // namespace jet::bench
