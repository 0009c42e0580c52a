// When and how the constraints of a large world are given to domains (domains.hpp).
#include "solver.hpp"

namespace jet::physics {

namespace {

// Contacts and joints from which on worlds are divided in two, in four; below a half of it they are joined again.
constexpr std::size_t kDivideFrom[] = {1500, 6000};
static_assert(std::size(kDivideFrom) == Domains::kMostDepth);
constexpr std::uint64_t kPatience = 8;         // steps, at least, between divisions
constexpr std::size_t kBorderPart = 24;        // more than this part of the contacts on borders is much
constexpr std::size_t kNewcomersPart = 16;     // the same of bodies that are in no domain
constexpr double kUneven = 1.3;                // times the mean, of the contacts of a domain
constexpr std::uint64_t kUnevenPatience = 60;  // steps

}  // namespace

template <class Real>
std::size_t Solver<Real>::borderContacts() const
{
    std::size_t count = 0;
    for (std::size_t which = 0; which < (domains_.leaves() - 1) * kColours; ++which) count += colours_[which].count;
    return count;
}

template <class Real>
bool Solver<Real>::isDivisionDue(const Collider& collider, std::size_t joints, int& depth) const
{
    std::size_t all = joints, most = 0;
    for (std::size_t node = 1; node <= Domains::kNodes; ++node) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < kColours; ++i) count += colours_[firstColourOf(static_cast<Node>(node)) + i].count;
        all += count;
        if (node >= domains_.leaves()) most = std::max(most, count);
    }
    depth = domains_.depth();
    while (depth < Domains::kMostDepth && all >= kDivideFrom[depth]) ++depth;
    while (depth > 0 && all < kDivideFrom[depth - 1] / 2) --depth;
    if (depth == 0) return domains_.depth() > 0;
    if (sinceDivided_ < kPatience && domains_.depth() > 0) return false;
    if (depth != domains_.depth()) return true;
    if (domains_.newcomers() * kNewcomersPart > collider.bodies().size()) return true;
    if (borderContacts() > std::max<std::size_t>(2 * bordersThen_, all / kBorderPart)) return true;
    return sinceDivided_ >= kUnevenPatience &&
           static_cast<double>(most * domains_.leaves()) > kUneven * static_cast<double>(all);
}

template <class Real>
void Solver<Real>::divide(Collider& collider, const State& state, const std::vector<Joint>& joints, bool anyway)
{
    ++sinceDivided_;
    int depth = 0;
    if (isDivisionDue(collider, joints.size(), depth) || anyway) {
        sinceDivided_ = 0;
        std::vector<Domains::Body> bodies;
        std::vector<std::pair<Index, Index>> links;
        const auto& all = collider.bodies();
        for (Index i = 1; i < all.size() && depth > 0; ++i) {
            const Vec2& at = state.nodes.position[all[i].node];
            if (all[i].moves) bodies.push_back({i, at.x(), at.y()});
        }
        const auto link = [&](Index a, Index b) {
            if (all[a].moves && all[b].moves) links.emplace_back(a, b);
        };
        for (Index i = 0; i < collider.places().size(); ++i)
            if (isPlaced(collider.places()[i])) link(collider.contacts()[i].bodyA, collider.contacts()[i].bodyB);
        for (const Joint& joint : joints)
            if (joint.lives()) link(joint.a, joint.b);
        domains_.divide(depth, std::move(bodies), links);
        moveToNodes(collider);
        jointsVersion_ = 0;
        bordersThen_ = borderContacts();
    }
    if (states_.size() != domains_.slotCount()) states_ = arena_->take<BodyState<Real>>(domains_.slotCount());
    states_[0] = BodyState<Real>();
}

/// Constraints go to where their bodies are now, in the order of their colours.
template <class Real>
void Solver<Real>::moveToNodes(Collider& collider)
{
    const auto& bodies = collider.bodies();
    std::vector<Colour> old(colours_.size());
    old.swap(colours_);
    taken_.clear();
    taken_.resize(bodies.size(), domains_.depth());
    for (std::size_t i = 0; i < old.size(); ++i) {
        const std::size_t source = i % Domains::kNodes * kColours + i / Domains::kNodes;
        for (std::size_t at = 0; at < old[source].count; ++at) {
            const Index contact = old[source].index[at];
            if (contact == kNone) continue;
            const RigidContact& c = collider.contacts()[contact];
            const std::size_t which = colourOf(c.bodyA, bodies[c.bodyA].moves, c.bodyB, bodies[c.bodyB].moves, taken_);
            Colour& colour = colours_[which];
            addLane(colour, isLast(which));
            const std::size_t to = colour.count - 1;
            copyLane(old[source], at, colour, to, bounces_);
            ContactLanes<Real>& lanes = colour.contacts[to / kWidth];
            const auto shown = [&](Index body, std::int32_t& far) {
                if (far != 0) far = farOf<Real>(domains_.slotOf(body));
            };
            shown(c.bodyA, lanes.a[to % kWidth]), shown(c.bodyB, lanes.b[to % kWidth]);
            collider.places()[contact] = placeOf(which, to);
        }
    }
}

template class Solver<float>;
template class Solver<double>;

}  // namespace jet::physics
