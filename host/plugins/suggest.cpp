#include "suggest.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace jet::host {

namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Optimal string alignment distance (letters added, left out, changed, or swapped with the next), without regard to
/// case.
std::size_t distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before.swap(last);
        last.swap(row);
    }
    return last[b.size()];
}

}  // namespace

std::string nearestWord(std::string_view written, const std::vector<std::string>& known)
{
    std::string best;
    std::size_t least = std::max<std::size_t>(1, written.size() / 3) + 1;
    if (written.size() > 200) return {};
    for (const std::string& word : known) {
        if (word == written) continue;
        if (const std::size_t changes = distance(written, word); changes < least) least = changes, best = word;
    }
    return best;
}

std::string didYouMean(std::string_view written, const std::vector<std::string>& known)
{
    const std::string best = nearestWord(written, known);
    return best.empty() ? std::string() : "; did you mean '" + best + "'?";
}

}  // namespace jet::host
