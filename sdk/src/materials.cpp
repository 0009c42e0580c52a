#include "physics_ranges.hpp"

#include <jet/value.hpp>

namespace jet {

MaterialTable::MaterialTable(std::string first) : names_{std::move(first)}, pairs_{MaterialPair{}} {}

int MaterialTable::find(std::string_view name) const
{
    const auto found = std::find(names_.begin(), names_.end(), name);
    return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
}

std::size_t MaterialTable::add(std::string name)
{
    const std::size_t n = names_.size();
    std::vector<MaterialPair> grown((n + 1) * (n + 1));
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b) grown[a * (n + 1) + b] = pairs_[a * n + b];
    pairs_ = std::move(grown);
    names_.push_back(std::move(name));
    return n;
}

void MaterialTable::remove(std::size_t index)
{
    const std::size_t n = names_.size();
    std::vector<MaterialPair> shrunk;
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b)
            if (a != index && b != index) shrunk.push_back(pairs_[a * n + b]);
    pairs_ = std::move(shrunk);
    names_.erase(names_.begin() + static_cast<std::ptrdiff_t>(index));
}

const MaterialPair& MaterialTable::pair(std::size_t a, std::size_t b) const { return pairs_[a * names_.size() + b]; }

void MaterialTable::setPair(std::size_t a, std::size_t b, const MaterialPair& pair)
{
    pairs_[a * names_.size() + b] = pair;
    pairs_[b * names_.size() + a] = pair;
}

bool MaterialTable::operator==(const MaterialTable& other) const
{
    const auto equal = [](const MaterialPair& a, const MaterialPair& b) {
        return a.friction == b.friction && a.restitution == b.restitution && a.collides == b.collides;
    };
    return names_ == other.names_ &&
           std::equal(pairs_.begin(), pairs_.end(), other.pairs_.begin(), other.pairs_.end(), equal);
}

Result<void> checkPair(std::string_view a, std::string_view b, const MaterialPair& pair)
{
    const auto fails = [&](const char* what, double value, const std::string& range) {
        const std::string is = std::isfinite(value) ? numberText(value) : "not a number";
        return Error("the materials '" + std::string(a) + "' and '" + std::string(b) + "': " + what + " is " + is +
                     "; it must be from 0 to " + range);
    };
    if (!(pair.friction >= 0 && pair.friction <= kMostOfPhysics))
        return fails("friction", pair.friction, numberText(kMostOfPhysics));
    if (!(pair.restitution >= 0 && pair.restitution <= 1))
        return fails("restitution", pair.restitution, "1, where 0 is no bounce and 1 a full one");
    return {};
}

Result<void> checkMaterials(const MaterialTable& table)
{
    for (std::size_t a = 0; a < table.size(); ++a)
        for (std::size_t b = a; b < table.size(); ++b)
            if (auto fits = checkPair(table.names()[a], table.names()[b], table.pair(a, b)); !fits) return fits;
    return {};
}

}  // namespace jet
