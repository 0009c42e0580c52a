// Limits that project files share between reader and writer: what is saved can be opened.
#pragma once

namespace jet {

inline constexpr int kMaximumFilterDepth = 100;

}  // namespace jet
