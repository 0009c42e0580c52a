#include "report.hpp"

#include <algorithm>

namespace jet::svg {

namespace {

constexpr int kMostSingleNotes = 100;  // a broken file has one cause, not a thousand

}  // namespace

Report::~Report()
{
    std::vector<std::pair<Kind, const std::string*>> kinds;
    for (const auto& [message, kind] : kinds_) kinds.emplace_back(kind, &message);
    std::sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.first.first < b.first.first; });
    for (const auto& [kind, message] : kinds) {
        const std::string times = kind.times == 1 ? "" : " (" + std::to_string(kind.times) + " times, first here)";
        notes_.push_back({*message + times, source_.locate(kind.first)});
    }
}

void Report::note(std::string message, std::size_t offset)
{
    if (silent_ > 0) return;
    if (++single_ > kMostSingleNotes) return count("more of the drawing is faulty", offset);
    notes_.push_back({std::move(message), source_.locate(offset)});
}

void Report::count(std::string_view message, std::size_t offset)
{
    if (silent_ > 0) return;
    const auto found = kinds_.find(message);
    Kind& kind =
        found != kinds_.end() ? found->second : kinds_.emplace(std::string(message), Kind{offset, 0}).first->second;
    ++kind.times;
    kind.first = std::min(kind.first, offset);
}

}  // namespace jet::svg
