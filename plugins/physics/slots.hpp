// Places of bodies that were removed, for those that are built alike and come after them.
//
// All data of bodies lie in ranges of arrays, and handles, nodes and points are indices into these: closing a gap would
// give others new numbers. So the gap stays, and a body takes it over whose ranges are as long. Nobody takes over the
// place of a body before the next step, as that tells the end of its contacts. See docs/decisions/0081.
#pragma once

#include "state.hpp"

#include <algorithm>
#include <compare>
#include <map>
#include <set>

namespace jet::physics {

/// How much room a body takes, and in which stages.
struct Build {
    bool rigid = false, single = false, simple = false;  // as of BodyRecord
    Index nodes = 0, points = 0, walls = 0;
    Index parts = 0;                        // rigid and simple
    Index springs = 0, angularSprings = 0;  // soft

    auto operator<=>(const Build&) const = default;
};

class Slots {
public:
    /// It was removed.
    void give(Index body, const Build& build)
    {
        free_[build].insert(body);
        nodes_ += build.nodes;
        waiting_.insert(std::lower_bound(waiting_.begin(), waiting_.end(), body), body);
    }
    /// The first place of this build that may be taken over; kNone: there is none.
    Index take(const Build& build)
    {
        const auto places = free_.find(build);
        if (places == free_.end()) return kNone;
        const auto waits = [&](Index body) { return std::binary_search(waiting_.begin(), waiting_.end(), body); };
        const auto found = std::find_if_not(places->second.begin(), places->second.end(), waits);
        if (found == places->second.end()) return kNone;
        const Index body = *found;
        places->second.erase(found);
        if (places->second.empty()) free_.erase(places);
        nodes_ -= build.nodes;
        return body;
    }
    /// A step begins.
    void release() { waiting_.clear(); }
    /// Nodes of the places that nobody has.
    std::size_t nodes() const { return nodes_; }

    /// Which places there are is a matter of what the world is made of.
    template <class Archive>
    void archive(Archive& with)
    {
        with.list(waiting_, [&](Index& body) { with(body); });
    }

private:
    std::map<Build, std::set<Index>> free_;
    std::vector<Index> waiting_;  // ascending: since the last step
    std::size_t nodes_ = 0;
};

}  // namespace jet::physics
