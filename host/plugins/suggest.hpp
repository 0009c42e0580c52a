// "Did you mean ...?": the known word nearest to what was written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace jet::host {

/// The candidate with the fewest changed letters, if they are few enough to be a slip; empty otherwise.
std::string nearestWord(std::string_view written, const std::vector<std::string>& known);
/// "; did you mean 'x'?", or nothing.
std::string didYouMean(std::string_view written, const std::vector<std::string>& known);

}  // namespace jet::host
