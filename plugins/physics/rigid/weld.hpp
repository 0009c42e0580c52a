// Flush sides of bodies that never move, as tiles of a level have them, become one outline: what glides over them feels
// no seam. Sides are flush when they have both ends in common; tiles of different size are not welded.
#pragma once

#include "column.hpp"
#include "contact.hpp"
#include "rules.hpp"

#include <utility>
#include <vector>

namespace jet::physics {

class Weld {
public:
    /// The outline a part has by itself, or none; one call a part, in their order.
    void add(const PartOutline*);
    /// Another part is in the place of a removed one. Has either an outline?
    bool replace(std::size_t part, const PartOutline*);
    /// Works out the outlines of all parts from where their bodies are.
    void run(std::vector<Part>& parts, const std::vector<RigidBody>& bodies, const RuleBook&, const State&,
             float typicalLength);

    /// Null for a part that is all outside.
    const PartOutline* outlineOf(std::size_t part) const
    {
        const std::uint32_t at = outlineOf_[part];
        return at == kNoOutline ? nullptr : &outlines_[at];
    }
    std::size_t bytes() const { return (own_.capacity() + outlines_.capacity()) * sizeof(PartOutline); }

private:
    static constexpr std::uint32_t kNoOutline = 0xffffffffU;

    std::vector<PartOutline> own_, outlines_;
    // [parts] into own_ and outlines_; up to the last that has one.
    Column<std::uint32_t> ownOf_{kNoOutline}, outlineOf_{kNoOutline};
    std::vector<std::uint32_t> free_;  // rows of own_
    std::size_t parts_ = 0;
};

}  // namespace jet::physics
