// What a check of a project finds, and what was done about it.
#pragma once

#include <jet/result.hpp>

#include <string>
#include <vector>

namespace jet::host {

struct Finding {
    enum class Weight {
        Error,   ///< the project does not open, or does not mean what it says
        Warning  ///< it opens; something is left over or not told
    };
    Weight weight = Weight::Error;
    Location where;       ///< in the file as it was found
    std::string problem;  ///< a clause: "the id 5 is taken already"
    std::string repair;   ///< what repairing does: "gets the id 12"; empty: a person has to decide
    bool repaired = false;
};

using Findings = std::vector<Finding>;

}  // namespace jet::host
